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
constexpr double stand_low = -0.24;  // foot of the pull rolls' stands
constexpr double belt_height = 0.11;
constexpr double outfeed_leg = 0.795;
constexpr int tube_rollers = 4;
constexpr double tube_roller = 0.09;  // outer diameter [m]
constexpr int cleats = 8;             // marks on the belt that show its motion

constexpr std::array<float, 3> roll_colour = {0.62F, 0.64F, 0.67F};
constexpr std::array<float, 3> paint = {0.16F, 0.30F, 0.42F};
constexpr std::array<float, 3> rubber = {0.14F, 0.15F, 0.16F};
constexpr std::array<float, 3> web_colour = {0.96F, 0.62F, 0.12F};
constexpr std::array<float, 3> mark_colour = {0.85F, 0.87F, 0.88F};
constexpr std::array<float, 3> print_colour = {0.10F, 0.09F, 0.09F};
constexpr double print_look = 15e-3;  // a narrower mark would vanish in the picture [m]
constexpr std::size_t most_prints = 40;
constexpr double beyond_cut = 0.3;  // of the web before it is cut, where marks are shown [m]

using Shape = Part::Shape;

/// How high the material looks [m].
double look_of(const WebData& data) { return std::max(section_height(data.cross_section()), least_look); }
std::array<double, 3> stand_size(double look) { return {0.06, look + roll_diameter - stand_low, 0.024}; }
/// Width of rolls, tables and belt [m]: a tube needs more than its own.
double machine_width(const WebData& data) {
  return data.cross_section().tube ? std::max(4 * data.width, 0.16) : data.width;
}
/// Where the measuring wheel's axle is, and the arm on the operator's side that carries it.
double wheel_y_of(const WebData& data) {
  return look_of(data) + data.wheel.circumference / (2 * std::numbers::pi);
}
double wheel_z_of(const WebData& data) { return data.cross_section().tube ? 0 : machine_width(data) * 0.4; }
double wheel_arm_z(const WebData& data) { return machine_width(data) * 0.55 + 0.04; }

