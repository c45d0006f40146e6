#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plants/colours.hpp"
#include "plants/linear_axis.hpp"
#include "plants/pose_math.hpp"

namespace drycut::plants {

// How a linear axis looks: beam with two rails and the screw (or belt) between them, motor at the lower end,
// carriage on top. All sizes follow the carriage, so that a short axis is a small one.

namespace {

using Shape = Part::Shape;
using Point = std::array<double, 3>;

constexpr double floor_y = -0.9;
constexpr double belt_lead = 0.06;   // no screw has such a lead [m]
constexpr double ink_step = 1.2e-3;  // [m]
constexpr std::size_t ink_dots = 600;
constexpr double right_angle = std::numbers::pi / 2;

constexpr std::array<float, 3> ink_colour = {0.05F, 0.25F, 0.75F};

double carriage_length(const LinearAxisData& data) {
  return std::clamp(0.2 * (data.travel_max - data.travel_min), 0.07, 0.2);
}
/// Size of everything against a carriage of 160 mm.
double size_factor(const LinearAxisData& data) { return carriage_length(data) / 0.16; }
double middle(const LinearAxisData& data) { return (data.travel_min + data.travel_max) / 2; }
double beam_length(const LinearAxisData& data) {
  return data.travel_max - data.travel_min + carriage_length(data) + 0.1 * size_factor(data);
}
const Quaternion lying = about_y(right_angle);  // a cylinder along the axis

}  // namespace

/// A part and where its middle is: along the axis from position 0, over the beam's lower side, to its right.
struct LinearAxis::Item {
  Part part;
  double along = 0;
  double up = 0;
  double side = 0;
  bool carried = false;  ///< moves with the carriage; `along` is from its middle
  Quaternion turned = {0, 0, 0, 1};
};

Point LinearAxis::point(const Point& from, double along, double up, double side) const {
  const double ch = std::cos(data_.heading);
  const double sh = std::sin(data_.heading);
  const double ci = std::cos(data_.inclination);
  const double si = std::sin(data_.inclination);
  return {from[0] + ci * ch * along - si * ch * up + sh * side, from[1] + si * along + ci * up,
          from[2] - ci * sh * along + si * sh * up + ch * side};
}

Point LinearAxis::origin(double carrier_position) const {
  const Point place = {data_.place_x, data_.place_y, data_.place_z};
  if (carrier_ == nullptr) return place;
  const Point on = carrier_->mount(carrier_position);
  const Point middle_at = {on[0] + place[0], on[1] + place[1], on[2] + place[2]};
  return point(middle_at, -middle(data_), 0, 0);
}

Point LinearAxis::mount(double position) const {
  return point(origin(carrier_ != nullptr ? carrier_->carriage_.position : 0), position,
               0.13 * size_factor(data_), 0);
}

Point LinearAxis::pen_tip(double carrier_position, double position) const {
  const double k = size_factor(data_);
  return point(origin(carrier_position), position, 0.13 * k, -0.24 * k);
}

void LinearAxis::draw_ink() {
  if (ink_.size() == ink_dots) return;
  const Point tip = pen_tip(carrier_ != nullptr ? carrier_->carriage_.position : 0, carriage_.position);
  if (!ink_.empty()) {
    const Point& last = ink_.back();
    if (std::hypot(tip[0] - last[0], tip[1] - last[1], tip[2] - last[2]) < ink_step) return;
  }
  ink_.push_back(tip);
}

std::vector<LinearAxis::Item> LinearAxis::items() const {
  std::vector<Item> all;
  add_beam(all);
  add_drive(all);
  add_carriage(all);
  if (data_.tool == "blade") add_blade(all);
  if (data_.tool == "guide") add_guide(all);
  if (data_.tool == "pen") add_pen(all);
  return all;
}

void LinearAxis::add_beam(std::vector<Item>& all) const {
  const double k = size_factor(data_);
  const double mid = middle(data_);
  const double beam = beam_length(data_);
  const double c = carriage_length(data_);
  all = {
      {{"beam", Shape::box, {beam, 0.07 * k, 0.14 * k}, colours::bed, "paint", "beam"}, mid, 0.035 * k, 0},
      {{"rail 1", Shape::box, {beam - 0.06 * k, 0.03 * k, 0.02 * k}, colours::steel, "steel", "rail"},
       mid,
       0.085 * k,
       0.05 * k},
      {{"rail 2", Shape::box, {beam - 0.06 * k, 0.03 * k, 0.02 * k}, colours::steel, "steel", "rail"},
       mid,
       0.085 * k,
       -0.05 * k},
      {{"end block 1", Shape::box, {0.03 * k, 0.14 * k, 0.15 * k}, colours::bed, "paint", "end_block"},
       mid - beam / 2,
       0.07 * k,
       0},
      {{"end block 2", Shape::box, {0.03 * k, 0.14 * k, 0.15 * k}, colours::bed, "paint", "end_block"},
       mid + beam / 2,
       0.07 * k,
       0},
      {{"stop 1", Shape::cylinder, {0.04 * k, 0.04 * k, 0.03 * k}, colours::red, "rubber", "bumper"},
       data_.travel_min - c / 2 - 0.015 * k,
       0.116 * k,
       0,
       false,
       lying},
      {{"stop 2", Shape::cylinder, {0.04 * k, 0.04 * k, 0.03 * k}, colours::red, "rubber", "bumper"},
       data_.travel_max + c / 2 + 0.015 * k,
       0.116 * k,
       0,
       false,
       about_y(-right_angle)},
      {{"home switch", Shape::box, {0.035 * k, 0.025 * k, 0.025 * k}, colours::white, "paint"},
       data_.sensors.home.centre,
       0.045 * k,
       0.086 * k},
  };
  if (carrier_ == nullptr && beam > 0.6) {
    const double height = data_.place_y - floor_y;
    for (const double at : {-0.38, 0.38})
      all.push_back(
          {{at < 0 ? "leg 1" : "leg 2", Shape::box, {0.09, height, 0.1}, colours::bed, "paint", "frame_post"},
           mid + at * beam,
           -height / 2,
           0});
  }
}

void LinearAxis::add_drive(std::vector<Item>& all) const {
  const double k = size_factor(data_);
  const double mid = middle(data_);
  const double beam = beam_length(data_);
  const bool above = data_.motor == "upper";
  const auto beside = [&](double distance) {  // of the motor's end
    return above ? mid + beam / 2 + distance * k : mid - beam / 2 - distance * k;
  };
  const Quaternion facing = about_y(above ? -right_angle : right_angle);  // towards the axis
  const double angle = 2 * std::numbers::pi * rotor_.part;
  const double mark = 0.026 * k;
  const std::vector<Item> driven = {
      {{"coupling", Shape::cylinder, {0.05 * k, 0.05 * k, 0.05 * k}, colours::steel, "steel", "coupling"},
       beside(0.04),
       0.085 * k,
       0,
       false,
       product(about_x(angle), lying)},
      {{"coupling mark", Shape::box, {0.03 * k, 0.006 * k, 0.014 * k}, colours::red, "paint"},
       beside(0.04),
       0.085 * k + mark * std::cos(angle),
       mark * std::sin(angle),
       false,
       about_x(angle)},
      {{"motor", Shape::box, {0.11 * k, 0.11 * k, 0.16 * k}, colours::dark, "paint", "servo_motor"},
       beside(0.145),
       0.085 * k,
       0,
       false,
       facing},
      {{"encoder disc",
        Shape::cylinder,
        {0.1 * k, 0.1 * k, 0.008 * k},
        colours::brass,
        "steel",
        "encoder_disc"},
       beside(0.236),
       0.085 * k,
       0,
       false,
       product(about_x(angle), lying)},
      {{"encoder", Shape::cylinder, {0.085 * k, 0.085 * k, 0.04 * k}, colours::steel, "steel", "encoder"},
       beside(0.264),
       0.085 * k,
       0,
       false,
       facing},
  };
  all.insert(all.end(), driven.begin(), driven.end());
  const double screw_angle = 2 * std::numbers::pi * std::fmod(rotor_.revolutions() / data_.gear.ratio, 1.0);
  if (data_.lead >= belt_lead)
    all.push_back({{"belt", Shape::box, {beam - 0.05 * k, 0.008 * k, 0.05 * k}, colours::dark, "rubber"},
                   mid,
                   0.085 * k,
                   0});
  else
    all.push_back({{"screw",
                    Shape::cylinder,
                    {0.025 * k, 0.025 * k, beam - 0.02 * k},
                    colours::steel,
                    "steel",
                    "screw"},
                   mid,
                   0.085 * k,
                   0,
                   false,
                   product(about_x(screw_angle), lying)});
}

void LinearAxis::add_carriage(std::vector<Item>& all) const {
  const double k = size_factor(data_);
  const double c = carriage_length(data_);
  all.push_back({{"home flag", Shape::box, {0.02 * k, 0.06 * k, 0.006 * k}, colours::white, "paint"},
                 0,
                 0.09 * k,
                 0.083 * k,
                 true});
  all.push_back({{"carriage", Shape::box, {c, 0.03 * k, 0.16 * k}, colours::moving, "paint", "carriage"},
                 0,
                 0.117 * k,
                 0,
                 true});
}

void LinearAxis::add_blade(std::vector<Item>& all) const {
  const double k = size_factor(data_);
  const double stroke = tool_.level ? 0 : 1;
  const double web = -data_.place_y;  // height of the web over the beam's lower side
  const double reach = -data_.place_z;
  const double blade = web + 0.05 + 0.07 * stroke;
  all.push_back(
      {{"column", Shape::box, {0.1, 0.24, 0.06}, colours::moving, "paint"}, 0, 0.13 * k + 0.12, 0, true});
  all.push_back({{"arm", Shape::box, {0.08, 0.06, reach + 0.24}, colours::moving, "paint"},
                 0,
                 0.13 * k + 0.22,
                 (reach + 0.18) / 2,
                 true});
  all.push_back(
      {{"ram", Shape::box, {0.05, 0.3, 0.05}, colours::steel, "steel"}, 0, blade + 0.18, reach, true});
  all.push_back(
      {{"blade", Shape::wedge, {0.03, 0.1, 0.34}, colours::red, "blade", "", std::array{0.0, -0.05, 0.17}},
       0,
       blade,
       reach,
       true});
}

void LinearAxis::add_guide(std::vector<Item>& all) const {
  const double k = size_factor(data_);
  all.push_back(
      {{"post", Shape::box, {0.04 * k, 0.2 * k, 0.04 * k}, colours::steel, "steel"}, 0, 0.23 * k, 0, true});
  all.push_back({{"arm", Shape::box, {0.03 * k, 0.025 * k, 0.2 * k}, colours::steel, "steel"},
                 0,
                 0.32 * k,
                 0.1 * k,
                 true});
  for (const double at : {-1.0, 1.0})
    all.push_back({{at < 0 ? "roller 1" : "roller 2",
                    Shape::cylinder,
                    {0.03 * k, 0.03 * k, 0.08 * k},
                    colours::dark,
                    "steel"},
                   at * 0.02 * k,
                   0.32 * k,
                   0.23 * k,
                   true,
                   about_x(right_angle)});
}

void LinearAxis::add_pen(std::vector<Item>& all) const {
  const double k = size_factor(data_);
  const double stroke = tool_.level ? 0 : 1;
  const double lift = 0.02 * k * stroke;
  all.push_back({{"pen holder", Shape::box, {0.06 * k, 0.06 * k, 0.1 * k}, colours::moving, "paint"},
                 0,
                 0.13 * k,
                 -0.08 * k,
                 true});
  all.push_back({{"pen", Shape::cylinder, {0.022 * k, 0.022 * k, 0.22 * k}, colours::red, "paint"},
                 0,
                 0.13 * k,
                 -0.13 * k + lift,
                 true});
}

std::vector<Part> LinearAxis::parts() {
  std::vector<Part> list;
  for (Item& item : items()) list.push_back(std::move(item.part));
  if (data_.tool == "pen") {
    const double wide = carrier_ != nullptr ? carrier_->data_.travel_max - carrier_->data_.travel_min : 0.05;
    const double deep = data_.travel_max - data_.travel_min;
    list.push_back({"sheet", Shape::box, {deep, wide, 0.004}, colours::white, "paint"});
    for (std::size_t i = 0; i < ink_dots; ++i)
      list.push_back(
          {fmt::format("ink {}", i + 1), Shape::box, {1.4e-3, 1.4e-3, 1.4e-3}, ink_colour, "paint"});
  }
  return list;
}

void LinearAxis::poses(std::vector<PartPose>& out) {
  const double carrier_position = carrier_ != nullptr ? carrier_->carriage_.position : 0;
  const Point zero = origin(carrier_position);
  const Quaternion attitude = product(about_y(data_.heading), about_z(data_.inclination));
  out.clear();
  for (const Item& item : items()) {
    const double along = item.along + (item.carried ? carriage_.position : 0);
    out.push_back({.pose = {point(zero, along, item.up, item.side), product(attitude, item.turned)}});
  }
  if (data_.tool != "pen") return;
  Point sheet = pen_tip(carrier_ != nullptr ? middle(carrier_->data_) : 0, middle(data_));
  sheet = point(sheet, 0, 0, -0.0025);
  out.push_back({.pose = {sheet, attitude}});
  for (std::size_t i = 0; i < ink_dots; ++i) {
    const bool drawn = i < ink_.size();
    out.push_back({.pose = {drawn ? ink_[i] : sheet, {0, 0, 0, 1}}, .visible = drawn});
  }
}

}  // namespace drycut::plants
