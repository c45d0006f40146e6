#include "sim/file.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/plain_text.hpp"
#include "base/text.hpp"

namespace drycut::sim {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Vendors' editors export UTF-16, with its mark. Nullopt if it is broken.
std::optional<std::string> from_utf16(std::string text) {
  const auto converter = iconv_open("UTF-8", "UTF-16");
  std::string result(2 * text.size(), '\0');  // a unit of two bytes becomes three at most
  auto* in = text.data();
  auto* out = result.data();
  auto in_left = text.size();
  auto out_left = result.size();
  const bool sound = iconv(converter, &in, &in_left, &out, &out_left) != static_cast<std::size_t>(-1);
  iconv_close(converter);
  result.resize(result.size() - out_left);
  return sound ? std::optional(std::move(result)) : std::nullopt;
}

/// A text as an editor saved it, as the readers want it: without its mark. A problem if it is no plain text.
std::optional<std::string> plain(std::string text, const fs::path& file, Problems& problems) {
  const auto refuse = [&](int line, int column, const std::string& what) {
    problems.push_back(
        {"file.not-text"_code, file.string(), line, column, what, "save it as plain text in UTF-8"});
    return std::nullopt;
  };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    auto converted = from_utf16(std::move(text));
    if (!converted) return refuse(1, 1, "this is broken UTF-16");
    text = std::move(*converted);
  }
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  const auto fault = text_fault(text);
  if (!fault) return text;
  return refuse(fault->line, fault->column, fault->what);
}

FileSet::File from_disk(const fs::path& file, std::uintmax_t largest) {
  using State = FileSet::State;
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) return {State::missing, ""};
  if (fs::is_directory(status)) return {State::folder, ""};
  if (!fs::is_regular_file(status)) return {State::irregular, ""};
  if (fs::file_size(file, error) > largest) return {State::large, ""};
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream && !stream.eof()) return {State::unreadable, ""};
  return {State::present, std::move(bytes).str()};
}

std::vector<fs::path> from_folder(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

thread_local FileSet* files_in_use = nullptr;

FileSet::File fetch(const fs::path& file, std::uintmax_t largest) {
  return files_in_use != nullptr ? files_in_use->file(file, largest) : from_disk(file, largest);
}

}  // namespace

FileSet::File FileSet::file(const fs::path& name, std::uintmax_t largest) {
  const std::lock_guard lock(mutex_);
  const auto known = files.find(name.string());
  if (known != files.end()) return known->second;
  if (sealed_) throw std::logic_error(fmt::format("{} is read, but was not staged", name.string()));
  auto found = from_disk(name, largest);
  if (found.state == State::missing && name.has_parent_path())
    files.emplace(name.parent_path().string(), from_disk(name.parent_path(), largest));
  return files.emplace(name.string(), std::move(found)).first->second;
}

std::vector<fs::path> FileSet::files_in(const fs::path& folder) {
  const std::lock_guard lock(mutex_);
  auto known = folders.find(folder.string());
  if (known == folders.end()) {
    if (sealed_) throw std::logic_error(fmt::format("{} is read, but was not staged", folder.string()));
    known = folders.emplace(folder.string(), std::vector<std::string>()).first;
    for (const auto& file : from_folder(folder)) known->second.push_back(file.string());
  }
  return {known->second.begin(), known->second.end()};
}

std::size_t FileSet::size() const {
  const std::lock_guard lock(mutex_);
  return files.size() + folders.size();
}

UseFiles::UseFiles(FileSet& files) : before_(std::exchange(files_in_use, &files)) {}
UseFiles::~UseFiles() { files_in_use = before_; }

bool file_exists(const fs::path& file) { return fetch(file, largest_input).state != FileSet::State::missing; }
// A set keeps what it found: a file that is asked for here is read next.
bool folder_exists(const fs::path& folder) {
  return fetch(folder, largest_input).state == FileSet::State::folder;
}

std::vector<fs::path> files_in(const fs::path& folder, std::string_view extension) {
  auto files = files_in_use != nullptr ? files_in_use->files_in(folder) : from_folder(folder);
  std::erase_if(files, [&](const fs::path& file) { return file.extension() != extension; });
  return files;
}

namespace {

/// What to do about a file that is not there: its folder may have one of nearly its name.
std::string instead_of(const fs::path& file, bool names_itself) {
  const auto folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::vector<std::string> names;
  for (const auto& other : files_in_use != nullptr ? files_in_use->files_in(folder) : from_folder(folder))
    names.push_back(other.filename().string());
  return did_you_mean(
      file.filename().string(), names,
      names_itself ? "check the path" : "check the path; it is relative to the file that names it");
}

}  // namespace

std::optional<std::string> read_file(const fs::path& file, Problems& problems, std::uintmax_t largest) {
  return read_file(file, problems, {file.string(), 1, 1}, largest);
}

std::optional<std::string> read_bytes(const fs::path& file, Problems& problems, const NamedAt& where,
                                      std::uintmax_t largest) {
  const auto problem = [&](Code code, const std::string& what, const std::string& remedy) {
    problems.push_back({code, where.file, where.line, where.column, what, remedy});
    return std::nullopt;
  };
  auto found = fetch(file, largest);
  switch (found.state) {
    case FileSet::State::missing:
      return problem("file.missing"_code, fmt::format("there is no file {}", file.string()),
                     instead_of(file, where.file == file.string()));
    case FileSet::State::folder:
    case FileSet::State::irregular:
      return problem("file.not-regular"_code, fmt::format("{} is not a regular file", file.string()),
                     "name a text file");
    case FileSet::State::large:
      return problem("file.too-large"_code,
                     fmt::format("{} is larger than {} MiB", file.string(), largest >> 20U),
                     "name a text file of a program or scenario");
    case FileSet::State::unreadable:
      return problem("file.unreadable"_code, fmt::format("{} cannot be read", file.string()),
                     "check its permissions");
    case FileSet::State::present:
      break;
  }
  return std::move(found.bytes);
}

std::optional<std::string> read_file(const fs::path& file, Problems& problems, const NamedAt& where,
                                     std::uintmax_t largest) {
  auto bytes = read_bytes(file, problems, where, largest);
  return bytes ? plain(std::move(*bytes), file, problems) : std::nullopt;
}

}  // namespace drycut::sim
