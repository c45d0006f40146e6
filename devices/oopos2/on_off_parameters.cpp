#include <fmt/format.h>

#include <algorithm>

#include "devices/axis/limits.hpp"
#include "devices/oopos2/on_off_positioner.hpp"

namespace drycut::devices::oopos2 {
namespace {

constexpr std::int64_t ratio_bits = 400000;  // cntratio counts 1/100000 Um a pulse, a pulse is 4 bits
static_assert(ratio_bits * 10 == parts_per_um);

int milliseconds(std::int32_t hundredths) { return std::max(hundredths, 0) * 10; }

}  // namespace

bool OnOffPositioner::may_write(Symbol symbol, std::int32_t new_value) {
  if (VariableRow{symbol.index} != "posit" || !movement_.placing() || state("st_still")) return true;
  return movement_.goes_on_from(new_value * parts_per_um);
}

void OnOffPositioner::written(Symbol symbol, std::int32_t new_value) {
  const VariableRow variable{symbol.index};
  value(variable) = new_value;
  check_dependent_range(variable);
  if (variable == "posit") {
    quota_.set_um(new_value, resolution_);
    return;
  }
  rescale();
  recompute();
  if (variable == "cntratio") check_ratio();
  if (variable == "setpos") retarget();
}

void OnOffPositioner::rescale() { quota_.rescale(resolution_, axis::usable(value("cntratio"), ratio_bits)); }

/// What the ratio acts as, if not as itself.
void OnOffPositioner::check_ratio() {
  if (counter_ && resolution_.measure != value("cntratio"))
    report(axis::acts_as("cntratio", value("cntratio"), resolution_.measure));
}

void OnOffPositioner::recompute() {
  movement_.times = {milliseconds(value("tbrake")), milliseconds(value("tinvt")),
                     milliseconds(value("slowdly")), milliseconds(value("toldly"))};
}

void OnOffPositioner::check_dependent_range(VariableRow variable) {
  if (variable == "setpos" || variable == "prspos") report_outside(variable, value("minpos"), "maxpos");
}

void OnOffPositioner::retarget() {
  const bool placing = movement_.placing() && !state("st_still") && search_ == Search::none;
  if (!placing || value("setpos") == wanted_) return;
  const std::int64_t tenths = clamped(std::int64_t{value("setpos")} * 10 + tool_, "setpos", value("setpos"));
  const Legs legs = legs_to(tenths, movement_.leg().backward, movement_.overshooting());
  if (!movement_.retarget(position(), legs.overshoot, legs.last)) {
    report({Diagnostic::Kind::warning, "setpos",
            "kept for the next START: the running placement is in its slow range or would have to turn"});
    return;
  }
  wanted_ = value("setpos");
  target_ = tenths;
  value("actiner") = inertia_band(tenths, value("minpos"), value("maxpos"), value("ninert"));
}

// A counter of absurd size is held where no way from it to a quota overflows.
Parts OnOffPositioner::position() const {
  constexpr Parts most = 400'000'000'000'000'000;
  return std::clamp(quota_.numerator(), -most, most) * 10;
}

bool OnOffPositioner::slows_by_speed() const { return value("slowtype") == 1 || value("slowtype") == 2; }

Parts OnOffPositioner::slow_way() const {
  return (slows_by_speed() ? value("exeslow") : value("slowpos")) * parts_per_um;
}

OnOffPositioner::VariableRow OnOffPositioner::inertia_variable(int band, bool backward) const {
  return VariableRow{VariableRow("iner01") + inertia_row(band, value("dobiner") == 1, backward)};
}

OnOffPositioner::Legs OnOffPositioner::legs_to(std::int64_t tenths, bool backward, bool overshoots) const {
  const int band = inertia_band(tenths, value("minpos"), value("maxpos"), value("ninert"));
  const auto inertia = [&](bool back) { return value(inertia_variable(band, back)) * parts_per_tenth; };
  Legs legs;
  legs.last = {backward, false, true, tenths * parts_per_tenth, inertia(backward)};
  if (!overshoots) return legs;
  const std::int64_t over = std::int64_t{value("overpos")} * 10;
  const std::int64_t beyond = within_limits(tenths + (backward ? -over : over));
  const bool slows = value("bklashmode") <= 2;
  legs.overshoot = Leg{backward, false, slows, beyond * parts_per_tenth, inertia(backward)};
  legs.last.backward = !backward;
  legs.last.inertia = inertia(!backward);
  return legs;
}

/// A quota [Um/10] held between minpos and maxpos.
std::int64_t OnOffPositioner::within_limits(std::int64_t tenths) const {
  return std::max(std::int64_t{value("minpos")} * 10, std::min(tenths, std::int64_t{value("maxpos")} * 10));
}

bool OnOffPositioner::within_tolerance(std::int64_t tenths) const {
  return in_tolerance(position() - tenths * parts_per_tenth, value("tollp"), value("tolln"));
}

}  // namespace drycut::devices::oopos2
