#include "plants/flying_saw_blade.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

double at(const Slide& slide, double h, double fraction) {
  return within_step(slide.position_before, slide.position, slide.speed_before, slide.speed, h, fraction);
}

}  // namespace

double cutting_time(const SawBladeData& blade, const Section& section, double force, double throttle) {
  return (throttle * section_height(section) + blade.resistance * section_area(section)) / force;
}

SawCut::SawCut(const SawBladeData& blade, const Section& section, double clearance)
    : blade_(blade), section_(section), clearance_(clearance), height_(section_height(section)) {}

SawCut::Load SawCut::load(const Slide& head, const Slide& carriage, const Slide& material, bool met) {
  resistance_ = sideways_ = 0;
  if (!engaged_ || !met) return {};
  Load load;
  const double depth = head.position - clearance_;
  if (!separated_ && depth >= deepest_)
    load.resistance = resistance_ = blade_.resistance * section_chord(section_, depth);
  // Where the force is at its limit, blade or material give way and stay so.
  const double most = blade_.yield / blade_.stiffness;
  given_ = std::clamp(given_, displacement_ - most, displacement_ + most);
  const double rate = carriage.speed - material.speed;
  load.sideways = std::clamp(-blade_.stiffness * (displacement_ - given_) - blade_.damping * rate,
                             -blade_.yield, blade_.yield);
  // Once the piece is off, the material behind can only run up against the blade.
  if (separated_) load.sideways = std::max(load.sideways, 0.0);
  sideways_ = load.sideways;
  return load;
}

void SawCut::enter(double fraction, const Slide& carriage, const Slide& material, double h) {
  engaged_ = true;
  separated_ = pinched_ = false;
  given_ = deepest_ = largest_force_ = largest_pinch_ = 0;
  mark_ = at(material, h, fraction) - at(carriage, h, fraction);
  time_ = -fraction * h;
}

SawCut::Outcome SawCut::sense(const Slide& head, const Slide& carriage, const Slide& material, double h) {
  Outcome outcome;
  const double before = head.position_before - clearance_;
  const double depth = head.position - clearance_;
  force_ = resistance_ * std::max(head.speed, 0.0);
  if (depth <= 0) {
    engaged_ = false;
    displacement_ = 0;
    return outcome;
  }
  const auto crossing = [&](double edge) {
    return depth != before ? std::clamp((edge - before) / (depth - before), 0.0, 1.0) : 1.0;
  };
  if (!engaged_) enter(crossing(0), carriage, material, h);
  time_ += h;
  displacement_ = mark_ - (material.position - carriage.position);
  largest_force_ = std::max(largest_force_, force_);
  largest_pinch_ = std::max(largest_pinch_, std::abs(sideways_));
  if (!pinched_ && std::abs(sideways_) > blade_.pinch_limit) pinched_ = outcome.pinched = true;
  deepest_ = std::max(deepest_, depth);
  if (!separated_ && depth >= height_) {
    separated_ = outcome.separated = true;
    outcome.fraction = crossing(height_);
    outcome.mark = mark_;
    outcome.slant = mark_ - (at(material, h, outcome.fraction) - at(carriage, h, outcome.fraction));
    outcome.pinch = largest_pinch_;
    outcome.force = largest_force_;
    outcome.time = time_ - (1 - outcome.fraction) * h;
  }
  return outcome;
}

void SawCut::visit(StateArchive& archive) {
  STATE(archive, engaged_, separated_, pinched_, mark_, displacement_, given_, deepest_, time_, resistance_,
        force_, sideways_, largest_pinch_, largest_force_);
}

Parameters saw_blade_parameters(SawBladeData& data) {
  return {
      row("resistance", "N s/m2", "cutting force for the width of the cut and the speed of the plunge",
          data.resistance, 0, 1e9, "estimate: 40 cm2/s of steel tube at 400 N"),
      row("stiffness", "N/m", "sideways force for the displacement of blade and material on each other",
          data.stiffness, 0, 1e8, "estimate: disc of 300 mm, 2.5 mm thick"),
      row("damping", "N s/m", "sideways damping", data.damping, 0, 1e5, "estimate: 3 % of critical"),
      row("yield", "N", "largest sideways force: then blade or material give way", data.yield, 1, 1e6,
          "estimate"),
      row("pinch_limit", "N", "sideways force that is reported as a pinch", data.pinch_limit, 0, 1e6,
          "estimate: the blade begins to burn"),
  };
}

}  // namespace drycut::plants
