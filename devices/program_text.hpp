#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

// What one sees of a controller's programs while they run.
namespace drycut::devices {

/// A text that a controller runs, or is set up by.
struct ProgramText {
  std::string name;      ///< the file's, without its folder
  std::string file;      ///< as messages name it
  std::string language;  ///< "qcl", "cnf", "il", "st"
  std::string text;      ///< UTF-8
  /// What of Controller::find() each line names, by the line's number from 1, in its order.
  std::map<int, std::vector<std::string>> values = {};

  ProgramText(const std::string& in_file, std::string in_language, std::string of)
      : name(in_file.substr(in_file.find_last_of("/\\") + 1)),
        file(in_file),
        language(std::move(in_language)),
        text(std::move(of)) {}
  /// A line names a value, once.
  void add_value(int line, const std::string& value) {
    auto& names = values[line];
    if (std::find(names.begin(), names.end(), value) == names.end()) names.push_back(value);
  }
};

/// A place at which a program stands until something comes, or for ever.
struct ProgramWait {
  std::string program;        ///< ProgramText::name
  int line = 0;               ///< from 1
  std::int64_t since_ns = 0;  ///< it has stood there all the time
  bool ended = false;         ///< it came to its end: nothing comes any more
};

/// What programs do at a moment.
struct ProgramPositions {
  /// Where one of them stands.
  struct Task {
    std::string name;
    std::size_t program = 0;      ///< of Controller::programs()
    int line = 0;                 ///< from 1; 0: nowhere, as between two scans
    std::string doing;            ///< "waits", "runs", "ended", "error 6: division by zero"
    std::vector<int> calls = {};  ///< lines of the calls that led there, the outermost first
  };
  std::vector<Task> tasks;
  /// For each program what its last scan did, a letter a line: '+' executed, with power or with a condition
  /// that held; '-' come by, without; ' ' not come by. "" of what is not scanned, or was not watched yet.
  std::vector<std::string> scanned;
};

}  // namespace drycut::devices
