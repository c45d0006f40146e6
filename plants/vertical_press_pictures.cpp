#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "plants/assembly.hpp"
#include "plants/vertical_press.hpp"

namespace drycut::plants {

// How the press looks: bed with table, two uprights, crown, the ram on two guide columns between them. The
// nut turns in the crown, driven by a belt from the motor beside it; the screw goes up and down with the ram.

namespace {

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

}  // namespace

/// Its frames are at the middle of the table's top and at the tool's face.
struct VerticalPress::Picture : Assembly {
  explicit Picture(const VerticalPress& press) : press_(press), data_(press.data_) {
    add_frame();
    add_drive();
    if (data_.counterbalance > 0) add_counterbalance();
    add_stops_and_switches();
    add_load();
  }

  void add_frame();
  void add_drive();
  void add_counterbalance();
  void add_stops_and_switches();
  void add_load();
  /// A part that stands on both sides of the middle.
  void pair(const char* name, double x, double diameter, double length, const looks::Look& look,
            const Pose& offset, const char* model = "") {
    for (const double side : {-1.0, 1.0})
      rod(numbered(name, side), diameter, length, look, at(side * x, 0, 0) * offset, model);
  }

  const VerticalPress& press_;
  const VerticalPressData& data_;
  double crown = data_.travel_max + ram_top + clearance;  // its lower side over the table
  Pose table = at(data_.place_x, data_.place_y, data_.place_z);
  Frame table_ = [table = table] { return table; };
  Frame ram_ = [table = table, &ram = press_.ram()] { return table * at(0, ram.position, 0); };
};

void VerticalPress::Picture::add_frame() {
  on(table_);
  box("bed", {1.04, bed_height, 0.56}, looks::bed, at(0, -0.05 - bed_height / 2, 0), "press_bed");
  for (const double side : {-1.0, 1.0})
    box(numbered("foot", side), {0.22, foot_height, 0.56}, looks::bed,
        at(side * 0.41, floor_y + foot_height / 2, 0), "leg");
  box("table", {0.84, 0.05, 0.52}, looks::steel, at(0, -0.025, 0), "press_table");
  for (const double side : {-1.0, 1.0})
    box(numbered("upright", side), {0.1, crown, 0.3}, looks::bed, at(side * upright_x, crown / 2, -0.1),
        "press_upright");
  box("crown", {1.04, crown_height, 0.44}, looks::bed, at(0, crown + crown_height / 2, -0.03), "press_crown");
  pair("column", column_x, 0.06, crown, looks::steel, at(0, crown / 2, 0.04) * upright);
  on(ram_);
  const double ram_middle = tool_height + ram_height / 2;
  box("ram", {0.8, ram_height, 0.3}, looks::moving, at(0, ram_middle, 0.02), "press_ram");
  pair("bush", column_x, 0.11, ram_height + 0.06, looks::brass, at(0, ram_middle, 0.04) * upright, "bush");
  box("tool", {0.22, tool_height, 0.22}, looks::dark.on("steel"), at(0, tool_height / 2, 0.04), "tool");
}

void VerticalPress::Picture::add_drive() {
  const double top = crown + crown_height;
  // The screw reaches the nut at the lowest position.
  const double screw = top + 0.12 - (data_.travel_min + ram_top);
  rod("screw", 0.05, screw, looks::steel, at(0, ram_top + screw / 2, 0.02) * upright, "screw");
  on([table = table * at(0, top + 0.035, 0.02), &drive = press_.screw_] {
    return table * about_y(drive.screw_turn());
  });
  rod("nut", 2 * nut_radius, 0.07, looks::brass, upright, "pulley");
  box("nut mark", {0.06, 0.074, 0.012}, looks::red, at(0.06, 0.002, 0));
  on(table_);
  box("belt", {motor_x + nut_radius + 0.065, 0.03, 2 * nut_radius + 0.01}, looks::dark.on("rubber"),
      at((motor_x + 0.055 - nut_radius) / 2, top + 0.035, 0.02), "drive_belt");
  const Frame shaft = [table = table * at(motor_x, top, 0.02), &rotor = press_.rotor()] {
    return table * about_y(units::turn * rotor.part);
  };
  on(shaft);
  rod("pulley", 0.11, 0.05, looks::steel, at(0, 0.035, 0) * upright, "pulley");
  const auto on_motor = [&](double y) { return at(motor_x, top + y, 0.02); };
  on(table_);
  rod("motor", 0.18, 0.26, looks::dark, on_motor(0.2) * downward, "induction_motor");
  rod("fan", 0.19, 0.05, looks::grey.on("paint"), on_motor(0.355) * upright);
  rod("brake", 0.15, 0.06, looks::red, on_motor(0.41) * upright);
  rod("encoder", 0.08, 0.05, looks::steel, on_motor(0.465) * downward, "encoder");
  on(shaft);
  box("encoder mark", {0.03, 0.006, 0.008}, looks::red, at(0.018, 0.493, 0));

  // A lamp on the crown: red while the brake holds, else green. Low, so that a close-up of the ram has it
  // too.
  on(table_);
  rod("lamp cap", 0.13, 0.02, looks::dark, at(-0.36, top + 0.11, 0.1) * upright);
  for (const bool lamp : {false, true}) {
    on([table = table, lamp, &drive = press_.drive_] {
      return PartPose(table, lamp == drive.brake().released());
    });
    rod(lamp ? "lamp released" : "lamp brake", 0.12, 0.1, lamp ? looks::green : looks::red,
        at(-0.36, top + 0.05, 0.1) * upright);
  }
}

/// Its rods push the ram from below; their cylinders hang in the bed.
void VerticalPress::Picture::add_counterbalance() {
  const double reach = std::min(data_.travel_max + tool_height + 0.06, -floor_y + tool_height);
  const double body = reach - tool_height + 0.04;
  for (const double side : {-1.0, 1.0}) {
    const double x = side * 0.22;
    on(ram_);
    rod(numbered("rod", side), 0.04, reach, looks::steel, at(x, tool_height - reach / 2, -0.09) * upright);
    on(table_);
    rod(numbered("cylinder", side), 0.1, body, looks::grey, at(x, -0.05 - body / 2, -0.09) * upright);
    rod(numbered("gland", side), 0.09, 0.05, looks::grey, at(x, 0.025, -0.09) * upright);
  }
}

void VerticalPress::Picture::add_stops_and_switches() {
  const looks::Look rubber = looks::red.on("rubber");
  const double low = data_.travel_min + tool_height;
  on(table_);
  for (const double side : {-1.0, 1.0}) {
    const double x = side * 0.2;
    rod(side < 0 ? "stop 1" : "stop 2", 0.06, low, rubber, at(x, low / 2, 0.13) * upright, "bumper");
    rod(side < 0 ? "stop 3" : "stop 4", 0.06, clearance, rubber,
        at(x, crown - clearance / 2, 0.13) * downward, "bumper");
  }
  const double flag_y = tool_height + ram_height / 2;
  const auto sensor = [&](const char* name, double height) {
    box(name, {0.045, 0.03, 0.03}, looks::white, at(upright_x - 0.07, flag_y + height, 0.075));
  };
  sensor("home switch", data_.sensors.home.centre);
  sensor("limit switch 1", data_.sensors.limit_min);
  sensor("limit switch 2", data_.sensors.limit_max);
  on(ram_);
  box("flag", {0.012, data_.sensors.home.width, 0.05}, looks::white, at(0.4, flag_y, 0.12));
  on(table_);
  box("scale", {0.02, crown - 0.1, 0.02}, looks::white, at(-upright_x + 0.06, crown / 2, 0.06));
}

void VerticalPress::Picture::add_load() {
  on([ram = ram_, &press = press_] {
    const double load = press.screw_.mass() - press.data_.mass;
    const double stack = std::max(load, 1e-6) * weight_plate;
    return PartPose(ram().pose * at(0, ram_top + stack / 4, 0), load > 0, {1, stack / 2, 1});
  });
  for (const double side : {-1.0, 1.0})
    box(numbered("load", side), {0.2, 1, 0.2}, looks::grey, at(side * 0.19, 0, 0.06), "weight");
  if (data_.workpiece.stiffness <= 0) return;
  on([table = table, &press = press_] {
    const double height = std::min(press.data_.workpiece_height, press.ram().position);
    return PartPose(table * at(0, height / 2, 0), true, {1, std::max(height, 1e-3), 1});
  });
  box("workpiece", {0.3, 1, 0.26}, looks::brass, at(0, 0, 0.04), "workpiece");
}

std::vector<Part> VerticalPress::parts() { return Picture(*this).take(); }

std::optional<QuotaLine> VerticalPress::quota_line(double quota) const {
  constexpr double before_tool = 0.17;
  const auto end = [&](double side) {
    return std::array{data_.place_x + side * upright_x, data_.place_y + quota, data_.place_z + before_tool};
  };
  return QuotaLine{end(-1), end(1), screw_.slide.position - quota};
}

}  // namespace drycut::plants
