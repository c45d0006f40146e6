#include "devices/lx3vp/ecamtbx.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/state_archive.hpp"

namespace drycut::devices::lx3vp {

void SawParameters::visit(StateArchive& archive) {
  STATE(archive, master_length, slave_length, sync_length, sync_ratio, max_ratio, acceleration, curve,
        resolution);
}
void SCurveParameters::visit(StateArchive& archive) {
  STATE(archive, length, top_speed, acceleration, deceleration, resolution);
}

namespace {

constexpr int least_rows = 10;
constexpr int most_rows = 512;
constexpr int automatic_rows = 200;
// P4 is a 32-bit float: how far a ratio may be from another and still be meant as the same.
constexpr double same_ratio = 1e-6;

EcamResult failed(EcamError error) {
  EcamResult result;
  result.error = error;
  return result;
}

std::optional<Transition> transition_of(std::uint16_t acceleration) {
  constexpr std::array laws = {Transition::constant, Transition::uniform_acceleration, Transition::b_type};
  if (acceleration >= laws.size()) return {};
  return laws[acceleration];
}

/// A saw's parameters as magnitudes and real numbers.
struct Saw {
  explicit Saw(const SawParameters& p)
      : master(p.master_length),
        slave(std::abs(static_cast<double>(p.slave_length))),
        sync(p.sync_length),
        k(static_cast<double>(p.sync_ratio)),
        max_ratio(static_cast<double>(p.max_ratio)),
        law(transition_of(p.acceleration).value_or(Transition::constant)) {}
  double master;
  double slave;
  double sync;
  double k;
  double max_ratio;
  Transition law;

