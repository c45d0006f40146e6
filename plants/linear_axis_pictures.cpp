#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "plants/assembly.hpp"
#include "plants/linear_axis.hpp"

namespace drycut::plants {

// How a linear axis looks: beam with two rails and the screw (or belt) between them, motor at the lower end,
// carriage on top. All sizes follow the carriage, so that a short axis is a small one.

namespace {

constexpr double belt_lead = 0.06;   // no screw has such a lead [m]
constexpr double ink_step = 1.2e-3;  // [m]
constexpr std::size_t ink_dots = 600;

constexpr looks::Look ink_look = {{0.05F, 0.25F, 0.75F}};

double carriage_length(const LinearAxisData& data) {
  return std::clamp(0.2 * (data.travel_max - data.travel_min), 0.07, 0.2);
}
/// Size of everything against a carriage of 160 mm.
double size_factor(const LinearAxisData& data) { return carriage_length(data) / 0.16; }
double middle(const LinearAxisData& data) { return (data.travel_min + data.travel_max) / 2; }

// The play is far too small to be seen: nut and flanks stand once more on the carriage, with it enlarged.
constexpr double least_play = 1e-6;  // [m]: less is not shown
constexpr double nut_length = 0.05;  // against a carriage of 160 mm [m]
constexpr double flank = 0.018;
constexpr double flank_height = 0.08;

double play_of(const LinearAxisData& data) { return data.gear.backlash * data.lead / units::turn; }

/// How much larger the play is drawn: 1, 2, 5, 10 ... so that it takes up to half of the carriage.
double enlargement(const LinearAxisData& data) {
  const double most = 0.5 * carriage_length(data) / play_of(data);
  const double decade = std::pow(10, std::floor(std::log10(most)));
  const double digit = most / decade;
  return std::max(1.0, decade * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1));
}

}  // namespace

Pose LinearAxis::base(double carrier_position) const {
  const Pose attitude = about_y(data_.heading) * about_z(data_.inclination);
  Pose place = at(data_.place_x, data_.place_y, data_.place_z);
  if (carrier_ == nullptr) return place * attitude;
  const double top = 0.13 * size_factor(carrier_->data_);
  const Pose mount = carrier_->base(carrier_->carrier_position()) * at(carrier_position, top, 0);
  return at(mount.position) * place * attitude * at(-middle(data_), 0, 0);
}

Pose LinearAxis::pen_tip(double carrier_position, double position) const {
  const double k = size_factor(data_);
  return base(carrier_position) * at(position, 0.13 * k, -0.24 * k);
}

void LinearAxis::draw_ink() {
  if (ink_.size() == ink_dots) return;
  const auto tip = pen_tip(carrier_position(), carriage().position).position;
  if (!ink_.empty()) {
    const auto& last = ink_.back();
    if (std::hypot(tip[0] - last[0], tip[1] - last[1], tip[2] - last[2]) < ink_step) return;
  }
  ink_.push_back(tip);
}

/// In its frames x is along the axis, from position 0 or from the middle of the carriage, y over the lower
/// side of the beam, z to its right.
struct LinearAxis::Picture : Assembly {
  explicit Picture(const LinearAxis& axis) : axis_(axis), data_(axis.data_) {
    add_beam();
    add_motor();
    add_screw();
    on(carriage_);
    box("home flag", {0.02 * k, 0.06 * k, 0.006 * k}, looks::white, at(0, 0.09 * k, 0.083 * k));
    box("carriage", {length, 0.03 * k, 0.16 * k}, looks::moving, at(0, 0.117 * k, 0), "carriage");
    if (data_.tool == "blade") add_blade();
    if (data_.tool == "guide") add_guide();
    if (data_.tool == "pen") add_pen();
    if (play_of(data_) > least_play) add_play();
  }

  void add_beam();
  void add_motor();
  void add_screw();
  void add_blade();
  void add_guide();
  void add_pen();
  void add_play();
  /// Turns with `angle` about the screw's axis.
  template <class Angle>
  [[nodiscard]] Frame turning(double along, Angle angle) const {
    return
        [beam = beam_, axis = at(along, screw_y, 0), angle] { return beam().pose * axis * about_x(angle()); };
  }
  /// With the carriage, moved by y and z while the tool is up.
  [[nodiscard]] Frame lifted(double y, double z) const {
    return [this_axis = &axis_, carriage = carriage_, y, z] {
      return this_axis->tool_.level ? carriage() : carriage().pose * at(0, y, z);
    };
  }