/// So many marks can be in sight.
std::size_t prints_of(const PrintMarkData& marks) {
  if (marks.pitch <= 0) return 0;
  return std::min(most_prints, static_cast<std::size_t>((upstream + beyond_cut) / marks.pitch) + 2);
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
      {"upper pull roll",
       Shape::cylinder,
       {roll_diameter, roll_diameter, w * 1.15},
       rubber,
       "rubber",
       "roller"},
      {"lower pull roll",
       Shape::cylinder,
       {roll_diameter, roll_diameter, w * 1.15},
       roll_colour,
       "steel",
       "roller"},
      {"pull roll mark", Shape::box, {0.012, 0.05, 0.006}, mark_colour, "paint"},
      {"measuring wheel", Shape::cylinder, {wheel, wheel, 0.03}, rubber, "rubber", "measuring_wheel"},
      {"measuring wheel mark", Shape::box, {0.012, wheel * 0.38, 0.006}, mark_colour, "paint"},
      {"wheel arm", Shape::box, {0.26, 0.025, 0.02}, roll_colour, "steel", "wheel_arm"},
      {"wheel axle",
       Shape::cylinder,
       {0.018, 0.018, wheel_arm_z(data_) - wheel_z_of(data_)},
       roll_colour,
       "steel"},
      {"wheel post",
       Shape::box,
       {0.05, wheel_y_of(data_) + 0.035 - stand_low, 0.024},
       paint,
       "paint",
       "frame_post"},
      {"roll stand 1", Shape::box, stand_size(look), paint, "paint", "frame_post"},
      {"roll stand 2", Shape::box, stand_size(look), paint, "paint", "frame_post"},
      {"infeed frame", Shape::box, {upstream - 0.3, 0.22, w * 0.8}, paint, "paint", "hollow_frame"},
      {"infeed leg 1", Shape::box, {0.09, 0.75, w * 0.7}, paint, "paint", "leg"},
      {"infeed leg 2", Shape::box, {0.09, 0.75, w * 0.7}, paint, "paint", "leg"},
      {"outfeed belt", Shape::box, {belt, belt_height, w * 1.15}, rubber, "rubber", "conveyor_belt"},
      {"outfeed roll 1", Shape::cylinder, {0.1, 0.1, w * 1.16}, roll_colour, "steel", "roller"},
      {"outfeed roll 2", Shape::cylinder, {0.1, 0.1, w * 1.16}, roll_colour, "steel", "roller"},
      {"outfeed frame", Shape::box, {belt - 0.15, 0.1, w * 1.15 + 0.04}, paint, "paint", "hollow_frame"},
      {"outfeed leg 1", Shape::box, {0.09, outfeed_leg, w}, paint, "paint", "leg"},
      {"outfeed leg 2", Shape::box, {0.09, outfeed_leg, w}, paint, "paint", "leg"},
  };
  if (!tube)
    parts.push_back({"table", Shape::box, {upstream - 0.25, 0.02, w * 1.1}, roll_colour, "steel", "table"});
  if (tube)
    for (int i = 0; i < tube_rollers; ++i)
      parts.push_back({fmt::format("tube roller {}", i + 1),
                       Shape::cylinder,
                       {tube_roller, tube_roller, w},
                       roll_colour,
                       "steel",
                       "tube_roller"});
  for (int i = 0; i < cleats; ++i)
    parts.push_back(
        {fmt::format("belt mark {}", i + 1), Shape::box, {0.02, 0.004, w * 1.15}, mark_colour, "paint"});
  for (int i = 0; i < Outfeed::pool_size; ++i) parts.push_back(material(fmt::format("piece {}", i + 1)));
  for (std::size_t i = 0; i < prints_of(data_.marks); ++i)
    parts.push_back({fmt::format("print mark {}", i + 1),
                     Shape::box,
                     {std::max(data_.marks.width, print_look), 1e-3, 0.3 * data_.width},
                     print_colour,
                     "web"});
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
  const double wheel_y = wheel_y_of(data_);
  const double wheel_z = wheel_z_of(data_);
  out.push_back({.pose = turned(wheel_x, wheel_y, wheel_z, wheel_angle)});
  out.push_back(
      {.pose = turned(wheel_x - wheel_radius * 0.55 * std::sin(wheel_angle),
                      wheel_y + wheel_radius * 0.55 * std::cos(wheel_angle), wheel_z + 0.018, wheel_angle)});
  const double arm_z = wheel_arm_z(data_);
  out.push_back(at(wheel_x - 0.118, wheel_y, arm_z));
  out.push_back(at(wheel_x, wheel_y, (wheel_z + arm_z) / 2));
  out.push_back(at(wheel_x - 0.236, (wheel_y + 0.035 + stand_low) / 2, arm_z - 0.02));
  const double stand_y = stand_low + stand_size(look)[1] / 2;
  for (const double side : {1.0, -1.0}) out.push_back(at(pull_x, stand_y, side * (near_side * 1.15 + 0.02)));
  out.push_back(at(-(upstream + 0.3) / 2, -0.13));
  out.push_back(at(-upstream + 0.25, leg_y));
  out.push_back(at(-0.45, leg_y));
  const double belt_y = -0.001 - belt_height / 2;
  const double belt_angle = std::fmod(outfeed_.belt_travel() / 0.05, 2 * std::numbers::pi);
  out.push_back(at(belt_x + belt / 2, belt_y));
  out.push_back({.pose = turned(belt_x + belt_height / 2, belt_y, 0, -belt_angle)});
  out.push_back({.pose = turned(belt_x + belt - belt_height / 2, belt_y, 0, -belt_angle)});
  out.push_back(at(belt_x + belt / 2, belt_y - 0.01));
  out.push_back(at(belt_x + 0.45, floor_y + outfeed_leg / 2));
  out.push_back(at(belt_x + belt - 0.3, floor_y + outfeed_leg / 2));
  if (!tube) out.push_back(at(-(upstream + 0.25) / 2, -0.011));
  const double rest = tube_roller / 3;  // radius of a roller's waist, on which the tube lies
  const double roller_angle = std::fmod(material_.position / rest, 2 * std::numbers::pi);
  if (tube)
    for (int i = 0; i < tube_rollers; ++i)
      out.push_back({.pose = turned(-1.55 + 0.4 * i, -rest, 0, -roller_angle)});
  for (int i = 0; i < cleats; ++i)
    out.push_back(at(belt_x + std::fmod(outfeed_.belt_travel() + belt * i / cleats, belt), -0.002));
  for (const Outfeed::Piece& piece : outfeed_.pieces()) {
    out.push_back(material(piece.body->position, std::max(piece.length, 1e-3)));
    out.back().visible = piece.body->awake;
  }
  pose_prints(out);
}

/// The marks from where the web comes into sight to its end: before the photocell, where none is decided yet,
/// at the true pitch.
void Web::pose_prints(std::vector<PartPose>& out) const {
  const std::size_t count = prints_of(data_.marks);
  const double above = look_of(data_);
  const double lead = std::max(0.0, material_.position - lead_end_);
  std::vector<double> places(marks_.places().begin(), marks_.places().end());
  const double pitch = data_.marks.pitch * (1 + data_.marks.stretch);
  while (count > 0 && !places.empty() && material_.position - places.back() > -upstream)
    places.push_back(places.back() + pitch);
  std::size_t shown = 0;
  for (const double place : places) {
    const double x = material_.position - place;
    if (shown == count || x < -upstream || x > lead) continue;
    out.push_back({.pose = turned(x, above, 0.33 * data_.width, 0)});
    ++shown;
  }
  for (; shown < count; ++shown) out.push_back({.pose = {}, .visible = false});
}

void Web::callouts(std::vector<Callout>& out) {
  const double height = look_of(data_) / 2;
  const double side = data_.width / 2;
  for (const Outfeed::Piece& piece : outfeed_.pieces()) {
    if (!piece.body->awake) continue;
    const double middle = piece.body->position;
    out.push_back({Callout::Kind::length,
                   fmt::format("{:.1f} mm", piece.length * 1e3),
                   {middle - piece.length / 2, height, side},
                   {middle + piece.length / 2, height, side}});
  }
}

}  // namespace drycut::plants
