#include "sim/live/line_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "renders/gltf.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/report/film.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::live {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_channels = 256;  ///< of an asker

/// The machine as a .glb: its first frame, with all that may ever be seen.
std::string machine_of(scenario::Scenario scenario, std::vector<std::string>& parts, Problems& problems) {
  auto& pictures = scenario.pictures;
  pictures.frames = true;
  pictures.from = 0;
  pictures.until.reset();
  pictures.around.reset();
  pictures.every = scenario.scene.step;
  pictures.slow = 1;
  pictures.live.clear();
  scenario.record.channels.clear();
  loop::Simulation simulation(scenario, problems);
  const auto meshes = report::load_part_meshes(scenario, simulation.plants(), problems);
  if (!problems.empty()) return "";
  simulation.advance();
  const auto film = report::film_of(scenario, simulation, meshes);
  for (const auto& part : film.parts) parts.push_back(part.name);
  if (film.frames.empty() || film.parts.empty()) return "";
  return renders::gltf_of_parts(film);
}

Replay read(const Line::Options& options, std::vector<std::string>& notes, Problems& problems) {
  if (!options.from) return {scenario::read_scenario(options.scenario, options.set, problems)};
  return read_session(options.from->session, options.from->at, notes, problems).value_or(Replay{});
}

/// The web that a plant works on, "" = none.
std::string web_of(const scenario::PlantEntry& plant) {
  for (const auto& row : plant.definition->parameters())
    if (row.reference == "web") return *std::get<std::string*>(row.value);
  return "";
}

}  // namespace

LineRun::LineRun(const Line::Options& options, int number, Problems& problems)
    : replay_(read(options, notes_, problems)), number_(number) {
  if (!problems.empty()) return;
  std::vector<std::string> told;
  machine_ = machine_of(read(options, told, problems).scenario, parts_, problems);
  if (!problems.empty()) return;
  if (!options.from) replay_.fingerprint = fingerprint_of(scenario_);
  simulation_ = std::make_unique<loop::Simulation>(scenario_, problems);
  if (!problems.empty()) return;
  simulation_->keep_nothing();
  simulation_->tell(*this);
  for (const auto& [name, plant] : simulation_->plants())
    for (auto& part : plant->parts()) shown_.push_back(std::move(part));
  auto& names = simulation_->names();
  for (const auto& name : names.setting_names())
    if (auto target = names.target(name)) targets_.push_back(std::move(*target));
  for (const auto& name : names.lamp_names())
    if (auto lamp = names.reading(name)) lamps_.push_back(std::move(*lamp));
}

void LineRun::begin(const fs::path& folder, const std::atomic<bool>& stopped) {
  if (!folder.empty()) record_in(folder);
  next_reached_ = replay_.reached;
  while (!stopped && now() < replay_.reached && advance()) {
  }
  constexpr std::size_t most_shown = 200;
  if (events_.size() > most_shown) events_.erase(events_.begin(), events_.end() - most_shown);
}

void LineRun::record_in(const fs::path& folder) {
  fs::create_directories(folder);
  // Nothing that is there is touched: each run takes the next number.
  for (int number = 1; record_.empty(); ++number) {
    const auto next = folder / std::to_string(number);
    if (fs::create_directory(next)) record_ = next;
  }
  session_.emplace(record_ / session_file, scenario_, replay_.fingerprint);
  const auto& timeline = scenario_.timeline;
  for (auto act = timeline.end() - static_cast<std::ptrdiff_t>(replay_.acts); act != timeline.end(); ++act)
    session_->add(*act);
  simulation_->write_to(record_ / report::trace_file, record_ / report::events_file);
}

void LineRun::end() {
  if (session_) {
    session_->reached(now());
    simulation_->flush();
  }
  keep_retentive();
}

void LineRun::keep_retentive() const { loop::keep_retentive(scenario_, simulation_->retentive_state()); }

bool LineRun::advance() {
  const bool sound = simulation_->advance();
  if (session_ && now() >= next_reached_) {
    session_->reached(now());
    next_reached_ = (now() / second + 1) * second;
  }
  return sound;
}

