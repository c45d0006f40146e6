#include "sim/fmi/foreign/archive.hpp"

#include <fmt/format.h>
#include <minizip/unzip.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "sim/scenario/guests.hpp"

namespace drycut::sim::fmi {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_entries = 20000;
constexpr std::size_t most_bytes = std::size_t{1} << 30U;

[[noreturn]] void refuse_archive(const std::string& what) {
  throw scenario::GuestRefused("fmu.archive"_code, what, "export the FMU again");
}

/// No way out of the folder, and nothing that means two things.
bool stays_inside(const std::string& name) {
  if (name.empty() || name.front() == '/' || name.find('\\') != std::string::npos) return false;
  return std::ranges::none_of(fs::path(name), [](const fs::path& part) { return part == ".."; });
}

}  // namespace

OwnFolder::OwnFolder() {
  // The process of an FMU has another folder to work in, and begins the standard's URI with it.
  auto name = fs::absolute(fs::temp_directory_path() / "drycut-fmu-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(fmt::format("cannot make the folder {}", name));
  path_ = name;
}

OwnFolder::~OwnFolder() {
  std::error_code none;
  fs::remove_all(path_, none);
}

FmuArchive::FmuArchive(const std::string& bytes) : zip_(nullptr) {
  // minizip reads files; this one is in memory.
  zlib_filefunc64_def functions{};
  fill_fopen64_filefunc(&functions);
  functions.zopen64_file = [](void* /*opaque*/, const void* in_memory, int /*mode*/) -> void* {
    const auto& of = *static_cast<const std::string*>(in_memory);
    return fmemopen(const_cast<char*>(of.data()), of.size(), "rb");
  };
  zip_ = bytes.empty() ? nullptr : unzOpen2_64(&bytes, &functions);
  if (zip_ == nullptr) refuse_archive("it is no FMU: no zip archive");
  try {
    list();
  } catch (...) {
    unzClose(zip_);
    throw;
  }
}

FmuArchive::~FmuArchive() { unzClose(zip_); }

void FmuArchive::list() {
  constexpr std::size_t least_for_a_bomb = 50'000'000;
  constexpr std::size_t most_times = 200;
  std::size_t packed = 0;
  std::size_t unpacked = 0;
  for (int at = unzGoToFirstFile(zip_); at != UNZ_END_OF_LIST_OF_FILE; at = unzGoToNextFile(zip_)) {
    unz_file_info64 info{};
    std::array<char, 1024> name{};
    if (at != UNZ_OK ||
        unzGetCurrentFileInfo64(zip_, &info, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) != UNZ_OK)
      refuse_archive("its list of files is damaged");
    if (info.size_filename >= name.size() || entries_.size() == most_entries)
      refuse_archive("it has too many files, or too long names");
    const std::string entry(name.data(), info.size_filename);
    if (entry.find('\0') != std::string::npos || !stays_inside(entry))
      refuse_archive("it has a file that would be put elsewhere: '" + std::string(name.data()) + "'");
    packed += info.compressed_size;
    unpacked += info.uncompressed_size;
    if (info.uncompressed_size > most_bytes || unpacked > most_bytes ||
        (unpacked > least_for_a_bomb && unpacked / most_times > packed))
      refuse_archive("it would take more than a gigabyte, or two hundred times its size: it is not unpacked");
    entries_.push_back({entry, static_cast<std::size_t>(info.uncompressed_size)});
  }
}

bool FmuArchive::has(std::string_view name) const {
  return std::ranges::find(entries_, name, &Entry::name) != entries_.end();
}

std::vector<std::string> FmuArchive::names() const {
  std::vector<std::string> names;
  for (const auto& entry : entries_) names.push_back(entry.name);
  return names;
}

std::string FmuArchive::bytes(const std::string& name) const {
  const auto entry = std::ranges::find(entries_, name, &Entry::name);
  if (entry == entries_.end()) refuse_archive("it has no " + name);
  return read(*entry);
}

std::string FmuArchive::read(const Entry& entry) const {
  constexpr int exactly = 1;
  if (unzLocateFile(zip_, entry.name.c_str(), exactly) != UNZ_OK || unzOpenCurrentFile(zip_) != UNZ_OK)
    refuse_archive(entry.name + " cannot be unpacked");
  std::string bytes(entry.size, '\0');
  std::size_t at = 0;
  int got = 1;
  while (at < bytes.size() && got > 0) {
    const auto piece = std::min<std::size_t>(bytes.size() - at, std::size_t{1} << 24U);
    got = unzReadCurrentFile(zip_, bytes.data() + at, static_cast<unsigned>(piece));
    if (got > 0) at += static_cast<std::size_t>(got);
  }
  char more = 0;
  const bool whole = at == bytes.size() && unzReadCurrentFile(zip_, &more, 1) == 0;
  if (unzCloseCurrentFile(zip_) != UNZ_OK || !whole)
    refuse_archive(entry.name + " is damaged: it has another length or sum than the archive says");
  return bytes;
}

void FmuArchive::unpack(const std::vector<std::string>& prefixes, const fs::path& folder) const {
  for (const auto& entry : entries_) {
    const bool wanted = std::ranges::any_of(
        prefixes, [&](const std::string& prefix) { return entry.name.starts_with(prefix); });
    if (!wanted || entry.name.ends_with('/')) continue;
    const auto file = folder / entry.name;
    fs::create_directories(file.parent_path());
    std::ofstream out(file, std::ios::binary);
    out << read(entry);
    if (!out.flush()) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
  }
}

}  // namespace drycut::sim::fmi
