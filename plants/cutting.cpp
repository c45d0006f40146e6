#include "plants/cutting.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

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

double helix_lag(double radius, double helix, double width) {
  return std::tan(helix) * width / (radius * std::cos(helix));
}

double helix_of_lag(double radius, double lag, double width) {
  // tan / cos = sin / (1 - sin^2)
  const double ratio = lag * radius / width;
  return ratio > 0 ? std::asin((std::sqrt(1 + 4 * ratio * ratio) - 1) / (2 * ratio)) : 0;
}

HelicalCut helical_cut(double peak, double radius, double thickness, double lead, double lag) {
  const double touch = engagement_angle(radius, thickness);
  // Work that a point has taken until it is at an angle: what they took more is what the blade meets.
  const auto work = [&](double theta) {
    return theta < 0 ? shear_work(peak, thickness, penetration(radius, thickness, theta))
                     : shear_work(peak, thickness, thickness);
  };
  // The integral of shear_force over the angle up to bottom dead centre: 4 peak q (1 - q), q = R (1 - cos) /
  // s.
  const auto sum = [&](double theta) {
    const double t = std::clamp(-theta, 0.0, touch);
    const double q = radius / thickness;
    return 4 * peak * (q * (t - std::sin(t)) - q * q * (1.5 * t - 2 * std::sin(t) + std::sin(2 * t) / 4));
  };
  return {(work(lead) - work(lead - lag)) / lag, (sum(lead - lag) - sum(lead)) / lag};
}

Cutter::Cutter(const CutterData& data, const Shaft& drum)
    : data_(data),
      closing_(data.counter_blades ? 2 * data.radius : data.radius),
      along_(data.radius * std::cos(data.helix)),
      lag_(helix_lag(data.radius, data.helix, data.width)),
      touch_(engagement_angle(closing_, data.thickness)),
      engagement_(touch_ + lag_ / 2),
      pitch_(2 * pi / data.blades),
      coupling_(data.coupling),
      theta_(nearest_blade(drum)),
      engaged_(std::abs(theta_) < engagement_),
      direction_(theta_ <= 0 ? 1 : -1),
      deepest_(engaged_ ? penetration(closing_, data.thickness, theta_) : 0),
      farthest_(lead()) {}

// A circle that lies e beside the axis has its tips e/R cos(angle to blade 1) ahead of their place.
double Cutter::ahead(double blade) const {
  return data_.eccentricity / data_.radius * std::cos(2 * pi * blade / data_.blades);
}

// Angle of the point of the blade that is nearest to bottom dead centre.
double Cutter::nearest_point() const {
  return theta_ > 0 ? std::max(0.0, theta_ - lag_ / 2) : std::min(0.0, theta_ + lag_ / 2);
}

double Cutter::along_web(const Shaft& drum, double theta) const {
  return drum.speed * along_ * std::cos(theta);
}

double Cutter::place() const {
  if (!engaged_ || lag_ == 0) return 0;
  return direction_ * (std::clamp(lead() / lag_, 0.0, 1.0) - 0.5) * data_.width;
}

void Cutter::shear(const Shaft& drum, DryResistance& dry) {
  const double depth = penetration(closing_, data_.thickness, theta_);
  if (depth < deepest_) return;
  // Work on the drum: F dd = F R |sin theta| dtheta, only in the direction that goes deeper.
  const double force = shear_force(data_.peak_force, data_.thickness, depth);
  const double resistance = force * closing_ * std::abs(std::sin(theta_));
  (theta_ < 0 ? dry.forward : dry.backward) = resistance;
  if (theta_ * drum.speed < 0) force_ = force;
  largest_force_ = std::max(largest_force_, force_);
}

void Cutter::shear_by_helix(const Shaft& drum, DryResistance& dry) {
  if (lead() < farthest_) return;
  const HelicalCut cut = helical_cut(data_.peak_force, closing_, data_.thickness, lead(), lag_);
  (direction_ > 0 ? dry.forward : dry.backward) = cut.torque;
  if (direction_ * drum.speed > 0) force_ = cut.force;
  largest_force_ = std::max(largest_force_, force_);
}

// Each point in the web has its share of the force. Where it is cut, the web can only run up.
void Cutter::push_by_helix(const Shaft& drum, const Slide& web, Load& load) const {
  const auto push = [&](double from, double to, double most) {
    if (to <= from) return;
    const double share = (to - from) / lag_;
    const double arm = along_ * (std::sin(to) - std::sin(from)) / (to - from);
    const double mismatch = drum.speed * arm - web.speed;
    const double force = share * std::clamp(coupling_ * mismatch, -data_.grip, most);
    load.web_force += force;
    load.torque -= force * arm;
  };
  const double trailing = std::max(lead() - lag_, -touch_);
  const double leading = std::min(lead(), touch_);
  const double cut = lead() - std::max(farthest_, 0.0);
  push(trailing, std::min(leading, cut), data_.grip);
  push(std::max(trailing, cut), leading, 0);
}