  const LinearAxis& axis_;
  const LinearAxisData& data_;
  double k = size_factor(data_);
  double mid = middle(data_);
  double length = carriage_length(data_);
  double beam_length = data_.travel_max - data_.travel_min + length + 0.1 * k;
  double screw_y = 0.085 * k;
  Frame beam_ = [axis = &axis_] { return axis->base(axis->carrier_position()); };
  Frame carriage_ = [axis = &axis_] {
    return axis->base(axis->carrier_position()) * at(axis->carriage().position, 0, 0);
  };
};

void LinearAxis::Picture::add_beam() {
  on(beam_);
  box("beam", {beam_length, 0.07 * k, 0.14 * k}, looks::bed, at(mid, 0.035 * k, 0), "beam");
  for (const double side : {-1.0, 1.0})
    box(numbered("rail", side), {beam_length - 0.06 * k, 0.03 * k, 0.02 * k}, looks::steel,
        at(mid, 0.085 * k, -side * 0.05 * k), "rail");
  for (const double side : {-1.0, 1.0})
    box(numbered("end block", side), {0.03 * k, 0.14 * k, 0.15 * k}, looks::bed,
        at(mid + side * beam_length / 2, 0.07 * k, 0), "end_block");
  for (const double side : {-1.0, 1.0}) {
    const double face = (side < 0 ? data_.travel_min : data_.travel_max) + side * length / 2;
    rod(numbered("stop", side), 0.04 * k, 0.03 * k, looks::red.on("rubber"),
        at(face + side * 0.015 * k, 0.116 * k, 0) * (side < 0 ? along_line : against_line), "bumper");
  }
  box("home switch", {0.035 * k, 0.025 * k, 0.025 * k}, looks::white,
      at(data_.sensors.home.centre, 0.045 * k, 0.086 * k));
  if (axis_.carrier_ != nullptr || beam_length <= 0.6) return;
  const double height = data_.place_y - floor_y;
  for (const double side : {-1.0, 1.0})
    box(numbered("leg", side), {0.09, height, 0.1}, looks::bed,
        at(mid + side * 0.38 * beam_length, -height / 2, 0), "frame_post");
}

void LinearAxis::Picture::add_motor() {
  const double side = data_.motor == "upper" ? 1 : -1;
  const auto beside = [&](double distance) { return mid + side * (beam_length / 2 + distance * k); };
  const auto on_shaft = [&](double distance) {
    on(turning(beside(distance), [&rotor = axis_.rotor()] { return units::turn * rotor.part; }));
  };
  const auto facing_axis = [&](double distance) {
    return at(beside(distance), screw_y, 0) * (side > 0 ? against_line : along_line);
  };
  on_shaft(0.04);
  rod("coupling", 0.05 * k, 0.05 * k, looks::steel, along_line, "coupling");
  box("coupling mark", {0.03 * k, 0.006 * k, 0.014 * k}, looks::red, at(0, 0.026 * k, 0));
  on(beam_);
  box("motor", {0.11 * k, 0.11 * k, 0.16 * k}, looks::dark, facing_axis(0.145), "servo_motor");
  on_shaft(0.236);
  rod("encoder disc", 0.1 * k, 0.008 * k, looks::brass, along_line, "encoder_disc");
  on(beam_);
  rod("encoder", 0.085 * k, 0.04 * k, looks::steel, facing_axis(0.264), "encoder");
}

void LinearAxis::Picture::add_screw() {
  if (data_.lead >= belt_lead) {
    box("belt", {beam_length - 0.05 * k, 0.008 * k, 0.05 * k}, looks::dark.on("rubber"), at(mid, screw_y, 0));
    return;
  }
  on(turning(mid, [&screw = axis_.screw_] { return screw.screw_turn(); }));
  rod("screw", 0.025 * k, beam_length - 0.02 * k, looks::steel, along_line, "screw");
}

