#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "plants/assembly.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

// How the line looks. The web runs at y = 0 from left to right; the machine stands on a floor at y = -0.9 m.

namespace {

constexpr double before_puller = 0.45;  // visible web before the line drive [m]
constexpr double least_look = 3e-3;     // thinner web would vanish in the picture [m]
constexpr double roll_diameter = 0.14;
constexpr double stand_low = -0.24;      // lower side of the infeed frame
constexpr double support_height = 0.05;  // of what carries the pull rolls and the measuring wheel on it
constexpr double belt_height = 0.11;
constexpr double infeed_leg = 0.75;
constexpr double most_between_legs = 1.6;
constexpr double outfeed_leg = 0.795;
constexpr double tube_roller_pitch = 0.4;
constexpr double tube_roller = 0.09;       // outer diameter [m]
constexpr double waist = tube_roller / 3;  // radius of a roller's waist, on which the tube lies
constexpr double station_gap = 0.06;       // between a belt and a station on the line [m]
constexpr double shortest_belt = 0.16;     // [m]
constexpr int cleats = 8;                  // marks on the belt that show its motion

constexpr looks::Look roll_look = {{0.62F, 0.64F, 0.67F}, "steel"};
constexpr looks::Look rubber_look = {{0.14F, 0.15F, 0.16F}, "rubber"};
constexpr looks::Look web_look = {{0.96F, 0.62F, 0.12F}, "web"};
constexpr looks::Look mark_look = {{0.85F, 0.87F, 0.88F}};
constexpr looks::Look print_look = {{0.10F, 0.09F, 0.09F}, "web"};
constexpr double least_print = 15e-3;  // a narrower mark would vanish in the picture [m]
constexpr std::size_t most_prints = 40;
constexpr double beyond_cut = 0.3;  // of the web before it is cut, where marks are shown [m]

/// How high the material looks [m].
double look_of(const WebData& data) { return std::max(section_height(data.cross_section()), least_look); }

/// So many marks can be in sight.
std::size_t prints_of(const PrintMarkData& marks, double upstream) {
  if (marks.pitch <= 0) return 0;
  return std::min(most_prints, static_cast<std::size_t>((upstream + beyond_cut) / marks.pitch) + 2);
}

}  // namespace

struct Web::Picture : Assembly {
  explicit Picture(const Web& web) : web_(web), data_(web.data_) {
    add_material("web", [this_web = &web_, upstream = upstream] {
      const double lead = this_web->overhang();
      return std::pair((lead - upstream) / 2, upstream + lead);
    });
    add_pull_rolls();
    add_wheel();
    add_stands();
    add_outfeed();
    if (tube)
      add_tube_rollers();
    else
      box("table", {upstream - 0.25, 0.02, wide + std::min(0.1 * wide, 0.08)}, roll_look,
          at(-(upstream + 0.25) / 2, -0.011, 0), "table");
    add_cleats();
    add_pieces();
    add_prints();
  }

  void add_pull_rolls();
  void add_wheel();
  void add_stands();
  [[nodiscard]] std::vector<std::pair<double, double>> belts() const;
  void add_outfeed();
  void add_belt(double x, double length, int number);
  void add_tube_rollers();
  void add_cleats();
  void add_pieces();
  void add_prints();

  /// A stretch of the material; `stretch` gives its middle and its length [m]. The part is 1 m long.
  template <class Stretch>
  void add_material(const std::string& name, Stretch stretch, const bool* shown = nullptr) {
    on([stretch, shown, y = look / 2, along_z = tube] {
      const auto [middle, length] = stretch();
      return PartPose(at(middle, y, 0), shown == nullptr || *shown,
                      {along_z ? 1 : length, 1, along_z ? length : 1});
    });
    if (tube)
      rod(name, look, 1, web_look, along_line);
    else
      box(name, {1, look, wide}, web_look, {});
    on_floor();
  }
  /// What turns about z at a place by an angle [rad].
  template <class Angle>
  [[nodiscard]] static Frame turning(const Pose& place, Angle angle) {
    return [place, angle] { return place * about_z(angle()); };
  }

  const Web& web_;
  const WebData& data_;
  double pull_x = -data_.strip.puller_distance;
  double wheel_x = -data_.strip.wheel_distance;
  double upstream = before_puller - pull_x;  // visible web before the cut [m]
  bool tube = data_.cross_section().tube;
  double look = look_of(data_);
  /// Width of rolls, tables and belt [m]: a tube needs more than its own.
  double wide = tube ? std::max(4 * data_.width, 0.16) : data_.width;
  double across = wide + std::min(0.15 * wide, 0.12);  ///< of rolls and belt, which stick out
  double stands_z = across / 2 + 0.02;
  double frame_half = (wide - std::min(0.2 * wide, 0.12)) / 2;  ///< of the infeed frame's width
};

