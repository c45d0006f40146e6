#include "sim/studies/faults/bench.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drycut::sim::studies {

namespace {

constexpr std::string_view enable_plug = ".enable";

}  // namespace

FaultBench::FaultBench(const scenario::Scenario& scenario, Problems& problems)
    : scenario_(scenario),
      simulation_(scenario, problems),
      watch_(simulation_.names()),
      checks_(scenario, watch_, simulation_.names(), simulation_.all_events(), problems),
      look_every_((millisecond + scenario.scene.step - 1) / scenario.scene.step * scenario.scene.step) {
  if (!problems.empty()) return;
  if (scenario.faults.told)
    told_ = scenario::Expression::compile(
        *scenario.faults.told, scenario, [this](const std::string& name) { return watch_.operand(name); }, {},
        problems);
  // What the controller wants of a drive, whatever comes through the wire.
  if (auto* controller = simulation_.controller(); controller != nullptr && !told_)
    for (const auto& [terminal, plug] : scenario.wiring) {
      const auto found = controller->terminal(terminal.text);
      const auto* address = std::get_if<devices::Address>(&found);
      if (address == nullptr || !plug.text.ends_with(enable_plug)) continue;
      const auto output = controller->cards().outputs.find(*address);
      if (output != controller->cards().outputs.end()) enables_.push_back({plug.text, &output->second});
    }
  StateArchive::save(fresh_, checks_);
  simulation_.keep_nothing();
  simulation_.add(*this);
  simulation_.tell_steps(*this);
}

bool FaultBench::run_to(Time until) {
  while (simulation_.time() < until)
    if (!simulation_.advance()) return false;
  return true;
}

bool FaultBench::of_plant(const std::string& source) const {
  return std::ranges::any_of(scenario_.plants,
                             [&](const scenario::PlantEntry& plant) { return plant.name.text == source; });
}

void FaultBench::tell(Time now, std::string by) {
  if (!told_by_) told_by_.emplace(now, std::move(by));
}

void FaultBench::happened(const record::RecordedEvent& event) {
  watch_.update();
  checks_.happened(event);
  seen_.push_back({event.time, event.at_seconds(), event.source, event.event, event.severity});
  const bool of_controller = !of_plant(event.source) && event.source != "timeline" && event.source != "card";
  if (!told_ && of_controller && event.severity >= Severity::error)
    tell(event.time,
         fmt::format("{} {}{}{}", event.source, event.event, event.text.empty() ? "" : ": ", event.text));
}

void FaultBench::stepped(Time now) {
  if (checks_.looks_at_steps()) checks_.stepped(now);
  if (now < next_look_) return;
  next_look_ = now + look_every_;
  for (auto& enable : enables_) {
    if (enable.was_on && !enable.output->level) tell(now, enable.plug + " off");
    enable.was_on = enable.output->level;
  }
  if (!told_) return;
  watch_.update();
  const bool holds = told_->evaluate().holds;
  if (holds && !held_) tell(now, scenario_.faults.told->text);
  held_ = holds;
}

void FaultBench::sample(Time now) {
  watch_.update();
  checks_.sample(now);
}

void FaultBench::watch_anew() {
  auto archive = StateArchive::restoring(fresh_.data(), fresh_.size());
  checks_.visit(archive);
  seen_.clear();
  told_by_.reset();
  next_look_ = simulation_.time();
  for (auto& enable : enables_) enable.was_on = enable.output->level;
  if (!told_) return;
  watch_.update();
  held_ = told_->evaluate().holds;
}

FaultCell FaultBench::cell(const FaultQuestion& question, const TriedFault& fault,
                           const FaultMoment& moment) {
  simulation_.restore(moment.state);
  watch_anew();
  simulation_.names().fault(fault.component, fault.name)->act(fault.value);

  FaultCell cell;
  const double begin = seconds(moment.at);
  std::size_t looked = 0;
  const auto breaks = [&] {
    for (; looked < seen_.size(); ++looked) {
      const auto& event = seen_[looked];
      const auto name = event.source + "." + event.event;
      if (event.severity != Severity::damage || question.known_damage.contains(name)) continue;
      cell.kind = FaultCell::Kind::damage;
      cell.harm = name;
      cell.harm_after = event.at - begin;
      return true;
    }
    return false;
  };
  bool broken = false;
  while (simulation_.time() < moment.until && !broken) {
    if (!simulation_.advance()) break;
    broken = breaks();
  }

  double last_cut = begin;
  for (const auto& event : seen_) {
    if (event.source != question.cutter || event.event != plants::cut_event) continue;
    ++cell.cuts;
    last_cut = event.at;
  }
  cell.goes_on = question.cycle > 0 && cell.cuts > 0 &&
                 last_cut >= seconds(moment.until - cycles_behind * question.cycle);
  if (told_by_) {
    cell.told_by = told_by_->second;
    cell.told_after = seconds(told_by_->first - moment.at);
  }
  if (broken) return cell;
  if (!simulation_.failure().empty()) {
    cell.kind = FaultCell::Kind::stopped;
    cell.harm = simulation_.failure();
    cell.harm_after = seconds(simulation_.time() - moment.at);
    return cell;
  }
  for (const auto& check : product())
    if (!check.passed && check.failed_at &&
        (!cell.harm_after || *check.failed_at - begin < *cell.harm_after)) {
      cell.harm = check.name;
      cell.detail = check.detail;
      cell.harm_after = *check.failed_at - begin;
    }
  if (cell.harm.empty() && moment.cuts && !cell.goes_on) {
    cell.harm = "no more cuts";
    cell.harm_after = last_cut + seconds(question.cycle) - begin;  // when the next was due
  }
  const bool in_time = told_by_ && told_by_->first - moment.at <= scenario_.faults.within;
  if (in_time || (told_by_ && cell.harm.empty()))
    cell.kind = FaultCell::Kind::told;
  else if (!cell.harm.empty())
    cell.kind = FaultCell::Kind::wrong;
  return cell;
}

}  // namespace drycut::sim::studies
