#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace drycut::sim::fmi {

/// A folder of its own under that of temporary files, gone with the object.
class OwnFolder {
 public:
  OwnFolder();
  ~OwnFolder();
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The zip archive that an FMU is. Names that lead out of the folder, more than a gigabyte, and what takes
/// two hundred times its room are refused before anything is unpacked. Everything throws
/// scenario::GuestRefused.
class FmuArchive {
 public:
  /// `bytes` outlive it.
  explicit FmuArchive(const std::string& bytes);
  ~FmuArchive();
  FmuArchive(const FmuArchive&) = delete;
  FmuArchive& operator=(const FmuArchive&) = delete;

  [[nodiscard]] bool has(std::string_view name) const;
  /// The names of its files, with their folders.
  [[nodiscard]] std::vector<std::string> names() const;
  /// The bytes of an entry.
  [[nodiscard]] std::string bytes(const std::string& name) const;
  /// Writes what begins with one of `prefixes` into `folder`.
  void unpack(const std::vector<std::string>& prefixes, const std::filesystem::path& folder) const;

 private:
  struct Entry {
    std::string name;
    std::size_t size;
  };
  void list();
  [[nodiscard]] std::string read(const Entry& entry) const;

  void* zip_;
  std::vector<Entry> entries_;
};

}  // namespace drycut::sim::fmi