  [[nodiscard]] bool steps() const { return law == Transition::constant; }
};

/// What both saws ask of their parameters.
EcamError check_saw(const SawParameters& p) {
  if (!transition_of(p.acceleration)) return EcamError::type;
  if (p.master_length <= 0 || p.slave_length == 0 || p.sync_length < 0) return EcamError::length;
  const auto is_number = [](float value) { return std::isfinite(value) && value > 0; };
  if (!is_number(p.sync_ratio) || !is_number(p.max_ratio)) return EcamError::number;
  if (p.sync_length > std::abs(static_cast<std::int64_t>(p.slave_length))) return EcamError::sync_zone;
  if (p.resolution != 0 && (p.resolution < least_rows || p.resolution > most_rows))
    return EcamError::resolution;
  return p.max_ratio < p.sync_ratio ? EcamError::ratio : EcamError::none;
}

/// Pieces in a row, from `in` to the middle of the correction; reversed they lead out of it.
struct ProfileLeg {
  double length = 0;
  double r0 = 0;
  double r1 = 0;
};
using Legs = std::vector<ProfileLeg>;

Legs reversed(Legs legs) {
  std::reverse(legs.begin(), legs.end());
  for (auto& leg : legs) std::swap(leg.r0, leg.r1);
  return legs;
}

/// The zone outside the synchronous one: master and slave pulses to make up.
struct Correction {
  double master = 0;
  double slave = 0;
  [[nodiscard]] double mean() const { return slave / master; }
};

/// First half of the correction, from ratio k to the middle (spec cases A to E and U); nullopt: needs more
/// than P5.
std::optional<Legs> half_of(const Correction& zone, const Saw& saw) {
  const double k = saw.k;
  const double mean = zone.mean();
  const double half = zone.master / 2;
  if (std::abs(mean - k) < same_ratio * k) return Legs{{half, mean, mean}};
  if (mean > saw.max_ratio) return {};
  if (saw.steps()) return Legs{{half, mean, mean}};
  if (mean > k && mean >= saw.max_ratio) return {};
  const double peak = 2 * mean - k;
  if (peak < 0) {
    const double ramp = zone.slave / k;
    return Legs{{ramp, k, 0}, {half - ramp, 0, 0}};
  }
  if (peak <= saw.max_ratio) return Legs{{half, k, peak}};
  const double ramp = zone.master * (saw.max_ratio - mean) / (saw.max_ratio - k);
  return Legs{{ramp, k, saw.max_ratio}, {half - ramp, saw.max_ratio, saw.max_ratio}};
}

/// midCAMbegin: from rest to k within half the correction; nullopt: needs more than P5.
std::optional<Legs> run_in(const Correction& zone, const Saw& saw) {
  const double k = saw.k;
  const double h = zone.master / 2;
  const double way = zone.slave / 2;
  if (saw.steps()) return Legs{{h, zone.mean(), zone.mean()}};
  if (2 * way <= h * k) return Legs{{h - 2 * way / k, 0, 0}, {2 * way / k, 0, k}};
  const double peak = (way + std::sqrt(way * way - h * way * k + h * h * k * k / 2)) / h;
  if (peak > saw.max_ratio) return {};
  const double up = h * peak / (2 * peak - k);
  return Legs{{up, 0, peak}, {h - up, peak, k}};
}

void append(CamProfile& profile, const Legs& legs, Transition law) {
  for (const auto& leg : legs) profile.add(leg.length, leg.r0, leg.r1, law);
}

void append_sync(CamProfile& profile, double length, double k) {
  profile.sync_begin = profile.master_length;
  profile.add(length, k, k, Transition::constant);
  profile.sync_end = profile.master_length;
}

/// Synchronous zone and correction in the order of the curve. False: it needs more than P5.
bool arrange(CamProfile& profile, std::uint16_t curve, double sync, const Correction& zone, const Saw& saw) {
  const auto half = half_of(zone, saw);
  if (!half) return false;
  Legs before;
  Legs after;
  if (curve == mid_cam_begin || curve == mid_cam_end) {
    const auto rest = run_in(zone, saw);
    if (!rest) return false;
    before = curve == mid_cam_begin ? *rest : reversed(*half);
    after = curve == mid_cam_end ? reversed(*rest) : *half;
    profile.stops = curve == mid_cam_end;
  } else {
    Legs whole = *half;
    const auto back = reversed(*half);
    if (curve == mid_cam_all) {
      before = back;
      after = *half;
    } else {
      whole.insert(whole.end(), back.begin(), back.end());
      (curve == left_cam ? after : before) = whole;
    }
  }
  append(profile, before, saw.law);
  append_sync(profile, sync, saw.k);
  append(profile, after, saw.law);
  return true;
}

bool is_rotary_curve(std::uint16_t curve) {
  return curve == left_cam || curve == mid_cam_all || curve == mid_cam_begin || curve == mid_cam_end ||
         curve == right_cam;
}

EcamResult finished(CamProfile profile, const TableEnd& end, std::uint16_t resolution) {
  const int asked = resolution == 0 ? automatic_rows : resolution;
  auto rows = sample_rows(profile, end, asked);
  if (!rows) return failed(EcamError::resolution);
  EcamResult result;
  result.rows = std::move(*rows);
  result.profile = std::move(profile);
  return result;
}

}  // namespace

EcamResult make_rotary_saw(const SawParameters& parameters) {
  const auto curve = static_cast<std::uint16_t>(parameters.curve & ~return_square);
  if (!is_rotary_curve(curve)) return failed(EcamError::type);
  if (const auto error = check_saw(parameters); error != EcamError::none) return failed(error);
  const Saw saw(parameters);
  double sync = saw.sync / saw.k;
  // The ratio is only known to seven digits: a zone that fills the cycle but for that fills it.
  if (std::abs(saw.master - sync) <= same_ratio * saw.master && saw.slave == saw.sync) sync = saw.master;
  const Correction zone{saw.master - sync, saw.slave - saw.sync};
  if (zone.master < 0 || (zone.master == 0 && zone.slave != 0)) return failed(EcamError::sync_zone);
  CamProfile profile;
  if (zone.master == 0) {
    append_sync(profile, saw.master, saw.slave / saw.master);
    profile.stops = curve == mid_cam_end;
  } else if (!arrange(profile, curve, sync, zone, saw)) {
    return failed(EcamError::ratio);
  }
  const bool backwards = parameters.slave_length < 0 || (parameters.curve & return_square) != 0;
  if (backwards) profile.mirror();
  const auto slave = static_cast<std::int64_t>(saw.slave);
  // 2^31 forwards is one pulse more than the register holds.
  if (!backwards && slave > std::numeric_limits<std::int32_t>::max()) return failed(EcamError::length);
  const TableEnd end{parameters.master_length, static_cast<std::int32_t>(backwards ? -slave : slave)};
  return finished(std::move(profile), end, parameters.resolution);
}

EcamResult make_fly_saw(const SawParameters& parameters) {
  if (const auto error = check_saw(parameters); error != EcamError::none) return failed(error);
  if (parameters.master_length > std::numeric_limits<std::int32_t>::max() / 2)
    return failed(EcamError::length);
  const Saw saw(parameters);
  const double ramp = saw.steps() ? 0 : (saw.slave - saw.sync) / saw.k;
  const double sync = (saw.steps() ? saw.slave : saw.sync) / saw.k;
  const double hold = saw.master - 2 * ramp - sync;
  if (hold < 0) return failed(EcamError::sync_zone);
  CamProfile profile;
  profile.add(ramp, 0, saw.k, saw.law);
  append_sync(profile, sync, saw.k);
  profile.add(ramp, saw.k, 0, saw.law);
  profile.add(hold, 0, 0, Transition::constant);
  profile.add(ramp, 0, -saw.k, saw.law);
  profile.add(sync, -saw.k, -saw.k, Transition::constant);
  profile.add(ramp, -saw.k, 0, saw.law);
  profile.add(hold, 0, 0, Transition::constant);
  if (parameters.slave_length < 0) profile.mirror();
  return finished(std::move(profile), {2 * parameters.master_length, 0}, parameters.resolution);
}

EcamResult make_s_curve(EcamType type, const SCurveParameters& parameters) {
  constexpr int least = 51;
  constexpr int fastest = 150000;
  constexpr double tick = 1e-4;  // s
  if (!is_s_curve(type)) return failed(EcamError::type);
  if (parameters.length == 0) return failed(EcamError::length);
  if (parameters.resolution < least || parameters.resolution > most_rows)
    return failed(EcamError::resolution);
  if (parameters.top_speed < 1 || parameters.top_speed > fastest || parameters.acceleration < 0 ||
      parameters.deceleration < 0)
    return failed(EcamError::speed);
  const double length = std::abs(static_cast<double>(parameters.length));
  const double up = parameters.acceleration * 10.0;  // ticks
  const double down = parameters.deceleration * 10.0;
  double ratio = parameters.top_speed * tick;  // pulses a tick
  double level = length / ratio - (up + down) / 2;
  if (level < 0) {  // too short for the top speed: the times stay
    level = 0;
    ratio = 2 * length / (up + down);
  }
  if (up + level + down >= std::numeric_limits<std::int32_t>::max()) return failed(EcamError::length);
  const auto law = type == EcamType::s_curve_0 ? Transition::cosine : Transition::parabolas;
  CamProfile profile;
  profile.add(up, 0, ratio, law);
  profile.add(level, ratio, ratio, Transition::constant);
  profile.add(down, ratio, 0, law);
  if (parameters.length < 0) profile.mirror();
  const auto ticks = static_cast<std::int32_t>(std::llround(profile.master_length));
  auto result = finished(std::move(profile), {ticks, parameters.length}, parameters.resolution);
  if (!result.ok()) return result;
  result.uniform_time = static_cast<std::int32_t>(std::llround(level));
  result.speed_reached = static_cast<std::int32_t>(std::llround(ratio / tick));
  return result;
}

EcamResult make_table(EcamType type, const SawParameters& saw, const SCurveParameters& s_curve) {
  if (type == EcamType::rotary_saw) return make_rotary_saw(saw);
  return type == EcamType::fly_saw ? make_fly_saw(saw) : make_s_curve(type, s_curve);
}

std::span<const EcamError> ecam_errors() {
  static constexpr std::array errors = {EcamError::type,  EcamError::length,     EcamError::sync_zone,
                                        EcamError::ratio, EcamError::resolution, EcamError::speed,
                                        EcamError::area,  EcamError::number};
  return errors;
}

std::string_view error_text(EcamError error) {
  switch (error) {
    case EcamError::none:
      return "no error";
    case EcamError::type:
      return "there is no such type of table, acceleration or cam curve (S1, P6)";
    case EcamError::length:
      return "a length is 0, negative or beyond 32 bits (P1, P2, P3)";
    case EcamError::sync_zone:
      return "the synchronous zone does not fit the cycle or the slave's length (P1, P2, P3, P4)";
    case EcamError::ratio:
      return "the cycle needs a ratio above the largest allowed (P5)";
    case EcamError::resolution:
      return "the resolution is out of range or finer than the master's pulses";
    case EcamError::speed:
      return "a speed or a time is out of range (P2, P4, P5)";
    case EcamError::area:
      return "the table does not fit the D registers";
    case EcamError::number:
      return "a ratio is not a finite number above 0 (P4, P5)";
  }
  return "";
}

}  // namespace drycut::devices::lx3vp
