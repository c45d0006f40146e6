#include <fmt/format.h>

#include <algorithm>

#include "devices/axis/limits.hpp"
#include "devices/oopos2/on_off_positioner.hpp"
#include "devices/oopos2/rows.hpp"

namespace drycut::devices::oopos2 {
namespace {

constexpr std::int64_t ratio_bits = 400000;  // cntratio counts 1/100000 Um a pulse, a pulse is 4 bits
static_assert(ratio_bits * 10 == parts_per_um);

int milliseconds(std::int32_t hundredths) { return std::max(hundredths, 0) * 10; }

}  // namespace

bool OnOffPositioner::may_write(Symbol symbol, std::int32_t new_value) {
  if (symbol.index != v_posit || !movement_.placing() || state(st_still)) return true;
  return movement_.goes_on_from(new_value * parts_per_um);
}

void OnOffPositioner::written(Symbol symbol, std::int32_t new_value) {
  value(symbol.index) = new_value;
  check_dependent_range(symbol.index);
  if (symbol.index == v_posit) {
    quota_.set_um(new_value, resolution_);
    return;
  }
  rescale();
  recompute();
  if (symbol.index == v_cntratio) check_ratio();
  if (symbol.index == v_setpos) retarget();
}

void OnOffPositioner::rescale() {
  const axis::Resolution resolution = axis::usable(value(v_cntratio), ratio_bits);
  if (resolution == resolution_) return;
  quota_.rescale(resolution_, resolution);
  resolution_ = resolution;
}

/// What the ratio acts as, if not as itself.
void OnOffPositioner::check_ratio() {
  if (counter_ && resolution_.measure != value(v_cntratio))
    report(axis::acts_as("cntratio", value(v_cntratio), resolution_.measure));
}

void OnOffPositioner::recompute() {
  movement_.times = {milliseconds(value(v_tbrake)), milliseconds(value(v_tinvt)),
                     milliseconds(value(v_slowdly)), milliseconds(value(v_toldly))};
}

void OnOffPositioner::check_dependent_range(int variable) {
  if (variable == v_setpos || variable == v_prspos) report_outside(variable, value(v_minpos), v_maxpos);
}

void OnOffPositioner::retarget() {
  const bool placing = movement_.placing() && !state(st_still) && search_ == Search::none;
  if (!placing || value(v_setpos) == wanted_) return;
  const std::int64_t tenths = clamped(std::int64_t{value(v_setpos)} * 10 + tool_, "setpos", value(v_setpos));
  const Legs legs = legs_to(tenths, movement_.leg().backward, movement_.overshooting());
  if (!movement_.retarget(position(), legs.overshoot, legs.last)) {
    report({Diagnostic::Kind::note, "setpos",
            "kept for the next START: the running placement is in its slow range or would have to turn"});
    return;
  }
  wanted_ = value(v_setpos);
  target_ = tenths;
  value(v_actiner) = inertia_band(tenths, value(v_minpos), value(v_maxpos), value(v_ninert));
}

// A counter of absurd size is held where no way from it to a quota overflows.
Parts OnOffPositioner::position() const {
  constexpr Parts most = 400'000'000'000'000'000;
  return std::clamp(quota_.numerator(), -most, most) * 10;
}

bool OnOffPositioner::slows_by_speed() const { return value(v_slowtype) == 1 || value(v_slowtype) == 2; }

Parts OnOffPositioner::slow_way() const {
  return value(slows_by_speed() ? v_exeslow : v_slowpos) * parts_per_um;
}

int OnOffPositioner::inertia_variable(int band, bool backward) const {
  return v_iner01 + inertia_row(band, value(v_dobiner) == 1, backward);
}

OnOffPositioner::Legs OnOffPositioner::legs_to(std::int64_t tenths, bool backward, bool overshoots) const {
  const int band = inertia_band(tenths, value(v_minpos), value(v_maxpos), value(v_ninert));
  const auto inertia = [&](bool back) { return value(inertia_variable(band, back)) * parts_per_tenth; };
  Legs legs;
  legs.last = {backward, false, true, tenths * parts_per_tenth, inertia(backward)};
  if (!overshoots) return legs;
  const std::int64_t over = std::int64_t{value(v_overpos)} * 10;
  const std::int64_t beyond =
      std::max(std::int64_t{value(v_minpos)} * 10,
               std::min(tenths + (backward ? -over : over), std::int64_t{value(v_maxpos)} * 10));
  const bool slows = value(v_bklashmode) <= 2;
  legs.overshoot = Leg{backward, false, slows, beyond * parts_per_tenth, inertia(backward)};
  legs.last.backward = !backward;
  legs.last.inertia = inertia(!backward);
  return legs;
}

bool OnOffPositioner::within_tolerance(std::int64_t tenths) const {
  return in_tolerance(position() - tenths * parts_per_tenth, value(v_tollp), value(v_tolln));
}

}  // namespace drycut::devices::oopos2
