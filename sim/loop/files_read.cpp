#include "sim/loop/files_read.hpp"

#include <algorithm>

#include "sim/file.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/guests.hpp"
#include "sim/recordings/recording_file.hpp"
#include "sim/scenario/guests.hpp"

namespace drycut::sim::loop {

std::vector<std::pair<std::string, std::string>> read_files_of(const scenario::Scenario& scenario) {
  std::vector<std::pair<std::string, std::string>> files;
  Problems ignored;
  const auto add = [&](const std::string& name, const std::filesystem::path& path) {
    files.emplace_back(name, read_file(path, ignored, largest_export).value_or(""));
  };
  for (const auto& name : controller_files(scenario)) add(name.text, scenario.file.parent_path() / name.text);
  for (const auto& plant : scenario.plants)
    if (const auto* const guest = guest_of(plant))
      files.emplace_back(guest->file(), read_bytes(scenario.file.parent_path() / guest->file(), ignored, {},
                                                   scenario::largest_guest)
                                            .value_or(""));
  std::vector<std::string> known;
  for (const auto& input : scenario.inputs) {
    if (std::ranges::find(known, input.recording.text) != known.end()) continue;
    known.push_back(input.recording.text);
    const auto path = scenario.file.parent_path() / input.recording.text;
    add(input.recording.text, path);
    const auto file = recordings::read_recording_text(files.back().second, path, ignored);
    if (!file.file.text.empty()) add(file.file.text, file.export_path());
  }
  return files;
}

}  // namespace drycut::sim::loop
