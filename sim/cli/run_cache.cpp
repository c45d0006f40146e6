#include "sim/cli/run_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "base/json.hpp"
#include "base/text.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/record/json.hpp"

namespace drycut::sim::cli {

namespace fs = std::filesystem;

namespace {

constexpr auto* entry_file = "entry.json";

std::string digits(std::uint64_t fingerprint) { return fmt::format("{:016x}", fingerprint); }

std::string fingerprint_of(std::string_view text) {
  loop::Fingerprint hash;
  hash.add(text);
  return digits(hash.value());
}

/// Of a file's bytes; "" if it cannot be read to its end.
std::string fingerprint_of_file(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return "";  // a FIFO would be waited for
  loop::Fingerprint hash;
  std::ifstream stream(file, std::ios::binary);
  std::string block(std::size_t{1} << 16U, '\0');
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0)
    hash.add(std::string_view(block).substr(0, static_cast<std::size_t>(stream.gcount())));
  return stream.eof() ? digits(hash.value()) : "";
}

fs::path program_in_path(const char* name) {
  const auto* all = std::getenv("PATH");
  std::error_code ignored;
  for (const auto& folder : split_words(all == nullptr ? "" : all, {}, ":"))
    if (auto file = fs::path(folder.text) / name; fs::is_regular_file(file, ignored)) return file;
  return {};
}

/// What the report takes from the machine that it is made on.
Json helpers() {
  Json files;
  const fs::path scripts = "/usr/share/javascript";
  for (const auto& file :
       {scripts / "dygraphs/dygraph.min.js", scripts / "dygraphs/dygraph.min.css",
        scripts / "three/three.min.js", scripts / "three/examples/js/loaders/GLTFLoader.js",
        scripts / "three/examples/js/controls/OrbitControls.js", program_in_path("ffmpeg")})
    if (!file.empty()) files[file.string()] = fingerprint_of_file(file);
  return files;
}

/// What a run has listed, in the order in which it did: a hit lists it likewise.
std::vector<std::string> listed_by_run(const OutputFolder& folder) {
  std::vector<std::string> names;
  std::ifstream manifest(folder.path() / ".drycut-run");
  for (std::string line; std::getline(manifest, line);)
    if (folder.listed().contains(line)) names.push_back(line);
  return names;
}

/// The entry as it was kept, with all its files; nullopt if anything of it is another.
std::optional<Json> sound_entry(const fs::path& entry, const std::string& inputs) {
  Problems ignored;
  constexpr std::uintmax_t largest = 64U << 20U;
  const auto text = read_file(entry / entry_file, ignored, largest);
  if (!text) return {};
  const auto end = text->find('\n');  // of the first line: the fingerprint of the others
  if (end == std::string::npos || text->substr(0, end) != fingerprint_of(text->substr(end + 1))) return {};
  auto json = json_from(text->substr(end + 1));
  if (json.at("inputs") != inputs) return {};
  for (const auto& [name, fingerprint] : json.at("files").items()) {
    const bool is_inside = !name.starts_with('/') && name.find("..") == std::string::npos;
    if (!is_inside || fingerprint_of_file(entry / "files" / name) != fingerprint) return {};
  }
  return json;
}

// Of a process that was killed as it kept something, or of one that is at it: FINGERPRINT.PID.
bool is_begun(const fs::path& folder) {
  const auto fingerprint = folder.stem().string();
  const auto pid = folder.extension().string();
  return fingerprint.size() == fingerprint_of("").size() && pid.size() > 1 &&
         fingerprint.find_first_not_of("0123456789abcdef") == std::string::npos &&
         pid.find_first_not_of("0123456789", 1) == std::string::npos;
}

}  // namespace

