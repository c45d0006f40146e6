#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/output_file.hpp"
#include "base/problem.hpp"

namespace drycut::sim {

/// Programs and scenarios are kilobytes; what is larger is none [bytes].
inline constexpr std::uintmax_t largest_input = 16U << 20U;

/// Files by the names under which they are read, each read from the disk once: a study sees one state of
/// them, and whoever does its work elsewhere can be given all that it read. Safe to use from several threads.
class FileSet {
 public:
  enum class State { present, missing, folder, irregular, large, unreadable };
  struct File {
    State state = State::missing;
    std::string bytes;  ///< of one that is present
  };
  /// Of a file that is missing it is known besides whether its folder is there. Throws std::logic_error if it
  /// is sealed and has no such file.
  File file(const std::filesystem::path& name, std::uintmax_t largest);
  /// The files in a folder, by name; likewise.
  std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);
  /// From now on nothing comes from the disk.
  void seal() { sealed_ = true; }

  /// How many names are known: more than before = there is something new.
  [[nodiscard]] std::size_t size() const;

  std::map<std::string, File> files = {};
  std::map<std::string, std::vector<std::string>> folders = {};

 private:
  mutable std::mutex mutex_;
  bool sealed_ = false;
};

/// While it lives, this thread reads files through a set.
class UseFiles {
 public:
  explicit UseFiles(FileSet& files);
  ~UseFiles();
  UseFiles(const UseFiles&) = delete;
  UseFiles& operator=(const UseFiles&) = delete;

 private:
  FileSet* before_;
};

/// Whether there is something of that name, or a folder.
bool file_exists(const std::filesystem::path& file);
bool folder_exists(const std::filesystem::path& folder);
/// The files in a folder that end in `extension`, by name; none if there is no such folder.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, std::string_view extension);

/// The text of a file, without a byte-order mark. Everything that is read as text is read by this function.
/// If it cannot be read, that is a problem at the place that names it: `where` gives file, line and column.
/// What is no UTF-8, or a control character, is a problem at its own place in the file.
std::optional<std::string> read_file(const std::filesystem::path& file, Problems& problems,
                                     const NamedAt& where, std::uintmax_t largest = largest_input);
/// The same for a file that the command line names: the place is the file's own beginning.
std::optional<std::string> read_file(const std::filesystem::path& file, Problems& problems,
                                     std::uintmax_t largest = largest_input);
/// The bytes of a file that is no text: an FMU.
std::optional<std::string> read_bytes(const std::filesystem::path& file, Problems& problems,
                                      const NamedAt& where, std::uintmax_t largest);

}  // namespace drycut::sim
