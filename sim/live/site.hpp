#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace drycut::sim::live {

/// What the page of a live line is made of: its own files, which are built into the program (live*.* and
/// view*.* of renders/assets), and three.js, from the folder where its package (libjs-three) puts it. Where
/// that is not installed its files are empty, and the page says what is missing.
class Site {
 public:
  explicit Site(const std::filesystem::path& three = "/usr/share/javascript/three");

  struct File {
    const char* type;  ///< as HTTP calls it
    std::string_view bytes;
  };
  /// "/" and what it names; nullopt if there is nothing of that name.
  [[nodiscard]] std::optional<File> find(std::string_view path) const;

 private:
  std::map<std::string, std::string, std::less<>> three_;  ///< by path
};

}  // namespace drycut::sim::live
