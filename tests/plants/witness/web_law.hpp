#pragma once
#include <algorithm>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "plants/web.hpp"
#include "tests/plants/witness/cvode.hpp"
#include "tests/plants/witness/laws.hpp"

namespace drycut::plants::witness {

/// The elastic web; the plant's is plants/elastic_strip.cpp with line_drive.cpp. Travels a past the puller, b
/// past the wheel and c past the cut, rolls of speed r, draw d of the rolls ahead of the web, a force F at
/// the cut; L and W the distances of puller and wheel from it, m mass per metre:
///   d' = r - a',  D = k d + e (r - a')                      grip of the rolls
///   T = EA / (L - W) (b - a + tau (b' - a'))                tension before the wheel
///   U = EA / W (c - b + tau (c' - b'))                      and behind it
///   M a'' = D + T,  (J / r2 + m L / 2) b'' = U - T,  m (W / 2 + lead + c) c'' = F - U
/// A span that is pushed beyond Euler's load makes a loop: its tension stays there, and close to it the
/// damper is no stronger than the spring.
struct WebLaw : Equations {
  enum State { puller, puller_speed, wheel, wheel_speed, cut, cut_speed, draw, all };

  Motion motion;  ///< volts are the speed of the rolls [m/s], the force is that at the cut
  WebData web;
  double stiffness = 0;  ///< EA [N]
  double metre = 0;      ///< [kg]
  double euler = 0;      ///< [N]
  double growing = 1;    ///< share of the web beyond the cut that weighs

  WebLaw(WebData strip, Motion told) : motion(std::move(told)), web(std::move(strip)) {
    stiffness = web.strip.elasticity * web.width * web.thickness;
    metre = web.density * web.width * web.thickness;
    euler = std::numbers::pi * std::numbers::pi * web.strip.elasticity * web.width * web.thickness *
            web.thickness * web.thickness / 12 / web.strip.guide_distance / web.strip.guide_distance;
  }

  [[nodiscard]] std::vector<double> start() const override {
    const double v = web.drive.speed;
    return {0, v, 0, v, 0, v, 0};
  }
  void record(std::span<const double> y, Track& track) const {
    track.motor.push_back(y[wheel]);
    track.load.push_back(y[cut]);
  }
  [[nodiscard]] double tension(double length, double stretch, double rate) const {
    const double k = stiffness / length;
    const double spring = k * stretch + euler;  // over the load at which a loop begins
    if (spring < 0) return -euler;
    return std::max(0.0, spring + std::min(spring, k * web.strip.retardation * rate)) - euler;
  }
  void slope(double t, std::span<const double> y, std::span<double> dy) const override {
    const ElasticStripData& s = web.strip;
    const double rolls = motion.volts(t);
    const double grip = web.drive.stiffness * y[draw] + web.drive.damping * (rolls - y[puller_speed]);
    const double before =
        tension(s.puller_distance - s.wheel_distance, y[wheel] - y[puller], y[wheel_speed] - y[puller_speed]);
    const double behind = tension(s.wheel_distance, y[cut] - y[wheel], y[cut_speed] - y[wheel_speed]);
    dy[puller] = y[puller_speed];
    dy[wheel] = y[wheel_speed];
    dy[cut] = y[cut_speed];
    dy[draw] = rolls - y[puller_speed];
    dy[puller_speed] = (grip + before) / web.mass;
    dy[wheel_speed] = (behind - before) / (s.wheel_mass + metre * s.puller_distance / 2);
    dy[cut_speed] =
        (motion.force() - behind) / (metre * (s.wheel_distance / 2 + growing * (web.lead + y[cut])));
  }
  // Tension is continuous: no switch is needed.
  [[nodiscard]] int switches() const override { return 0; }
  void watch(double, std::span<const double>, std::span<double>) const override {}
  void act(double, std::span<double>, int) override {}
};

}  // namespace drycut::plants::witness
