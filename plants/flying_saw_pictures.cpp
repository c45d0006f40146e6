#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plants/colours.hpp"
#include "plants/flying_saw.hpp"
#include "plants/pose_math.hpp"

namespace drycut::plants {

// How the saw looks: a bed with two rails under the line, the carriage on it with a vice before and behind
// the blade, and a column at the back that carries the saw head over the material.

namespace {

using Shape = Part::Shape;

constexpr double floor_y = -0.9;
constexpr double rack_lead = 0.06;  // no screw has a longer lead [m]
constexpr double carriage_length = 0.36;
constexpr double carriage_y = -0.115;  // middle of its plate
constexpr double disc = 0.3;           // of the blade
constexpr double vice_x = 0.11;        // from the blade
constexpr double jaw_gap = 0.03;       // of an open jaw over the material

constexpr std::array<float, 3> jaw_colour = {0.35F, 0.62F, 0.30F};

constexpr double right_angle = std::numbers::pi / 2;
/// An axis z along the line, or against it.
const Quaternion along_line = about_y(right_angle);
const Quaternion against_line = about_y(-right_angle);
const Quaternion upwards = about_x(-right_angle);

}  // namespace

/// A part and where its middle is.
struct FlyingSaw::Item {
  Part part;
  std::array<double, 3> at;
  bool carried = false;  ///< `at` is from the place of the blade on the line
  Quaternion turned = {0, 0, 0, 1};
};

void FlyingSaw::add_bed(std::vector<Item>& all) const {
  const double low = data_.travel_min - carriage_length / 2;
  const double high = data_.travel_max + carriage_length / 2;
  const double middle = (low + high) / 2;
  const double length = high - low + 0.16;
  all.push_back(
      {{"bed", Shape::box, {length, 0.12, 0.34}, colours::bed, "paint", "beam"}, {middle, -0.26, 0}});
  for (const double z : {-0.13, 0.13})
    all.push_back({{z < 0 ? "rail 1" : "rail 2",
                    Shape::box,
                    {length - 0.06, 0.03, 0.024},
                    colours::steel,
                    "steel",
                    "rail"},
                   {middle, -0.185, z}});
  for (const double side : {-1.0, 1.0}) {
    const char* stop = side < 0 ? "stop 1" : "stop 2";
    const char* block = side < 0 ? "stop block 1" : "stop block 2";
    const double face = side < 0 ? low : high;
    all.push_back({{stop, Shape::cylinder, {0.06, 0.06, 0.03}, colours::red, "rubber", "bumper"},
                   {face + side * 0.015, -0.13, 0},
                   false,
                   side < 0 ? along_line : against_line});
    all.push_back(
        {{block, Shape::box, {0.03, 0.12, 0.16}, colours::bed, "paint"}, {face + side * 0.045, -0.15, 0}});
    const double leg = -0.32 - floor_y;
    all.push_back({{side < 0 ? "leg 1" : "leg 2", Shape::box, {0.1, leg, 0.3}, colours::bed, "paint", "leg"},
                   {middle + side * length * 0.4, floor_y + leg / 2, 0}});
  }
  all.push_back({{"home switch", Shape::box, {0.04, 0.03, 0.03}, colours::white, "paint"},
                 {data_.sensors.home.centre, -0.22, 0.19}});
  all.push_back(
      {{"home flag", Shape::box, {0.02, 0.1, 0.008}, colours::white, "paint"}, {0, -0.16, 0.185}, true});
}

void FlyingSaw::add_drive(std::vector<Item>& all) const {
  const double low = data_.travel_min - carriage_length / 2;
  const double high = data_.travel_max + carriage_length / 2;
  const double angle = 2 * std::numbers::pi * rotor_.revolutions() / data_.gear.ratio;
  const double turn = std::fmod(angle, 2 * std::numbers::pi);
  if (data_.lead < rack_lead) {
    const double y = -0.185;
    all.push_back({{"screw", Shape::cylinder, {0.03, 0.03, high - low}, colours::steel, "steel", "screw"},
                   {(low + high) / 2, y, 0},
                   false,
                   product(about_x(turn), along_line)});
    all.push_back({{"motor", Shape::box, {0.12, 0.12, 0.2}, colours::dark, "paint", "servo_motor"},
                   {low - 0.2, y, 0},
                   false,
                   along_line});
    all.push_back({{"coupling mark", Shape::box, {0.04, 0.008, 0.016}, colours::red, "paint"},
                   {low - 0.07, y + 0.03 * std::cos(turn), 0.03 * std::sin(turn)},
                   false,
                   about_x(turn)});
    return;
  }
  const double radius = std::min(data_.lead / (2 * std::numbers::pi), 0.06);
  const double z = 0.2;
  const double y = -0.2 + radius;
  all.push_back({{"rack", Shape::box, {high - low, 0.03, 0.04}, colours::steel, "steel", "rack"},
                 {(low + high) / 2, -0.215, z}});
  all.push_back(
      {{"pinion", Shape::cylinder, {2 * radius, 2 * radius, 0.04}, colours::steel, "steel", "pinion"},
       {0.1, y, z},
       true,
       about_z(-turn)});
  all.push_back({{"pinion mark", Shape::box, {0.01, radius * 0.9, 0.006}, colours::red, "paint"},
                 {0.1 + radius * 0.5 * std::sin(turn), y + radius * 0.5 * std::cos(turn), z + 0.022},
                 true,
                 about_z(-turn)});
  all.push_back({{"motor", Shape::box, {0.11, 0.11, 0.2}, colours::dark, "paint", "servo_motor"},
                 {0.1, y, z - 0.15},
                 true});
}

void FlyingSaw::add_carriage(std::vector<Item>& all) const {
  const WebData& web = web_.data();
  const double height = section_height(web.cross_section());
  const double wide = std::max(web.width, 0.06);
  all.push_back(
      {{"carriage", Shape::box, {carriage_length, 0.05, 0.36}, colours::moving, "paint", "carriage"},
       {0, carriage_y, 0},
       true});
  const double open = clamp_.closed.level ? 0 : jaw_gap;
  for (const double side : {-1.0, 1.0}) {
    const std::string number = side < 0 ? " 1" : " 2";
    const double x = side * vice_x;
    all.push_back(
        {{"lower jaw" + number, Shape::box, {0.06, 0.09, wide}, colours::steel, "steel", "lower_jaw"},
         {x, -0.045, 0},
         true});
    all.push_back({{"upper jaw" + number, Shape::box, {0.06, 0.05, wide}, jaw_colour, "paint", "upper_jaw"},
                   {x, height + open + 0.025, 0},
                   true});
    all.push_back({{"clamp rod" + number, Shape::cylinder, {0.02, 0.02, 0.12}, colours::steel, "steel"},
                   {x, height + open + 0.11, 0},
                   true,
                   upwards});
    all.push_back(
        {{"clamp cylinder" + number, Shape::box, {0.05, 0.05, 0.1}, colours::grey, "steel", "cylinder"},
         {x, height + jaw_gap + 0.19, 0},
         true,
         upwards});
    all.push_back({{"clamp arm" + number, Shape::box, {0.05, 0.03, 0.2}, colours::moving, "paint"},
                   {x, height + jaw_gap + 0.255, -0.09},
                   true});
  }
}

void FlyingSaw::add_head(std::vector<Item>& all) const {
  const double height = section_height(web_.data().cross_section());
  const double axis = height + data_.head.clearance - head_.body().position + disc / 2;
  const double column = height + 0.62;
  all.push_back({{"column", Shape::box, {0.3, column, 0.06}, colours::moving, "paint", "column"},
                 {0, column / 2 - 0.1, -0.22},
                 true});
  all.push_back({{"head guide", Shape::box, {0.05, column - 0.2, 0.02}, colours::steel, "steel"},
                 {0, column / 2, -0.18},
                 true});
  all.push_back({{"head cylinder", Shape::box, {0.05, 0.05, 0.2}, colours::grey, "steel", "cylinder"},
                 {0, column - 0.06, -0.16},
                 true,
                 upwards});
  all.push_back({{"head rod", Shape::cylinder, {0.018, 0.018, 0.16}, colours::steel, "steel"},
                 {0, axis + 0.16, -0.16},
                 true,
                 upwards});
  all.push_back({{"saw head", Shape::box, {0.08, 0.12, 0.13}, colours::steel, "steel", "saw_head"},
                 {0.055, axis, -0.11},
                 true});
  all.push_back(
      {{"saw motor", Shape::cylinder, {0.11, 0.11, 0.13}, colours::dark, "paint", "induction_motor"},
       {0.16, axis, -0.11},
       true,
       against_line});
  all.push_back({{"spindle", Shape::cylinder, {0.05, 0.05, 0.05}, colours::steel, "steel"},
                 {0.015, axis, 0},
                 true,
                 along_line});
  all.push_back({{"saw blade", Shape::cylinder, {disc, disc, 0.005}, colours::red, "blade", "saw_blade"},
                 {0, axis, 0},
                 true,
                 product(about_x(blade_turn_), along_line)});
  const double guard = disc * 0.58;                // height of the guard, which ends a little below the axis
  const double lowest = -disc * 1.05 + guard / 2;  // the blade's lowest point, from the guard's middle
  all.push_back({{"saw guard",
                  Shape::box,
                  {0.034, guard, disc * 1.1},
                  colours::moving,
                  "paint",
                  "saw_guard",
                  std::array{0.0, lowest, 0.0}},
                 {0, axis + disc * 0.55 - guard / 2, 0},
                 true});
  for (const double side : {0.0, std::numbers::pi}) {
    const double a = blade_turn_ + side;
    all.push_back({{side == 0 ? "blade mark 1" : "blade mark 2",
                    Shape::box,
                    {0.008, 0.07, 0.014},
                    colours::white,
                    "paint"},
                   {0, axis + 0.09 * std::cos(a), 0.09 * std::sin(a)},
                   true,
                   about_x(a)});
  }
}

std::vector<FlyingSaw::Item> FlyingSaw::items() const {
  std::vector<Item> all;
  add_bed(all);
  add_drive(all);
  add_carriage(all);
  add_head(all);
  return all;
}

std::vector<Part> FlyingSaw::parts() {
  std::vector<Part> list;
  for (Item& item : items()) list.push_back(std::move(item.part));
  return list;
}

void FlyingSaw::poses(std::vector<PartPose>& out) {
  out.clear();
  for (const Item& item : items()) {
    const double x = item.at[0] + (item.carried ? carriage_.position : 0);
    out.push_back({.pose = {{x, item.at[1], item.at[2]}, item.turned}});
  }
}

void FlyingSaw::callouts(std::vector<Callout>& out) {
  const double height = section_height(web_.data().cross_section());
  const double x = carriage_.position;
  const double axis = height + data_.head.clearance - head_.body().position + disc / 2;
  const auto force = [&](const char* what, const std::array<double, 3>& at, const std::array<double, 3>& f) {
    if (f != std::array<double, 3>{0, 0, 0}) out.push_back({Callout::Kind::force, what, at, f});
  };
  force("cut", {x, std::max(0.0, axis - disc / 2), 0}, {0, cut_.force(), 0});
  force("pinch", {x, height / 2, disc / 3}, {cut_.sideways(), 0, 0});
  if (clamp_.closed.level)
    for (const double side : {-1.0, 1.0})
      force("clamp", {x + side * vice_x, height + 0.05, 0.05}, {0, -clamp_.normal(), 0});
}

}  // namespace drycut::plants