std::string inputs_of_run(const scenario::Scenario& scenario, const FileSet& files, const RunKind& kind) {
  loop::Fingerprint program;
  program.add_program();
  Json inputs = {{"program", digits(program.value())},
                 {"name", kind.name},
                 {"pictures", kind.pictures},
                 {"gltf", kind.gltf},
                 {"verify_step", kind.verify_step},
                 {"strict", kind.strict},
                 {"scenario", fingerprint_of(scenario::expand(scenario))},
                 {"folders", files.folders}};
  for (const auto& [name, file] : files.files)
    inputs["files"][name] = fmt::format("{} {}", static_cast<int>(file.state), fingerprint_of(file.bytes));
  for (const auto& mesh : scenario.pictures.meshes) {
    // A mesh may have its points or colours in files beside it.
    const auto file = scenario.file.parent_path() / mesh.file.text;
    std::error_code ignored;
    for (const auto& beside :
         fs::directory_iterator(file.has_parent_path() ? file.parent_path() : ".", ignored))
      if (beside.path() == file || file.extension() != ".stl")
        inputs["meshes"][beside.path().string()] = fingerprint_of_file(beside.path());
  }
  if (kind.pictures) inputs["helpers"] = helpers();
  return json_text(inputs);
}

RunCache::RunCache(fs::path folder, Problems& problems, std::uintmax_t most)
    : folder_(std::move(folder)), most_(most) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_))
    problems.push_back({"file.not-writable"_code, "--cache", 1, 1,
                        fmt::format("the directory {} cannot be made{}{}", folder_.string(),
                                    error ? ": " : "", error ? error.message() : ""),
                        "name one that can be written"});
}

fs::path RunCache::entry_of(const std::string& inputs) const { return folder_ / fingerprint_of(inputs); }

std::optional<CachedRun> RunCache::take(const std::string& inputs, OutputFolder& to) const {
  const auto entry = entry_of(inputs);
  try {
    const auto json = sound_entry(entry, inputs);
    if (!json) return {};
    CachedRun run;
    record::take_json(json->at("run"), run);
    for (const auto& [name, fingerprint] : json->at("files").items())
      fs::copy_file(entry / "files" / name, to.add(name), fs::copy_options::overwrite_existing);
    std::error_code ignored;
    fs::last_write_time(entry / entry_file, fs::file_time_type::clock::now(), ignored);
    return run;
  } catch (const Json::exception&) {
    return {};
  } catch (const fs::filesystem_error&) {  // another process made room just now
    return {};
  }
}

void RunCache::keep(const std::string& inputs, const OutputFolder& from, const CachedRun& run) const {
  const auto entry = entry_of(inputs);
  const auto begun = fs::path(fmt::format("{}.{}", entry.string(), getpid()));
  std::error_code error;
  const std::shared_ptr<void> remains(nullptr, [&](void*) { fs::remove_all(begun, error); });
  Json json = {{"inputs", inputs}, {"run", record::json_of(run)}};
  for (const auto& name : listed_by_run(from)) {
    const auto copy = begun / "files" / name;
    fs::create_directories(copy.parent_path());
    fs::copy_file(from.path() / name, copy, fs::copy_options::overwrite_existing);
    json["files"][name] = fingerprint_of_file(copy);
  }
  const auto text = json_text(json, 2) + "\n";
  write_file(begun / entry_file, fingerprint_of(text) + "\n" + text);
  fs::remove_all(entry);            // a damaged one
  fs::rename(begun, entry, error);  // unless another process has kept the same
  make_room();
}

void RunCache::make_room() const {
  struct Entry {
    fs::file_time_type used;
    fs::path folder;
    std::uintmax_t bytes = 0;
  };
  std::vector<Entry> entries;
  std::uintmax_t bytes = 0;
  std::error_code ignored;
  for (const auto& folder : fs::directory_iterator(folder_, ignored)) {
    auto used = fs::last_write_time(folder.path() / entry_file, ignored);
    if (ignored && is_begun(folder.path())) used = fs::last_write_time(folder.path(), ignored);
    if (ignored) continue;  // none of ours
    entries.push_back({used, folder.path()});
    for (const auto& file : fs::recursive_directory_iterator(folder.path(), ignored))
      if (file.is_regular_file(ignored)) entries.back().bytes += file.file_size(ignored);
    bytes += entries.back().bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const auto& entry : entries) {
    if (bytes <= most_) return;
    fs::remove_all(entry.folder, ignored);
    bytes -= entry.bytes;
  }
}

}  // namespace drycut::sim::cli
