#include "sim/record/recording.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace drycut::sim::record {

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& folder) {
  throw std::runtime_error(fmt::format("cannot {} what is recorded in {}: {}", what, folder.string(),
                                       errno == 0 ? "it is cut short" : std::strerror(errno)));
}

}  // namespace

Spool::~Spool() {
  if (file_ >= 0) close(file_);
}

void Spool::open() {
  if (folder_.empty()) folder_ = std::filesystem::temp_directory_path();
  file_ = ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file_ >= 0) return;
  // A file system that knows no files without a name.
  auto name = (folder_ / "drycut-XXXXXX").string();
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) fail("keep", folder_);
  unlink(name.c_str());
}

std::int64_t Spool::write(const void* bytes, std::size_t size) {
  if (file_ < 0) open();
  const auto place = size_;
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0) {
    errno = 0;
    const auto written = pwrite(file_, from, size, size_);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("keep", folder_);
    from += written;
    size -= static_cast<std::size_t>(written);
    size_ += written;
  }
  return place;
}

void Spool::read(std::int64_t place, void* bytes, std::size_t size) const {
  auto* to = static_cast<char*>(bytes);
  while (size > 0) {
    errno = 0;
    const auto got = pread(file_, to, size, place);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("read back", folder_);
    to += got;
    size -= static_cast<std::size_t>(got);
    place += got;
  }
}

}  // namespace drycut::sim::record
