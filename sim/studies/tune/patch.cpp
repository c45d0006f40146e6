#include "sim/studies/tune/patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "sim/scenario/format.hpp"

namespace drycut::sim::studies {

namespace {

/// A value at its place in the scenario.
struct PatchEntry {
  std::string path;
  std::string value;
  std::string who;
};

/// The keys of a path; what stands below `set` and `wiring` is one key, dots and all.
std::vector<std::string> keys_of(const std::string& path) {
  std::vector<std::string> keys;
  for (std::size_t at = 0; at <= path.size();) {
    const bool whole = !keys.empty() && (keys.back() == "set" || keys.back() == "wiring");
    const auto dot = whole ? path.size() : std::min(path.find('.', at), path.size());
    keys.push_back(path.substr(at, dot - at));
    at = dot + 1;
  }
  return keys;
}

/// A list's entry, by its number or its name, cannot be pasted: the rest of the list is not known here.
bool lies_in_a_list(const std::string& path) {
  constexpr std::array<std::string_view, 4> lists = {"timeline", "disturbances", "checks", "plots"};
  const auto keys = keys_of(path);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
    if (std::all_of(keys[i].begin(), keys[i].end(), is_digit)) return true;
    if (i + 1 < keys.size() && std::find(lists.begin(), lists.end(), keys[i]) != lists.end()) return true;
  }
  return false;
}

std::vector<PatchEntry> entries_of(const Tuning& tuning) {
  const auto& parameters = tuning.trials.parameters();
  const auto& point = tuning.trials.at(tuning.best).point;
  std::vector<PatchEntry> entries;
  for (std::size_t i = 0; i < parameters.size() && !tuning.stays; ++i) {
    const auto& before = tuning.present[i].value;
    entries.push_back({parameters[i].path, value_text(parameters[i], point[i]),
                       before ? fmt::format("drycut tune; before: {}{}", value_text(parameters[i], *before),
                                            tuning.present[i].set_by == "--set" ? " (--set)" : "")
                              : std::string("drycut tune")});
  }
  for (const auto& override : tuning.study.set) {
    const bool told = std::any_of(entries.begin(), entries.end(),
                                  [&](const PatchEntry& entry) { return entry.path == override.path; });
    if (!told) entries.push_back({override.path, override.value, "--set"});
  }
  return entries;
}

/// Set for the trial, and nothing of the machine: how long it ran, for what product, what was done to it.
bool is_of_trial(const PatchEntry& entry) {
  return entry.who == "--set" && !entry.path.starts_with("controller.") && !entry.path.starts_with("plants.");
}

std::string yaml_of(std::vector<PatchEntry> entries) {
  std::sort(entries.begin(), entries.end(),
            [](const PatchEntry& a, const PatchEntry& b) { return a.path < b.path; });
  std::string text;
  std::vector<std::string> open;  // keys of the line before
  for (const auto& [path, value, who] : entries) {
    auto keys = keys_of(path);
    const auto same =
        std::mismatch(keys.begin(), keys.end() - 1, open.begin(), open.end()).first - keys.begin();
    for (auto i = static_cast<std::size_t>(same); i < keys.size(); ++i) {
      const auto end = i + 1 == keys.size() ? fmt::format(" {}  # {}", value, who) : std::string();
      text += fmt::format("{:{}}{}:{}\n", "", 2 * i, scenario::yaml_text(keys[i]), end);
    }
    open = std::move(keys);
  }
  return text;
}

std::string qcl_line(std::string name, double value) {
  if (const auto dot = name.find('.'); dot != std::string::npos) name[dot] = ':';
  return fmt::format("#   {} = {}{}\n", name, value < 0 ? "- " : "", std::abs(value));
}

}  // namespace

std::string patch_text(const Tuning& tuning) {
  auto entries = entries_of(tuning);
  const bool has_any = !entries.empty();
  std::string arguments = "#  ";
  std::string with;
  for (const auto& entry : entries) {
    arguments += fmt::format(" --set \"{}={}\"", entry.path, entry.value);
    if (is_of_trial(entry)) with += fmt::format("#   {}: {}\n", entry.path, entry.value);
  }
  std::erase_if(entries, is_of_trial);
  std::string qcl;
  for (std::size_t i = 0; i < tuning.trials.parameters().size() && !tuning.stays; ++i) {
    const auto preset = preset_name(tuning.trials.parameters()[i].path);
    if (preset && preset->section == "qmove")
      qcl += qcl_line(preset->value, tuning.trials.at(tuning.best).point[i]);
  }
  std::string others;
  for (const auto& [path, value, who] : entries)
    if (lies_in_a_list(path)) others += fmt::format("#   {}: {} ({})\n", path, value, who);
  std::erase_if(entries, [](const PatchEntry& entry) { return lies_in_a_list(entry.path); });

  std::string text;
  if (const auto miss = miss_text(tuning); !miss.empty()) text += fmt::format("# {}\n", miss);
  if (!entries.empty())
    text += "# Into the scenario, beside what stands there\n" + yaml_of(std::move(entries));
  if (!others.empty()) text += "# In lists of the scenario, at these paths\n" + others;
  if (!qcl.empty()) text += "# Or in QCL, in the set-up of the axis\n" + qcl;
  if (!with.empty()) text += "# It was tried with these, which are no part of it\n" + with;
  if (tuning.study.ignore_checks) text += "# The scenario's checks were ignored (--ignore-checks)\n";
  if (!has_any) return text + "# There is nothing to change\n";
  return text + "# Or for drycut run\n" + arguments + "\n";
}

}  // namespace drycut::sim::studies
