#include "sim/live/line_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <set>

#include "renders/gltf.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/report/film.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::live {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_channels = 256;       ///< of an asker
constexpr std::size_t most_channels_all = 1024;  ///< different ones, of all askers
constexpr std::size_t most_told = 100;           ///< events of a kind between two news
constexpr std::size_t most_slips = 16;           ///< of a request are told

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

Replay read(const Line::Options& options, std::vector<Finding>& notes, Problems& problems) {
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

LineRun::LineRun(const Line::Options& options, Problems& problems) : LineRun(options, nullptr, problems) {}

LineRun::LineRun(const Line::Options& options, const LineRun& before, Problems& problems)
    : LineRun(options, &before, problems) {}

LineRun::LineRun(const Line::Options& options, const LineRun* before, Problems& problems)
    : replay_(read(options, notes_, problems)), number_(before == nullptr ? 1 : before->number_ + 1) {
  if (!problems.empty()) return;
  if (!options.from) replay_.fingerprint = fingerprint_of(scenario_);
  if (before != nullptr && looks_like(*before)) {
    machine_ = before->machine_;
    parts_ = before->parts_;
  } else {
    std::vector<Finding> told;
    machine_ = machine_of(read(options, told, problems).scenario, parts_, problems);
    if (!problems.empty()) return;
  }
  simulation_ = std::make_unique<loop::Simulation>(scenario_, problems);
  if (!problems.empty()) return;
  simulation_->keep_nothing();
  simulation_->add(*this);
  for (const auto& [name, plant] : simulation_->plants())
    for (auto& part : plant->parts()) shown_.push_back(std::move(part));
  auto& names = simulation_->names();
  for (const auto& name : names.setting_names())
    if (auto target = names.target(name)) targets_.push_back(std::move(*target));
  for (const auto& name : names.lamp_names())
    if (auto lamp = names.reading(name)) lamps_.push_back(std::move(*lamp));
}

// The fingerprint knows nothing of what is in the files of meshes.
bool LineRun::looks_like(const LineRun& other) const {
  return replay_.fingerprint == other.replay_.fingerprint && scenario_.pictures.meshes.empty();
}

void LineRun::begin(const fs::path& folder, const Inbox& inbox) {
  if (!folder.empty()) {
    record_ =
        std::make_unique<SessionRecord>(folder, scenario_, replay_.fingerprint, simulation_->recording());
    simulation_->add(*record_);
    const auto& timeline = scenario_.timeline;
    for (auto act = timeline.end() - static_cast<std::ptrdiff_t>(replay_.acts); act != timeline.end(); ++act)
      record_->add(*act);
  }
  simulation_->begin();
  next_reached_ = replay_.reached;
  while (!inbox.stopped() && now() < replay_.reached && advance()) {
  }
}

const fs::path& LineRun::record() const {
  static const fs::path none;
  return record_ ? record_->folder() : none;
}

const std::string& LineRun::record_lost() const {
  static const std::string none;
  return record_ ? record_->lost() : none;
}

void LineRun::end() {
  if (record_) {
    record_->reached(now());
    record_->finish();
  }
  keep_retentive();
}

void LineRun::keep_retentive() const { loop::keep_retentive(scenario_, simulation_->retentive_state()); }

bool LineRun::advance() {
  const bool sound = simulation_->advance();
  if (record_ && now() >= next_reached_) {
    record_->reached(now());
    next_reached_ = (now() / second + 1) * second;
  }
  return sound;
}

Problems LineRun::act(const std::string& text) {
  Problems problems;
  const auto stimulus = read_act(text, "act", now(), problems);
  if (stimulus) problems = act(*stimulus);
  if (problems.size() > most_slips) problems.resize(most_slips);
  for (auto& problem : problems) problem.file = "act";
  return problems;
}

Problems LineRun::act(const scenario::Stimulus& stimulus) {
  Problems problems;
  if (simulation_->act(stimulus, problems) && record_) record_->add(stimulus);
  return problems;
}

// A master that writes registers as fast as it can makes events by the thousand: those do not displace what
// the machine reports.
void LineRun::happened(const record::RecordedEvent& event) {
  auto& kept = event.source == "timeline" ? done_ : events_;
  kept.push_back(event);
  if (kept.size() > most_told) {
    kept.pop_front();
    ++events_left_out_;
  }
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

/// Nullptr if there is no such value.
const std::function<double()>* LineRun::known(const std::string& name) {
  auto found = known_.find(name);
  if (found == known_.end()) {
    const auto reading = simulation_->names().reading(name);
    if (!reading) return nullptr;
    found = known_.emplace(name, reading->read).first;
  }
  return &found->second;
}

Problems LineRun::want(Asker asker, const Sample& sample) {
  const auto& names = sample.names;
  Problems problems;
  if (names.size() > most_channels)
    return {{"live.message"_code, "sample", 1, 1, fmt::format("{} channels", names.size()),
             fmt::format("{} at most", most_channels)}};
  for (const auto& name : names) {
    if (problems.size() >= most_slips) break;
    if (known(name) == nullptr)
      problems.push_back({"scenario.unknown-name"_code, "sample", 1, 1,
                          fmt::format("there is no channel '{}'", name),
                          simulation_->names().suggest_reading(name)});
  }
  if (!problems.empty()) return problems;
  auto& own = wanted_[asker];
  count(own.names, -1);
  count(names, 1);
  if (const auto all = wanted_names_.size(); all > most_channels_all) {
    count(names, -1);
    count(own.names, 1);
    return {{"live.message"_code, "sample", 1, 1, fmt::format("the line would sample {} channels", all),
             fmt::format("{} at most for all pages together", most_channels_all)}};
  }
  own = sample;
  chosen_anew_ = true;
  watch_programs();
  return {};
}

void LineRun::leave(Asker asker) {
  const auto gone = wanted_.extract(asker);
  if (!gone) return;
  count(gone.mapped().names, -1);
  chosen_anew_ = true;
  watch_programs();
}

void LineRun::count(const std::vector<std::string>& names, int by) {
  for (const auto& name : names)
    if (const auto found = wanted_names_.try_emplace(name, 0).first; (found->second += by) == 0)
      wanted_names_.erase(found);
}

// The columns change only between two news: nobody's curve has a gap because others come and go.
void LineRun::take_samples() {
  if (chosen_anew_ && samples_.times.empty()) choose_samples();
  if (readings_.empty()) return;
  samples_.times.push_back(now());
  for (const auto* read : readings_) samples_.rows.push_back((*read)());
}

Problems LineRun::values_of(const std::vector<std::string>& names, std::vector<double>& values) {
  Problems problems;
  for (const auto& name : names) {
    if (const auto* read = known(name)) {
      values.push_back((*read)());
      continue;
    }
    problems.push_back({"scenario.unknown-name"_code, "read", 1, 1,
                        fmt::format("there is no channel '{}'", name),
                        simulation_->names().suggest_reading(name)});
    if (problems.size() >= most_slips) break;
  }
  if (!problems.empty()) values.clear();
  return problems;
}

void LineRun::tell(News& news) {
  news.run = number_;
  news.time = now();
  news.failure = failure();
  news.record_lost = record_lost();
  news.poses.reserve(shown_.size());
  for (const auto& part : shown_) news.poses.push_back(part.now());
  for (const auto& target : targets_) news.values.push_back(scenario::from_si(target.read(), target.unit));
  for (const auto& lamp : lamps_) news.lamps.push_back(lamp.read());
  std::merge(done_.begin(), done_.end(), events_.begin(), events_.end(), std::back_inserter(news.events),
             [](const auto& one, const auto& other) { return one.time < other.time; });
  done_.clear();
  events_.clear();
  news.events_left_out = std::exchange(events_left_out_, 0);
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
  const auto cuts = [&](const std::string& plant) {
    return std::ranges::any_of(simulation_->known_events(), [&](const auto& event) {
      return event.source == plant && event.name == plants::cut_event;
    });
  };
  for (const auto& plant : scenario_.plants)
    told->plants.push_back({plant.name.text, plant.type.text, web_of(plant), cuts(plant.name.text)});
  if (scenario_.controller) told->controller = scenario_.controller->kind();
  told->opcua = scenario_.opcua;
  describe_programs(*told);
  told->parts = parts_;
  told->machine = machine_;
  for (const auto& check : simulation_->outcome().checks) told->checks.push_back(check.name);
  told->notes = record::texts_of(simulation_->warnings());
  for (auto& note : simulation_->notes()) told->notes.push_back(std::move(note.text));
  const auto read = record::texts_of(notes_);
  told->notes.insert(told->notes.begin(), read.begin(), read.end());
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
  names->reserve(wanted_names_.size());
  readings_.clear();
  for (const auto& [name, askers] : wanted_names_) {
    names->push_back(name);
    readings_.push_back(known(name));
  }
  sample_names_ = std::move(names);
  samples_ = {sample_names_, {}, {}};
  chosen_anew_ = false;
}

}  // namespace drycut::sim::live
