#include "base/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace drycut {

namespace fs = std::filesystem;

namespace {

std::string last_error() { return std::strerror(errno); }

}  // namespace

std::string words_of(const std::exception& error) {
  const auto* const of_files = dynamic_cast<const fs::filesystem_error*>(&error);
  if (of_files == nullptr) return error.what();
  const auto& file = of_files->path2().empty() ? of_files->path1() : of_files->path2();
  return fmt::format("{}: {}", file.string(), of_files->code().message());
}

std::string hindrance_in(const fs::path& folder) {
  const auto* const name = folder.empty() ? "." : folder.c_str();
  const bool unknown = access(name, W_OK | X_OK) == 0 || errno == ENOENT || errno == ENOTDIR;
  return unknown ? "" : last_error();
}

std::string hindrance(const fs::path& file) {
  // What is regular is written beside its place, and takes it when it is whole.
  const auto in_folder = [](const fs::path& place) {
    const auto why = hindrance_in(place.parent_path());
    return why.empty() ? "" : "nothing can be made in its folder: " + why;
  };
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) return in_folder(file);
  if (S_ISDIR(found.st_mode)) return "it is a directory";
  constexpr auto writable = S_IWUSR | S_IWGRP | S_IWOTH;
  // The administrator may write everything; what was made read-only is still not to be replaced.
  if (S_ISREG(found.st_mode) && ((found.st_mode & writable) == 0 || access(file.c_str(), W_OK) != 0))
    return "it is read-only";
  if (S_ISREG(found.st_mode)) {
    std::error_code ignored;
    return in_folder(fs::canonical(file, ignored));
  }
  if (!S_ISFIFO(found.st_mode)) return "";
  const int reader = open(file.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (reader < 0) return errno == ENXIO ? "nobody reads from this FIFO" : last_error();
  close(reader);
  return "";
}

OutputFile::OutputFile(fs::path file) : file_(std::move(file)) {
  if (const auto why = hindrance(file_); !why.empty())
    throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(), why));
  std::error_code ignored;
  const auto status = fs::status(file_, ignored);
  const bool dangling = !fs::exists(status) && fs::is_symlink(fs::symlink_status(file_, ignored));
  if (fs::is_regular_file(status)) file_ = fs::canonical(file_);
  if (!dangling && (fs::is_regular_file(status) || !fs::exists(status)))
    temporary_ = file_.string() + ".part";
  stream_ = std::fopen(temporary_.empty() ? file_.c_str() : temporary_.c_str(), "wbe");
  require(stream_ != nullptr);
  struct stat old {};
  if (temporary_.empty() || stat(file_.c_str(), &old) != 0) return;
  fchmod(fileno(stream_), old.st_mode);  // the new one stays as open, or closed, to others as the old one
}

OutputFile::~OutputFile() {
  if (stream_ != nullptr) std::fclose(stream_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void OutputFile::require(bool good) const {
  if (!good) throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(), last_error()));
}

void OutputFile::write(std::string_view text) {
  require(std::fwrite(text.data(), 1, text.size(), stream_) == text.size());
}

void OutputFile::finish() {
  require(std::fclose(std::exchange(stream_, nullptr)) == 0);
  require(temporary_.empty() || std::rename(temporary_.c_str(), file_.c_str()) == 0);
  temporary_.clear();
}

void write_file(const fs::path& file, std::string_view text) {
  OutputFile out(file);
  out.write(text);
  out.finish();
}

void write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw std::runtime_error(last_error());
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace drycut
