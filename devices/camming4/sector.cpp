#include "devices/camming4/sector.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::camming4 {
namespace {

bool opposite(double a, double b) { return !is_standstill(a) && !is_standstill(b) && (a < 0) != (b < 0); }

bool is_change_of_ratio(const Row& row) { return row.codeG == 154 || row.codeG == 254; }

/// A row on the way to its sector: its numbers in Um.
struct Draft {
  const Row& row;
  double Qm = row.codeQm;
  double Qs = row.codeQs;
  double Qma = row.codeQma;
  double bit;  ///< [Um]
  double Qsa = row.codeQsa * bit;
  double v_in;
  Shape shape;
  Law law{};
  double mid_reference = v_in;  ///< the speed whose sign the middle should keep (warning 7)
};

/// The end speeds are given, and the auxiliary spaces.
Law auxiliary_ramp(const Draft& draft, double v0, double v1) {
  return fitted(draft.Qma, draft.Qsa, v0, v1, draft.bit, draft.shape);
}

void accelerate_with_master(Draft& draft) {
  const double v1 = draft.Qs < 0 ? -1 : 1;
  draft.law = fitted(draft.Qm, draft.Qs, 0, v1, draft.bit, draft.shape);
  draft.mid_reference = v1;
}

void accelerate_then_run(Draft& draft) {
  const double ratio = draft.Qs / draft.Qm;
  draft.law = joined(auxiliary_ramp(draft, 0, ratio), draft.Qsa, constant(draft.Qm, ratio));
  draft.mid_reference = ratio;
}

void run_then_decelerate(Draft& draft) {
  const Law run = single_ramp(draft.Qm, draft.Qs, draft.v_in, Shape::straight);
  const Law stop = two_phase(draft.Qma, draft.Qsa, run.exit_speed, 0, Shape::straight);
  draft.law = joined(run, draft.Qs, stop);
  draft.law.mid_speed = stop.mid_speed;
  draft.mid_reference = run.exit_speed;
}

void change_to_ratio(Draft& draft) {
  const double ratio = draft.Qs / draft.Qm;
  draft.law = auxiliary_ramp(draft, draft.v_in, ratio);
  if (is_standstill(draft.v_in)) draft.mid_reference = ratio;
}

void apply_ramp_law(int base_code, Draft& draft) {
  switch (base_code) {
    case 132:
      return accelerate_with_master(draft);
    case 134:
      draft.law = two_phase(draft.Qm, draft.Qs, draft.v_in, draft.v_in, draft.shape);
      return;
    case 135:
      draft.law = two_phase(draft.Qm, draft.Qs, draft.v_in, 0, draft.shape);
      return;
    case 150:
      return accelerate_then_run(draft);
    case 151:
      return run_then_decelerate(draft);
    case 152:
    case 153:
      return change_to_ratio(draft);
    default:  // 131 and 133
      draft.law = single_ramp(draft.Qm, draft.Qs, draft.v_in, draft.shape);
      draft.mid_reference = 0;
  }
}

/// Softening of the change from a constant ratio to the next row's; none unless that is a 154/254 as well.
Softening softening_towards(const Row& row, const Row* next, Shape shape) {
  if (!asks_softening(row) || row.codeQsa == 1 || next == nullptr || !is_change_of_ratio(*next)) return {};
  if (next->codeQsa == 2 || next->codeQm <= 0) return {};
  const double smaller = std::min(row.codeQm, next->codeQm);
  const double change =
      static_cast<double>(next->codeQs) / next->codeQm - static_cast<double>(row.codeQs) / row.codeQm;
  return {smaller / (row.codeQma + 1), change, shape};
}

void make_constant_ratio(SectorResult& result, const Row& row, Shape shape, const SectorEntry& entry) {
  Sector& sector = result.sector;
  const double ratio = static_cast<double>(row.codeQs) / row.codeQm;
  if (row.codeQsa == 2) {
    sector.kind = Sector::Kind::gearing;
    sector.law = constant(row.codeQm, ratio);
  } else {
    sector.exit = softening_towards(row, entry.next, shape);
    sector.law = softened(row.codeQm, ratio, entry.softening, sector.exit);
  }
  sector.entry_speed = entry.softening.half_width > 0 ? at(sector.law, 0).velocity : ratio;
  sector.exit_speed = row.codeQsa == 1 ? 0 : ratio;
}

void make_arc_sector(SectorResult& result, const Row& row, const CamSettings& settings) {
  Sector& sector = result.sector;
  result.error = arc_error(row.codeQm, row.codeQs, row.codeQsa);
  if (result.error != 0) return;
  const Turn turn = row.codeG % 2 == 0 ? Turn::clockwise : Turn::counterclockwise;
  sector.arc = make_arc(row.codeQm, row.codeQs, row.codeQsa, turn);
  sector.reads_out = true;
  sector.master = space(sector.arc.length * static_cast<double>(settings.master.pulse));
  const auto grains_per_um = static_cast<double>(settings.slave.pulse);
  if (row.codeG >= 174) {
    const double turn_um = 360 * std::pow(10.0, std::clamp(settings.decpt, 0, 3));
    const CamMotion motion = at(sector.arc, ArcAxis::tangent, sector.arc.length, turn_um);
    sector.law = constant(sector.arc.length, motion.velocity);
    sector.slave = space(motion.position * grains_per_um);
    sector.entry_speed = sector.exit_speed = motion.velocity;
    return;
  }
  sector.kind = row.codeG <= 171 ? Sector::Kind::arc_x : Sector::Kind::arc_y;
  const std::int32_t displacement = row.codeG <= 171 ? row.codeQs : row.codeQsa;
  sector.slave = {multiply(displacement, settings.slave.pulse), 0};
  sector.entry_speed = at(sector, 0).velocity;
  const double exit = at(sector, sector.arc.length).velocity;
  sector.exit_speed = is_standstill(exit) ? 0 : exit;
}

void warn(SectorResult& result, int warning) { result.warnings[result.warning_count++] = warning; }

void make_ramp_sector(SectorResult& result, const Code& code, const Row& row, const CamSettings& settings,
                      double speed) {
  Sector& sector = result.sector;
  const double v_in = code.zero_start || is_standstill(speed) ? 0 : speed;
  const double bit = static_cast<double>(settings.slave.measure) / static_cast<double>(settings.slave.pulse);
  Draft draft{
      .row = row, .bit = bit, .v_in = v_in, .shape = code.epicycloidal ? Shape::cycloidal : Shape::straight};
  apply_ramp_law(code.epicycloidal ? code.code - 100 : code.code, draft);
  sector.law = draft.law;
  sector.entry_speed = v_in;
  sector.exit_speed = draft.law.exit_speed;
  // 151 turns round inside, before its stop.
  const double final = code.code == 151 ? draft.mid_reference : draft.law.exit_speed;
  if (opposite(v_in, final)) warn(result, 5);
  if (opposite(draft.law.mid_speed, draft.mid_reference)) warn(result, 7);
}

/// Exact spaces of a row in the columns of its code.
void set_spaces(Sector& sector, const Code& code, const Row& row, const CamSettings& settings) {
  Space master;
  Space slave;
  if (code.qm == Use::master_space) {
    master.grains = multiply(row.codeQm, settings.master.pulse);
    slave.grains = multiply(row.codeQs, settings.slave.pulse);
  }
  if (code.qma == Use::master_space) {
    master.grains = add(master.grains, multiply(row.codeQma, settings.master.pulse));
    slave.grains = add(slave.grains, multiply(row.codeQsa, settings.slave.measure));
  }
  sector.master = master;
  sector.slave = slave;
}

}  // namespace

