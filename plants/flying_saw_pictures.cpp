#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "plants/assembly.hpp"
#include "plants/flying_saw.hpp"

namespace drycut::plants {

// How the saw looks: a bed with two rails under the line, the carriage on it with a vice before and behind
// the blade, and a column at the back that carries the saw head over the material.

namespace {

constexpr double rack_lead = 0.06;     // no screw has a longer lead [m]
constexpr double saw_carriage = 0.36;  // length of its plate [m]
constexpr double disc = 0.3;           // of the blade
constexpr double vice_x = 0.11;        // from the blade
constexpr double jaw_gap = 0.03;       // of an open jaw over the material

constexpr looks::Look jaw_look = {{0.35F, 0.62F, 0.30F}};

}  // namespace

/// The carriage's frame is at the place of the blade on the line.
struct FlyingSaw::Picture : Assembly {
  explicit Picture(const FlyingSaw& saw) : saw_(saw), data_(saw.data_) {
    add_bed();
    add_drive();
    add_carriage();
    add_head();
  }

  void add_bed();
  void add_drive();
  void add_rack();
  void add_carriage();
  void add_head();
  /// On the carriage.
  [[nodiscard]] Frame on_carriage(double x, double y, double z) const {
    return [&carriage = saw_.carriage(), x, y, z] { return at(carriage.position + x, y, z); };
  }

