#include <fmt/format.h>

#include <algorithm>

#include "plants/pose_math.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

// How the line looks. The web runs at y = 0 from left to right; the machine stands on a floor at y = -0.9 m.

namespace {

constexpr double floor_y = -0.9;
constexpr double upstream = 1.7;     // visible web before the cut [m]
constexpr double least_look = 3e-3;  // thinner web would vanish in the picture [m]
constexpr double pull_x = -1.25;     // line drive
constexpr double wheel_x = -0.7;
constexpr double roll_diameter = 0.14;
constexpr int cleats = 8;  // marks on the belt that show its motion

constexpr std::array<float, 3> steel = {0.62F, 0.64F, 0.67F};
constexpr std::array<float, 3> paint = {0.16F, 0.30F, 0.42F};
constexpr std::array<float, 3> rubber = {0.14F, 0.15F, 0.16F};
constexpr std::array<float, 3> web_colour = {0.96F, 0.62F, 0.12F};
constexpr std::array<float, 3> mark_colour = {0.85F, 0.87F, 0.88F};

using Shape = Part::Shape;

/// How high the material looks [m].
double look_of(const WebData& data) { return std::max(section_height(data.cross_section()), least_look); }
/// Width of rolls, tables and belt [m]: a tube needs more than its own.
double machine_width(const WebData& data) {
  return data.cross_section().tube ? std::max(4 * data.width, 0.16) : data.width;
}

}  // namespace

std::vector<Part> Web::parts() {
  const double w = machine_width(data_);
  const double look = look_of(data_);
  const double belt = data_.outfeed.length;
  const double wheel = data_.wheel.circumference / std::numbers::pi;
  const bool tube = data_.cross_section().tube;
  // Of a length of 1 m: poses scale it.
  const auto material = [&](const std::string& name) {
    return tube ? Part{name, Shape::cylinder, {look, look, 1}, web_colour, "web"}
                : Part{name, Shape::box, {1, look, w}, web_colour, "web"};
  };
  std::vector<Part> parts = {
      material("web"),
      {"upper pull roll", Shape::cylinder, {roll_diameter, roll_diameter, w * 1.15}, rubber, "rubber"},
      {"lower pull roll", Shape::cylinder, {roll_diameter, roll_diameter, w * 1.15}, steel, "steel"},
      {"pull roll mark", Shape::box, {0.012, 0.05, 0.006}, mark_colour, "paint"},
      {"measuring wheel", Shape::cylinder, {wheel, wheel, 0.03}, rubber, "rubber"},
      {"measuring wheel mark", Shape::box, {0.012, wheel * 0.38, 0.006}, mark_colour, "paint"},
      {"wheel arm", Shape::box, {0.26, 0.025, 0.02}, steel, "steel"},
      {"table", Shape::box, {upstream - 0.25, 0.02, w * 1.1}, steel, "steel"},
      {"infeed frame", Shape::box, {upstream - 0.3, 0.22, w * 0.8}, paint, "paint"},
      {"infeed leg 1", Shape::box, {0.09, 0.75, w * 0.7}, paint, "paint"},
      {"infeed leg 2", Shape::box, {0.09, 0.75, w * 0.7}, paint, "paint"},
      {"outfeed belt", Shape::box, {belt, 0.03, w * 1.15}, rubber, "rubber"},
      {"outfeed roll 1", Shape::cylinder, {0.1, 0.1, w * 1.16}, steel, "steel"},
      {"outfeed roll 2", Shape::cylinder, {0.1, 0.1, w * 1.16}, steel, "steel"},
      {"outfeed frame", Shape::box, {belt - 0.15, 0.09, w * 0.9}, paint, "paint"},
      {"outfeed leg 1", Shape::box, {0.09, 0.75, w * 0.7}, paint, "paint"},
      {"outfeed leg 2", Shape::box, {0.09, 0.75, w * 0.7}, paint, "paint"},
  };
  for (int i = 0; i < cleats; ++i)
    parts.push_back(
        {fmt::format("belt mark {}", i + 1), Shape::box, {0.02, 0.004, w * 1.15}, mark_colour, "paint"});
  for (int i = 0; i < Outfeed::pool_size; ++i) parts.push_back(material(fmt::format("piece {}", i + 1)));
  return parts;
}

