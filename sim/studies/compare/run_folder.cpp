#include "sim/studies/compare/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "base/json.hpp"
#include "devices/plcopen/axis.hpp"
#include "sim/file.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/names.hpp"
#include "sim/record/hdf5_file.hpp"
#include "sim/record/json.hpp"
#include "sim/record/trace_files.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/units.hpp"
#include "sim/scenario/yaml_node.hpp"
#include "sim/studies/recorded_csv.hpp"

namespace drycut::sim::studies {

namespace fs = std::filesystem;

namespace {

/// A file that is read where it lies: a trace may be larger than the memory.
class MappedFile {
 public:
  explicit MappedFile(const fs::path& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a FIFO is not waited for
    const auto end = descriptor < 0 ? 0 : lseek(descriptor, 0, SEEK_END);
    if (end > 0) place_ = mmap(nullptr, static_cast<std::size_t>(end), PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (place_ != MAP_FAILED) size_ = static_cast<std::size_t>(end);
    if (descriptor >= 0) close(descriptor);
  }
  ~MappedFile() {
    if (size_ > 0) munmap(place_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  [[nodiscard]] std::string_view text() const { return {static_cast<const char*>(place_), size_}; }

 private:
  void* place_ = MAP_FAILED;
  std::size_t size_ = 0;
};

void refuse_file(const fs::path& file, Problems& problems) {
  problems.push_back(
      {"record.damaged"_code, file.string(), 1, 1, "the file cannot be read, or is empty", run_again});
}

constexpr std::uintmax_t largest_record = std::uintmax_t{1} << 40U;  // [bytes]

/// A whole file of a run; the events of a long one are many.
std::optional<std::string> whole_file(const fs::path& file, Problems& problems) {
  auto text = read_file(file, problems, largest_record);
  if (!text || !text->empty()) return text;
  refuse_file(file, problems);
  return {};
}

/// "; did you mean out/rotary_knife?" where a run's folder lies one deeper.
std::string nearest_run(const fs::path& folder) {
  std::vector<std::string> runs;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (fs::exists(entry.path() / report::checks_file, ignored)) runs.push_back(entry.path().string());
  std::sort(runs.begin(), runs.end());
  if (runs.empty()) return "name a folder that drycut run made of a scenario, such as out/rotary_knife";
  return fmt::format("the runs in it are {}", fmt::join(runs, ", "));
}

bool is_run(const fs::path& folder, Problems& problems) {
  std::error_code ignored;
  const auto refuse = [&](Code code, std::string what, std::string remedy) {
    problems.push_back({code, folder.string(), 1, 1, std::move(what), std::move(remedy)});
    return false;
  };
  if (!fs::exists(folder, ignored))
    return refuse("record.no-run"_code, "there is no such folder", "check the path");
  if (!fs::is_directory(folder, ignored))
    return refuse("record.no-run"_code, "it is not a folder",
                  "name a folder that drycut run made of a scenario");
  std::vector<const char*> files = {report::checks_file, report::scenario_file};
  if (!fs::is_regular_file(folder / report::hdf5_file, ignored))
    files.insert(files.begin(), {report::trace_file, report::events_file});
  std::vector<std::string> missing;
  for (const auto* file : files)
    if (!fs::is_regular_file(folder / file, ignored)) missing.emplace_back(file);
  if (missing.empty()) return true;
  const auto what = fmt::format("it is not the folder of a run: there is no {}", fmt::join(missing, ", "));
  // A folder of an older drycut has all but the scenario.
  return refuse(
      "record.no-run"_code, what,
      missing.size() < 4 ? "run the scenario again: drycut run writes all of them" : nearest_run(folder));
}

void place_of(const std::string& text, std::size_t byte, int& line, int& column) {
  const auto before = std::string_view(text).substr(0, std::min(byte, text.size()));
  line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  column = static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1;
}

void read_checks_json(const std::string& text, const std::string& file, ComparedRun& run,
                      Problems& problems) {
  try {
    const auto json = json_from(text);
    run.version = json.at("drycut").get<std::string>();
    static_cast<void>(json.at("passed"));
    static_cast<void>(json.at("checks"));
    record::take_json(json, run.outcome);
  } catch (const Json::parse_error& error) {
    int line = 1;
    int column = 1;
    place_of(text, error.byte == 0 ? 0 : error.byte - 1, line, column);
    problems.push_back({"record.damaged"_code, file, line, column, "this is no JSON", run_again});
  } catch (const Json::exception& error) {
    const std::string what = error.what();
    const auto bracket = what.find("] ");
    problems.push_back({"record.damaged"_code, file, 1, 1,
                        fmt::format("a check's result is missing or of another kind: {}",
                                    bracket == std::string::npos ? what : what.substr(bracket + 2)),
                        run_again});
  }
}

bool all_scalars(const scenario::YamlNode& list) {
  return std::all_of(list.items.begin(), list.items.end(), [](const scenario::YamlNode& item) {
    return item.kind == scenario::YamlNode::Kind::scalar;
  });
}

std::string list_text(const scenario::YamlNode& list) {
  std::vector<std::string> texts;
  for (const auto& item : list.items) texts.push_back(item.text.text);
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

void flatten(const scenario::YamlNode& node, const std::string& path,
             std::vector<std::pair<std::string, std::string>>& values) {
  if (node.kind == scenario::YamlNode::Kind::map) {
    for (const auto& entry : node.entries)
      flatten(entry.value, path.empty() ? entry.key.text : path + "." + entry.key.text, values);
  } else if (node.kind == scenario::YamlNode::Kind::sequence && !all_scalars(node)) {
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const auto* name = scenario::child(node.items[i], "name");
      flatten(node.items[i],
              fmt::format("{}[{}]", path, name != nullptr ? name->text.text : std::to_string(i)), values);
    }
  } else {
    values.emplace_back(path,
                        node.kind == scenario::YamlNode::Kind::sequence ? list_text(node) : node.text.text);
  }
}

/// Every panel of pictures.plots that states limits for the one value of an event that it shows.
std::vector<Tolerance> tolerances_of(const scenario::PicturesSection& pictures) {
  std::vector<Tolerance> found;
  for (const auto& plot : pictures.plots) {
    for (const auto& panel : plot.panels) {
      if (!panel.limits || panel.values.size() != 1) continue;
      std::optional<double> until;
      if (plot.until) until = seconds(*plot.until);
      found.push_back({panel.event.text, panel.values[0].text, panel.limits->first, panel.limits->second,
                       seconds(plot.from), until});
    }
  }
  return found;
}

/// Where checks of events begin.
std::vector<std::pair<std::string, double>> starts_of(const scenario::YamlNode& root) {
  std::vector<std::pair<std::string, double>> starts;
  const auto* checks = scenario::child(root, "checks");
  if (checks == nullptr) return starts;
  for (const auto& check : checks->items) {
    const auto* from = scenario::child(check, "from");
    const auto time = from == nullptr ? std::nullopt : scenario::parse_quantity(from->text.text);
    if (!time || !scenario::is_unit(time->unit) || !scenario::same_dimension(time->unit, "s")) continue;
    for (const auto* kind : {"each", "all"})
      if (const auto* event = scenario::child(check, kind))
        starts.emplace_back(event->text.text, scenario::to_si(time->number, time->unit));
  }
  return starts;
}

/// The positions of modulo axes: their axis has a turn, in the unit of its positions.
std::map<std::string, double> turns_of(const ComparedRun& run) {
  constexpr std::string_view axes = "controller.plcopen.axes.";
  constexpr std::string_view modulo = ".modulo";
  std::map<std::string, double> turns;
  for (const auto& [path, value] : run.parameters) {
    if (!path.starts_with(axes) || !path.ends_with(modulo)) continue;
    const auto axis = path.substr(axes.size(), path.size() - axes.size() - modulo.size());
    const auto turn = scenario::parse_quantity(value);
    if (!turn || !(turn->number > 0)) continue;
    for (const auto& row : devices::plcopen::axis_value_table()) {
      const auto* column = row.in_turn ? run.recording.column(fmt::format("{}.{}", axis, row.name)) : nullptr;
      if (column == nullptr || !scenario::is_unit(turn->unit) || !scenario::is_unit(column->unit) ||
          !scenario::same_dimension(turn->unit, column->unit))
        continue;
      turns[column->name] = scenario::from_si(scenario::to_si(turn->number, turn->unit), column->unit);
    }
  }
  return turns;
}

void read_scenario_yaml(const std::string& text, const std::string& file, ComparedRun& run,
                        Problems& problems) {
  scenario::Findings findings({file});
  auto root = scenario::parse_yaml(text, 0, findings);
  if (const auto* pictures = scenario::child(root, "pictures")) {
    scenario::PicturesSection section;
    scenario::MapReader reader(*pictures, "pictures", findings);
    scenario::visit(reader, section);
    reader.finish();
    run.tolerances = tolerances_of(section);
  }
  std::erase_if(root.entries,
                [](const scenario::YamlNode::Entry& entry) { return entry.key.text == "pictures"; });
  if (findings.empty() && root.kind != scenario::YamlNode::Kind::map)
    scenario::refuse_kind(root, "a scenario", scenario::YamlNode::Kind::map, findings);
  run.starts = starts_of(root);
  flatten(root, "", run.parameters);
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
}

/// What checks.json of a folder says, if there is one.
ComparedRun judged_run(const fs::path& folder, Problems& problems) {
  std::error_code ignored;
  ComparedRun run;
  if (const auto file = folder / report::checks_file; fs::exists(file, ignored))
    if (const auto text = whole_file(file, problems)) read_checks_json(*text, file.string(), run, problems);
  return run;
}

/// What the folder of a run says beside its record, as far as the run has come.
void add_about(const fs::path& folder, record::Record& record, Problems& problems) {
  std::error_code ignored;
  auto run = judged_run(folder, problems);
  if (!run.version.empty()) record.about.emplace_back("drycut", run.version);
  record.outcome = std::move(run.outcome);
  const auto file = folder / report::scenario_file;
  if (!fs::exists(file, ignored)) return;
  if (const auto text = whole_file(file, problems)) {
    read_scenario_yaml(*text, file.string(), run, problems);
    if (const auto* step = run.parameter("scene.step")) record.about.emplace_back("step", *step);
    record.about.emplace_back("scenario", *text);
  }
}

}  // namespace

const Tolerance* ComparedRun::tolerance(const std::string& source, const std::string& event,
                                        const std::string& value) const {
  const auto found = std::find_if(tolerances.begin(), tolerances.end(), [&](const Tolerance& stated) {
    return stated.value == value && loop::names_event(stated.event, source, event);
  });
  return found == tolerances.end() ? nullptr : &*found;
}

const std::string* ComparedRun::parameter(const std::string& path) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const auto& parameter) { return parameter.first == path; });
  return found == parameters.end() ? nullptr : &found->second;
}

record::Record read_record(const fs::path& run, Problems& problems) {
  std::error_code ignored;
  const bool is_folder = fs::is_directory(run, ignored);
  if (const auto hdf5 = is_folder ? run / report::hdf5_file : run;
      is_folder ? fs::exists(hdf5, ignored) : record::is_hdf5(hdf5)) {
    auto record = record::read_hdf5(hdf5, problems, loop::severity_of);
    if (is_folder) record.outcome.failure = judged_run(run, problems).outcome.failure;
    return record;
  }
  const auto file = is_folder ? run / report::trace_file : run;
  record::Record record;
  if (is_folder && !fs::exists(file, ignored)) {
    problems.push_back({"record.no-run"_code, run.string(), 1, 1,
                        fmt::format("it is not the folder of a run: there is no {}, no {}",
                                    report::trace_file, report::hdf5_file),
                        nearest_run(run)});
    return record;
  }
  const MappedFile trace(file);
  if (trace.text().empty())
    refuse_file(file, problems);
  else
    record.recording = read_trace(trace.text(), file.string(), problems);
  const auto events = record::events_beside(file);
  if (const auto text = whole_file(events, problems))
    read_events(*text, events.string(), record.recording, problems);
  if (is_folder) add_about(run, record, problems);
  return record;
}

ComparedRun read_run(const fs::path& folder, Problems& problems) {
  ComparedRun run;
  run.folder = folder;
  run.label = folder.string();
  if (!is_run(folder, problems)) return run;
  const auto name = [&](const char* file) { return (folder / file).string(); };
  run.recording = read_record(folder, problems).recording;
  if (const auto text = whole_file(folder / report::checks_file, problems))
    read_checks_json(*text, name(report::checks_file), run, problems);
  if (const auto text = whole_file(folder / report::scenario_file, problems))
    read_scenario_yaml(*text, name(report::scenario_file), run, problems);
  run.turns = turns_of(run);
  return run;
}

std::vector<std::string> labels_of(const std::vector<fs::path>& folders, Problems& problems) {
  std::vector<std::vector<std::string>> parts;
  std::set<fs::path> seen;
  for (const auto& folder : folders) {
    const auto place = (folder / "").lexically_normal().parent_path();
    if (!seen.insert(place).second)
      problems.push_back(
          {"study.twice"_code, folder.string(), 1, 1, "the folder is given twice", "give each run once"});
    auto& own = parts.emplace_back();
    for (const auto& part : place) own.push_back(part.string());
  }
  // What all paths begin and end with tells nothing; something of each stays.
  const auto all = [&](const auto& holds) { return std::all_of(parts.begin(), parts.end(), holds); };
  while (all([&](const auto& p) { return p.size() > 1 && p.front() == parts[0].front(); }))
    for (auto& own : parts) own.erase(own.begin());
  while (all([&](const auto& p) { return p.size() > 1 && p.back() == parts[0].back(); }))
    for (auto& own : parts) own.pop_back();
  std::vector<std::string> labels;
  for (const auto& own : parts) {
    fs::path label;
    for (const auto& part : own) label /= part;
    labels.push_back(label.string());
  }
  return labels;
}

}  // namespace drycut::sim::studies
