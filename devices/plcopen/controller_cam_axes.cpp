// The cams of the axes as a simulation compares them with their laws.
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "devices/plcopen/controller.hpp"

namespace drycut::devices::plcopen {

std::vector<CamAxis> PlcopenController::cam_axes() {
  std::vector<CamAxis> axes;
  for (int number = 0; number < kernel_.axes(); ++number) {
    CamAxis cam;
    cam.name = configuration_.axes[static_cast<std::size_t>(number)].name;
    cam.kind = "mc_camin";
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
  if (slave.parameters().kind != static_cast<double>(AxisKind::virtual_axis))
    moment.behind = slave.following_error() / cam.slave_scaling;
  return moment;
}

std::string PlcopenController::cam_table(int number) const {
  const Axis& slave = axis(number);
  const CouplingLink& link = slave.link();
  const CamTable* table = kernel_.tables().find(link.table);
  if (slave.coupling() == nullptr || slave.coupling()->cam() == nullptr || table == nullptr) return "";
  const CamFollow& cam = *slave.coupling()->cam();
  const auto unit = [&](int axis) {
    return configuration_.axes[static_cast<std::size_t>(axis)].measure == Measure::length ? "mm" : "deg";
  };
  constexpr std::array endless = {"negative", "no", "positive"};
  // The kernel's speeds are 1000 to a mm/s or deg/s, its accelerations 1.
  auto text = fmt::format(
      "# interpolation: {}\n# master_modulo: {:.0f}\n# slave_modulo: {:.0f}\n# endless: {}\n# periodic: {}\n"
      "# master_unit: {}\n# slave_unit: {}\n# maxvel: {}\n# maxacc: {}\n",
      name_of(link.interpolation), cam.curve.master_length, slave.modulo(),
      endless[static_cast<std::size_t>(static_cast<int>(link.endless) + 1)], cam.periodic ? "yes" : "no",
      unit(link.master.number), unit(number), slave.parameters().vb_max / 1000, slave.parameters().a_max);
  if (!table->file.empty()) text.insert(0, fmt::format("## {}\n", table->file));
  const int columns = table->columns();
  text += columns == 4 ? "a0,a1,a2,a3\n" : columns == 2 ? "master,slave\n" : "slave\n";
  for (std::size_t line = 0; line < table->lines(); ++line)
    for (int column = 0; column < columns; ++column)
      fmt::format_to(std::back_inserter(text), "{}{}", table->value(line, column),
                     column + 1 == columns ? '\n' : ',');
  return text;
}

}  // namespace drycut::devices::plcopen
