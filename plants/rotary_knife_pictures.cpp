#include <fmt/format.h>

#include "plants/colours.hpp"
#include "plants/pose_math.hpp"
#include "plants/rotary_knife.hpp"

namespace drycut::plants {

// How the knife looks: drum over the web between two frames that hang its bearings from above, so that the
// cut stays in sight; anvil roll under it; gearbox, motor and encoder behind.

namespace {

constexpr double blade_height = 0.03;  // stands out of the drum [m]
constexpr double anvil_diameter = 0.16;
constexpr double base_top = -0.15;
constexpr double base_height = 0.75;
constexpr double bearing_width = 0.11;
constexpr double bearing_height = 0.09;
constexpr double frame_depth = 0.05;
constexpr double gap = 0.025;  // between the drum's end and a frame

constexpr std::array<float, 3> drum_colour = {0.55F, 0.58F, 0.62F};
constexpr std::array<float, 3> bearing_colour = {0.28F, 0.43F, 0.52F};
constexpr std::array<float, 3> shaft_colour = {0.70F, 0.72F, 0.74F};

using Shape = Part::Shape;

}  // namespace

/// A part and where its middle is.
struct RotaryKnife::Item {
  Part part;
  Pose pose;
};

/// The frame at `side` 1 towards the operator or -1 behind: the bearing hangs under a beam between two posts,
/// towards the operator on one post only, behind the cut.
void RotaryKnife::add_frame(std::vector<Item>& all, int side) const {
  const double z = side * (data_.blade_width / 2 + gap + frame_depth / 2);
  const double low = radius_ + bearing_height / 2;  // lower side of the beam
  const double top = low + 0.06;
  const double apart = radius_ + 0.09;
  const double left = side > 0 ? -bearing_width / 2 : -apart;
  const int number = side > 0 ? 1 : 2;
  const auto add = [&](std::string name, double width, double height, const char* model, double x, double y,
                       double turn = 0) {
    const auto& colour = turn == 0 ? colours::bed : bearing_colour;
    all.push_back({{std::move(name), Shape::box, {width, height, frame_depth}, colour, "paint", model},
                   turned(x, y, z, turn)});
  };
  const double height = top - base_top;
  add(fmt::format("frame post {}", number), 0.06, height, "frame_post", apart, base_top + height / 2);
  if (side < 0) add("frame post 3", 0.06, height, "frame_post", -apart, base_top + height / 2);
  add(fmt::format("frame beam {}", number), apart - left, top - low, "frame_beam", (apart + left) / 2,
      (top + low) / 2);
  add(fmt::format("bearing {}", number), bearing_width, bearing_height, "bearing_block", 0, radius_,
      std::numbers::pi);
  const double anvil_bearing = 2 * (-base_top - anvil_diameter / 2);
  all.push_back({{fmt::format("anvil bearing {}", number),
                  Shape::box,
                  {0.15, anvil_bearing, 0.04},
                  bearing_colour,
                  "paint",
                  "bearing_block"},
                 turned(0, -anvil_diameter / 2, side * (data_.blade_width / 2 + 0.022), 0)});
}

void RotaryKnife::add_drive(std::vector<Item>& all) const {
  const double behind = -data_.blade_width / 2;
  const double turn = 2 * std::numbers::pi * rotor_.part;
  const auto add = [&](Part part, double y, double z, double angle = 0) {
    all.push_back({std::move(part), turned(0, y, behind - z, angle)});
  };
  const double plate = radius_ + 0.07 - base_top;
  add({"back plate", Shape::box, {0.26, plate, 0.03}, colours::bed, "paint", "back_plate"},
      base_top + plate / 2, 0.095);
  add({"gearbox", Shape::cylinder, {0.13, 0.13, 0.12}, shaft_colour, "steel", "gearbox"}, radius_, 0.17);
  add({"motor", Shape::box, {0.14, 0.14, 0.20}, colours::dark, "paint", "servo_motor"}, radius_, 0.33);
  add({"encoder disc", Shape::cylinder, {0.11, 0.11, 0.008}, colours::brass, "steel", "encoder_disc"},
      radius_, 0.44, turn);
  add({"encoder", Shape::cylinder, {0.09, 0.09, 0.05}, colours::dark, "paint", "encoder"}, radius_, 0.475);
}

std::vector<RotaryKnife::Item> RotaryKnife::items() const {
  const double w = data_.blade_width;
  const double end = w / 2;
  const double body = 2 * (radius_ - blade_height * 0.8);
  const double axis = radius_;  // height of the drum's axis over the anvil
  const double angle = 2 * std::numbers::pi * drum_.part;
  const double mark = radius_ * 0.5;
  const Pose on_axis = turned(0, axis, 0, angle);
  std::vector<Item> all = {
      {{"drum", Shape::cylinder, {body, body, w}, drum_colour, "steel", "drum"}, on_axis},
      {{"drum shaft", Shape::cylinder, {0.05, 0.05, w + 0.2}, shaft_colour, "steel", "drum_shaft"}, on_axis},
      {{"drum mark", Shape::box, {0.012, radius_ * 0.32, 0.004}, colours::white, "paint"},
       turned(mark * std::sin(angle), axis - mark * std::cos(angle), end - 0.001, angle)},
      {{"anvil roll",
        Shape::cylinder,
        {anvil_diameter, anvil_diameter, w + 0.08},
        shaft_colour,
        "steel",
        "anvil_roll"},
       turned(0, -anvil_diameter / 2, 0, -angle)},
      {{"base",
        Shape::box,
        {2 * radius_ + 0.26, base_height, w + 2 * (gap + frame_depth)},
        colours::bed,
        "paint",
        "machine_base"},
       turned(0, base_top - base_height / 2, 0, 0)},
  };
  add_frame(all, 1);
  add_frame(all, -1);
  add_drive(all);
  const double switch_x = -0.06 - radius_ * 0.8;
  const double switch_y = axis + radius_ * 0.7;
  all.push_back({{"home switch", Shape::box, {0.05, 0.018, 0.018}, colours::white, "paint"},
                 turned(switch_x, switch_y, end - 0.02, 0)});
  all.push_back({{"home switch arm", Shape::box, {0.016, 0.016, 0.1}, shaft_colour, "steel"},
                 turned(switch_x - 0.02, switch_y + 0.016, end + 0.02, 0)});
  for (int i = 0; i < data_.blade_count; ++i) {
    const double theta = angle - 2 * std::numbers::pi * i / data_.blade_count;
    const double middle = radius_ - blade_height / 2;
    all.push_back({{fmt::format("blade {}", i + 1),
                    Shape::wedge,
                    {0.022, blade_height, w},
                    colours::red,
                    "blade",
                    "knife_blade",
                    std::array{0.0, -blade_height / 2, end}},
                   turned(middle * std::sin(theta), axis - middle * std::cos(theta), 0, theta)});
  }
  return all;
}

std::vector<Part> RotaryKnife::parts() {
  std::vector<Part> list;
  for (Item& item : items()) list.push_back(std::move(item.part));
  return list;
}

void RotaryKnife::poses(std::vector<PartPose>& out) {
  out.clear();
  for (const Item& item : items()) out.push_back({.pose = item.pose});
}

void RotaryKnife::callouts(std::vector<Callout>& out) {
  const double force = cutter_.force();
  if (force > 0) out.push_back({Callout::Kind::force, "cut", {0, 0, data_.blade_width / 2}, {0, force, 0}});
}

}  // namespace drycut::plants
