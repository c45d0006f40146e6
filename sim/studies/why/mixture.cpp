#include "sim/studies/why/mixture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/file.hpp"
#include "sim/record/verdict.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::studies {

namespace {

namespace fs = std::filesystem;

/// The scenario of a run's folder; its paths lead on from the file that was run.
bool read_folder(RunSide& side, Problems& problems) {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    problems.push_back({"record.no-run"_code, side.given.string(), 1, 1, what, remedy});
    return false;
  };
  const auto verdict = record::read_verdict(side.given);
  if (!file_exists(side.given / report::scenario_file) || !verdict || verdict->scenarios.size() != 1)
    return refuse("it is not the folder of a run of one scenario",
                  "name a folder that drycut run made of a scenario, such as out/rotary_knife");
  side.file = verdict->scenarios.front();
  if (!file_exists(side.file))
    return refuse(fmt::format("it was made of {}, which is not there", side.file.string()),
                  "call drycut from the folder from which it was run");
  auto text = read_file(side.given / report::scenario_file, problems);
  if (text) side.text = std::move(*text);
  return text.has_value();
}

bool names_it(const scenario::YamlNode& node, const std::string& name) {
  return node.kind == scenario::YamlNode::Kind::scalar && node.text.text == name;
}

void rename(scenario::YamlNode& node, const std::string& name, const std::string& other) {
  if (names_it(node, name)) node.text.text = other;
  for (auto& item : node.items) rename(item, name, other);
  for (auto& entry : node.entries) rename(entry.value, name, other);
}

}  // namespace

bool RunSide::is_folder() const { return folder_exists(given); }

std::optional<RunSide> read_side(const fs::path& given, Problems& problems) {
  RunSide side{given, given, "", {}, {}, {}};
  const auto before = problems.size();
  std::optional<scenario::Scenario> scenario;
  if (side.is_folder()) {
    if (!read_folder(side, problems)) return {};
    scenario = scenario::read_scenario_text(side.text, side.file, {}, problems);
  } else {
    scenario = scenario::read_scenario(given, {}, problems);
    if (problems.size() == before) side.text = scenario::expand(*scenario);
  }
  if (problems.size() != before) return {};
  scenario::Findings findings({given.string()});
  side.tree = without_looks(scenario::parse_scenario(side.text, 0, findings));
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  for (const auto& channel : scenario->record.channels) side.channels.push_back(channel.text);
  if (scenario->controller)
    for (const auto& name : scenario->controller->files()) {
      auto text = read_file(side.file.parent_path() / name.text, problems, named_at(*scenario, name.place));
      if (text) side.programs.emplace_back(name.text, std::move(*text));
    }
  if (problems.size() != before) return {};
  return side;
}

// Files of the same name are compared; of the rest those of one ending, in their order.
Mixture::Mixture(RunSide good, RunSide failed) : good_(std::move(good)), failed_(std::move(failed)) {
  std::vector<bool> used(failed_.programs.size(), false);
  const auto pair_up = [&](const auto& fits) {
    for (const auto& [name, text] : good_.programs) {
      if (std::ranges::any_of(programs_, [&, &name = name](const auto& one) { return one.name == name; }))
        continue;
      for (std::size_t k = 0; k < failed_.programs.size(); ++k) {
        if (used[k] || !fits(name, failed_.programs[k].first)) continue;
        used[k] = true;
        programs_.push_back({name, text, failed_.programs[k].second});
        if (failed_.programs[k].first != name) {
          for (auto& [key, value, line] : failed_.tree.entries)
            if (key.text == "controller") rename(value, failed_.programs[k].first, name);
        }
        break;
      }
    }
  };
  pair_up([](const fs::path& a, const fs::path& b) { return a == b; });
  pair_up([](const fs::path& a, const fs::path& b) { return a.extension() == b.extension(); });
  for (const auto& [name, text] : good_.programs)  // in the order of the scenario
    if (std::ranges::none_of(programs_, [&, &name = name](const auto& one) { return one.name == name; }))
      programs_.push_back({name, text, text});
  for (std::size_t k = 0; k < failed_.programs.size(); ++k)
    if (!used[k])
      programs_.push_back(
          {failed_.programs[k].first, failed_.programs[k].second, failed_.programs[k].second});
  walk([&](const Difference& difference) {
    differences_.push_back(difference);
    return TakenSide::good;
  });
}

Mixture::Made Mixture::walk(const Take& take) const {
  Made made{good_.file, text_of(mixed_tree(good_.tree, failed_.tree, take)) + "\n"};
  for (const auto& [name, good, failed] : programs_)
    made.files.emplace((good_.file.parent_path() / name).string(), mixed_lines(name, good, failed, take));
  return made;
}

Mixture::Made Mixture::with(const Subset& taken, bool late) const {
  std::size_t number = 0;
  return walk([&](const Difference&) {
    const bool is_taken = std::ranges::binary_search(taken, number++);
    return !is_taken ? TakenSide::good : late ? TakenSide::late : TakenSide::failed;
  });
}

std::vector<std::string> Mixture::channels() const {
  auto all = good_.channels;
  all.insert(all.end(), failed_.channels.begin(), failed_.channels.end());
  return all;
}

bool Mixture::states_fit(const Subset& differences) const {
  return std::ranges::all_of(differences, [&](std::size_t number) {
    const auto& one = differences_[number];
    return one.kind != Difference::Kind::line || same_but_numbers(one.good, one.failed);
  });
}

}  // namespace drycut::sim::studies
