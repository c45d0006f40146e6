#include "devices/plcopen/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/state_archive.hpp"
#include "base/text.hpp"

namespace drycut::devices::plcopen {
namespace {

constexpr double offset_max = 2147483648.0;
/// A slave this near to the new law needs no ramp-in [inc].
constexpr double in_place = 1;

Endless endless_of(std::uint32_t mode) {
  if ((mode & hli_ci_endless_positive) != 0) return Endless::positive;
  return (mode & hli_ci_endless_negative) != 0 ? Endless::negative : Endless::no;
}

ErrorId check_pins(const CamInRequest& request) {
  constexpr std::uint32_t known = 0x7F;
  constexpr std::uint32_t both = hli_ci_endless_positive | hli_ci_endless_negative;
  if ((request.start_mode & ~known) != 0 || (request.start_mode & both) == both) return ErrorId::start_mode;
  if (!(std::abs(request.master_offset) <= offset_max) || !(std::abs(request.slave_offset) <= offset_max))
    return ErrorId::offset_range;
  const double scaling = request.master_scaling;
  if (!(std::abs(scaling) <= offset_max) || scaling == 0 || scaling != std::round(scaling))
    return ErrorId::master_scaling;
  return std::abs(request.slave_scaling) <= offset_max ? ErrorId::none : ErrorId::slave_scaling;
}

ErrorId check_pins(const GearInRequest& request) {
  if (request.mode != 0 && request.mode != gear_on_actual_values) return ErrorId::gear_mode;
  constexpr std::uint32_t most = 2147483647;
  const bool ratio = request.numerator != 0 && request.denominator != 0 && request.denominator <= most;
  return ratio ? ErrorId::none : ErrorId::gear_ratio;
}

/// The scaled cam stays where positions are exact, 100 km at most.
bool within_reach(const CamCurve& curve, double scaling) {
  constexpr double farthest = 1e12;
  return std::all_of(curve.pieces.begin(), curve.pieces.end(), [&](const CamPiece& piece) {
    double most = 0;
    for (const double c : polynomial_of(piece).c) most += std::abs(c);
    return std::abs(scaling) * most <= std::max(farthest, most);
  });
}

/// Smallest and largest position of a curve, by samples that lie near enough for a cubic or quintic.
std::pair<double, double> range_of(const CamCurve& curve) {
  const double first = polynomial_of(curve.pieces.front()).c[0];
  std::pair range{first, first};
  constexpr int samples = 64;
  for (const CamPiece& piece : curve.pieces)
    for (int i = 0; i <= samples; ++i) {
      const double position =
          at(polynomial_of(piece), static_cast<double>(i) / samples, piece.length).position;
      range = {std::min(range.first, position), std::max(range.second, position)};
    }
  return range;
}

}  // namespace

AxisRef MotionKernel::add_axis(std::string name, const AxisParameters& parameters) {
  axes_.push_back(std::make_unique<Axis>(std::move(name), parameters));
  return {static_cast<int>(axes_.size()) - 1};
}

AxisRef MotionKernel::find_axis(std::string_view name) const {
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (same_word(axes_[i]->name(), name)) return {static_cast<int>(i)};
  return {};
}

bool MotionKernel::locked(std::uint16_t table) const {
  return std::any_of(axes_.begin(), axes_.end(), [&](const auto& axis) {
    return axis->coupling() != nullptr && axis->link().locks_table && axis->link().table == table;
  });
}

ErrorId MotionKernel::add_table(McCamTable table) {
  return locked(table.id) ? ErrorId::table_locked : tables_.add(std::move(table));
}

ErrorId MotionKernel::write_table(std::uint16_t id, std::size_t line, int column, double value) {
  return locked(id) ? ErrorId::table_locked : tables_.write(id, line, column, value);
}

ErrorId MotionKernel::begin_table_change(std::uint16_t id) {
  return locked(id) ? ErrorId::table_locked : tables_.begin_change(id);
}

bool MotionKernel::follows(const Axis& slave, const Axis& master) const {
  const Axis* axis = &slave;
  while (axis != nullptr && axis != &master)
    axis = axis->coupling() == nullptr ? nullptr : this->axis(axis->link().master);
  return axis == &master;
}

Order MotionKernel::check_axes(AxisRef master, AxisRef slave) const {
  const Axis* ahead = axis(master);
  const Axis* behind = axis(slave);
  if (ahead == nullptr || behind == nullptr) return {ErrorId::no_such_axis};
  if (follows(*ahead, *behind)) return {ErrorId::own_master};
  if (!ahead->parameters().is_master) return {ErrorId::not_a_master, 0, master};
  return {};
}

Order MotionKernel::check_cam(const CamInRequest& request, const McCamTable& table,
                              Interpolation interpolation) const {
  const Axis& master = *axis(request.master);
  const Axis& slave = *axis(request.slave);
  const bool pairs = interpolation == Interpolation::line_poly5 || interpolation == Interpolation::poly5_line;
  const bool turns_on = endless_of(request.start_mode) != Endless::no;
  if (master.modulo() <= 0) return {ErrorId::not_modulo, 0, request.master};
  if (slave.modulo() <= 0 && (pairs || turns_on)) return {ErrorId::not_modulo};
  if (const ErrorId error = plcopen::check(table, interpolation, master.modulo()); error != ErrorId::none)
    return {error};
  if (tables_.busy(request.table)) return {ErrorId::table_busy};
  if (!slave.homed()) return {ErrorId::not_homed};
  return {slave.control.feed_enable ? ErrorId::none : ErrorId::feed_enable_missing};
}

ErrorId MotionKernel::check_curve(const CamInRequest& request, const CamCurve& curve) const {
  const double turns = request.slave_scaling * static_cast<double>(curve.turns);
  if (turns != std::round(turns) || !within_reach(curve, request.slave_scaling))
    return ErrorId::slave_scaling;
  const AxisParameters& slave = axis(request.slave)->parameters();
  if (slave.modulo > 0 || !(slave.swe_neg < slave.swe_pos)) return ErrorId::none;
  const auto [low, high] = range_of(curve);
  for (const double cam : {low, high}) {
    const double position = request.slave_scaling * cam + request.slave_offset;
    if (position < slave.swe_neg || position > slave.swe_pos) return ErrorId::software_limit;
  }
  return ErrorId::none;
}

Order MotionKernel::check(AxisRef ref, const Request& request) const {
  if (const auto* cam = std::get_if<CamInRequest>(&request)) {
    const Order order = check_axes(cam->master, cam->slave);
    return order.error != ErrorId::none ? order : Order{check_pins(*cam)};
  }
  JerkLimits limits;
  if (const auto* gear = std::get_if<GearInRequest>(&request)) {
    const Order order = check_axes(gear->master, gear->slave);
    if (order.error != ErrorId::none) return order;
    if (const ErrorId error = check_pins(*gear); error != ErrorId::none) return {error};
    return {axis(ref)->limits_of(gear->dynamics, limits)};
  }
  return {axis(ref)->check(std::get<MoveRequest>(request), limits)};
}

Order MotionKernel::start(AxisRef ref, const Request& request, std::uint64_t again, std::uint64_t ticket) {
  if (const auto* cam = std::get_if<CamInRequest>(&request)) return cam_in(*cam, again, ticket);
  if (const auto* gear = std::get_if<GearInRequest>(&request)) return gear_in(*gear, ticket);
  return axis(ref)->move(std::get<MoveRequest>(request), ticket);
}

Order MotionKernel::give(AxisRef ref, const Request& request, BufferMode mode, std::uint64_t again) {
  Axis* moved = axis(ref);
  if (moved == nullptr) return {ErrorId::no_such_axis};
  if (mode < BufferMode::aborting || mode > BufferMode::blending_high) return {ErrorId::buffer_mode};
  if (mode == BufferMode::aborting || (moved->waiting().empty() && moved->takes_next()))
    return start(ref, request, again, 0);
  const Order order = check(ref, request);
  return order.error != ErrorId::none ? order : moved->wait(request, mode);
}

/// In the cycle in which a command is done the one that waits takes over.
void MotionKernel::start_waiting(AxisRef ref) {
  Axis& moved = *axis(ref);
  while (!moved.waiting().empty() && moved.takes_next()) {
    const WaitingCommand next = moved.take_next();
    const Order order = start(ref, next.request, 0, next.ticket);
    if (order.error != ErrorId::none) return moved.drop(next.ticket, order.error);
    moved.blend();
    moved.run_on();
  }
}

Order MotionKernel::cam_in(const CamInRequest& request, std::uint64_t again, std::uint64_t ticket) {
  if (const Order order = check_axes(request.master, request.slave); order.error != ErrorId::none)
    return order;
  Axis& slave = *axis(request.slave);
  if (const CommandVerdict verdict = judge(slave.state(), Command::cam_in); verdict.error != ErrorId::none)
    return {verdict.error};
  if (const ErrorId error = check_pins(request); error != ErrorId::none) return {error};
  const McCamTable* table = tables_.find(request.table);
  if (table == nullptr) return {ErrorId::no_such_table};
  const std::optional<Interpolation> interpolation = interpolation_of(*table, request.interpolation);
  if (!interpolation) return {ErrorId::unknown_interpolation};
  if (const Order order = check_cam(request, *table, *interpolation); order.error != ErrorId::none)
    return order;

  const bool periodic = (request.start_mode & hli_ci_f_periodic) != 0;
  Coupling* present = slave.coupling();
  if (!periodic && again != 0 && again == slave.ticket() && present != nullptr && present->running_pass()) {
    present->add_pass();
    return {ErrorId::none, again};
  }
  const CouplingLink link{
      .master = request.master,
      .table = request.table,
      .revision = tables_.revision(request.table),
      .locks_table = (request.start_mode & hli_ci_lock_table) != 0,
      .own_copy = *interpolation == Interpolation::line_poly5 || *interpolation == Interpolation::poly5_line,
      .endless = endless_of(request.start_mode),
      .interpolation = *interpolation};
  const AxisMotion master = axis(request.master)->set();
  CamFollow law{
      .curve = curve_of(*table, *interpolation, axis(request.master)->modulo(), slave.modulo(), link.endless),
      .master_scaling = std::llround(request.master_scaling),
      .slave_scaling = request.slave_scaling,
      .master_offset = request.master_offset,
      .slave_offset = request.slave_offset,
      .periodic = periodic};
  if (const ErrorId error = check_curve(request, law.curve); error != ErrorId::none) return {error};
  Coupling coupling(std::move(law), slave.modulo());
  const AxisMotion from = slave.start_of(ticket);
  if (present != nullptr && slave.link().master == request.master)
    coupling.take_over(*present, master, from, in_place);
  if (!periodic) coupling.start_in_place(master, from, in_place);
  return slave.couple(std::move(coupling), link, Command::cam_in, ticket);
}

Order MotionKernel::gear_in(const GearInRequest& request, std::uint64_t ticket) {
  if (const Order order = check_axes(request.master, request.slave); order.error != ErrorId::none)
    return order;
  Axis& slave = *axis(request.slave);
  if (const CommandVerdict verdict = judge(slave.state(), Command::gear_in); verdict.error != ErrorId::none)
    return {verdict.error};
  if (const ErrorId error = check_pins(request); error != ErrorId::none) return {error};
  JerkLimits limits;
  if (const ErrorId error = slave.limits_of(request.dynamics, limits); error != ErrorId::none) return {error};
  if (!slave.control.feed_enable) return {ErrorId::feed_enable_missing};
  CouplingLink link;
  link.master = request.master;
  link.actual_values = request.mode == gear_on_actual_values;
  const GearFollow gear{request.numerator, request.denominator, axis(request.master)->modulo()};
  slave.set_gear_dynamics(request.dynamics);
  return slave.couple(Coupling(gear, slave.modulo()), link, Command::gear_in, ticket);
}

ErrorId MotionKernel::set_position(AxisRef ref, double position, bool relative) {
  Axis* moved = axis(ref);
  if (moved == nullptr) return ErrorId::no_such_axis;
  const auto follows_it = [&](const auto& slave) {
    return slave->coupling() != nullptr && slave->link().master == ref;
  };
  if (std::any_of(axes_.begin(), axes_.end(), follows_it)) return ErrorId::in_synchronized_motion;
  return moved->set_position(position, relative);
}

Order MotionKernel::phase(AxisRef master, AxisRef slave_ref, double shift, const Dynamics& dynamics) {
  Axis* slave = axis(slave_ref);
  const Axis* ahead = axis(master);
  if (slave == nullptr || ahead == nullptr) return {ErrorId::no_such_axis};
  if (const CommandVerdict verdict = judge(slave->state(), Command::phasing); verdict.error != ErrorId::none)
    return {verdict.error};
  if (slave->link().master != master) return {ErrorId::phasing_not_synchronous};
  if (!slave->coupling()->engaged()) return {ErrorId::phasing_slave_not_reached};
  if (!(std::abs(shift) <= offset_max)) return {ErrorId::offset_range};
  if (!(dynamics.velocity >= 1)) return {ErrorId::velocity_range};
  JerkLimits limits;
  if (const ErrorId error = ahead->limits_of(dynamics, limits); error != ErrorId::none) return {error};
  slave->coupling()->shift_phase(shift, limits);
  return {ErrorId::none, slave->ticket()};
}

void MotionKernel::refresh(Axis& slave) {
  CouplingLink& link = slave.link();
  if (link.table == 0 || link.own_copy || link.revision == tables_.revision(link.table)) return;
  // A table replaced by one of another kind is no change of the running cam: that goes on as it was.
  const McCamTable& table = *tables_.find(link.table);
  const double modulo = axis(link.master)->modulo();
  link.revision = tables_.revision(link.table);
  if (plcopen::check(table, link.interpolation, modulo) != ErrorId::none) return;
  CamCurve curve = curve_of(table, link.interpolation, modulo, slave.modulo(), link.endless);
  if (within_reach(curve, slave.coupling()->cam()->slave_scaling))
    slave.coupling()->replace_curve(std::move(curve));
}

void MotionKernel::set_points(std::size_t number) {
  if (moved_[number]) return;
  moved_[number] = true;
  Axis& axis = *axes_[number];
  const double dt = static_cast<double>(cycle_ns_) * 1e-9;
  if (axis.coupling() == nullptr) {
    axis.move(dt);
    return start_waiting({static_cast<int>(number)});
  }
  const CouplingLink& link = axis.link();
  set_points(static_cast<std::size_t>(link.master.number));
  refresh(axis);
  axis.follow(this->axis(link.master)->as_master(link.actual_values, axis.parameters().delay_time * 1e-6),
              dt);
  start_waiting({static_cast<int>(number)});
}

void MotionKernel::cycle() {
  const double dt = static_cast<double>(cycle_ns_) * 1e-9;
  for (const auto& axis : axes_) axis->latch(dt);
  moved_.assign(axes_.size(), false);
  for (std::size_t i = 0; i < axes_.size(); ++i) set_points(i);
  for (const auto& axis : axes_) axis->regulate();
}

void MotionKernel::visit(StateArchive& archive) {
  for (const auto& axis : axes_) archive.named(axis->name(), *axis);
  STATE(archive, tables_);
}

}  // namespace drycut::devices::plcopen