void Web::Picture::add_pull_rolls() {
  const double upper_y = look + roll_diameter / 2;
  const auto angle = [&web = web_.material_] {
    return std::fmod(web.position / (roll_diameter / 2), units::turn);
  };
  const Frame upper = turning(at(pull_x, upper_y, 0), angle);
  on(upper);
  rod("upper pull roll", roll_diameter, across, rubber_look, {}, "roller").ends_kept = true;
  on(turning(at(pull_x, -roll_diameter / 2, 0), [angle] { return -angle(); }));
  rod("lower pull roll", roll_diameter, across, roll_look, {}, "roller").ends_kept = true;
  on(upper);
  box("pull roll mark", {0.012, 0.05, 0.006}, mark_look, at(0, 0.035, across / 2 + 0.003));
}

void Web::Picture::add_wheel() {
  const double diameter = data_.wheel.circumference / std::numbers::pi;
  const double axle_y = look + data_.wheel.circumference / units::turn;
  const double z = tube ? 0 : wide / 2 - std::min(0.1 * wide, 0.05);
  const double arm_z = wide / 2 + std::min(0.05 * wide, 0.03) + 0.04;  // on the operator's side
  on(turning(at(wheel_x, axle_y, z), [&wheel = web_.wheel_] {
    return units::turn * (wheel.revolutions() - std::floor(wheel.revolutions()));
  }));
  rod("measuring wheel", diameter, 0.03, rubber_look, {}, "measuring_wheel");
  box("measuring wheel mark", {0.012, diameter * 0.38, 0.006}, mark_look, at(0, diameter / 2 * 0.55, 0.018));
  on_floor();
  box("wheel arm", {0.26, 0.025, 0.02}, roll_look, at(wheel_x - 0.118, axle_y, arm_z), "wheel_arm");
  rod("wheel axle", 0.018, arm_z - z, roll_look, at(wheel_x, axle_y, (z + arm_z) / 2));
  const double post_x = wheel_x - 0.236;
  const double post_z = arm_z - 0.02;
  box("wheel post", {0.05, axle_y + 0.035 - stand_low, 0.024}, looks::bed,
      at(post_x, (axle_y + 0.035 + stand_low) / 2, post_z), "frame_post");
  box("wheel bracket", {0.05, support_height, post_z - frame_half}, looks::bed,
      at(post_x, stand_low + support_height / 2, (post_z + frame_half) / 2));
}

void Web::Picture::add_stands() {
  const double foot = stand_low - support_height;
  const double stand = look + roll_diameter - foot;
  for (const double side : {-1.0, 1.0})
    box(numbered("roll stand", side), {0.06, stand, 0.024}, looks::bed,
        at(pull_x, foot + stand / 2, -side * stands_z), "frame_post");
  const auto carry = [&](const std::string& roll, double y) {
    for (const double side : {-1.0, 1.0})
      box(numbered(roll + " bearing", side), {0.11, 0.09, 0.03}, looks::bearing,
          at(pull_x, y, -side * (stands_z + 0.027)), "bearing_block");
    rod(roll + " shaft", 0.045, 2 * (stands_z + 0.06), roll_look, at(pull_x, y, 0));
  };
  carry("upper roll", look + roll_diameter / 2);
  carry("lower roll", -roll_diameter / 2);
  box("roll beam", {0.06, support_height, 2 * stands_z}, looks::bed,
      at(pull_x, foot + support_height / 2, 0));
  box("infeed frame", {upstream - 0.3, 0.22, 2 * frame_half}, looks::bed, at(-(upstream + 0.3) / 2, -0.13, 0),
      "hollow_frame")
      .ends_kept = true;
  const double first = -upstream + 0.25;
  const double last = -0.45;
  const int gaps = std::max(1, static_cast<int>(std::ceil((last - first) / most_between_legs)));
  for (int i = 0; i <= gaps; ++i)
    box(fmt::format("infeed leg {}", i + 1), {0.09, infeed_leg, wide - std::min(0.3 * wide, 0.2)}, looks::bed,
        at(first + (last - first) * i / gaps, floor_y + infeed_leg / 2, 0), "leg")
        .ends_kept = true;
}

/// What the stations on it leave of the belt, from and to [m].
std::vector<std::pair<double, double>> Web::Picture::belts() const {
  std::vector<std::pair<double, double>> found;
  double from = data_.outfeed.start;
  const double end = from + data_.outfeed.length;
  for (const auto& [before, behind] : web_.rooms_) {
    if (std::min(before - station_gap, end) - from > shortest_belt)
      found.emplace_back(from, std::min(before - station_gap, end));
    from = std::max(from, behind + station_gap);
  }
  if (end - from > shortest_belt || found.empty())
    found.emplace_back(from, std::max(end, from + shortest_belt));
  return found;
}

