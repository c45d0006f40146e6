#include "sim/file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace drycut::sim {

namespace {

constexpr std::uintmax_t largest_input = 16U << 20U;  // [bytes]; programs and scenarios are kilobytes

}  // namespace

std::optional<std::string> read_file(const std::filesystem::path& file, devices::Problems& problems) {
  return read_file(file, problems, {file.string(), 1, 1, "", ""});
}

std::optional<std::string> read_file(const std::filesystem::path& file, devices::Problems& problems,
                                     const devices::Problem& where) {
  const auto problem = [&](const std::string& what, const std::string& remedy) {
    problems.push_back({where.file, where.line, where.column, what, remedy});
    return std::nullopt;
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return problem(fmt::format("there is no file {}", file.string()),
                   where.file == file.string() ? "check the path"
                                               : "check the path; it is relative to the file that names it");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return problem(fmt::format("{} is not a regular file", file.string()), "name a text file");
  }
  if (std::filesystem::file_size(file, error) > largest_input) {
    return problem(fmt::format("{} is larger than 16 MiB", file.string()),
                   "name a text file of a program or scenario");
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream && !stream.eof()) {
    return problem(fmt::format("{} cannot be read", file.string()), "check its permissions");
  }
  return text.str();
}

OutputFile::OutputFile(std::filesystem::path file)
    : file_(std::move(file)), temporary_(file_.string() + ".part"), stream_(temporary_, std::ios::binary) {
  if (!stream_)
    throw std::runtime_error(fmt::format("cannot write {}: {}", temporary_.string(), std::strerror(errno)));
}

OutputFile::~OutputFile() {
  if (finished_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream_)
    throw std::runtime_error(fmt::format("cannot write {}: {}", temporary_.string(), std::strerror(errno)));
}

void OutputFile::finish() {
  stream_.close();
  if (!stream_)
    throw std::runtime_error(fmt::format("cannot write {}: {}", temporary_.string(), std::strerror(errno)));
  std::filesystem::rename(temporary_, file_);
  finished_ = true;
}

}  // namespace drycut::sim
