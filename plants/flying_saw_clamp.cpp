#include "plants/flying_saw_clamp.hpp"

#include "base/state_archive.hpp"

namespace drycut::plants {

void Clamp::move_jaws(double h) {
  closed.edges.clear();
  gripped_ = let_go_ = false;
  if (stroke_ == (command.level ? 1 : 0)) return;  // they are there
  const double time = command.level ? data_.close_time : data_.open_time;
  const double change = time > 0 ? h / time : 1;
  stroke_ = std::clamp(stroke_ + (command.level ? change : -change), 0.0, 1.0);
  // A hair of rounding must not cost a step.
  constexpr double hair = 1e-9;
  const bool before = closed_;
  closed_ = closed_ ? stroke_ > hair : stroke_ > 1 - hair;
  gripped_ = closed_ && !before;
  let_go_ = before && !closed_;
  if (closed_ == before) return;
  closed.level = closed_;
  closed.add_edge(closed_, 0);
  slip_ = 0;
}

void Clamp::drive(Slide& carriage, Slide& material, double h) {
  move_jaws(h);
  friction_ = 0;
  if (const double most = limit(); most > 0) {
    const double reduced = carriage.mass * material.mass / (carriage.mass + material.mass);
    const double difference = carriage.speed + carriage.force * h / carriage.mass - material.speed -
                              material.force * h / material.mass;
    friction_ = std::clamp(-difference * reduced / h, -most, most);
  }
  carriage.add_force(friction_);
  material.add_force(-friction_);
}

void Clamp::sense(const Slide& carriage, const Slide& material, double h) {
  if (closed_) slip_ += (carriage.speed - material.speed) * h;
}

void Clamp::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back(fault_value(component, "force_loss", "%", lost_,
                               "share of the clamping force that is missing: a leak, oil on the jaws",
                               in_percent));
}

void Clamp::visit(StateArchive& archive) {
  STATE(archive, command, closed, stroke_, closed_, gripped_, let_go_, friction_, slip_, lost_);
}

Parameters clamp_parameters(ClampData& data) {
  return {
      row("force", "N", "force of a jaw on the material", data.force, 0, 1e6, "cylinder of 125 mm at 5 bar"),
      row("friction", "", "Coulomb friction coefficient, jaw on material", data.friction, 0, 2,
          "estimate: steel on steel, dry"),
      row("close_time", "ms", "from the command until the jaws grip", data.close_time, 0, 10000,
          "estimate: short stroke"),
      row("open_time", "ms", "from the end of the command until they let go", data.open_time, 0, 10000,
          "estimate: venting"),
  };
}

}  // namespace drycut::plants