Problems LineRun::act(const std::string& text) {
  Problems problems;
  const auto stimulus = read_act(text, "act", now(), problems);
  if (stimulus) problems = act(*stimulus);
  for (auto& problem : problems) problem.file = "act";
  return problems;
}

Problems LineRun::act(const scenario::Stimulus& stimulus) {
  Problems problems;
  if (simulation_->act(stimulus, problems) && session_) session_->add(stimulus);
  return problems;
}

void LineRun::happened(const loop::RecordedEvent& event) {
  events_.push_back(event);
  if (awaited_ && loop::names_event(*awaited_, event.source, event.event)) seen_ = true;
  if (awaited_ && awaited_->empty()) seen_ = true;
}

Problems LineRun::await(const std::string& event) {
  Problems problems;
  if (!event.empty()) loop::find_event(simulation_->all_events(), {event, {1, 1}, {}}, scenario_, problems);
  for (auto& problem : problems) problem.file = "event";
  if (!problems.empty()) return problems;
  awaited_ = event;
  seen_ = false;
  return {};
}

Problems LineRun::want(Asker asker, const Sample& sample) {
  const auto& names = sample.names;
  Problems problems;
  if (names.size() > most_channels)
    problems.push_back(
        {"sample", 1, 1, fmt::format("{} channels", names.size()), fmt::format("{} at most", most_channels)});
  for (const auto& name : names) {
    if (problems.size() < most_channels && !simulation_->names().reading(name))
      problems.push_back({"sample", 1, 1, fmt::format("there is no channel '{}'", name),
                          simulation_->names().suggest_reading(name)});
  }
  if (!problems.empty()) return problems;
  wanted_[asker] = sample;
  choose_samples();
  watch_programs();
  return {};
}

void LineRun::leave(Asker asker) {
  if (wanted_.erase(asker) == 0) return;
  choose_samples();
  watch_programs();
}

void LineRun::take_samples() {
  if (readings_.empty()) return;
  samples_.times.push_back(now());
  for (const auto& reading : readings_) samples_.rows.push_back(reading.read());
}

Problems LineRun::values_of(const std::vector<std::string>& names, std::vector<double>& values) {
  Problems problems;
  for (const auto& name : names) {
    auto known = known_.find(name);
    if (known == known_.end()) {
      const auto reading = simulation_->names().reading(name);
      if (!reading) {
        problems.push_back({"read", 1, 1, fmt::format("there is no channel '{}'", name),
                            simulation_->names().suggest_reading(name)});
        if (problems.size() >= most_channels) break;
        continue;
      }
      known = known_.emplace(name, reading->read).first;
    }
    values.push_back(known->second());
  }
  if (!problems.empty()) values.clear();
  return problems;
}

void LineRun::tell(News& news) {
  news.run = number_;
  news.time = now();
  news.failure = failure();
  news.poses.reserve(shown_.size());
  for (const auto& part : shown_) news.poses.push_back(part.now());
  for (const auto& target : targets_) news.values.push_back(scenario::from_si(target.read(), target.unit));
  for (const auto& lamp : lamps_) news.lamps.push_back(lamp.read());
  news.events = std::exchange(events_, {});
  news.samples = std::exchange(samples_, {sample_names_, {}, {}});
  if (programs_wanted_) news.programs = simulation_->controller()->positions(now());
}

std::shared_ptr<const LineDescription> LineRun::describe() {
  auto told = std::make_shared<LineDescription>();
  static const auto process = fmt::format("{:08x}", std::random_device()());
  told->process = process;
  told->run = number_;
  told->title = scenario_.scene.title;
  told->scenario = scenario_.file.filename().string();
  told->step = scenario_.scene.step;
  told->duration = scenario_.scene.duration;
  auto& names = simulation_->names();
  for (const auto& target : targets_)
    told->targets.push_back({target.name, target.unit, target.range, target.name.starts_with("panel."),
                             is_push_button(target), largest_used(target)});
  for (const auto& lamp : lamps_) told->lamps.push_back(lamp.name);
  for (const auto& [component, fault] : names.faults())
    told->faults.push_back(
        {component, fault.name, std::string(fault.unit), fault.meaning, loop::range_of(fault.range)});
  for (const auto& name : names.reading_names()) {
    const auto reading = names.reading(name);
    if (!reading) continue;
    const auto target = names.target(name);
    told->channels.push_back(
        {name, reading->unit, target.has_value(), target ? target->range : std::nullopt});
  }
  for (const auto& plant : scenario_.plants)
    told->plants.push_back({plant.name.text, plant.type.text, web_of(plant)});
  if (scenario_.controller) told->controller = scenario_.controller->kind();
  told->opcua = scenario_.opcua;
  describe_programs(*told);
  told->parts = parts_;
  told->machine = machine_;
  for (const auto& check : simulation_->outcome().checks) told->checks.push_back(check.name);
  told->notes = simulation_->notes();
  told->notes.insert(told->notes.begin(), notes_.begin(), notes_.end());
  return told;
}

