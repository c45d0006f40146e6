#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/problem.hpp"

namespace drycut::sim {

/// Programs and scenarios are kilobytes; what is larger is none [bytes].
inline constexpr std::uintmax_t largest_input = 16U << 20U;

/// The text of a file, without a byte-order mark. Everything that is read as text is read by this function.
/// If it cannot be read, that is a problem at the place that names it: `where` gives file, line and column.
/// What is no UTF-8, or a control character, is a problem at its own place in the file.
std::optional<std::string> read_file(const std::filesystem::path& file, Problems& problems,
                                     const Problem& where, std::uintmax_t largest = largest_input);
/// The same for a file that the command line names: the place is the file's own beginning.
std::optional<std::string> read_file(const std::filesystem::path& file, Problems& problems,
                                     std::uintmax_t largest = largest_input);

/// Why a file cannot be written, "" if nothing is known against it: it is read-only, or a directory, or a
/// FIFO that nobody reads.
std::string hindrance(const std::filesystem::path& file);

/// A file that is written. A regular file, or one that is not there yet, is written under a temporary name
/// and takes its own when finished, so that no reader ever sees half of it; a link stays, what it leads to is
/// replaced. A device or a FIFO is written into as it is. Throws std::runtime_error when something cannot be
/// written.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  void write(std::string_view text);
  void finish();

 private:
  void require(bool good) const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;  ///< "" = written as it is, or finished
  std::FILE* stream_ = nullptr;
};

/// Writes a whole file so.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace drycut::sim