Cutter::Load Cutter::meet(const Shaft& drum, const Slide& web) {
  Load load;
  if (lag_ > 0) {
    if (!separated_) shear_by_helix(drum, load.dry);
    push_by_helix(drum, web, load);
    return load;
  }
  const double cosine = std::cos(theta_);
  if (!separated_) shear(drum, load.dry);
  const double mismatch = drum.speed * along_ * cosine - web.speed;
  // Once the piece is off, the web can only run up against the blade; the blade no longer pulls it.
  if (separated_ && mismatch > 0) return load;
  load.web_force = std::clamp(coupling_ * mismatch, -data_.grip, data_.grip);
  load.torque = -load.web_force * along_ * cosine;
  return load;
}

void Cutter::enter(const Shaft& drum, const Slide& web, double before) {
  engaged_ = true;
  separated_ = failed_ = false;
  deepest_ = largest_force_ = 0;
  direction_ = before <= 0 ? 1 : -1;
  farthest_ = -touch_;
  // The mismatch is largest where the tip touches the web, between two steps.
  const double share =
      std::clamp((engagement_ - std::abs(before)) / (std::abs(theta_) - std::abs(before)), 0.0, 1.0);
  const double drum_speed = drum.speed_before + share * (drum.speed - drum.speed_before);
  const double web_speed = web.speed_before + share * (web.speed - web.speed_before);
  largest_mismatch_ = std::abs(drum_speed * along_ * std::cos(touch_) - web_speed);
}

// Which points of the blade reached bottom dead centre in the last step, and where the web was then.
void Cutter::follow(const Shaft& drum, const Slide& web, double before, double h, Outcome& outcome) {
  const auto fraction_of = [&](double lead) {
    // Linear first, then one Newton step on the parabola of constant acceleration: exact to the third order.
    const double from = before - direction_ * (lead - lag_ / 2);
    const double f = from / (before - theta_);
    const double bend = 0.5 * (drum.speed - drum.speed_before) * h;
    const double slope = theta_ - before + bend * (2 * f - 1);
    const double correction = slope != 0 ? bend * f * (f - 1) / slope : 0;
    return std::clamp(f - correction, 0.0, 1.0);
  };
  const auto web_at = [&](double fraction) {
    return within_step(web.position_before, web.position, web.speed_before, web.speed, h, fraction);
  };
  const auto reached = [&](double point) { return farthest_ < point && lead() >= point; };
  if (reached(0)) first_mark_ = web_at(fraction_of(0));
  if (reached(lag_ / 2)) middle_mark_ = web_at(fraction_of(lag_ / 2));
  if (reached(lag_)) {
    separated_ = outcome.separated = true;
    outcome.fraction = fraction_of(lag_);
    outcome.mismatch = largest_mismatch_;
    outcome.force = largest_force_;
    outcome.mark = middle_mark_;
    outcome.skew =
        data_.width * std::tan(data_.helix) - direction_ * (web_at(outcome.fraction) - first_mark_);
  }
}

Cutter::Outcome Cutter::sense_blade(const Shaft& drum, const Slide& web, double before, double h) {
  Outcome outcome;
  // From one blade to the next theta jumps at half a pitch; there it passes no bottom dead centre.
  const bool near = std::abs(theta_ - before) < pi / data_.blades;
  const double through = (engaged_ ? direction_ : before <= 0 ? 1 : -1) * lag_ / 2;
  const bool passed =
      near && ((before < through && theta_ >= through) || (before > through && theta_ <= through));
  if (std::abs(theta_) >= engagement_ && !passed) {
    engaged_ = false;
    mismatch_ = 0;
    return outcome;
  }
  if (!engaged_) enter(drum, web, before);

  mismatch_ = along_web(drum, nearest_point()) - web.speed;
  if (!separated_) {
    largest_mismatch_ = std::max(largest_mismatch_, std::abs(mismatch_));
    const double last = std::clamp(lead() - lag_, -touch_, 0.0);  // of its points that are in the web
    if (lag_ > 0)
      largest_mismatch_ = std::max(largest_mismatch_, std::abs(along_web(drum, last) - web.speed));
  }
  if (!failed_) {
    outcome.tore = !separated_ && mismatch_ > data_.mismatch_limit;
    outcome.buckled = mismatch_ < -data_.mismatch_limit;
    failed_ = outcome.tore || outcome.buckled;
    outcome.excess = std::abs(mismatch_);
  }
  deepest_ = std::max(deepest_, penetration(closing_, data_.thickness, theta_));
  if (!separated_) follow(drum, web, before, h, outcome);
  farthest_ = std::max(farthest_, lead());
  return outcome;
}

void Cutter::visit(StateArchive& archive) {
  STATE(archive, coupling_, theta_, engaged_, separated_, failed_, direction_, deepest_, farthest_,
        first_mark_, middle_mark_, largest_mismatch_, largest_force_, mismatch_, force_);
}

}  // namespace drycut::plants