// Values that only a program's text names (an element, a register as wide as an instruction takes it) are
// channels too.
void LineRun::describe_programs(LineDescription& told) {
  auto* const controller = simulation_->controller();
  if (controller == nullptr) return;
  told.programs = controller->programs();
  std::set<std::string> known;
  for (const auto& channel : told.channels) known.insert(channel.name);
  auto& names = simulation_->names();
  for (const auto& program : told.programs) {
    for (const auto& [line, values] : program.values) {
      for (const auto& name : values) {
        if (!known.insert(name).second) continue;
        if (const auto reading = names.reading(name))
          told.channels.push_back({name, reading->unit, names.target(name).has_value()});
      }
    }
  }
}

std::optional<bool> LineRun::is_push_button(const loop::Target& target) const {
  const auto& push = scenario_.panel.push_buttons;
  if (push.empty() || !target.name.starts_with("panel.")) return {};
  return std::any_of(push.begin(), push.end(),
                     [&](const auto& name) { return "panel." + name.text == target.name; });
}

/// What a plant's parameter of the setting's name is where a scenario does not give it; 0 if it has none.
double LineRun::usual_of(const loop::Target& target) const {
  const auto dot = target.name.find('.');
  for (const auto& entry : scenario_.plants) {
    if (entry.name.text != target.name.substr(0, dot)) continue;
    for (const auto& type : plants::plant_types()) {
      if (type.name != entry.type.text) continue;
      const auto usual = type.define();
      for (const auto& row : usual->parameters())
        if (auto* const* value = std::get_if<double*>(&row.value);
            value && row.name == target.name.substr(dot + 1))
          return std::abs(scenario::from_si(**value, target.unit));
    }
  }
  return 0;
}

// A setting that stands at 0 now may be meant to go far.
double LineRun::largest_used(const loop::Target& target) const {
  double largest = std::abs(scenario::from_si(target.read(), target.unit));
  const auto look = [&](const std::vector<std::pair<scenario::Text, scenario::Quantity>>& entries) {
    for (const auto& [name, quantity] : entries) {
      if (name.text != target.name) continue;
      const bool own_unit = !quantity.unit.empty();
      const double given =
          own_unit ? scenario::from_si(scenario::to_si(quantity.number, quantity.unit), target.unit)
                   : quantity.number;
      largest = std::max(largest, std::abs(given));
    }
  };
  for (const auto& stimulus : scenario_.timeline) {
    look(stimulus.set);
    look(stimulus.ramp);
  }
  return largest > 0 ? largest : usual_of(target);
}

void LineRun::watch_programs() {
  auto* const controller = simulation_->controller();
  const bool wanted =
      controller != nullptr &&
      std::any_of(wanted_.begin(), wanted_.end(), [](const auto& one) { return one.second.programs; });
  if (wanted != programs_wanted_) controller->watch_programs(wanted);
  programs_wanted_ = wanted;
}

void LineRun::choose_samples() {
  auto names = std::make_shared<std::vector<std::string>>();
  for (const auto& [asker, own] : wanted_)
    for (const auto& name : own.names)
      if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
  readings_.clear();
  for (const auto& name : *names) readings_.push_back(simulation_->names().reading(name).value());
  sample_names_ = std::move(names);
  samples_ = {sample_names_, {}, {}};
}

}  // namespace drycut::sim::live