void Web::Picture::add_outfeed() {
  int number = 0;
  for (const auto& [from, to] : belts()) add_belt(from, to - from, number++);
}

/// The belt of that number, from 0 on.
void Web::Picture::add_belt(double x, double length, int number) {
  const double y = -0.001 - belt_height / 2;
  const auto named = [number](const char* name) {
    return number == 0 ? std::string(name) : fmt::format("{} {}", name, number + 1);
  };
  const auto paired = [number](const char* name, double side) {
    return fmt::format("{} {}", name, 2 * number + (side < 0 ? 1 : 2));
  };
  box(named("outfeed belt"), {length, belt_height, across}, rubber_look, at(x + length / 2, y, 0),
      "conveyor_belt");
  for (const double side : {-1.0, 1.0}) {
    const double end = side < 0 ? x + belt_height / 2 : x + length - belt_height / 2;
    on(turning(at(end, y, 0),
               [&belt = web_.outfeed_] { return -std::fmod(belt.belt_travel() / 0.05, units::turn); }));
    rod(paired("outfeed roll", side), 0.1, across + std::min(0.01 * wide, 0.01), roll_look, {}, "roller")
        .ends_kept = true;
  }
  on_floor();
  box(named("outfeed frame"), {length - std::min(0.15, length / 4), 0.1, across + 0.04}, looks::bed,
      at(x + length / 2, y - 0.01, 0), "hollow_frame")
      .ends_kept = true;
  for (const double side : {-1.0, 1.0})
    box(paired("outfeed leg", side), {0.09, outfeed_leg, wide}, looks::bed,
        at(side < 0 ? x + std::min(0.45, length / 4) : x + length - std::min(0.3, length / 4),
           floor_y + outfeed_leg / 2, 0),
        "leg")
        .ends_kept = true;
}

void Web::Picture::add_tube_rollers() {
  const int rollers = static_cast<int>((upstream - 0.1) / tube_roller_pitch);
  for (int i = 0; i < rollers; ++i) {
    on(turning(at(0.15 - upstream + tube_roller_pitch * i, -waist, 0),
               [&web = web_.material_] { return -std::fmod(web.position / waist, units::turn); }));
    rod(fmt::format("tube roller {}", i + 1), tube_roller, wide, roll_look, {}, "tube_roller");
  }
}

void Web::Picture::add_cleats() {
  const double length = data_.outfeed.length;
  for (int i = 0; i < cleats; ++i) {
    on([start = data_.outfeed.start, length, i, &belt = web_.outfeed_, all = belts()] {
      const double x = start + std::fmod(belt.belt_travel() + length * i / cleats, length);
      const bool seen = std::any_of(all.begin(), all.end(),
                                    [x](const auto& one) { return x >= one.first && x <= one.second; });
      return PartPose(at(x, -0.002, 0), seen);
    });
    box(fmt::format("belt mark {}", i + 1), {0.02, 0.004, across}, mark_look, {});
  }
}

void Web::Picture::add_pieces() {
  int number = 0;
  for (const Outfeed::Piece& piece : web_.outfeed_.pieces())
    add_material(
        fmt::format("piece {}", ++number),
        [&piece] { return std::pair(piece.body->position, std::max(piece.length, 1e-3)); },
        &piece.body->awake);
}

void Web::Picture::add_prints() {
  for (std::size_t i = 0; i < prints_of(data_.marks, upstream); ++i) {
    on([&web = web_, i, place = at(0, look, 0.33 * data_.width)] {
      const std::vector<double> shown = web.prints_in_sight();
      return i < shown.size() ? PartPose(at(shown[i], 0, 0) * place) : PartPose({}, false);
    });
    box(fmt::format("print mark {}", i + 1),
        {std::max(data_.marks.width, least_print), 1e-3, 0.3 * data_.width}, print_look, {});
  }
}

std::vector<Part> Web::parts() { return Picture(*this).take(); }

double Web::overhang() const { return std::max(0.0, material_.position - lead_end_); }

/// Before the photocell, where no mark is decided yet, they are at the true pitch.
std::vector<double> Web::prints_in_sight() const {
  std::vector<double> places(marks_.places().begin(), marks_.places().end());
  const double pitch = data_.marks.pitch * (1 + data_.marks.stretch);
  const double upstream = data_.strip.puller_distance + before_puller;
  while (!places.empty() && material_.position - places.back() > -upstream)
    places.push_back(places.back() + pitch);
  std::vector<double> shown;
  for (const double place : places) {
    const double x = material_.position - place;
    if (x >= -upstream && x <= overhang()) shown.push_back(x);
  }
  return shown;
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
