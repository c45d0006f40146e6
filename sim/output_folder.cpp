#include "sim/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>

#include "sim/file.hpp"

namespace drycut::sim {

namespace fs = std::filesystem;

namespace {

enum class Locked { yes, by_another };

/// An exclusive lock on a folder, given back by the last owner of `held` and by the end of the process,
/// however it ends. Nothing is left in the folder.
Locked lock_folder(const fs::path& folder, std::shared_ptr<void>& held) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return Locked::yes;  // writing into it will tell what is wrong
  held = std::shared_ptr<void>(nullptr, [descriptor](void*) { close(descriptor); });
  // A file system that knows no locks protects nobody: that is no reason not to write there.
  const bool taken = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  return taken ? Locked::by_another : Locked::yes;
}

/// Makes a folder. The folders that were not there go again with the last owner of what is returned, if
/// nothing has come into them.
std::shared_ptr<void> make_folder(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> made;
  std::error_code ignored;
  for (auto path = fs::absolute(folder, ignored).lexically_normal();
       !path.empty() && !fs::exists(fs::symlink_status(path, ignored)); path = path.parent_path())
    made.push_back(path);
  fs::create_directories(folder, error);
  return {nullptr, [made](void*) {
            std::error_code not_empty;
            for (const auto& path : made) fs::remove(path, not_empty);
          }};
}

/// What a manifest lists; lines that lead out of the folder are not believed.
std::set<std::string> read_manifest(const fs::path& manifest) {
  std::set<std::string> names;
  std::ifstream stream(manifest);
  for (std::string line; std::getline(stream, line);) {
    const fs::path name = line;
    const bool inside = name.is_relative() && name.lexically_normal() == name && *name.begin() != "..";
    if (!line.empty() && line.front() != '#' && inside) names.insert(line);
  }
  return names;
}

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  const auto shown = std::min(most, names.size());
  auto text = fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<long>(shown), ", "));
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

void require(bool good, const std::string& what, const fs::path& file, const std::error_code& why) {
  if (!good) throw std::runtime_error(fmt::format("cannot {} {}: {}", what, file.string(), why.message()));
}

/// Removes the folders that these files were in, as far as nothing stands in them.
void remove_emptied(const fs::path& folder, const std::set<std::string>& files) {
  std::set<fs::path, std::greater<>> inside;  // the inner ones first
  for (const auto& name : files)
    for (auto parent = fs::path(name).parent_path(); !parent.empty(); parent = parent.parent_path())
      inside.insert(folder / parent);
  std::error_code not_empty;
  for (const auto& place : inside) fs::remove(place, not_empty);
}

std::error_code last_error() { return {errno, std::generic_category()}; }

}  // namespace

OutputFolder::OutputFolder(fs::path folder, const std::string& kind, const std::vector<std::string>& names,
                           Problems& problems)
    : folder_(std::move(folder)), manifest_(folder_ / (".drycut-" + kind)), kind_(kind) {
  const auto refuse = [&](Code code, const std::string& what, const std::string& remedy) {
    problems.push_back({code, "--out", 1, 1, what, remedy});
  };
  std::error_code error;
  made_ = make_folder(folder_, error);
  if (folder_.empty() || error || !fs::is_directory(folder_)) {
    refuse("file.not-writable"_code,
           fmt::format("the directory {} cannot be made{}{}", folder_.string(), error ? ": " : "",
                       error ? error.message() : ""),
           "name one that can be written");
    return;
  }
  if (const auto why = hindrance_in(folder_); !why.empty()) {
    refuse("file.not-writable"_code, fmt::format("nothing can be written into {}: {}", folder_.string(), why),
           "name one that can be written");
    return;
  }
  if (lock_folder(folder_, lock_) == Locked::by_another) {
    refuse("file.in-use"_code, fmt::format("another drycut is writing into {}", folder_.string()),
           "let it end first, or name another folder");
    return;
  }
  listed_ = read_manifest(manifest_);
  if (const auto found = strangers(names); !found.empty()) {
    refuse("file.not-ours"_code,
           fmt::format("in {} stands what no earlier {} wrote: {}", folder_.string(), kind_, some_of(found)),
           "name another folder, or move it away");
  }
}

bool OutputFolder::is_ours(const fs::path& file) const {
  const auto name = file.lexically_relative(folder_);
  std::error_code ignored;
  // What lies behind a link in our folder is somebody else's.
  const auto place = fs::canonical(folder_, ignored) / name;
  return listed_.contains(name.string()) && fs::canonical(file.parent_path(), ignored) == place.parent_path();
}

