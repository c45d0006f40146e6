#pragma once
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "devices/problem.hpp"

namespace drycut::sim {

/// The text of a file. If it cannot be read, that is a problem at the place that names it: `where` gives
/// file, line and column.
std::optional<std::string> read_file(const std::filesystem::path& file, devices::Problems& problems,
                                     const devices::Problem& where);
/// The same for a file that the command line names: the place is the file's own beginning.
std::optional<std::string> read_file(const std::filesystem::path& file, devices::Problems& problems);

/// A file written under a temporary name that takes its own name when finished: no reader ever sees half of
/// it. Throws std::runtime_error when something cannot be written.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  void write(std::string_view text);
  void finish();

 private:
  std::filesystem::path file_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool finished_ = false;
};

}  // namespace drycut::sim
