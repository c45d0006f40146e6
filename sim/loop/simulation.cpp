#include "sim/loop/simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "plants/motor_load.hpp"
#include "sim/loop/bindings.hpp"
#include "sim/loop/checks.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/directions.hpp"
#include "sim/loop/disturbances.hpp"
#include "sim/loop/drive_judge.hpp"
#include "sim/loop/guests.hpp"
#include "sim/loop/hunting.hpp"
#include "sim/loop/inputs.hpp"
#include "sim/loop/links.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/odd_parameters.hpp"
#include "sim/loop/opcua_names.hpp"
#include "sim/loop/overwritten.hpp"
#include "sim/loop/played_cams.hpp"
#include "sim/loop/program_words.hpp"
#include "sim/loop/remarks.hpp"
#include "sim/loop/shutter.hpp"
#include "sim/loop/standing.hpp"
#include "sim/loop/strobe.hpp"
#include "sim/loop/timeline.hpp"
#include "sim/loop/unasked.hpp"
#include "sim/loop/units.hpp"
#include "sim/loop/waits.hpp"
#include "sim/loop/watch.hpp"
#include "sim/loop/whereabouts.hpp"
#include "sim/loop/wires.hpp"
#include "sim/record/trace_files.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/motor_catalogue.hpp"
#include "sim/scenario/variable_slips.hpp"
#include "sim/scenario/variables.hpp"

