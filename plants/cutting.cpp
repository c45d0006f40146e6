#include "plants/cutting.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::plants {

namespace {
constexpr double pi = std::numbers::pi;
}

double engagement_angle(double radius, double thickness) { return std::acos(1 - thickness / radius); }

double penetration(double radius, double thickness, double theta) {
  return std::clamp(thickness - radius * (1 - std::cos(theta)), 0.0, thickness);
}

double shear_force(double peak, double thickness, double depth) {
  const double p = std::clamp(depth / thickness, 0.0, 1.0);
  return 4 * peak * p * (1 - p);
}

double shear_work(double peak, double thickness, double depth) {
  const double p = std::clamp(depth / thickness, 0.0, 1.0);
  return 4 * peak * thickness * p * p * (0.5 - p / 3);
}

Cutter::Cutter(const CutterData& data, const Shaft& drum)
    : data_(data),
      engagement_(engagement_angle(data.radius, data.thickness)),
      theta_(nearest_blade(drum)),
      engaged_(std::abs(theta_) < engagement_),
      deepest_(engaged_ ? penetration(data.radius, data.thickness, theta_) : 0) {}

double Cutter::nearest_blade(const Shaft& drum) const {
  const double pitches = drum.part * data_.blades;
  const double blade = std::floor(pitches + 0.5);
  const double theta = (pitches - blade) * (2 * pi / data_.blades);
  if (data_.eccentricity == 0) return theta;
  // A circle that lies e beside the axis has its tips e/R cos(angle to blade 1) ahead of their place.
  return theta + data_.eccentricity / data_.radius * std::cos(2 * pi * blade / data_.blades);
}

Cutter::Load Cutter::load(const Shaft& drum, const Slide& web) {
  Load load;
  force_ = 0;
  if (!engaged_) return load;
  const double cosine = std::cos(theta_);
  const double depth = penetration(data_.radius, data_.thickness, theta_);
  if (!separated_ && depth >= deepest_) {
    // Work on the drum: F dd = F R |sin theta| dtheta, only in the direction that goes deeper.
    const double force = shear_force(data_.peak_force, data_.thickness, depth);
    const double resistance = force * data_.radius * std::abs(std::sin(theta_));
    (theta_ < 0 ? load.dry.forward : load.dry.backward) = resistance;
    if (theta_ * drum.speed < 0) force_ = force;
    largest_force_ = std::max(largest_force_, force_);
  }
  const double mismatch = drum.speed * data_.radius * cosine - web.speed;
  // Once the piece is off, the web can only run up against the blade; the blade no longer pulls it.
  if (separated_ && mismatch > 0) return load;
  load.web_force = std::clamp(data_.coupling * mismatch, -data_.grip, data_.grip);
  load.torque = -load.web_force * data_.radius * cosine;
  return load;
}

void Cutter::enter(const Shaft& drum, const Slide& web, double before) {
  engaged_ = true;
  separated_ = failed_ = false;
  deepest_ = largest_force_ = 0;
  // The mismatch is largest where the tip touches the web, between two steps.
  const double share =
      std::clamp((engagement_ - std::abs(before)) / (std::abs(theta_) - std::abs(before)), 0.0, 1.0);
  const double drum_speed = drum.speed_before + share * (drum.speed - drum.speed_before);
  const double web_speed = web.speed_before + share * (web.speed - web.speed_before);
  largest_mismatch_ = std::abs(drum_speed * data_.radius * std::cos(engagement_) - web_speed);
}

Cutter::Outcome Cutter::sense(const Shaft& drum, const Slide& web, double h) {
  Outcome outcome;
  const double before = theta_;
  theta_ = nearest_blade(drum);
  // From one blade to the next theta jumps at half a pitch; there it passes no bottom dead centre.
  const bool near = std::abs(theta_ - before) < pi / data_.blades;
  const bool passed = near && ((before < 0 && theta_ >= 0) || (before > 0 && theta_ <= 0));
  if (std::abs(theta_) >= engagement_ && !passed) {
    engaged_ = false;
    mismatch_ = 0;
    return outcome;
  }
  if (!engaged_) enter(drum, web, before);

  mismatch_ = drum.speed * data_.radius * std::cos(theta_) - web.speed;
  if (!separated_) largest_mismatch_ = std::max(largest_mismatch_, std::abs(mismatch_));
  if (!failed_) {
    outcome.tore = !separated_ && mismatch_ > data_.mismatch_limit;
    outcome.buckled = mismatch_ < -data_.mismatch_limit;
    failed_ = outcome.tore || outcome.buckled;
    outcome.excess = std::abs(mismatch_);
  }
  deepest_ = std::max(deepest_, penetration(data_.radius, data_.thickness, theta_));
  if (passed && !separated_) {
    separated_ = outcome.separated = true;
    // Linear first, then one Newton step on the parabola of constant acceleration: exact to the third order.
    const double f = before / (before - theta_);
    const double bend = 0.5 * (drum.speed - drum.speed_before) * h;
    const double slope = theta_ - before + bend * (2 * f - 1);
    const double correction = slope != 0 ? bend * f * (f - 1) / slope : 0;
    outcome.fraction = std::clamp(f - correction, 0.0, 1.0);
    outcome.mismatch = largest_mismatch_;
    outcome.force = largest_force_;
  }
  return outcome;
}

}  // namespace drycut::plants
