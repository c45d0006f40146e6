// The cams of the axes as a simulation compares them with their laws.
#include <algorithm>
#include <cmath>

#include "devices/plcopen/controller/controller.hpp"
#include "devices/plcopen/tab_file.hpp"

namespace drycut::devices::plcopen {

std::vector<CamAxis> PlcopenController::cam_axes() {
  std::vector<CamAxis> axes;
  for (int number = 0; number < kernel_.axes(); ++number) {
    CamAxis cam;
    cam.name = configuration_.axes[static_cast<std::size_t>(number)].name;
    cam.start = [this, number]() -> std::uint64_t {
      const Axis& slave = axis(number);
      if (slave.coupling() == nullptr || slave.coupling()->cam() == nullptr) return 0;
      // Tickets of couplings are few; a table has far fewer revisions than this.
      constexpr std::uint64_t most_revisions = 1'000'000;
      return slave.ticket() * most_revisions + slave.link().revision;
    };
    cam.moment = [this, number] { return cam_moment(number); };
    cam.table = [this, number] { return cam_table(number); };
    axes.push_back(std::move(cam));
  }
  return axes;
}

/// In increments; the slave without its offset and scaling.
CamMoment PlcopenController::cam_moment(int number) const {
  const Axis& slave = axis(number);
  const Coupling* coupling = slave.coupling();
  if (!powered_ || coupling == nullptr || coupling->cam() == nullptr || !coupling->engaged()) return {};
  const CamFollow& cam = *coupling->cam();
  const CouplingLink& link = slave.link();
  const double delay = slave.parameters().delay_time * 1e-6;
  const Position place = coupling->place(cam, axis(link.master.number).as_master(link.actual_values, delay));
  CamMoment moment;
  moment.follows = true;
  moment.master = static_cast<double>(place.turns) * cam.curve.master_length + place.part;
  moment.set = (slave.set().position.part - cam.slave_offset) / cam.slave_scaling;
  moment.turn = slave.modulo() / std::abs(cam.slave_scaling);
  if (slave.parameters().kind != AxisKind::virtual_axis)
    moment.behind = slave.following_error() / cam.slave_scaling;
  return moment;
}

std::shared_ptr<const devices::CamTable> PlcopenController::cam_table(int number) const {
  const Axis& slave = axis(number);
  const CouplingLink& link = slave.link();
  const McCamTable* table = kernel_.tables().find(link.table);
  if (slave.coupling() == nullptr || slave.coupling()->cam() == nullptr || table == nullptr) return nullptr;
  const CamFollow& cam = *slave.coupling()->cam();
  const auto unit = [&](int axis) {
    return configuration_.axes[static_cast<std::size_t>(axis)].measure == Measure::length ? "mm" : "deg";
  };
  CamFile held;
  held.table = *table;
  held.interpolation = link.interpolation;
  held.endless = link.endless;
  held.master_modulo = cam.curve.master_length;
  held.master_modulo_given = true;
  held.slave_modulo = slave.modulo();
  held.periodic = cam.periodic;
  held.master_unit = unit(link.master.number);
  held.slave_unit = unit(number);
  // The axis' own limits as the table has it, before it is scaled, and what its file says besides. The
  // kernel's speeds are 1000 to a mm/s or deg/s, its accelerations 1.
  const double scaling = std::abs(cam.slave_scaling);
  const auto limit = [&](std::optional<double>& least, double of_axis) {
    least = std::min(least.value_or(of_axis / scaling), of_axis / scaling);
  };
  limit(held.table.limits.velocity, slave.parameters().vb_max / 1000);
  limit(held.table.limits.acceleration, slave.parameters().a_max);
  return std::make_shared<const devices::CamTable>(std::move(held));
}

}  // namespace drycut::devices::plcopen