void LinearAxis::Picture::add_blade() {
  const double web = -data_.place_y;  // height of the web over the beam's lower side
  const double reach = -data_.place_z;
  const double wide = std::max(0.34, 2 * (reach - 0.16));  // the web ends before the axis
  box("column", {0.1, 0.24, 0.06}, looks::moving, at(0, 0.13 * k + 0.12, 0));
  box("arm", {0.08, 0.06, reach + 0.24}, looks::moving, at(0, 0.13 * k + 0.22, (reach + 0.18) / 2));
  on(lifted(0.07, 0));
  box("ram", {0.05, 0.3, 0.05}, looks::steel, at(0, web + 0.23, reach));
  wedge("blade", {0.03, 0.1, wide}, looks::red.on("blade"), at(0, web + 0.05, reach), {0, -0.05, wide / 2});
}

void LinearAxis::Picture::add_guide() {
  box("post", {0.04 * k, 0.2 * k, 0.04 * k}, looks::steel, at(0, 0.23 * k, 0));
  box("arm", {0.03 * k, 0.025 * k, 0.2 * k}, looks::steel, at(0, 0.32 * k, 0.1 * k));
  for (const double side : {-1.0, 1.0})
    rod(numbered("roller", side), 0.03 * k, 0.08 * k, looks::dark.on("steel"),
        at(side * 0.02 * k, 0.32 * k, 0.23 * k) * downward);
}

void LinearAxis::Picture::add_pen() {
  box("pen holder", {0.06 * k, 0.06 * k, 0.1 * k}, looks::moving, at(0, 0.13 * k, -0.08 * k));
  on(lifted(0, 0.02 * k));
  rod("pen", 0.022 * k, 0.22 * k, looks::red, at(0, 0.13 * k, -0.13 * k));
  const LinearAxis* carrier = axis_.carrier_;
  const double wide = carrier != nullptr ? carrier->data_.travel_max - carrier->data_.travel_min : 0.05;
  const double deep = data_.travel_max - data_.travel_min;
  const Pose sheet = axis_.pen_tip(carrier != nullptr ? middle(carrier->data_) : 0, mid) * at(0, 0, -0.0025);
  on_floor();
  box("sheet", {deep, wide, 0.004}, looks::white, sheet);
  for (std::size_t i = 0; i < ink_dots; ++i) {
    on([&ink = axis_.ink_, i] { return i < ink.size() ? PartPose(at(ink[i])) : PartPose({}, false); });
    box(fmt::format("ink {}", i + 1), {1.4e-3, 1.4e-3, 1.4e-3}, ink_look, {});
  }
}

/// The carriage's two flanks and the nut between them. A flank that the nut pushes is red.
void LinearAxis::Picture::add_play() {
  const double y = (0.132 + flank_height / 2) * k;
  const double z = 0.055 * k;
  for (const double side : {-1.0, 1.0}) {
    for (const bool touching : {false, true}) {
      on([carriage = carriage_, axis = &axis_, side, touching, unit = k] {
        const double half = play_of(axis->data_) / 2;
        const double from_middle = enlargement(axis->data_) * half + (nut_length + flank) / 2 * unit;
        const bool touches = side * axis->screw_.ahead() >= half;
        return PartPose(carriage().pose * at(side * from_middle, 0, 0), touches == touching);
      });
      box(numbered(touching ? "pushed flank" : "flank", side), {flank * k, flank_height * k, 0.04 * k},
          touching ? looks::red : looks::moving, at(0, y, z));
    }
  }
  on([carriage = carriage_, axis = &axis_] {
    const double half = play_of(axis->data_) / 2;
    const double ahead = std::clamp(axis->screw_.ahead(), -half, half);
    return carriage().pose * at(enlargement(axis->data_) * ahead, 0, 0);
  });
  box("nut", {nut_length * k, 0.75 * flank_height * k, 0.04 * k}, looks::brass, at(0, y, z));
}

void LinearAxis::callouts(std::vector<Callout>& out) {
  const double play = play_of(data_);
  if (play <= least_play) return;
  const double k = size_factor(data_);
  const double scale = enlargement(data_);
  const double half = scale * play / 2 + nut_length / 2 * k;
  const Pose carriage = base(carrier_position()) * at(this->carriage().position, 0, 0);
  const auto end = [&](double side) {
    return (carriage * at(side * half, (0.14 + flank_height) * k, 0.055 * k)).position;
  };
  const auto drawn = scale > 1 ? fmt::format("drawn x{:g}", scale) : std::string("to scale");
  out.push_back(
      {Callout::Kind::length, fmt::format("play {:.3g} mm, {}", play * 1e3, drawn), end(-1), end(1)});
}

std::vector<Part> LinearAxis::parts() { return Picture(*this).take(); }

}  // namespace drycut::plants
