#include <fmt/format.h>

#include "base/units.hpp"
#include "plants/assembly.hpp"
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

constexpr looks::Look drum_look = {{0.55F, 0.58F, 0.62F}, "steel"};
constexpr looks::Look bearing_look = {{0.28F, 0.43F, 0.52F}};
constexpr looks::Look shaft_look = {{0.70F, 0.72F, 0.74F}, "steel"};

}  // namespace

struct RotaryKnife::Picture : Assembly {
  explicit Picture(const RotaryKnife& knife) : knife_(knife) {
    add_drum();
    add_frame(1);
    add_frame(-1);
    add_drive();
    on_floor();
    const double switch_x = -0.06 - axis * 0.8;
    const double switch_y = axis + axis * 0.7;
    box("home switch", {0.05, 0.018, 0.018}, looks::white, at(switch_x, switch_y, width / 2 - 0.02));
    box("home switch arm", {0.016, 0.016, 0.1}, shaft_look,
        at(switch_x - 0.02, switch_y + 0.016, width / 2 + 0.02));
    add_blades();
  }

  void add_drum();
  void add_frame(int side);
  void add_drive();
  void add_blades();
  [[nodiscard]] Frame turning(const Shaft& shaft, const Pose& about, double direction = 1) const {
    return [&shaft, about, direction] { return about * about_z(direction * units::turn * shaft.part); };
  }

  const RotaryKnife& knife_;
  double axis = knife_.radius_;  // height of the drum's axis over the anvil
  double width = knife_.data_.blade_width;
  Frame drum_ = turning(knife_.drum_, at(0, axis, 0));
};

void RotaryKnife::Picture::add_drum() {
  on(drum_);
  rod("drum", 2 * (axis - blade_height * 0.8), width, drum_look, {}, "drum");
  rod("drum shaft", 0.05, width + 0.2, shaft_look, {}, "drum_shaft");
  box("drum mark", {0.012, axis * 0.32, 0.004}, looks::white, at(0, -axis * 0.5, width / 2 - 0.001));
  on(turning(knife_.drum_, at(0, -anvil_diameter / 2, 0), -1));
  rod("anvil roll", anvil_diameter, width + 0.08, shaft_look, {}, "anvil_roll");
  on_floor();
  box("base", {2 * axis + 0.26, base_height, width + 2 * (gap + frame_depth)}, looks::bed,
      at(0, base_top - base_height / 2, 0), "machine_base");
}

/// The frame at `side` 1 towards the operator or -1 behind: the bearing hangs under a beam between two posts,
/// towards the operator on one post only, behind the cut.
void RotaryKnife::Picture::add_frame(int side) {
  const Pose plane = at(0, 0, side * (width / 2 + gap + frame_depth / 2));
  const double low = axis + bearing_height / 2;  // lower side of the beam
  const double top = low + 0.06;
  const double apart = axis + 0.09;
  const double left = side > 0 ? -bearing_width / 2 : -apart;
  const int number = side > 0 ? 1 : 2;
  const auto post = [&](int which, double x) {
    box(fmt::format("frame post {}", which), {0.06, top - base_top, frame_depth}, looks::bed,
        plane * at(x, (top + base_top) / 2, 0), "frame_post");
  };
  post(number, apart);
  if (side < 0) post(3, -apart);
  box(fmt::format("frame beam {}", number), {apart - left, top - low, frame_depth}, looks::bed,
      plane * at((apart + left) / 2, (top + low) / 2, 0), "frame_beam");
  box(fmt::format("bearing {}", number), {bearing_width, bearing_height, frame_depth}, bearing_look,
      plane * at(0, axis, 0) * about_z(std::numbers::pi), "bearing_block");
  const double anvil_bearing = 2 * (-base_top - anvil_diameter / 2);
  box(fmt::format("anvil bearing {}", number), {0.15, anvil_bearing, 0.04}, bearing_look,
      at(0, -anvil_diameter / 2, side * (width / 2 + 0.022)), "bearing_block");
}

void RotaryKnife::Picture::add_drive() {
  const auto behind = [&](double z) { return at(0, axis, -width / 2 - z); };
  const double plate = axis + 0.07 - base_top;
  box("back plate", {0.26, plate, 0.03}, looks::bed, at(0, base_top + plate / 2, -width / 2 - 0.095),
      "back_plate");
  rod("gearbox", 0.13, 0.12, shaft_look, behind(0.17), "gearbox");
  box("motor", {0.14, 0.14, 0.20}, looks::dark, behind(0.33), "servo_motor");
  on(turning(knife_.rotor_, behind(0.44)));
  rod("encoder disc", 0.11, 0.008, looks::brass, {}, "encoder_disc");
  on_floor();
  rod("encoder", 0.09, 0.05, looks::dark, behind(0.475), "encoder");
}

void RotaryKnife::Picture::add_blades() {
  on(drum_);
  const int count = knife_.data_.blade_count;
  for (int i = 0; i < count; ++i)
    wedge(fmt::format("blade {}", i + 1), {0.022, blade_height, width}, looks::red.on("blade"),
          about_z(-units::turn * i / count) * at(0, blade_height / 2 - axis, 0),
          {0, -blade_height / 2, width / 2}, "knife_blade");
}

std::vector<Part> RotaryKnife::parts() { return Picture(*this).take(); }

void RotaryKnife::callouts(std::vector<Callout>& out) {
  const double force = cutter_.force();
  if (force > 0) out.push_back({Callout::Kind::force, "cut", {0, 0, data_.blade_width / 2}, {0, force, 0}});
}

}  // namespace drycut::plants
