#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "plants/assembly.hpp"
#include "plants/rotary_knife.hpp"

namespace drycut::plants {

// How the knife looks: drum over the web between two frames that hang its bearings from above, so that the
// cut stays in sight; anvil roll or counter drum under it; gearboxes, motors and encoder behind. With helical
// blades all of it stands at their angle to the line, and a blade is a row of straight pieces.

namespace {

constexpr double blade_height = 0.03;  // stands out of the drum [m]
constexpr double anvil_diameter = 0.16;
constexpr double base_of_anvil = -0.15;  // top of the base
constexpr double piece_of_blade = 0.05;  // at most so much of the drum's turn [rad]
constexpr double bearing_width = 0.11;
constexpr double bearing_height = 0.09;
constexpr double frame_depth = 0.05;
constexpr double beam_height = 0.06;
constexpr double gap = 0.025;  // between the drum's end and a frame

constexpr looks::Look drum_look = {{0.55F, 0.58F, 0.62F}, "steel"};
constexpr looks::Look shaft_look = {{0.70F, 0.72F, 0.74F}, "steel"};

}  // namespace

struct RotaryKnife::Picture : Assembly {
  explicit Picture(const RotaryKnife& knife) : knife_(knife) {
    add_drum();
    add_frame(1);
    add_frame(-1);
    add_drive();
    on_floor();
    add_home_switch();
    on(drum_);
    add_blades("blade", 1);
    if (knife_.data_.counter.cuts()) {
      on(counter_);
      add_blades("counter blade", -1);
    }
  }

  void add_drum();
  void add_frame(int side);
  void add_home_switch();
  void add_counter_drum();
  void add_drive();
  void add_motor(const std::string& ending, double height, int side, const Frame& rotor);
  void add_blades(const std::string& name, int side);
  [[nodiscard]] Pose behind(double height, double z, int side = 1) const {
    return at(0, height, -side * (width / 2 + z));
  }
  [[nodiscard]] Frame turning(const Shaft& shaft, const Pose& about, double direction = 1) const {
    return [&shaft, place = mounting * about, direction] {
      return place * about_z(direction * units::turn * shaft.part);
    };
  }

