#include <fmt/format.h>

#include "devices/oopos2/on_off_positioner.hpp"

namespace drycut::devices::oopos2 {

bool OnOffPositioner::may_execute(int command) {
  switch (command) {
    case CommandRow("MANSFW"):
    case CommandRow("MANFFW"):
      return value("posit") < value("maxpos");
    case CommandRow("MANSBW"):
    case CommandRow("MANFBW"):
      return value("posit") > value("minpos");
    default:
      return true;
  }
}

void OnOffPositioner::execute(int command) {
  switch (command) {
    case CommandRow("STOP"):
    case CommandRow("REGOFF"):
      end_search();
      movement_.stop();
      break;
    case CommandRow("START"):
      start();
      break;
    case CommandRow("PRESET"):
      preset();
      break;
    case CommandRow("MANSFW"):
    case CommandRow("MANFFW"):
      run(false, command == CommandRow("MANSFW"));
      break;
    case CommandRow("MANSBW"):
    case CommandRow("MANFBW"):
      run(true, command == CommandRow("MANSBW"));
      break;
    case CommandRow("DELCNT"):
      quota_.add_um(value("delta"), resolution_);
      break;
    default:
      break;
  }
}

/// A target [Um/10] held between minpos and maxpos; `quota` is the parameter that it comes from.
std::int64_t OnOffPositioner::clamped(std::int64_t tenths, std::string_view subject, std::int32_t quota) {
  const std::int64_t held = within_limits(tenths);
  if (held != tenths)
    report({Diagnostic::Kind::warning, std::string(subject),
            fmt::format("setpos {} plus tool is outside minpos..maxpos, the axis goes to {}", quota,
                        held / 10)});
  return held;
}

/// What START and a manual movement forget of the placement before.
void OnOffPositioner::leave_quota() {
  set_state("st_toll", false);
  set_state("st_sttoll", false);
}

void OnOffPositioner::start() {
  leave_quota();
  tool_ = value("tool");
  wanted_ = value("setpos");
  const std::int64_t tenths = clamped(std::int64_t{wanted_} * 10 + tool_, "START", wanted_);
  if (value("enstol") != 1 && within_tolerance(tenths)) {
    target_ = tenths;
    set_state("st_sttoll", true);
    set_state("st_toll", true);
    return;
  }
  place(tenths);
}

/// Starts a placement at a quota [Um/10].
void OnOffPositioner::place(std::int64_t tenths) {
  target_ = tenths;
  const Parts way = tenths * parts_per_tenth - position();
  if (value("maxvel") <= 0 && slows_by_speed())
    report({Diagnostic::Kind::out_of_range, "maxvel",
            fmt::format("{} is no speed to compare with: the slow range is maxslow", value("maxvel"))});
  const std::int32_t mode = value("bklashmode");
  const bool recovers = mode >= 1 && mode <= 4 && value("overpos") > 0;
  const bool ends_backward = mode == 2 || mode == 4;
  const bool overshoots = recovers && (way == 0 || (way < 0) != ends_backward);
  const bool backward = overshoots ? !ends_backward : way < 0;
  const Legs legs = legs_to(tenths, backward, overshoots);
  value("actiner") = inertia_band(tenths, value("minpos"), value("maxpos"), value("ninert"));
  set_state("st_still", false);
  movement_.place(legs.overshoot, legs.last);
}

/// A manual movement, at most to the limit of its direction.
void OnOffPositioner::run(bool backward, bool slow) {
  leave_quota();
  end_search();
  set_state("st_still", false);
  const std::int32_t limit = backward ? value("minpos") : value("maxpos");
  movement_.run({backward, slow, false, limit * parts_per_um, 0});
}

}  // namespace drycut::devices::oopos2