std::vector<std::string> OutputFolder::strangers(const std::vector<std::string>& names) const {
  std::vector<std::string> found;
  const auto look_at = [&](const fs::path& file) {
    if (!is_ours(file)) found.push_back(file.lexically_relative(folder_).string());
  };
  for (const auto& name : names) {
    std::error_code ignored;
    const bool is_folder = name.back() == '/';
    const auto place = folder_ / (is_folder ? name.substr(0, name.size() - 1) : name);
    const auto status = fs::symlink_status(place, ignored);
    if (!fs::exists(status)) continue;
    if (is_folder && fs::is_directory(status)) {
      for (const auto& entry : fs::recursive_directory_iterator(place, ignored))
        if (!entry.is_directory(ignored) || entry.is_symlink(ignored)) look_at(entry.path());
    } else if (fs::is_directory(status)) {
      found.push_back(name);
    } else {
      look_at(place);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void OutputFolder::remove(const std::set<std::string>& names) {
  for (const auto& name : names) {
    const auto file = folder_ / name;
    if (!is_ours(file)) continue;
    std::error_code error;
    fs::remove(file, error);
    require(!error, "remove", file, error);
    fs::remove(file.string() + ".part", error);  // of a run that was killed
  }
  remove_emptied(folder_, names);
}

void OutputFolder::write_manifest(const std::set<std::string>& names) {
  auto text =
      fmt::format("# Written by drycut ({}). The next one removes these files and no others.\n", kind_);
  for (const auto& name : names) text += name + '\n';
  write_file(manifest_, text);
  listed_ = names;
}

void OutputFolder::take_back(const std::vector<std::string>& names) {
  if (names.empty()) return;
  remove({names.begin(), names.end()});
  auto staying = listed_;
  for (const auto& name : names) staying.erase(name);
  write_manifest(staying);
}

// The manifest keeps the old name until it is next written whole: that nothing lies there does no harm.
fs::path OutputFolder::reuse(const std::string& file, const std::string& name) {
  std::error_code error;
  fs::rename(folder_ / file, folder_ / name, error);
  require(!error, "write", folder_ / name, error);
  listed_.erase(file);
  list({name});
  return folder_ / name;
}

void OutputFolder::begin(const std::vector<std::string>& kept) {
  std::set<std::string> staying;
  std::set<std::string> going;
  for (const auto& name : listed_)
    (std::find(kept.begin(), kept.end(), name) != kept.end() ? staying : going).insert(name);
  remove(going);
  write_manifest(staying);
}

void OutputFolder::begin_aside(const std::vector<std::string>& kept) {
  aside_ = fmt::format(".{}-to-come/", kind_);
  kept_ = {kept.begin(), kept.end()};
  std::vector<std::string> staying;  // but what one that was killed has left waiting
  for (const auto& name : listed_)
    if (!name.starts_with(aside_)) staying.push_back(name);
  begin(staying);
  // What does not come to finish() makes room again with the last owner; nothing waits behind finish().
  made_ = {nullptr, [folder = folder_, manifest = manifest_, aside = aside_, earlier = made_](void*) {
             std::error_code ignored;
             std::set<std::string> waiting;
             for (const auto& name : read_manifest(manifest))
               if (name.starts_with(aside)) waiting.insert(name);
             for (const auto& name : waiting) {
               fs::remove(folder / name, ignored);
               fs::remove((folder / name).string() + ".part", ignored);
             }
             remove_emptied(folder, waiting);
           }};
}

void OutputFolder::finish() {
  std::set<std::string> staying = waiting_;
  std::set<std::string> going;
  for (const auto& name : listed_) {
    const bool stays = waiting_.contains(name) || kept_.contains(name);
    (stays ? staying : going).insert(name);
  }
  for (const auto& name : waiting_) {
    std::error_code error;
    fs::create_directories((folder_ / name).parent_path(), error);
    if (!error) fs::rename(folder_ / aside_ / name, folder_ / name, error);
    require(!error, "write", folder_ / name, error);
  }
  remove(going);
  write_manifest(staying);
  aside_.clear();
  waiting_.clear();
}

std::vector<std::string> OutputFolder::files() const {
  std::vector<std::string> files;
  for (const auto& name : listed_)
    if (aside_.empty() || waiting_.contains(name) || kept_.contains(name)) files.push_back(name);
  return files;
}

void OutputFolder::list(const std::vector<std::string>& names) {
  std::ofstream stream(manifest_, std::ios::app);
  for (const auto& name : names) {
    if (!listed_.insert(name).second) continue;
    stream << name << '\n';
  }
  stream.flush();
  require(stream.good(), "write", manifest_, last_error());
}

fs::path OutputFolder::add(const std::string& name) {
  const fs::path file = name;
  return add(file.parent_path().string(), {file.filename().string()}) / file.filename();
}

fs::path OutputFolder::add(const std::string& subfolder, const std::vector<std::string>& names) {
  const auto inside = [&](const std::string& name) {
    return subfolder.empty() ? name : fmt::format("{}/{}", subfolder, name);
  };
  const bool waits = !aside_.empty() && !(names.size() == 1 && kept_.contains(inside(names[0])));
  auto place = folder_ / (waits ? aside_ : "") / subfolder;
  std::error_code error;
  fs::create_directories(place, error);
  require(!error, "make", place, error);
  std::vector<std::string> files;
  for (const auto& name : names) {
    const auto own = inside(name);
    for (const auto& listed : {own, aside_ + own}) {
      if (listed_.contains(listed) || !fs::exists(fs::symlink_status(folder_ / listed, error))) continue;
      throw std::runtime_error(
          fmt::format("{} is in the way: no earlier {} wrote it", (folder_ / listed).string(), kind_));
    }
    files.push_back(own);
    if (!waits) continue;
    files.push_back(aside_ + own);
    waiting_.insert(own);
  }
  list(files);
  return place;
}

}  // namespace drycut::sim
