#include "devices/oopos2/on_off_positioner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/state_archive.hpp"
#include "devices/axis/position.hpp"
#include "devices/device.hpp"
#include "devices/oopos2/oopos2.hpp"

namespace drycut::devices::oopos2 {

std::unique_ptr<Device> make_oopos2(const Resources& resources, Cards& cards) {
  return std::make_unique<OnOffPositioner>(resources, cards);
}

OnOffPositioner::OnOffPositioner(const Resources& resources, Cards& cards)
    : period_ms_(std::max(resources[FieldRow("TCamp")].number, 1)) {
  counter_ = connect(cards.counters, resources[FieldRow("IQCTL")]);
  enable_ = connect(cards.inputs, resources[FieldRow("IAZero")]);
  zero_line_ = resources[FieldRow("ILine")].number;
  for (int i = 0; i < outputs; ++i)
    outputs_[i].terminal = connect(cards.outputs, resources[FieldRow("OutAva") + i]);
}

void OnOffPositioner::power_up() {
  Device::power_up();
  movement_.abort();
  transducer_ = {};
  frequency_ = {};
  search_ = Search::none;
  for (Output& output : outputs_) {
    if (output.terminal) {
      output.terminal->level = false;
      output.turn.release(output.terminal->held);
    }
    output.level = false;
  }
}

void OnOffPositioner::Output::visit(StateArchive& archive) { STATE(archive, turn, level); }
void OnOffPositioner::visit(StateArchive& archive) {
  Device::visit(archive);
  STATE(archive, outputs_, transducer_, quota_, resolution_, frequency_, movement_, target_, tool_, wanted_,
        inertia_noted_, search_, search_backward_, search_slow_, search_zero_, enable_was_, enable_released_,
        zero_);
}

void OnOffPositioner::initialise() {
  rescale();
  recompute();
  check_ratio();
  // A kept position goes on with its remainder, unless memory was restored from elsewhere.
  if (quota_.um(resolution_) != value("posit")) quota_.set_um(value("posit"), resolution_);
  transducer_.rebase(count_of(counter_));
  enable_was_ = is_on(enable_);
  enable_released_ = false;
  zero_.reset();
}

void OnOffPositioner::latch() {
  if (!state("st_init")) return;
  const std::int64_t counted =
      transducer_.follow(count_of(counter_), state("st_cntlock"), state("st_cntrev"));
  quota_.count(counted, resolution_);
  value("posit") = static_cast<std::int32_t>(quota_.um(resolution_));
  if (frequency_.sample(counted, period_ms_, axis::frequency_window_ms(0))) {
    const double rate = frequency_.bits_per_second();
    const double bits_per_speed =
        axis::um_per_second(value("decpt"), value("unitvel")) * axis::bits_per_um(resolution_);
    value("frq") = axis::to_long(rate / 4);
    value("vel") = axis::to_long(rate / bits_per_speed);
  }
  movement_.tick(period_ms_);
}

void OnOffPositioner::interrupt(int line, bool rising) {
  if (!state("st_init") || !rising || line != zero_line_ || zero_) return;
  zero_ = counter_ ? transducer_.total_at(counter_->latched, state("st_cntlock"), state("st_cntrev"))
                   : transducer_.total();
}

void OnOffPositioner::step() {
  sample_preset();
  measure();
  // What follows a movement without a pause begins in the same sample.
  while (movement_.step(position(), slow_way())) movement_ended();
  put_out();
  value("posit") = static_cast<std::int32_t>(quota_.um(resolution_));
}

// The slow range is held once the axis is in it.
void OnOffPositioner::measure() {
  const MovementPhase phase = movement_.phase();
  if (movement_.placing() &&
      (phase == MovementPhase::slowdown || phase == MovementPhase::slow || phase == MovementPhase::tolerance))
    return;
  const Slowdown slowdown{value("slowtype"), value("maxslow"), value("minslow"), value("maxvel")};
  value("exeslow") = slows_by_speed() ? slow_range(slowdown, value("vel")) : 0;
}

void OnOffPositioner::movement_ended() {
  if (movement_.placing()) {
    const bool hit = within_tolerance(target_);
    recalculate_inertia(hit);
    set_state("st_toll", hit);
    if (!movement_.driven() && !hit)
      report({Diagnostic::Kind::warning, search_ == Search::none ? "setpos" : "prspos",
              fmt::format("no output was switched on, the quota {} is within the inertia range",
                          static_cast<double>(target_) / 10)});
  }
  const std::int64_t preset = std::int64_t{value("prspos")} * 10;
  if (search_ == Search::halt && (value("enstol") == 1 || !within_tolerance(preset))) {
    search_ = Search::place;
    place(preset);
    return;
  }
  if (search_ == Search::halt || search_ == Search::place) {
    set_state("st_prsok", true);
    end_search();
  }
  set_state("st_still", true);
}

// A placement whose last leg needed no output has not coasted: there is nothing to learn from it.
void OnOffPositioner::recalculate_inertia(bool in_tolerance) {
  const std::int32_t mode = value("inertmode");
  if (!movement_.driven() || !(mode == 2 || (mode == 1 && !in_tolerance))) return;
  const Leg& leg = movement_.leg();
  const Parts off = position() - target_ * parts_per_tenth;
  const auto old = static_cast<std::int32_t>(leg.inertia / parts_per_tenth);
  const Parts beyond = leg.backward ? -off : off;
  const std::int32_t fresh = recalculated_inertia(old, beyond);
  const VariableRow variable = inertia_variable(value("actiner"), leg.backward);
  value(variable) = fresh;
  note_held_inertia(variable, coasted_way(old, beyond));
  const std::int32_t most = value("maxiner");
  set_state("st_erin", most != 0 && std::abs(fresh - old) > most);
}

// An axis that coasts farther than the word says would miss every placement without a word about it.
void OnOffPositioner::note_held_inertia(VariableRow variable, std::int64_t coasted) {
  bool& noted = inertia_noted_.at(static_cast<std::size_t>(variable - VariableRow("iner01")));
  if (coasted <= largest_inertia || noted) return;
  noted = true;
  report({Diagnostic::Kind::warning, std::string(name_of(variable)),
          fmt::format("the way coasted would be {} Um/10, held at {}", coasted, largest_inertia)});
}

void OnOffPositioner::put_out() {
  const Outputs now = movement_.outputs();
  set_state("st_movfwd", now.forward);
  set_state("st_movbwd", now.backward);
  set_state("st_movslow", now.slow);
  set_state("st_movdir", movement_.last_backward());
  set_state("st_brake", now.braked == (value("breaktype") != 1));

  put("OutAva", now.forward);
  put("OutInd", now.backward);
  put("OutDir", state("st_movdir"));
  put("OutMov", now.forward || now.backward);
  put("OutRal", now.slow);
  put("OutFre", state("st_brake"));
}

void OnOffPositioner::put(FieldRow field, bool level) {
  Output& output = outputs_[field - FieldRow("OutAva")];
  if (!output.terminal) return;
  if (state("st_regoff") && field != "OutFre") {
    // What was on goes off with it; what was off may be another device's by now.
    if (output.level) output.terminal->level = false;
    output.level = false;
    output.turn.release(output.terminal->held);
    return;
  }
  output.level = output.terminal->level = level;
  if (output.turn.take(output.terminal->held))
    report({Diagnostic::Kind::warning, std::string(table::fields[field].name),
            "another device drives the same output; of devices that share one, all but one need REGOFF"});
}

}  // namespace drycut::devices::oopos2