  const RotaryKnife& knife_;
  double axis = knife_.radius_;  // height of the drum's axis over the anvil
  double width = knife_.data_.blade_width;
  bool geared = knife_.data_.counter.turns();
  double counter_axis = geared ? axis / knife_.data_.counter.ratio : anvil_diameter / 2;  // below the web
  double base_top = geared ? -2 * counter_axis - 0.02 : base_of_anvil;
  Pose mounting = about_y(knife_.data_.helix);
  Frame drum_ = turning(knife_.drum_, at(0, axis, 0));
  Frame counter_ = [&drum = knife_.drum_, ratio = knife_.data_.counter.ratio,
                    place = mounting * at(0, -counter_axis, 0)] {
    return place * about_z(-units::turn * std::fmod(drum.revolutions() * ratio, 1));
  };
};

void RotaryKnife::Picture::add_drum() {
  on(drum_);
  Part& drum = rod("drum", 2 * (axis - blade_height * 0.8), width, drum_look, {}, "drum");
  drum.ends_kept = true;
  drum.pitch = units::turn / knife_.data_.blade_count;
  rod("drum shaft", 0.05, width + 0.2, shaft_look, {}, "drum_shaft").ends_kept = true;
  box("drum mark", {0.012, axis * 0.32, 0.004}, looks::white, at(0, -axis * 0.5, width / 2 - 0.001));
  if (geared) {
    add_counter_drum();
  } else {
    on(turning(knife_.drum_, at(0, -counter_axis, 0), -1));
    rod("anvil roll", anvil_diameter, width + 0.08, shaft_look, {}, "anvil_roll").ends_kept = true;
  }
  on_floor();
  const double base_height = std::max(base_top - floor_y, 0.05);
  box("base", {2 * axis + 0.26, base_height, width + 2 * (gap + frame_depth)}, looks::bed,
      at(0, base_top - base_height / 2, 0), "machine_base")
      .ends_kept = true;
}

void RotaryKnife::Picture::add_counter_drum() {
  const double wheel_z = -(width + gap) / 2;
  const auto wheel = [&](const char* name, double diameter) {
    rod(name, diameter, gap * 0.8, looks::brass, at(0, 0, wheel_z));
  };
  wheel("gear wheel", 2 * axis);
  on(counter_);
  wheel("counter gear wheel", 2 * counter_axis);
  const double under_blades = knife_.data_.counter.cuts() ? blade_height * 0.8 : 0;
  Part& drum = rod("counter drum", 2 * (counter_axis - under_blades), width, drum_look, {}, "drum");
  drum.ends_kept = true;
  drum.pitch = units::turn / knife_.data_.blade_count;
  rod("counter shaft", 0.05, width + 0.2, shaft_look, {}, "drum_shaft").ends_kept = true;
  box("counter drum mark", {0.012, counter_axis * 0.32, 0.004}, looks::white,
      at(0, counter_axis * 0.5, width / 2 - 0.001));
}

/// The frame at `side` 1 towards the operator or -1 behind: the bearing hangs under a beam between two posts,
/// towards the operator on one post only, behind the cut.
void RotaryKnife::Picture::add_frame(int side) {
  const Pose plane = at(0, 0, side * (width / 2 + gap + frame_depth / 2));
  const double low = axis + bearing_height / 2;  // lower side of the beam
  const double top = low + beam_height;
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
  box(fmt::format("bearing {}", number), {bearing_width, bearing_height, frame_depth}, looks::bearing,
      plane * at(0, axis, 0) * about_z(std::numbers::pi), "bearing_block");
  const double anvil_bearing = 2 * (-base_top - counter_axis);
  box(fmt::format("anvil bearing {}", number), {0.15, anvil_bearing, 0.04}, looks::bearing,
      at(0, -counter_axis, side * (width / 2 + 0.022)), "bearing_block");
}

/// Before the drum at the beam's height, on an arm that the beam carries.
void RotaryKnife::Picture::add_home_switch() {
  const double y = axis + (bearing_height + beam_height) / 2;
  const double x = -std::sqrt(std::pow(axis + 0.056, 2) - std::pow(y - axis, 2));
  const double beam_z = width / 2 + gap + frame_depth / 2;
  box("home switch", {0.05, 0.018, 0.018}, looks::white, at(x, y - 0.017, width / 2 - 0.02));
  box("home switch arm", {0.016, 0.016, beam_z + 0.008 - (width / 2 - 0.03)}, shaft_look,
      at(x, y, (beam_z + 0.008 + width / 2 - 0.03) / 2));
  box("home switch bracket", {-bearing_width / 2 - x, 0.016, 0.016}, shaft_look,
      at((x - bearing_width / 2) / 2, y, beam_z));
}

void RotaryKnife::Picture::add_drive() {
  const double plate = axis + 0.07 - base_top;
  box("back plate", {0.26, plate, 0.03}, looks::bed, at(0, base_top + plate / 2, -width / 2 - 0.095),
      "back_plate");
  add_motor("", axis, 1, turning(knife_.rotor_, behind(axis, 0.44)));
  if (knife_.data_.motors < 2) return;
  // The second motor drives the counter drum, without one the other end of the drum.
  if (geared)
    add_motor(" 2", -counter_axis, 1, turning(knife_.rotor_, behind(-counter_axis, 0.44), -1));
  else
    add_motor(" 2", axis, -1, turning(knife_.rotor_, behind(axis, 0.44, -1)));
}

/// At `side` 1 behind the machine, -1 in front of it.
void RotaryKnife::Picture::add_motor(const std::string& ending, double height, int side, const Frame& rotor) {
  on_floor();
  rod("gearbox" + ending, 0.13, 0.12, shaft_look, behind(height, 0.17, side), "gearbox");
  box("motor" + ending, {0.14, 0.14, 0.20}, looks::dark, behind(height, 0.33, side), "servo_motor");
  on(rotor);
  rod("encoder disc" + ending, 0.11, 0.008, looks::brass, {}, "encoder_disc");
  on_floor();
  rod("encoder" + ending, 0.09, 0.05, looks::dark, behind(height, 0.475, side), "encoder");
}

/// On the knife drum at `side` 1, where the cut is below, or on the counter drum at -1.
void RotaryKnife::Picture::add_blades(const std::string& name, int side) {
  const int count = knife_.data_.blade_count;
  const double lag = std::tan(knife_.data_.helix) / axis * width;  // from one end to the other [rad]
  const int pieces = static_cast<int>(std::ceil(lag / piece_of_blade));
  const Pose edge = side > 0 ? Pose{} : about_z(std::numbers::pi);
  // Only the end towards the operator leaves a trail.
  const auto piece = [&](const std::string& piece_name, double angle, double z, double length, bool at_end) {
    Part& part = wedge(piece_name, {0.022, blade_height, length}, looks::red.on("blade"),
                       about_z(-side * angle) * at(0, side * (blade_height / 2 - axis), z) *
                           about_y(-knife_.data_.helix) * edge,
                       {0, -blade_height / 2, length / 2}, "knife_blade");
    if (!at_end || side < 0) part.tip.reset();
  };
  for (int i = 0; i < count; ++i) {
    const double angle = units::turn * i / count;
    const auto blade = fmt::format("{} {}", name, i + 1);
    if (pieces == 0) piece(blade, angle, 0, width, true);
    for (int k = 0; k < pieces; ++k) {
      const double along = (k + 0.5) / pieces - 0.5;  // of the blade, from its middle
      piece(fmt::format("{}, piece {}", blade, k + 1), angle + along * lag, along * width,
            width / pieces / std::cos(knife_.data_.helix), k + 1 == pieces);
    }
  }
}

std::vector<Part> RotaryKnife::parts() {
  Picture picture(*this);
  std::vector<Part> parts = picture.take();
  if (data_.helix > 0)
    for (Part& part : parts)
      if (!part.frame) part.offset = picture.mounting * part.offset;
  return moved_along(std::move(parts), data_.station.place);
}

void RotaryKnife::callouts(std::vector<Callout>& out) {
  const double force = cutter_.force();
  if (force <= 0) return;
  const double place = cutter_.place();
  const std::array<double, 3> cut = {data_.station.place + place * std::tan(data_.helix), 0,
                                     data_.helix > 0 ? place : data_.blade_width / 2};
  out.push_back({Callout::Kind::force, "cut", cut, {0, force, 0}});
}

}  // namespace drycut::plants