void Web::poses(std::vector<PartPose>& out) {
  const double look = look_of(data_);
  const bool tube = data_.cross_section().tube;
  // A cylinder's axis is z: a tube is turned into the line.
  const double half = std::sqrt(0.5);
  const auto material = [&](double middle, double length) {
    PartPose pose = {.pose = turned(middle, look / 2, 0, 0), .scale = {length, 1, 1}};
    if (tube) pose = {.pose = {{middle, look / 2, 0}, {0, half, 0, half}}, .scale = {1, 1, length}};
    return pose;
  };
  const double lead = std::max(0.0, material_.position - lead_end_);
  const double belt = data_.outfeed.length;
  const double belt_x = data_.outfeed.start;
  const double wheel_radius = data_.wheel.circumference / (2 * std::numbers::pi);
  const double wheel_angle = 2 * std::numbers::pi * (wheel_.revolutions() - std::floor(wheel_.revolutions()));
  const double roll_angle = std::fmod(material_.position / (roll_diameter / 2), 2 * std::numbers::pi);
  const double near_side = machine_width(data_) / 2;
  const double leg_y = floor_y + 0.375;
  const auto at = [](double x, double y, double z = 0) { return PartPose{.pose = turned(x, y, z, 0)}; };

  out.clear();
  out.push_back(material((lead - upstream) / 2, upstream + lead));
  const double upper_y = look + roll_diameter / 2;
  out.push_back({.pose = turned(pull_x, upper_y, 0, roll_angle)});
  out.push_back({.pose = turned(pull_x, -roll_diameter / 2, 0, -roll_angle)});
  out.push_back({.pose = turned(pull_x - 0.035 * std::sin(roll_angle), upper_y + 0.035 * std::cos(roll_angle),
                                near_side * 1.15 + 0.003, roll_angle)});
  const double wheel_y = look + wheel_radius;
  const double wheel_z = tube ? 0 : near_side * 0.8;
  out.push_back({.pose = turned(wheel_x, wheel_y, wheel_z, wheel_angle)});
  out.push_back(
      {.pose = turned(wheel_x - wheel_radius * 0.55 * std::sin(wheel_angle),
                      wheel_y + wheel_radius * 0.55 * std::cos(wheel_angle), wheel_z + 0.018, wheel_angle)});
  out.push_back(at(wheel_x - 0.13, wheel_y + 0.02, wheel_z - 0.03));
  out.push_back(at(-(upstream + 0.25) / 2, -0.011));
  out.push_back(at(-(upstream + 0.3) / 2, -0.13));
  out.push_back(at(-upstream + 0.25, leg_y));
  out.push_back(at(-0.45, leg_y));
  out.push_back(at(belt_x + belt / 2, -0.016));
  out.push_back(at(belt_x + 0.02, -0.052));
  out.push_back(at(belt_x + belt - 0.02, -0.052));
  out.push_back(at(belt_x + belt / 2, -0.13));
  out.push_back(at(belt_x + 0.45, leg_y));
  out.push_back(at(belt_x + belt - 0.3, leg_y));
  for (int i = 0; i < cleats; ++i)
    out.push_back(at(belt_x + std::fmod(outfeed_.belt_travel() + belt * i / cleats, belt), -0.002));
  for (const Outfeed::Piece& piece : outfeed_.pieces()) {
    out.push_back(material(piece.body->position, std::max(piece.length, 1e-3)));
    out.back().visible = piece.body->awake;
  }
}

}  // namespace drycut::plants
