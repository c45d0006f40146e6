#pragma once
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace drycut {

/// What went wrong, in words: of a std::filesystem::filesystem_error the file and the reason.
std::string words_of(const std::exception& error);

/// Why a file cannot be written, "" if nothing is known against it: it or its folder is read-only, or it is a
/// directory, or a FIFO that nobody reads. That there is no such folder is for others to tell.
std::string hindrance(const std::filesystem::path& file);
/// Why nothing can be made in a folder that is there: "Read-only file system"; "" if nothing is known.
std::string hindrance_in(const std::filesystem::path& folder);

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

/// Writes all bytes to an open descriptor, also where a signal comes in between. Throws std::runtime_error
/// with the reason.
void write_all(int descriptor, std::span<const std::byte> bytes);

}  // namespace drycut
