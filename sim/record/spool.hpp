#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace drycut::sim::record {

/// A file without a name for what would fill the memory; it is gone when the program ends, however it ends.
class Spool {
 public:
  Spool() = default;
  ~Spool();
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  /// The folder of the file, which is made at the first write; else it is the system's temporary one.
  void lies_in(std::filesystem::path folder) { folder_ = std::move(folder); }
  /// Appends and returns where. Throws std::runtime_error if there is no room.
  std::int64_t write(const void* bytes, std::size_t size);
  /// Throws std::runtime_error if it cannot be read back.
  void read(std::int64_t place, void* bytes, std::size_t size) const;

 private:
  void open();

  std::filesystem::path folder_;
  int file_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace drycut::sim::record
