#include <fmt/format.h>

#include "plants/pose_math.hpp"
#include "plants/rotary_knife.hpp"

namespace drycut::plants {

// How the knife looks: drum over the web, anvil roll under it. Bearing, gearbox and motor are behind, so that
// the operator sees the drum from its free end.

namespace {

constexpr double blade_height = 0.03;  // stands out of the drum [m]
constexpr double anvil_diameter = 0.16;
constexpr double gap = 0.012;  // between drum end and post

constexpr std::array<float, 3> drum_colour = {0.55F, 0.58F, 0.62F};
constexpr std::array<float, 3> blade_colour = {0.86F, 0.12F, 0.10F};
constexpr std::array<float, 3> frame_colour = {0.16F, 0.30F, 0.42F};
constexpr std::array<float, 3> motor_colour = {0.12F, 0.12F, 0.13F};
constexpr std::array<float, 3> steel = {0.70F, 0.72F, 0.74F};
constexpr std::array<float, 3> mark_colour = {0.95F, 0.95F, 0.95F};

using Shape = Part::Shape;

}  // namespace

std::vector<Part> RotaryKnife::parts() {
  const double w = data_.blade_width;
  const double body = 2 * (radius_ - blade_height * 0.8);
  std::vector<Part> parts = {
      {"drum", Shape::cylinder, {body, body, w}, drum_colour, "steel"},
      {"drum shaft", Shape::cylinder, {0.05, 0.05, w + 0.06}, steel, "steel"},
      {"drum mark", Shape::box, {0.012, radius_ * 0.6, 0.004}, mark_colour, "paint"},
      {"anvil roll", Shape::cylinder, {anvil_diameter, anvil_diameter, w}, steel, "steel"},
      {"bearing", Shape::cylinder, {0.12, 0.12, 0.05}, frame_colour, "paint"},
      {"post", Shape::box, {0.07, 2 * radius_ + 0.14, 0.05}, frame_colour, "paint"},
      {"back plate", Shape::box, {0.26, 2 * radius_ + 0.34, 0.03}, frame_colour, "paint"},
      {"base", Shape::box, {0.30, 0.75, w}, frame_colour, "paint"},
      {"gearbox", Shape::cylinder, {0.13, 0.13, 0.12}, steel, "steel"},
      {"motor", Shape::box, {0.14, 0.14, 0.20}, motor_colour, "paint"},
      {"encoder", Shape::cylinder, {0.09, 0.09, 0.05}, motor_colour, "paint"},
      {"home switch", Shape::box, {0.05, 0.018, 0.018}, mark_colour, "paint"},
  };
  for (int i = 0; i < data_.blade_count; ++i)
    parts.push_back(
        {fmt::format("blade {}", i + 1), Shape::wedge, {0.022, blade_height, w}, blade_colour, "blade"});
  return parts;
}

void RotaryKnife::poses(std::vector<PartPose>& out) {
  const double angle = 2 * std::numbers::pi * drum_.part;
  const double axis = radius_;  // height of the drum's axis over the anvil
  const double end = data_.blade_width / 2;
  const double ahead = 0.12 + radius_;
  const auto at = [](double x, double y, double z) { return PartPose{.pose = turned(x, y, z, 0)}; };

  out.clear();
  out.push_back({.pose = turned(0, axis, 0, angle)});
  out.push_back({.pose = turned(0, axis, 0, angle)});
  const double mark = radius_ * 0.36;
  out.push_back({.pose = turned(mark * std::sin(angle), axis - mark * std::cos(angle), end + 0.003, angle)});
  out.push_back({.pose = turned(0, -anvil_diameter / 2, 0, -angle)});
  out.push_back(at(0, axis, -end - gap - 0.02));
  out.push_back(at(0, axis + 0.12, -end - gap - 0.03));
  out.push_back(at(0, axis, -end - gap - 0.07));
  out.push_back(at(0, -0.525, 0));
  out.push_back(at(0, axis, -end - 0.17));
  out.push_back(at(0, axis, -end - 0.33));
  out.push_back(at(0, axis, -end - 0.455));
  out.push_back(at(-ahead * 0.5 - radius_ * 0.3, axis + radius_ * 0.7, end - 0.02));
  for (int i = 0; i < data_.blade_count; ++i) {
    const double theta = angle - 2 * std::numbers::pi * i / data_.blade_count;
    const double middle = radius_ - blade_height / 2;
    out.push_back({.pose = turned(middle * std::sin(theta), axis - middle * std::cos(theta), 0, theta)});
  }
}

}  // namespace drycut::plants