bool is_standstill(double speed) { return std::abs(speed) < 1e-9; }

bool asks_softening(const Row& row) {
  return is_change_of_ratio(row) && row.codeQma >= 1 && row.codeQma <= 4;
}

CamMotion at(const Sector& sector, double m) {
  switch (sector.kind) {
    case Sector::Kind::arc_x:
      return at(sector.arc, ArcAxis::x, m, 0);
    case Sector::Kind::arc_y:
      return at(sector.arc, ArcAxis::y, m, 0);
    default:
      return at(sector.law, m);
  }
}

double peak_acceleration(const Sector& sector) {
  if (sector.kind == Sector::Kind::arc_x) return peak_acceleration(sector.arc, ArcAxis::x);
  if (sector.kind == Sector::Kind::arc_y) return peak_acceleration(sector.arc, ArcAxis::y);
  return peak_acceleration(sector.law);
}

double peak_deceleration(const Sector& sector) {
  if (sector.kind == Sector::Kind::arc_x) return peak_deceleration(sector.arc, ArcAxis::x);
  if (sector.kind == Sector::Kind::arc_y) return peak_deceleration(sector.arc, ArcAxis::y);
  return peak_deceleration(sector.law);
}

bool is_empty_movement(const Code& code, const Row& row) {
  switch (code.code) {
    case 133:
    case 134:
    case 233:
    case 234:
      return row.codeQm == 0 && row.codeQs == 0;
    default:
      return code.qm == Use::radius && row.codeQm == 0 && row.codeQs == 0 && row.codeQsa == 0;
  }
}

SectorResult make_sector(const Code& code, const Row& row, int number, const CamSettings& settings,
                         const SectorEntry& entry) {
  SectorResult result;
  result.sector.number = number;
  result.sector.row = row;
  if (code.zero_start && !is_standstill(entry.speed)) warn(result, 6);
  if (code.qm == Use::radius) {
    make_arc_sector(result, row, settings);
    return result;
  }
  if (row.codeQm <= 0 || (code.qma == Use::master_space && row.codeQma <= 0)) {
    result.error = 4;
    return result;
  }
  set_spaces(result.sector, code, row, settings);
  if (is_change_of_ratio(row))
    make_constant_ratio(result, row, code.epicycloidal ? Shape::cycloidal : Shape::straight, entry);
  else
    make_ramp_sector(result, code, row, settings, entry.speed);
  return result;
}

}  // namespace drycut::devices::camming4