namespace drycut::sim::loop {

Simulation::Simulation(const scenario::Scenario& scenario, Problems& problems)
    : scenario_(scenario),
      step_(scenario.scene.step),
      h_(seconds(scenario.scene.step)),
      world_(scenario.scene.seed),
      shutter_(std::make_unique<Shutter>(scenario.pictures)),
      remarks_(std::make_unique<Remarks>()),
      open_(std::make_unique<OpenTerminals>()) {
  const auto before = problems.size();
  load_controller(problems);
  build_plants(problems);
  if (controller_) {
    bus_.connect(scenario, *controller_, named_, problems);
    refuse_shared_names(scenario, *controller_, problems);
    check_periods(problems);
    delay_outputs(problems);
  }
  names_ = std::make_unique<Names>(named_, controller_.get(), bus_.panel());
  names_->offer(bus_.faults());
  if (!controller_ && scenario.controller) names_->assume_controller(scenario.wiring);
  check_panel(problems);
  if (!scenario.wiring.empty()) links_ = std::make_unique<Links>(scenario, named_, *names_, problems);
  watch_ = std::make_unique<Watch>(*names_);
  if (!scenario.disturbances.empty())
    disturbances_ = std::make_unique<Disturbances>(scenario, *names_, problems);
  if (!scenario.inputs.empty())
    inputs_ = std::make_unique<Inputs>(scenario, named_, *names_, problems, notes_of_setup_);
  timeline_ = std::make_unique<Timeline>(scenario, *names_, controller_.get(), problems);
  for (const auto& [name, plant] : named_) {
    for (const auto& type : plant->event_types()) {
      KnownEvent event{name, std::string(type.name), {}, type.severity};
      for (const auto& value : type.values) event.values.emplace_back(value.name, value.unit);
      known_events_.push_back(std::move(event));
    }
  }
  check_opcua_names(scenario, *names_, known_events_, problems);
  all_events_ = known_events_;
  for (auto& event : events_of_every_run()) all_events_.push_back(std::move(event));
  checks_ = std::make_unique<Checks>(scenario, *watch_, *names_, all_events_, problems);
  if (scenario.faults.told) {
    Watch only_named(*names_);  // who tries faults looks at it, no run does
    scenario::Expression::compile(
        *scenario.faults.told, scenario, [&](const std::string& name) { return only_named.operand(name); },
        names_->reading_names(), problems);
  }
  captions_ = std::make_unique<Captions>(
      bind_recording({scenario, named_, *names_, *watch_, known_events_, all_events_}, recording_, problems));
  drives_ = std::make_unique<DriveJudge>(scenario, named_);
  unasked_ = std::make_unique<Unasked>(scenario, known_events_);
  observers_ = {checks_.get(), drives_.get(), unasked_.get(), shutter_.get(), remarks_.get(), &causes_};
  if (checks_->looks_at_steps()) tell_steps(*checks_);
  if (controller_ && problems.size() == before) look_after_program();
  if (problems.size() == before) compare_with_machine();
  scenario::blame_variables(scenario, problems, before, [&](const scenario::Trial& trial) {
    Problems left;
    const auto again =
        scenario::read_scenario(scenario.file, scenario.overrides, left, plants::plant_types(), &trial);
    if (again.buildable) const Simulation built(again, left);
    return left;
  });
}

Simulation::~Simulation() = default;

bool Simulation::act(const scenario::Stimulus& stimulus, Problems& problems) {
  return timeline_->add(stimulus, problems);
}

void Simulation::load_controller(Problems& problems) {
  for (const auto& plant : scenario_.plants)
    for (auto& note : scenario::notes_of_models(plant)) notes_of_setup_.push_back(std::move(note));
  for (auto& note : notes_of_guests(scenario_)) notes_of_setup_.push_back(std::move(note));
  controller_ = loop::load_controller(scenario_, problems, &notes_of_setup_);
  for (auto& note : scenario::unused_variables(scenario_)) notes_of_setup_.push_back(std::move(note));
}

void Simulation::compare_with_machine() {
  if (!controller_) return;
  contradictions_ = contradictions(scenario_, named_);
  for (const auto& note : contradictions_) notes_of_setup_.push_back(note);
  auto rarely = rarely_sampled(*controller_);
  contradictions_.insert(contradictions_.end(), rarely.begin(), rarely.end());
  *open_ = open_terminals(*controller_, bus_.unwired(), named_);
  warnings_ = open_->moving;
  warnings_.insert(warnings_.end(), open_->others.begin(), open_->others.end());
  for (auto& doubt : controller_->doubts())
    if (doubt.value.empty() || !scenario::sets(scenario_, doubt.value))
      doubts_of_program_.emplace_back(doubt.code, doubt.text);
  warnings_.insert(warnings_.end(), doubts_of_program_.begin(), doubts_of_program_.end());
  for (auto& doubt : doubtful_wires(scenario_, *controller_)) warnings_.push_back(std::move(doubt));
  for (auto& crossed : crossed_wires(scenario_, *controller_)) warnings_.push_back(std::move(crossed));
  for (auto& idle : faults_of_nothing(scenario_, named_)) warnings_.push_back(std::move(idle));
  std::ranges::move(rarely, std::back_inserter(warnings_));
}

// Its axes' directions, and the numbers of its programs that say how far they are, of those that are looked
// at.
void Simulation::look_after_program() {
  directions_ = std::make_unique<Directions>(scenario_, *controller_);
  hunting_ = std::make_unique<Hunting>(*controller_);
  standing_ = std::make_unique<Standing>(scenario_, *controller_);
  whereabouts_ = std::make_unique<Whereabouts>(scenario_, *controller_, *names_);
  observers_.insert(observers_.end(),
                    {directions_.get(), hunting_.get(), standing_.get(), whereabouts_.get()});
  watch_->each([&](const Reading& reading, const double* slot) {
    const bool of_program = reading.unit.empty() && reading.name.find('.') == std::string::npos;
    if (of_program && controller_->find(reading.name)) causes_.follow(reading.name, slot);
  });
}

void Simulation::build_plants(Problems& problems) {
  std::unordered_map<std::string_view, plants::Plant*> built;
  const auto find = [&](std::string_view name) -> plants::Plant* {
    const auto found = built.find(name);
    return found == built.end() ? nullptr : found->second;
  };
  for (const auto& entry : scenario_.plants) {
    const auto failed = !world_.failure().empty();
    plants_.push_back(entry.definition->build(world_, find));
    if (!failed && !world_.failure().empty())
      problems.push_back(problem_of_guest("fmu.refused"_code, scenario_, entry, world_.failure(),
                                          "look at the FMU in the tool that wrote it"));
    named_.push_back({entry.name.text, plants_.back().get()});
    built.emplace(entry.name.text, plants_.back().get());
  }
}

void Simulation::check_periods(Problems& problems) const {
  const auto place = scenario_.scene.step_place;
  for (const auto& period : controller_->periods()) {
    if (period.ns % step_ == 0) continue;
    problems.push_back(
        scenario::problem_at("scenario.time-grid"_code, scenario_, place,
                             fmt::format("{} of {} ns is not a whole multiple of the step of {} ns",
                                         period.name, period.ns, step_),
                             "choose a step that divides it"));
  }
}

void Simulation::check_panel(Problems& problems) const {
  if (scenario_.panel.push_buttons.empty()) return;
  std::vector<std::string> switches;
  switches.reserve(bus_.panel().switches.size());
  for (const auto& [name, port] : bus_.panel().switches) switches.push_back(name);
  for (const auto& push : scenario_.panel.push_buttons) {
    if (bus_.panel().switches.contains(push.text)) continue;
    problems.push_back(scenario::problem_at(
        "timeline.nothing-to-set"_code, scenario_, push.place,
        fmt::format("the panel has no switch '{}'", push.text),
        switches.empty() ? "wire one: {2.INP03: panel.start}" : did_you_mean(push.text, switches)));
  }
}

// The outputs come late by what the controller computes, at most until its next sample.
void Simulation::delay_outputs(Problems& problems) {
  const Time computing = scenario_.controller->compute_time;
  for (const auto& wire : bus_.analogue_wires()) {
    const Time period = controller_->output_period(wire.terminal);
    if (period == 0 || computing <= period) continue;
    problems.push_back(problem_at(
        "scenario.time-grid"_code, scenario_, scenario_.controller->place,
        fmt::format("compute_time of {} is longer than the sampling time {} of {}",
                    scenario::format_time(computing), scenario::format_time(period), wire.terminal_name),
        fmt::format("at most {}", scenario::format_time(period))));
  }
  bus_.compute_for(computing / step_);
}

void Simulation::write_to(const std::filesystem::path& trace, const std::filesystem::path& events) {
  write_to(std::make_unique<record::TraceFiles>(recording_, trace, events), trace.parent_path());
}

void Simulation::write_to(std::unique_ptr<record::Observer> files, const std::filesystem::path& folder) {
  recording_.spool_in(folder);
  files_ = std::move(files);
  observers_.push_back(files_.get());
}

void Simulation::keep_nothing() {
  recording_.keep_nothing();
  shutter_->close();
}

void Simulation::follow_cams(CamJudge judge, bool keeps_samples) {
  if (!controller_) return;
  judge_cams_ = std::move(judge);
  // A servo behind a pulse output tells on its own channel how far it is behind.
  const auto deviation = [this](const devices::Address& pulses) -> std::function<double()> {
    constexpr std::string_view train = ".pulses";
    for (const auto& wire : scenario_.wiring) {
      const auto terminal = controller_->terminal(wire.terminal.text);
      const auto* address = std::get_if<devices::Address>(&terminal);
      const auto& plug = wire.plug.text;
      if (address == nullptr || !(*address == pulses) || !plug.ends_with(train)) continue;
      const auto reading = names_->reading(plug.substr(0, plug.size() - train.size()) + ".deviation");
      if (reading) return reading->read;
    }
    return {};
  };
  cams_ = std::make_unique<CamRecorder>(controller_->cam_axes(), deviation, keeps_samples);
  observers_.push_back(cams_.get());
}

// The order of everything inside a step, once and whole (design: time).
void Simulation::step() {
  timeline_->run(time_, recording_);
  if (inputs_) inputs_->run(time_);
  if (disturbances_) disturbances_->run(time_);

  if (controller_) {
    controller_->run_devices(time_);
    controller_->run_tasks(time_);
    if (cams_) cams_->step();
    bus_.outputs_to_plants();
  }
  if (links_) links_->run();

  for (auto& plant : plants_) plant->drive(h_);
  world_.step(h_);
  for (auto& plant : plants_) plant->sense(h_);

  if (controller_) bus_.plants_to_inputs();

  if (has_events()) collect_events();
  time_ += step_;
  for (auto* observer : steppers_) observer->stepped(time_);
  if (!world_.failure().empty()) failure_ = world_.failure();
  if (time_ >= next_record_) record();
  if (time_ >= shutter_->next()) snapshot();
}

// A drive tells how long it was saturated, the machine cycle says how much that is.
void Simulation::add_share(record::RecordedEvent& event) const {
  if (event.event != "saturated") return;
  const auto* begin = event.find("begin");
  const auto* end = event.find("end");
  if (begin == nullptr || end == nullptr) return;
  const double share = (end->number - begin->number) / drives_->cycle_of(event.source, event.time + step_);
  event.values.push_back({"share", 100 * std::min(1.0, share), "%"});
}

// Something has happened in this step, or was told by who works at the machine.
bool Simulation::has_events() const {
  for (const auto& plant : plants_)
    if (plant->has_events()) return true;
  return (controller_ && controller_->has_events()) || bus_.has_losses() ||
         events_seen_ != recording_.events().size();
}

void Simulation::collect_events() {
  const auto severity_of = [&](const std::string& source, std::string_view name) {
    for (const auto& known : known_events_)
      if (known.source == source && known.name == name) return known.severity;
    throw std::logic_error(fmt::format("{} has not declared its event {}", source, name));
  };
  for (const auto& [name, plant] : named_) {
    if (!plant->has_events()) continue;
    for (const auto& event : plant->take_events()) {
      record::RecordedEvent recorded{time_, event.fraction * h_,          name, std::string(event.name), {},
                                     "",    severity_of(name, event.name)};
      for (const auto& value : event.values) {
        recorded.values.push_back({std::string(value.name), value.number, std::string(value.unit)});
      }
      add_share(recorded);
      recording_.happened(recorded);
    }
  }
  if (controller_ && controller_->has_events()) {
    for (auto& event : controller_->take_events()) {
      if (event.event == "error" && program_error_.empty()) {
        program_error_ = fmt::format("{}, at {} s", event.text, record::seconds_text(time_));
      }
      const auto severity = severity_of_every_run(event.event);
      recording_.happened(
          {time_, 0, std::move(event.source), std::move(event.event), {}, std::move(event.text), severity});
    }
  }
  for (auto& loss : bus_.take_losses())
    recording_.happened({time_, 0, "card", loss.event, {}, loss.text, severity_of_every_run(loss.event)});
  if (events_seen_ == recording_.events().size()) return;
  watch_->update();
  while (events_seen_ < recording_.events().size()) {
    const auto event = recording_.events()[events_seen_++];
    for (auto* observer : observers_) observer->happened(event);
  }
  if (recording_.keeps()) return;
  recording_.forget_events();
  events_seen_ = 0;
}

void Simulation::record() {
  watch_->update();
  recording_.sample(time_);
  for (auto* observer : observers_) observer->sample(time_);
  next_record_ = time_ + scenario_.record.every;
  if (const auto name = watch_->not_finite(); !name.empty()) {
    failure_ = fmt::format("{} is no longer a finite number at {} s: the simulation diverged", name,
                           record::seconds_text(time_));
  }
}

void Simulation::snapshot() {
  if (parts_.empty())
    for (auto& plant : plants_)
      for (auto& part : plant->parts()) parts_.push_back(std::move(part));
  auto* shot = shutter_->look(time_, parts_);
  if (shot == nullptr) return;
  watch_->update();
  for (auto& plant : plants_) plant->callouts(shot->callouts);
  for (const auto* slot : captions_->slots) shot->caption.push_back(*slot);
  if (const auto& [plant, slot, metres] = captions_->quota; plant != nullptr)
    shot->quota = {plant->quota_line(*slot * metres).value(), *slot * metres};
}

const std::vector<Snapshot>& Simulation::snapshots() const { return shutter_->kept(); }
std::optional<double> Simulation::frames_event() const { return shutter_->event_at(); }
const std::vector<std::string>& Simulation::caption_units() const { return captions_->units; }

std::vector<std::optional<Strobe>> Simulation::strobes() const {
  std::vector<PartWithPitch> parts;
  for (const auto& [name, plant] : named_)
    for (const auto& part : plant->parts())
      if (part.pitch > 0) parts.push_back({name + "." + part.name, part.pitch});
  return loop::strobes(parts, shutter_->kept());
}

std::vector<Finding> Simulation::notes() const {
  std::vector<Finding> notes;
  if (!open_->unnamed.empty())
    notes.emplace_back("wiring.unused-terminal"_code,
                       fmt::format("not wired: {}", fmt::join(open_->unnamed, ", ")));
  notes.insert(notes.end(), notes_of_setup_.begin(), notes_of_setup_.end());
  for (auto& lost : bus_.lost()) notes.push_back(std::move(lost));
  const auto& around = scenario_.pictures.around;
  if (around && scenario_.pictures.frames && !shutter_->event_at()) {
    notes.emplace_back("pictures.event-missing"_code,
                       fmt::format("no frames: {}[{}] did not happen; {} did", around->event.text,
                                   around->number, shutter_->seen()));
  }
  if (const auto strobe = worst_strobe(strobes()))
    notes.emplace_back("pictures.strobe"_code, text_of(*strobe, scenario_.pictures, scenario_.scene.step));
  if (inputs_ && time_ >= inputs_->end().at && time_ < scenario_.scene.duration)
    notes.emplace_back("input.over"_code,
                       fmt::format("the run ended at {} s, before its scene.duration: there the recording "
                                   "ends that drives {}",
                                   record::seconds_text(time_), inputs_->end().of));
  if (time_ > 0)  // it ran
    for (auto& undone : timeline_->left_undone(time_)) notes.push_back(std::move(undone));
  for (auto& told : contradicting_parameters()) notes.push_back(std::move(told));
  if (directions_)
    for (const auto& found : directions_->found()) notes.push_back(found.what);
  if (standing_ && time_ > 0)
    if (auto never = standing_->never_on()) notes.push_back(std::move(*never));
  if (whereabouts_)
    for (auto& zero : whereabouts_->zeros()) notes.push_back(std::move(zero));
  for (auto& remark : remarks_->notes()) notes.push_back(std::move(remark));
  if (time_ > 0 && drives_->judges())
    for (auto& drive : drives_->verdicts())
      for (auto& note : drive.notes)
        notes.emplace_back(drive.energy_cycles == 0 ? "drive.not-judged"_code : "drive.unsteady"_code,
                           std::move(note));
  return notes;
}

std::vector<Reading> Simulation::controller_values() {
  std::vector<Reading> values;
  if (!controller_) return values;
  for (const auto& name : controller_->names()) {
    auto value = controller_->find(name);
    if (!value) continue;
    if (value->of_table && value->read() == 0) continue;
    values.push_back({name, value->unit, value->read});
  }
  return values;
}

void Simulation::run_to_end(const std::function<void(Time)>& progress) {
  constexpr int steps_between_reports = 2000;
  if (keep_plain_) shutter_->close();  // states want rows and events, and no poses
  begin();
  int countdown = steps_between_reports;
  const auto next_after = [&](Time now) { return keep_ ? (now / keep_every_ + 1) * keep_every_ : never; };
  Time next_state = next_after(time_);
  const Time end = inputs_ ? std::min(scenario_.scene.duration, inputs_->end().at) : scenario_.scene.duration;
  while (time_ < end && failure_.empty()) {
    step();
    if (time_ >= next_state) {
      keep_();
      next_state = next_after(time_);
    }
    if (--countdown == 0) {
      countdown = steps_between_reports;
      if (progress) progress(time_);
    }
  }
}

record::Outcome Simulation::run(const std::function<void(Time)>& progress) {
  try {
    run_to_end(progress);
    for (auto* observer : observers_) observer->finish();
  } catch (const std::runtime_error& no_room) {
    failure_ = no_room.what();
  }
  return outcome();
}

std::vector<Finding> Simulation::contradicting_parameters() const {
  if (!controller_ || time_ == 0) return {};
  auto found = strange_units(scenario_, *controller_, named_);
  for (auto& speed : contradicting_speeds(scenario_, *controller_, named_)) found.push_back(std::move(speed));
  return found;
}

std::string Simulation::unpressed() const {
  const auto& pushes = scenario_.panel.push_buttons;
  std::string unpressed;
  for (const auto& [name, port] : bus_.panel().switches) {
    const bool is_push = std::any_of(pushes.begin(), pushes.end(),
                                     [&name = name](const auto& push) { return push.text == name; });
    if (is_push || bus_.panel().pressed.contains(name)) continue;
    std::string waits;
    for (const auto& entry : scenario_.timeline)
      for (const auto& [target, value] : entry.set)
        if (entry.when && value.number != 0 && target.text == "panel." + name) {
          const auto due = timeline_->due(entry.place.line);
          waits = fmt::format(": '{}' of line {} {}", entry.when->text, entry.place.line,
                              due ? fmt::format("came true and is due at {} s", record::seconds_text(*due))
                                  : "never came true");
        }
    unpressed += fmt::format("{}nothing pressed {} (panel.{} was never on{})", unpressed.empty() ? "" : ", ",
                             name, name, waits);
  }
  return unpressed;
}

namespace {

/// Phrases as one, of the first one's kind.
std::optional<Finding> joined(const std::vector<Finding>& findings) {
  if (findings.empty()) return {};
  auto all = findings.front();
  all.text = fmt::format("{}", fmt::join(record::texts_of(findings), "; "));
  return all;
}

/// The last instant [s] at which a check that failed could still have held.
double looked_until(const record::Outcome& outcome) {
  double until = 0;
  for (const auto& check : outcome.checks)
    if (!check.passed)
      until = std::max(until, check.deadline && check.failed_at ? *check.failed_at : seconds(outcome.end));
  return until;
}

/// Where nothing tells why: what failed first, or alone.
Finding what_failed_first(const std::vector<record::CheckResult>& checks) {
  std::vector<const record::CheckResult*> failed;
  for (const auto& check : checks)
    if (!check.passed) failed.push_back(&check);
  if (failed.size() == 1)
    return {"check.alone-fails"_code, fmt::format("while nothing but check '{}' is amiss", failed[0]->name),
            Finding::Role::cause};
  const auto* first = *std::ranges::min_element(failed, {}, [](const auto* check) {
    return check->failed_at.value_or(std::numeric_limits<double>::infinity());
  });
  return {"check.first-fails"_code,
          fmt::format("check '{}' first{}", first->name,
                      first->failed_at ? fmt::format(", at {:.6g} s", *first->failed_at) : ""),
          Finding::Role::cause};
}

}  // namespace

Causes::Known Simulation::known(const CamJudgement& cams, double until) {
  Causes::Known known;
  known.contradictions = contradictions_;
  for (const auto& cam : cams.doubts)
    if (cam.is_slip) known.contradictions.push_back(cam.what);
  known.contradictions.insert(known.contradictions.end(), doubts_of_program_.begin(),
                              doubts_of_program_.end());
  for (const auto* open : {&open_->moving, &open_->others})
    known.contradictions.insert(known.contradictions.end(), open->begin(), open->end());
  if (controller_) {
    for (auto& crossed : crossed_wires(scenario_, *controller_))
      known.contradictions.push_back(std::move(crossed));
    for (auto& open : without_zero_pulse(scenario_, *controller_))
      known.contradictions.push_back(std::move(open));
    for (auto& backward : backward_masters(scenario_, *controller_, named_))
      known.contradictions.push_back(std::move(backward));
  }
  for (auto& told : contradicting_parameters()) known.contradictions.push_back(std::move(told));
  if (controller_) {
    for (auto& units : different_units(scenario_, *controller_, named_))
      known.contradictions.push_back(std::move(units));
    for (auto& cycle : strange_cycles(cams.cycles, checks_->stated()))
      known.contradictions.push_back(std::move(cycle));
  }
  for (const auto& found : directions_ ? directions_->found() : std::vector<Directions::Found>())
    known.astray.emplace_back(found.at, found.what);
  if (auto lost = search_that_met_a_stop(); lost) known.astray.push_back(std::move(*lost));
  if (hunting_) known.hunting = hunting_->found();
  // An axis that only counts needs no loop.
  const auto moves = [&](const std::string& axis) {
    const auto loops = controller_->position_loops();
    return std::any_of(loops.begin(), loops.end(), [&](const auto& loop) {
      return loop.name == axis && loop.reference &&
             wire_at(scenario_, *controller_, *loop.reference) != nullptr;
    });
  };
  std::optional<Finding> standing;
  if (controller_) {
    const auto waits = waits_of(*controller_, time_);
    const bool waited = waits.since <= until;
    if (waited) standing = joined(waits.texts);
    if (waits.all && waited) known.standing.emplace(waits.since, *standing);
    const auto open = without_loop(*controller_);
    if (!standing && open) standing = open->what;
    if (!standing) {
      auto signs = standing_ ? standing_->texts(time_, until) : std::vector<Finding>();
      if (auto state = causes_.state_that_stands(seconds(time_), until)) signs.push_back(std::move(*state));
      standing = joined(signs);
    }
    if (open && moves(open->axis)) known.contradictions.push_back(open->what);
    if (known.hunting) known.doubts.push_back(known.hunting->second);
    for (auto& text : whereabouts_ ? whereabouts_->texts() : std::vector<Finding>())
      known.doubts.push_back(std::move(text));
    for (auto& doubt : doubtful_wires(scenario_, *controller_)) known.doubts.push_back(std::move(doubt));
    for (auto& odd : odd_parameters(*controller_)) known.doubts.push_back(std::move(odd));
    for (const auto& cam : cams.doubts)
      if (!cam.is_slip) known.doubts.push_back(cam.what);
    if (known.doubts.empty())
      if (auto line = line_of_grip()) known.doubts.push_back(std::move(*line));
  }
  if (auto first = unpressed(); !first.empty())
    known.hindrances.emplace_back("loop.not-pressed"_code, first + (standing ? "; " + standing->text : ""));
  else if (standing)
    known.hindrances.push_back(*standing);
  return known;
}

// Who took hold of material at another speed was told to.
std::optional<Finding> Simulation::line_of_grip() const {
  for (const auto& wire : scenario_.wiring) {
    if (wire.plug.text != causes_.grip()) continue;
    const auto lines = switched_on_by(*controller_, wire.terminal.text);
    if (!lines.empty())
      return Finding{"loop.switched-on"_code,
                     fmt::format("{} ({}) is switched on{}", wire.plug.text, wire.terminal.text, lines)};
  }
  return {};
}

// The home switch lies the other way, or is dead.
std::optional<std::pair<double, Finding>> Simulation::search_that_met_a_stop() const {
  const auto* blow = causes_.first_stop();
  if (blow == nullptr || !standing_) return {};
  const auto never = standing_->never_on(blow->source + ".home");
  if (never.empty()) return {};
  return std::pair(blow->at,
                   Finding{"loop.search-met-stop"_code,
                           fmt::format("{} at {:.6g} s: {}, and {} was never on: the search went the other "
                                       "way, or the switch is not where it should be",
                                       blow->source, blow->at, blow->text, never)});
}

void Simulation::warn_of_program(std::vector<Finding>& warnings) {
  for (auto& text : overwritten(scenario_, *controller_)) warnings.push_back(std::move(text));
  for (auto& text : ended_at_once(scenario_, *controller_, time_)) warnings.push_back(std::move(text));
  for (auto& text : without_zero_pulse(scenario_, *controller_)) warnings.push_back(std::move(text));
}

record::Outcome Simulation::outcome() {
  record::Outcome outcome;
  outcome.end = time_;
  outcome.failure = failure_;
  const bool stopped = !failure_.empty();
  outcome.checks = checks_->results(time_, stopped);
  const auto scenario_checks = outcome.checks.size();
  const bool missed = !outcome.passed();
  outcome.drives = drives_->verdicts();
  for (auto& check : drives_->results(outcome.drives)) outcome.checks.push_back(std::move(check));
  if (controller_) {
    outcome.checks.push_back({"the program runs",
                              "no run-time error stops the tasks",
                              program_error_.empty(),
                              {},
                              "",
                              {},
                              program_error_.empty() ? "no error" : program_error_});
  }
  for (auto& check : unasked_->results()) outcome.checks.push_back(std::move(check));
  for (auto& check : std::span(outcome.checks).subspan(scenario_checks))
    check.so_far = stopped && check.passed;
  auto warnings = warnings_;
  for (const auto& check : outcome.checks)
    if (!check.doubt.empty())
      warnings.emplace_back(check.judged_nothing() ? "check.judged-nothing"_code : "check.far-limit"_code,
                            check.doubt);
  for (const auto& drive : outcome.drives)
    for (const auto& warning : drive.warnings) warnings.emplace_back("drive.warning"_code, warning);
  if (controller_ && time_ > 0) warn_of_program(warnings);
  const auto cams = cams_ && judge_cams_ ? judge_cams_(cams_->played()) : CamJudgement();
  for (const auto& cam : cams.doubts)
    if (cam.is_slip) warnings.push_back(cam.what);
  outcome.add(warnings, Finding::Role::warning);
  outcome.alarms = causes_.alarms();
  if (has_failed_guest(plants_))
    outcome.findings.emplace_back("fmu.failed"_code, "because " + failure_).role = Finding::Role::cause;
  if (outcome.failure.empty() && !outcome.passed()) {
    auto known = this->known(cams, looked_until(outcome));
    if (!missed) known.hindrances.clear();  // only ratings, or what no check asks about
    auto cause = causes_.of(outcome.checks, known);
    outcome.findings.push_back(cause ? std::move(*cause) : what_failed_first(outcome.checks));
    if (auto sign = remarks_->signs().sentence(outcome)) outcome.findings.push_back(std::move(*sign));
  }
  return outcome;
}

namespace {

/// What a plant keeps of its motor for the report.
struct Loads {
  std::string name;
  plants::TellsMotorLoad::Kept* kept;
  void visit(StateArchive& archive) const { archive.log(name, *kept); }
};

}  // namespace

void Simulation::visit(StateArchive& archive) {
  STATE(archive, time_, next_record_, failure_, program_error_);
  for (const auto& [name, plant] : named_)
    archive.under(name, [&, plant = plant] { plant->visit_all(archive); });
  STATE(archive, world_);
  if (controller_) STATE(archive, *controller_);
  STATE(archive, bus_);
  if (disturbances_) STATE(archive, *disturbances_);
  if (inputs_) STATE(archive, *inputs_);
  STATE(archive, *timeline_, *watch_, *checks_, *drives_, *unasked_, *remarks_, causes_);
  if (directions_) STATE(archive, *directions_, *hunting_, *standing_, *whereabouts_);
  STATE(archive, recording_);
  // Who only draws: a run without pictures may go on from one with them, and the other way round.
  archive.part("pictures", shutter_->next() == never && shutter_->kept().empty() ? nullptr : shutter_.get());
  archive.part("cams", cams_.get());
  for (const auto& [name, plant] : named_) {
    auto* const tells = dynamic_cast<plants::TellsMotorLoad*>(plant);
    Loads loads{name + ".loads", tells != nullptr ? tells->motor_loads() : nullptr};
    archive.part(loads.name, loads.kept != nullptr ? &loads : nullptr);
  }
  events_seen_ = recording_.events().size();
}

const StateArchive::Bytes& Simulation::begun_state() const {
  if (begun_state_.empty()) begun_state_ = loop::begun_state(StateOrigin(scenario_));
  return begun_state_;
}

StateArchive::Bytes Simulation::save(StateArchive::Journal* journal) {
  begin();
  StateArchive::Bytes state;
  state.reserve(state_size_ + state_size_ / 2);
  state = begun_state();
  StateArchive::save(state, *this, nullptr, journal);
  state_size_ = state.size();
  StateHead head{{}, time_, keep_every_};
  head.plain = keep_plain_;
  if (journal != nullptr) {
    head.journal = journal->end();
    head.journal_sum = journal->sum;
  }
  seal(state, head);
  return state;
}

void Simulation::restore(std::span<const std::byte> state, std::span<const std::byte> journal, bool others) {
  const auto [head, members] = open_state(state, begun_state());
  if (!head.origin.build.empty()) {
    const StateOrigin own(scenario_);
    if (head.origin.version != own.version || head.origin.build != own.build)
      throw BadState(fmt::format("it was written by drycut {}, build {}; this is {}, build {}",
                                 head.origin.version, head.origin.build, own.version, own.build));
    if (const auto what = head.origin.differs_from(own); !others && !what.empty())
      throw BadState(fmt::format("it is of another scenario or program: {} differ", what));
  }
  if (journal.empty()) {
    auto archive = StateArchive::restoring(members.data(), members.size());
    visit(archive);
    if (archive.left() > 0) throw BadState("it has more members than this machine");
    return;
  }
  if (journal.size() < head.journal) throw BadState("its journal is cut short");
  journal = journal.first(static_cast<std::size_t>(head.journal));
  auto archive = StateArchive::restoring(members, journal);
  visit(archive);
  if (archive.left() > 0) throw BadState("it has more members than this machine");
  if (files_) tell_files();
}

// What was recorded, in the order in which it came: an event of a step is told before the row at its end.
void Simulation::tell_files() {
  const auto rows = recording_.times().size();
  const auto events = recording_.events().size();
  std::size_t event = 0;
  const auto tell_events = [&](Time until) {
    for (; event < events && recording_.events()[event].time < until; ++event)
      files_->happened(recording_.events()[event]);
  };
  StateArchive::Bytes slots;  // which are what the files look at
  StateArchive::save(slots, *watch_);
  for (std::size_t row = 0; row < rows; ++row) {
    tell_events(recording_.times()[row]);
    for (const auto& column : recording_.columns()) watch_->show(column.slot, column.values[row]);
    files_->sample(recording_.times()[row]);
  }
  tell_events(never);
  auto again = StateArchive::restoring(slots.data(), slots.size());
  watch_->visit(again);
}

}  // namespace drycut::sim::loop
