#pragma once
#include <cstddef>
#include <memory>
#include <string>

namespace drycut::sim::record {

/// Makes of numbers what HDF5's filters shuffle and deflate make of them: byte planes, all first bytes, all
/// second ones and so on, in the format of zlib. Planes that do not repeat themselves, as the last digits of
/// what is measured, are stored as they are, which is twice as fast as to try.
class Deflate {
 public:
  Deflate();
  ~Deflate();
  Deflate(const Deflate&) = delete;
  Deflate& operator=(const Deflate&) = delete;
  /// Of `count` numbers; lasts until the next call.
  const std::string& operator()(const double* numbers, std::size_t count);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::string planes_;
  std::string out_;
};

}  // namespace drycut::sim::record
