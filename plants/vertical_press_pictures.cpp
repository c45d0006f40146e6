#include <algorithm>
#include <cmath>

#include "plants/colours.hpp"
#include "plants/pose_math.hpp"
#include "plants/vertical_press.hpp"

namespace drycut::plants {

// How the press looks: bed with table, two uprights, crown, the ram on two guide columns between them. The
// nut turns in the crown, driven by a belt from the motor beside it; the screw goes up and down with the ram.

namespace {

using Shape = Part::Shape;
using Colour = std::array<float, 3>;

constexpr double floor_y = -0.9;
constexpr double bed_height = 0.22;
constexpr double foot_height = -floor_y - 0.05 - bed_height;
constexpr double tool_height = 0.12;  // from the tool's face to the ram [m]
constexpr double ram_height = 0.18;
constexpr double ram_top = tool_height + ram_height;  // over the tool's face
constexpr double clearance = 0.06;                    // under the crown
constexpr double crown_height = 0.16;
constexpr double upright_x = 0.47;
constexpr double column_x = 0.33;
constexpr double motor_x = 0.30;
constexpr double nut_radius = 0.09;
constexpr double weight_plate = 1e-3;  // height of a stack of plates per kilogram [m/kg]

// A cylinder stands along z; this stands it up.
const Quaternion upright = about_x(-std::numbers::pi / 2);
const Quaternion downward = about_x(std::numbers::pi / 2);
const Quaternion level = {0, 0, 0, 1};

Part rod(const char* name, double diameter, double length, Colour colour, const char* material,
         const char* model = "") {
  return {name, Shape::cylinder, {diameter, diameter, length}, colour, material, model};
}
Part box(const char* name, double x, double y, double z, Colour colour, const char* material = "paint",
         const char* model = "") {
  return {name, Shape::box, {x, y, z}, colour, material, model};
}

/// Lower side of the crown, over the table [m].
double crown_of(const VerticalPressData& data) { return data.travel_max + ram_top + clearance; }

}  // namespace

/// A part and where its middle is [m]: from the middle of the table's top, or from the tool's face if it goes
/// with the ram.
struct VerticalPress::Item {
  Part part;
  double x = 0;
  double y = 0;
  double z = 0;
  bool moves = false;
  Quaternion turned = level;
  double scale_y = 1;
  bool visible = true;
};

std::vector<VerticalPress::Item> VerticalPress::items() const {
  std::vector<Item> all;
  add_frame(all);
  add_drive(all);
  add_counterbalance(all);
  add_stops_and_switches(all);
  add_load(all);
  return all;
}

void VerticalPress::add_frame(std::vector<Item>& all) const {
  const double crown = crown_of(data_);
  all = {
      {box("bed", 1.04, bed_height, 0.56, colours::bed, "paint", "press_bed"), 0, -0.05 - bed_height / 2, 0},
      {box("foot 1", 0.22, foot_height, 0.56, colours::bed, "paint", "leg"), -0.41, floor_y + foot_height / 2,
       0},
      {box("foot 2", 0.22, foot_height, 0.56, colours::bed, "paint", "leg"), 0.41, floor_y + foot_height / 2,
       0},
      {box("table", 0.84, 0.05, 0.52, colours::steel, "steel", "press_table"), 0, -0.025, 0},
      {box("upright 1", 0.1, crown, 0.3, colours::bed, "paint", "press_upright"), -upright_x, crown / 2,
       -0.1},
      {box("upright 2", 0.1, crown, 0.3, colours::bed, "paint", "press_upright"), upright_x, crown / 2, -0.1},
      {box("crown", 1.04, crown_height, 0.44, colours::bed, "paint", "press_crown"), 0,
       crown + crown_height / 2, -0.03},
      {rod("column 1", 0.06, crown, colours::steel, "steel"), -column_x, crown / 2, 0.04, false, upright},
      {rod("column 2", 0.06, crown, colours::steel, "steel"), column_x, crown / 2, 0.04, false, upright},
      {box("ram", 0.8, ram_height, 0.3, colours::moving, "paint", "press_ram"), 0,
       tool_height + ram_height / 2, 0.02, true},
      {rod("bush 1", 0.11, ram_height + 0.06, colours::brass, "steel", "bush"), -column_x,
       tool_height + ram_height / 2, 0.04, true, upright},
      {rod("bush 2", 0.11, ram_height + 0.06, colours::brass, "steel", "bush"), column_x,
       tool_height + ram_height / 2, 0.04, true, upright},
      {box("tool", 0.22, tool_height, 0.22, colours::dark, "steel", "tool"), 0, tool_height / 2, 0.04, true},
  };
}

void VerticalPress::add_drive(std::vector<Item>& all) const {
  const double top = crown_of(data_) + crown_height;
  // The screw reaches the nut at the lowest position.
  const double screw = top + 0.12 - (data_.travel_min + ram_top);
  const double angle = 2 * std::numbers::pi * rotor_.part;
  const double nut_angle = 2 * std::numbers::pi * std::fmod(rotor_.revolutions() / data_.gear.ratio, 1.0);
  const std::vector<Item> driven = {
      {rod("screw", 0.05, screw, colours::steel, "steel", "screw"), 0, ram_top + screw / 2, 0.02, true,
       upright},
      {rod("nut", 2 * nut_radius, 0.07, colours::brass, "steel", "pulley"), 0, top + 0.035, 0.02, false,
       product(about_y(nut_angle), upright)},
      {box("nut mark", 0.06, 0.074, 0.012, colours::red), 0.06 * std::cos(nut_angle), top + 0.037,
       0.02 - 0.06 * std::sin(nut_angle), false, about_y(nut_angle)},
      {box("belt", motor_x + nut_radius + 0.065, 0.03, 2 * nut_radius + 0.01, colours::dark, "rubber",
           "drive_belt"),
       (motor_x + 0.055 - nut_radius) / 2, top + 0.035, 0.02},
      {rod("pulley", 0.11, 0.05, colours::steel, "steel", "pulley"), motor_x, top + 0.035, 0.02, false,
       product(about_y(angle), upright)},
      {rod("motor", 0.18, 0.26, colours::dark, "paint", "induction_motor"), motor_x, top + 0.2, 0.02, false,
       downward},
      {rod("fan", 0.19, 0.05, colours::grey, "paint"), motor_x, top + 0.355, 0.02, false, upright},
      {rod("brake", 0.15, 0.06, colours::red, "paint"), motor_x, top + 0.41, 0.02, false, upright},
      {rod("encoder", 0.08, 0.05, colours::steel, "steel", "encoder"), motor_x, top + 0.465, 0.02, false,
       downward},
      {box("encoder mark", 0.03, 0.006, 0.008, colours::red), motor_x + 0.018 * std::cos(angle), top + 0.493,
       0.02 - 0.018 * std::sin(angle), false, about_y(angle)},
  };
  all.insert(all.end(), driven.begin(), driven.end());

  // A lamp on the crown: red while the brake holds, else green.
  const bool released = drive_.brake().released();
  for (const bool lamp : {false, true})
    all.push_back(
        {box(lamp ? "lamp released" : "lamp brake", 0.06, 0.06, 0.02, lamp ? colours::green : colours::red),
         -0.42, top - crown_height / 2, 0.2, false, level, 1, lamp == released});
}

/// Its rods push the ram from below; their cylinders hang in the bed.
void VerticalPress::add_counterbalance(std::vector<Item>& all) const {
  if (data_.counterbalance <= 0) return;
  const double reach = std::min(data_.travel_max + tool_height + 0.06, -floor_y + tool_height);
  for (const double side : {-1.0, 1.0}) {
    all.push_back({rod(side < 0 ? "rod 1" : "rod 2", 0.04, reach, colours::steel, "steel"), side * 0.22,
                   tool_height - reach / 2, -0.09, true, upright});
    const double body = reach - tool_height + 0.04;
    all.push_back({rod(side < 0 ? "cylinder 1" : "cylinder 2", 0.1, body, colours::grey, "steel"),
                   side * 0.22, -0.05 - body / 2, -0.09, false, upright});
    all.push_back({rod(side < 0 ? "gland 1" : "gland 2", 0.09, 0.05, colours::grey, "steel"), side * 0.22,
                   0.025, -0.09, false, upright});
  }
}

void VerticalPress::add_stops_and_switches(std::vector<Item>& all) const {
  const double crown = crown_of(data_);
  for (const double side : {-1.0, 1.0}) {
    const double low = data_.travel_min + tool_height;
    all.push_back({rod(side < 0 ? "stop 1" : "stop 2", 0.06, low, colours::red, "rubber", "bumper"),
                   side * 0.2, low / 2, 0.13, false, upright});
    all.push_back({rod(side < 0 ? "stop 3" : "stop 4", 0.06, clearance, colours::red, "rubber", "bumper"),
                   side * 0.2, crown - clearance / 2, 0.13, false, downward});
  }
  const double switch_x = upright_x - 0.07;
  const double flag_y = tool_height + ram_height / 2;
  const auto sensor = [&](const char* name, double height) {
    all.push_back({box(name, 0.045, 0.03, 0.03, colours::white), switch_x, flag_y + height, 0.075});
  };
  sensor("home switch", data_.sensors.home.centre);
  sensor("limit switch 1", data_.sensors.limit_min);
  sensor("limit switch 2", data_.sensors.limit_max);
  all.push_back(
      {box("flag", 0.012, data_.sensors.home.width, 0.05, colours::white), 0.4, flag_y, 0.12, true});
  all.push_back({box("scale", 0.02, crown - 0.1, 0.02, colours::white), -upright_x + 0.06, crown / 2, 0.06});
}

void VerticalPress::add_load(std::vector<Item>& all) const {
  const double load = ram_.mass - data_.mass;
  const double stack = std::max(load, 1e-6) * weight_plate;
  for (const double side : {-1.0, 1.0})
    all.push_back({box(side < 0 ? "load 1" : "load 2", 0.2, 1, 0.2, colours::grey, "steel", "weight"),
                   side * 0.19, ram_top + stack / 4, 0.06, true, level, stack / 2, load > 0});
  if (data_.workpiece.stiffness > 0) {
    const double height = std::min(data_.workpiece_height, ram_.position);
    all.push_back({box("workpiece", 0.3, 1, 0.26, colours::brass, "steel", "workpiece"), 0, height / 2, 0.04,
                   false, level, std::max(height, 1e-3)});
  }
}

std::vector<Part> VerticalPress::parts() {
  std::vector<Part> list;
  for (Item& item : items()) list.push_back(std::move(item.part));
  return list;
}

void VerticalPress::poses(std::vector<PartPose>& out) {
  out.clear();
  for (const Item& item : items()) {
    const double y = data_.place_y + item.y + (item.moves ? ram_.position : 0);
    out.push_back({.pose = {{data_.place_x + item.x, y, data_.place_z + item.z}, item.turned},
                   .visible = item.visible,
                   .scale = {1, item.scale_y, 1}});
  }
}

}  // namespace drycut::plants
