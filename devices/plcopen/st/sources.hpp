#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drycut::devices::plcopen::st {

/// A file of Structured Text.
struct SourceFile {
  std::string name;
  std::string text;
};

/// The lines of all files of a program, counted on from each file to the next: one number says file and line.
class SourceLines {
 public:
  SourceLines() = default;
  explicit SourceLines(std::span<const SourceFile> files);

  struct At {
    std::size_t file = 0;
    int line = 0;  ///< in that file, from 1
  };
  [[nodiscard]] At at(int line) const;
  /// The number of a file's first line.
  [[nodiscard]] int first(std::size_t file) const { return begins_.at(file); }
  /// Of all files.
  [[nodiscard]] int count() const { return end_ - 1; }
  /// "line 5", or where that is another file than that of line `seen_from`, "line 5 of knife.st".
  [[nodiscard]] std::string told(int line, int seen_from) const;

 private:
  std::vector<int> begins_;
  std::vector<std::string> names_;
  int end_ = 1;
};

}  // namespace drycut::devices::plcopen::st