  const FlyingSaw& saw_;
  const FlyingSawData& data_;
  double low = data_.travel_min - saw_carriage / 2;
  double high = data_.travel_max + saw_carriage / 2;
  double middle = (low + high) / 2;
  double height = section_height(saw_.web_.data().cross_section());
  double wide = std::max(saw_.web_.data().width, 0.06);  ///< of what the vices hold
  double plate = std::max(0.36, wide + 0.12);            ///< of the carriage, across
  double more = plate / 2 - 0.18;                        ///< further out than for a narrow material
  Frame carriage_ = on_carriage(0, 0, 0);
};

void FlyingSaw::Picture::add_bed() {
  const double length = high - low + 0.16;
  box("bed", {length, 0.12, plate - 0.02}, looks::bed, at(middle, -0.26, 0), "beam").ends_kept = true;
  for (const double side : {-1.0, 1.0})
    box(numbered("rail", side), {length - 0.06, 0.03, 0.024}, looks::steel,
        at(middle, -0.185, side * (0.13 + more)), "rail");
  for (const double side : {-1.0, 1.0}) {
    const double face = side < 0 ? low : high;
    rod(numbered("stop", side), 0.06, 0.03, looks::red.on("rubber"),
        at(face + side * 0.015, -0.13, 0) * (side < 0 ? along_line : against_line), "bumper");
    box(numbered("stop block", side), {0.03, 0.12, 0.16}, looks::bed, at(face + side * 0.045, -0.15, 0));
    const double leg = -0.32 - floor_y;
    box(numbered("leg", side), {0.1, leg, plate - 0.06}, looks::bed,
        at(middle + side * length * 0.4, floor_y + leg / 2, 0), "leg")
        .ends_kept = true;
  }
  box("home switch", {0.04, 0.03, 0.03}, looks::white, at(data_.sensors.home.centre, -0.22, 0.19 + more));
  on(carriage_);
  box("home flag", {0.02, 0.1, 0.008}, looks::white, at(0, -0.16, 0.185 + more));
}

void FlyingSaw::Picture::add_drive() {
  on_floor();
  if (data_.lead >= rack_lead) return add_rack();
  const Pose axis = at(0, -0.185, 0);
  const Frame screw = [axis, &drive = saw_.screw_] { return axis * about_x(drive.screw_turn()); };
  on(screw);
  rod("screw", 0.03, high - low, looks::steel, at(middle, 0, 0) * along_line, "screw");
  on_floor();
  box("motor", {0.12, 0.12, 0.2}, looks::dark, at(low - 0.2, 0, 0) * axis * along_line, "servo_motor");
  on(screw);
  box("coupling mark", {0.04, 0.008, 0.016}, looks::red, at(low - 0.07, 0.03, 0));
}

void FlyingSaw::Picture::add_rack() {
  const double radius = std::min(data_.lead / units::turn, 0.06);
  const double y = -0.2 + radius;
  const double z = 0.2 + more;
  box("rack", {high - low, 0.03, 0.04}, looks::steel, at(middle, -0.215, z), "rack");
  on([pinion = on_carriage(0.1, y, z), &drive = saw_.screw_] {
    return pinion().pose * about_z(-drive.screw_turn());
  });
  rod("pinion", 2 * radius, 0.04, looks::steel, {}, "pinion");
  box("pinion mark", {0.01, radius * 0.9, 0.006}, looks::red, at(0, radius * 0.5, 0.022));
  on(carriage_);
  box("motor", {0.11, 0.11, 0.2}, looks::dark, at(0.1, y, z - 0.15), "servo_motor");
}

void FlyingSaw::Picture::add_carriage() {
  on(carriage_);
  box("carriage", {saw_carriage, 0.05, plate}, looks::moving, at(0, -0.115, 0), "carriage").ends_kept = true;
  const Frame jaws = [carriage = carriage_, &closed = saw_.clamp_.closed] {
    return carriage().pose * at(0, closed.level ? 0 : jaw_gap, 0);
  };
  for (const double side : {-1.0, 1.0}) {
    const double x = side * vice_x;
    on(carriage_);
    box(numbered("lower jaw", side), {0.06, 0.09, wide}, looks::steel, at(x, -0.045, 0), "lower_jaw");
    on(jaws);
    box(numbered("upper jaw", side), {0.06, 0.05, wide}, jaw_look, at(x, height + 0.025, 0), "upper_jaw");
    rod(numbered("clamp rod", side), 0.02, 0.12, looks::steel, at(x, height + 0.11, 0) * upright);
    on(carriage_);
    box(numbered("clamp cylinder", side), {0.05, 0.05, 0.1}, looks::grey,
        at(x, height + jaw_gap + 0.19, 0) * upright, "cylinder");
    box(numbered("clamp arm", side), {0.05, 0.03, 0.2 + more}, looks::moving,
        at(x, height + jaw_gap + 0.255, -0.09 - more / 2));
  }
}

void FlyingSaw::Picture::add_head() {
  const double column = height + 0.62;
  box("column", {0.3, column, 0.06}, looks::moving, at(0, column / 2 - 0.1, -0.22 - more), "column");
  if (more > 0)
    box("bridge", {0.12, 0.1, more + 0.08}, looks::moving, at(0, column - 0.15, -0.19 - more / 2));
  box("head guide", {0.05, column - 0.2, 0.02}, looks::steel, at(0, column / 2, -0.18));
  box("head cylinder", {0.05, 0.05, 0.2}, looks::grey, at(0, column - 0.06, -0.16) * upright, "cylinder");
  const Frame head = [&saw = saw_] { return at(saw.carriage().position, saw.blade_axis(), 0); };
  on(head);
  rod("head rod", 0.018, 0.16, looks::steel, at(0, 0.16, -0.16) * upright);
  box("saw head", {0.08, 0.12, 0.13}, looks::steel, at(0.055, 0, -0.11), "saw_head");
  rod("saw motor", 0.11, 0.13, looks::dark, at(0.16, 0, -0.11) * against_line, "induction_motor");
  rod("spindle", 0.05, 0.05, looks::steel, at(0.015, 0, 0) * along_line);
  const Frame blade = [head, &spindle = saw_.head_] { return head().pose * about_x(spindle.blade_turn()); };
  on(blade);
  rod("saw blade", disc, 0.005, looks::red.on("blade"), along_line, "saw_blade").pitch =
      units::turn / 2;  // its two marks
  on(head);
  const double guard = disc * 0.58;                // height of the guard, which ends a little below the axis
  const double lowest = -disc * 1.05 + guard / 2;  // the blade's lowest point, from the guard's middle
  box("saw guard", {0.034, guard, disc * 1.1}, looks::moving, at(0, disc * 0.55 - guard / 2, 0), "saw_guard")
      .tip = {0, lowest, 0};
  on(blade);
  for (const double side : {-1.0, 1.0})
    box(numbered("blade mark", side), {0.008, 0.07, 0.014}, looks::white,
        about_x(side < 0 ? 0 : std::numbers::pi) * at(0, 0.09, 0));
}

std::vector<Part> FlyingSaw::parts() { return moved_along(Picture(*this).take(), data_.station.place); }

double FlyingSaw::blade_axis() const {
  const double height = section_height(web_.data().cross_section());
  return height + data_.head.clearance - head_.body().position + disc / 2;
}

void FlyingSaw::callouts(std::vector<Callout>& out) {
  const double height = section_height(web_.data().cross_section());
  const double x = data_.station.place + carriage().position;
  const auto force = [&](const char* what, const std::array<double, 3>& at, const std::array<double, 3>& f) {
    if (f != std::array<double, 3>{0, 0, 0}) out.push_back({Callout::Kind::force, what, at, f});
  };
  force("cut", {x, std::max(0.0, blade_axis() - disc / 2), 0}, {0, cut_.force(), 0});
  force("pinch", {x, height / 2, disc / 3}, {cut_.sideways(), 0, 0});
  if (clamp_.closed.level)
    for (const double side : {-1.0, 1.0})
      force("clamp", {x + side * vice_x, height + 0.05, 0.05}, {0, -clamp_.normal(), 0});
  const double before = data_.station.place + data_.travel_min - saw_carriage / 2;
  out.push_back({Callout::Kind::speed,
                 web_.data().section == "tube" ? "tube" : "web",
                 {before, height + 0.01, 0},
                 {web_.material().speed, 0, 0}});
  out.push_back({Callout::Kind::speed, "carriage", {x, -0.09, 0.2}, {carriage().speed, 0, 0}});
}

}  // namespace drycut::plants
