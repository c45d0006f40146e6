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
#include "sim/loop/state_bytes.hpp"
#include "sim/report/film.hpp"
#include "sim/scenario/format.hpp"
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

/// What was done in the session that it goes on from is not in the scenario: it is done again, when it is
/// due.
Replay read(const Line::Options& options, std::vector<scenario::Stimulus>& acts, std::vector<Finding>& notes,
            Problems& problems) {
  if (!options.from) return {scenario::read_scenario(options.scenario, options.set, problems)};
  auto replay = read_session(options.from->session, options.from->at, notes, problems).value_or(Replay{});
  auto& timeline = replay.scenario.timeline;
  const auto first = timeline.end() - static_cast<std::ptrdiff_t>(replay.acts);
  acts.assign(std::move_iterator(first), std::move_iterator(timeline.end()));
  timeline.erase(first, timeline.end());
  std::ranges::stable_sort(acts, {}, [](const auto& act) { return act.at.value_or(0); });
  return replay;
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
    : replay_(read(options, acts_, notes_, problems)), number_(before == nullptr ? 1 : before->number_ + 1) {
  if (!problems.empty()) return;
  if (options.from) session_ = options.from->session.parent_path();
  if (!options.from) replay_.fingerprint = fingerprint_of(scenario_);
  if (before != nullptr && looks_like(*before)) {
    machine_ = before->machine_;
    parts_ = before->parts_;
  } else {
    std::vector<Finding> told;
    std::vector<scenario::Stimulus> again;
    machine_ = machine_of(read(options, again, told, problems).scenario, parts_, problems);
    if (!problems.empty()) return;
  }
  view_ = std::make_unique<LineView>(scenario_, problems);
  if (!problems.empty()) return;
  // With it, not later: its files may be edited while it runs.
  past_ = std::make_unique<Past>(scenario_, problems);
  if (problems.empty()) past_->try_acts(acts_, problems);
}

// The fingerprint knows nothing of what is in the files of meshes.
bool LineRun::looks_like(const LineRun& other) const {
  return replay_.fingerprint == other.replay_.fingerprint && scenario_.pictures.meshes.empty();
}

void LineRun::begin(const fs::path& folder, const Inbox& inbox) {
  again_until_ = next_reached_ = replay_.reached;
  auto kept = session_.empty() ? std::vector<Moment>() : read_moments(session_, replay_.reached);
  if (!kept.empty() && is_of_this(kept.back())) {
    for (const auto& moment : kept) past_->keep(moment);
    come_to(kept.back());
    begin_record(folder, &kept.back());
  } else {
    begin_record(folder, nullptr);
    simulation().begin();
    keep_moment();
  }
  do_again(inbox);
}

/// It goes with this build and the scenario as it is now.
bool LineRun::is_of_this(const Moment& moment) const {
  const auto origin = loop::open_state(*moment.state).head.origin;
  const loop::StateOrigin own(scenario_);
  return origin.version == own.version && origin.build == own.build && origin.differs_from(own).empty() &&
         moment.acts <= acts_.size();
}

void LineRun::come_to(const Moment& moment) {
  for (Problems none; again_ < moment.acts; ++again_) {
    simulation().act(acts_[again_], none);
    past_->done(acts_[again_]);
  }
  simulation().restore(*moment.state);
}

/// What the session did, each when it is due.
void LineRun::do_again(const Inbox& inbox) {
  while (!inbox.stopped() && now() < again_until_) {
    for (; again_ < acts_.size() && acts_[again_].at.value_or(0) <= now(); ++again_) act(acts_[again_]);
    if (!advance()) return;
  }
}

/// `from`: where the record in `session_` is gone on from.
void LineRun::begin_record(const fs::path& folder, const Moment* from) {
  std::vector<record::Observer*> observers = {this};
  if (!folder.empty()) {
    const auto& recording = simulation().recording();
    record_ =
        from == nullptr
            ? std::make_unique<SessionRecord>(folder, scenario_, replay_.fingerprint, recording)
            : std::make_unique<SessionRecord>(folder, SessionRecord::Past{session_, from->reach}, recording);
    observers.push_back(record_.get());
  }
  view_->tell(std::move(observers));
}

void LineRun::keep_moment() {
  past_->keep({now(), past_->acts(), record_ ? record_->reach() : std::nullopt,
               std::make_shared<const StateArchive::Bytes>(simulation().save())});
}

Problems LineRun::not_there_yet(Time time, const char* asked) const {
  if (time <= now()) return {};
  return {{"live.message"_code, asked, 1, 1,
           fmt::format("the line has not come to {} yet", scenario::format_time(time)),
           fmt::format("it is at {}", scenario::format_time(now()))}};
}

void LineRun::look(Asker asker, Look look) {
  if (const auto problems = not_there_yet(look.time, "look"); !problems.empty())
    return look.told(problems, {});
  past_->look(asker, number_, std::move(look));
}

Problems LineRun::come_back(Time from) {
  if (auto problems = not_there_yet(from, "go_on"); !problems.empty()) return problems;
  try {
    from_ = past_->come_before(from);
  } catch (const BadState& bad) {
    return {{"live.other-files"_code, "go_on", 1, 1, fmt::format("that moment cannot be had: {}", bad.what()),
             "restart the line"}};
  }
  return {};
}

void LineRun::go_on(Time from, const fs::path& folder, const Inbox& inbox) {
  ++number_;
  done_.clear();
  events_.clear();
  events_left_out_ = 0;
  awaited_.reset();
  samples_ = {};
  readings_.clear();
  chosen_anew_ = true;
  if (record_) session_ = record_->folder();
  record_.reset();
  // From the moment that was kept on, what was done until then is done again.
  again_until_ = next_reached_ = from / step() * step();
  again_ = 0;
  acts_ = past_->swap(view_, from_, again_until_);
  begin_record(folder, &from_);
  do_again(inbox);
  watch_programs();
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
  past_->rest();
  if (record_) {
    record_->reached(now());
    record_->finish();
    if (record_->lost().empty()) write_moments(record_->folder(), past_->moments());
  }
  keep_retentive();
}

void LineRun::keep_retentive() const {
  loop::keep_retentive(scenario_, view_->simulation().retentive_state());
}

bool LineRun::advance() {
  const bool sound = simulation().advance();
  if (sound && now() >= past_->next_moment()) keep_moment();
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
  if (!simulation().act(stimulus, problems)) return problems;
  past_->done(stimulus);
  if (record_) record_->add(stimulus);
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
  if (!event.empty()) loop::find_event(simulation().all_events(), {event, {1, 1}, {}}, scenario_, problems);
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
    return {{"live.message"_code, "sample", 1, 1, fmt::format("{} channels", names.size()),
             fmt::format("{} at most", most_channels)}};
  for (const auto& name : names) {
    if (problems.size() >= most_slips) break;
    if (view_->known(name) == nullptr)
      problems.push_back({"scenario.unknown-name"_code, "sample", 1, 1,
                          fmt::format("there is no channel '{}'", name),
                          simulation().names().suggest_reading(name)});
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
  past_->leave(asker);
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

void LineRun::tell(News& news) {
  news.run = number_;
  news.time = now();
  news.failure = failure();
  news.record_lost = record_lost();
  view_->look(news);
  std::merge(done_.begin(), done_.end(), events_.begin(), events_.end(), std::back_inserter(news.events),
             [](const auto& one, const auto& other) { return one.time < other.time; });
  done_.clear();
  events_.clear();
  news.events_left_out = std::exchange(events_left_out_, 0);
  news.samples = std::exchange(samples_, {sample_names_, {}, {}});
  if (view_->watches_programs()) news.programs = simulation().controller()->positions(now());
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
  auto& names = simulation().names();
  for (const auto& target : view_->targets())
    told->targets.push_back({target.name, target.unit, target.range, target.name.starts_with("panel."),
                             is_push_button(target), largest_used(target)});
  for (const auto& lamp : view_->lamps()) told->lamps.push_back(lamp.name);
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
    return std::ranges::any_of(simulation().known_events(), [&](const auto& event) {
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
  for (const auto& check : simulation().outcome().checks) told->checks.push_back(check.name);
  told->notes = record::texts_of(simulation().warnings());
  for (auto& note : simulation().notes()) told->notes.push_back(std::move(note.text));
  const auto read = record::texts_of(notes_);
  told->notes.insert(told->notes.begin(), read.begin(), read.end());
  return told;
}

// Values that only a program's text names (an element, a register as wide as an instruction takes it) are
// channels too.
void LineRun::describe_programs(LineDescription& told) {
  auto* const controller = simulation().controller();
  if (controller == nullptr) return;
  told.programs = controller->programs();
  std::set<std::string> known;
  for (const auto& channel : told.channels) known.insert(channel.name);
  auto& names = simulation().names();
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
  const std::vector<scenario::Stimulus>* const known[] = {&scenario_.timeline, &acts_};
  for (const auto* stimuli : known) {
    for (const auto& stimulus : *stimuli) {
      look(stimulus.set);
      look(stimulus.ramp);
    }
  }
  return largest > 0 ? largest : usual_of(target);
}

void LineRun::watch_programs() {
  view_->watch_programs(
      std::any_of(wanted_.begin(), wanted_.end(), [](const auto& one) { return one.second.programs; }));
}

void LineRun::choose_samples() {
  auto names = std::make_shared<std::vector<std::string>>();
  names->reserve(wanted_names_.size());
  readings_.clear();
  for (const auto& [name, askers] : wanted_names_) {
    names->push_back(name);
    readings_.push_back(view_->known(name));
  }
  sample_names_ = std::move(names);
  samples_ = {sample_names_, {}, {}};
  chosen_anew_ = false;
}

}  // namespace drycut::sim::live
