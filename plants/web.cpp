#include "plants/web.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/axis_objections.hpp"
#include "plants/materials.hpp"

namespace drycut::plants {

namespace {

constexpr double fastest = 1000;     // [m/min]
constexpr double held_time = 20e-3;  // a web that is held back is reported after this [s]
constexpr double kept_speed = 0.95;  // a slower web, of its line drive's speed, is held back

}  // namespace

Web::Web(const WebData& data, World& world)
    : data_(data),
      world_(world),
      material_(world.add_slide({.name = "web", .mass = data.mass, .speed = data.drive.speed})),
      drive_(data.drive),
      wheel_(data.wheel, world.random("wheel"), data.drive.speed),
      marks_(data.marks, world.random("marks")),
      outfeed_(data.outfeed, section_area(data.cross_section()) * data.density, world),
      lead_end_(-data.lead),
      last_cut_(-data.lead) {
  if (!data.strip.on) return;
  strip_.emplace(data.strip, data.springs(), data.mass, data.drive.speed, material_, world);
  strip_->weigh(overhang());
}

void Web::drive(double h) {
  if (strip_) strip_->drive();
  drive_.drive(strip_ ? strip_->puller() : material_, h);
  outfeed_.drive(drive_.roll_speed(), h);
}

void Web::sense(double h) {
  h_ = h;
  watch_drive(h);
  wheel_.sense(at_wheel(), h);
  if (strip_) return sense_strip(h);
  marks_.sense(material_.position, h);
}

void Web::watch_drive(double h) {
  if (!drive_.at_limit()) {
    held_ = 0;
    return;
  }
  const double set = drive_.roll_speed();
  const double speed = (strip_ ? strip_->puller() : material_).speed;
  if (speed * set >= kept_speed * set * set) return;
  const bool was = held_ >= held_time;
  held_ += h;
  if (was || held_ < held_time) return;
  happened({"held_back",
            1,
            {{"force", std::abs(drive_.force()), "N"},
             {"speed", speed * units::metres_a_minute, "m/min"},
             {"set_speed", set * units::metres_a_minute, "m/min"}}});
}

void Web::sense_strip(double h) {
  marks_.sense(strip_->travel_at(data_.marks.photocell), h);
  strip_->weigh(overhang());
  const bool was = slack_;
  slack_ = strip_->loop() > (was ? 0 : data_.strip.loop_limit);
  if (slack_ && !was) happened({"slack", 1, {{"loop", strip_->loop() * units::millimetres, "mm"}}});
}

std::vector<EventType> Web::event_types() {
  return {{"slack",
           {{"loop", "mm"}},
           "the elastic web does not push: so much of it lies in loops before the cut; once until it is "
           "straight again",
           Severity::warning},
          {"held_back",
           {{"force", "N"}, {"speed", "m/min"}, {"set_speed", "m/min"}},
           "the line drive has stood at its largest force for 20 ms while the web ran at less than 95 % of "
           "its set speed: something holds the web; once until the force is below its limit again",
           Severity::error}};
}

double Web::travel(double fraction) const {
  return within_step(material_.position_before, material_.position, material_.speed_before, material_.speed,
                     h_, fraction);
}

double Web::separate(double fraction) { return separate(fraction, travel(fraction)); }

double Web::separate(double fraction, double mark) {
  const double length = sever_at(material_, mark).length;
  sever(material_, fraction, mark, false);
  return length;
}

Slide* Web::lying_at(double x) {
  if (x < material_.position - lead_end_) return &material_;
  const Outfeed::Piece* piece = outfeed_.lying_at(x);
  return piece != nullptr ? piece->body : nullptr;
}

Web::Severed Web::sever_at(const Slide& what, double mark) const {
  if (&what == &material_) return {mark - lead_end_, 0};
  const double half = outfeed_.piece_of(what).length / 2;
  return {half + mark, half - mark};
}

void Web::sever(Slide& what, double fraction, double mark, bool drop) {
  const auto [length, rest] = sever_at(what, mark);
  ++pieces_;
  if (drop) {
    ++scraps_;
    scrap_length_ += length;
  }
  if (&what != &material_) {
    last_cut_ = outfeed_.piece_of(what).mark - rest;
    outfeed_.divide(what, length, drop, h_);
    return;
  }
  lead_end_ = last_cut_ = mark;
  // A web that stands or has run back leaves nothing that a belt could carry.
  if (length > 0 && !drop)
    outfeed_.add({.tail = travel(fraction) - mark, .length = length, .mark = mark}, material_.speed, fraction,
                 h_);
}

void Web::make_room(double from, double to) {
  rooms_.insert(std::upper_bound(rooms_.begin(), rooms_.end(), std::pair(from, to)), {from, to});
  outfeed_.follow_closely();
  marks_.keep(to);
}

std::vector<Port> Web::ports() {
  return {{"wheel", &wheel_.pulses.port, "encoder of the measuring wheel"},
          {"wheel.index", &wheel_.index, "its index pulse, once a turn of the wheel"},
          {"photocell", &marks_.photocell().port, "photocell over the printed marks"}};
}

std::optional<PlugScale> Web::scale_of(std::string_view port) const {
  if (port == "wheel") return PlugScale{4.0 * data_.wheel.lines / data_.wheel.circumference, false};
  return {};
}

std::vector<Recurrence> Web::recurrences() { return {{"wheel", data_.wheel.circumference}}; }

std::vector<Channel> Web::channels() {
  return {
      {"speed", "m/min", [this] { return material_.speed * units::metres_a_minute; }, "speed of the web"},
      {"position", "mm", [this] { return material_.position * units::millimetres; },
       "travel of the web since the start"},
      {"set_speed", "m/min", [this] { return drive_.roll_speed() * units::metres_a_minute; },
       "set speed of the line drive after its acceleration limit"},
      {"drive.force", "N", [this] { return drive_.force(); }, "force of the line drive on the web"},
      {"tension", "N", [this] { return strip_ ? strip_->tension() : 0; },
       "tension of an elastic web between wheel and cut, below 0 where it pushes"},
      {"puller.tension", "N", [this] { return strip_ ? strip_->puller_tension() : 0; },
       "the same between line drive and wheel"},
      {"loop", "mm", [this] { return strip_ ? strip_->loop() * units::millimetres : 0; },
       "material of an elastic web that lies in loops before the cut"},
      {"wheel.speed", "m/min", [this] { return at_wheel().speed * units::metres_a_minute; },
       "speed of the web at the measuring wheel"},
      {"wheel.stretch", "mm",
       [this] { return (material_.position - at_wheel().position) * units::millimetres; },
       "travel of the web at the cut less that at the measuring wheel"},
      {"wheel.count", "", [this] { return static_cast<double>(wheel_.pulses.port.count); },
       "count of the measuring wheel (x4), after faults"},
      {"lead", "mm", [this] { return (material_.position - lead_end_) * units::millimetres; },
       "web beyond the cut: the length of a piece cut now"},
      {"pieces", "", [this] { return static_cast<double>(pieces_); }, "pieces cut since the start"},
      {"scrap.pieces", "", [this] { return static_cast<double>(scraps_); }, "pieces that have dropped out"},
      {"scrap.length", "mm", [this] { return scrap_length_ * units::millimetres; }, "length of all of them"},
      {"photocell", "", [this] { return marks_.photocell().port.level ? 1.0 : 0.0; },
       "photocell over the printed marks"},
      {"outfeed.pieces", "", [this] { return static_cast<double>(outfeed_.on_belt()); },
       "pieces on the outfeed belt"},
  };
}

std::vector<Setting> Web::settings() {
  return {{"speed",
           "m/min",
           [this](double v) { drive_.set_speed(v); },
           [this] { return drive_.set_speed(); },
           "set speed of the line drive",
           {-fastest, fastest, false}}};
}

std::vector<Fault> Web::faults() {
  std::vector<Fault> faults;
  wheel_.offer_faults(faults, "wheel");
  marks_.offer_faults(faults, "marks", "photocell");
  return faults;
}

Parameters Web::live_parameters() { return live_rows(web_parameters(data_)); }

void Web::parameters_changed() {
  drive_.take(data_.drive);
  Slide& pulled = strip_ ? strip_->puller() : material_;
  if (pulled.mass != data_.mass) world_.set_mass(pulled, data_.mass);
}

void Web::visit(StateArchive& archive) {
  STATE(archive, drive_, wheel_, marks_, outfeed_, slack_, held_, h_, lead_end_, last_cut_, pieces_, scraps_,
        scrap_length_);
  if (strip_) archive.named("strip_", *strip_);
}

Parameters web_parameters(WebData& data) {
  return joined(
      {
          row("speed", "m/min", "line speed at the start; the web already runs at it", data.drive.speed, 0,
              fastest, "a usual speed of a cut-to-length line"),
          row("section", "what the material is: a flat strip or a round tube", data.section,
              {"strip", "tube"}, "solid board"),
          preset_row("material", "whose density, shear_strength, elasticity and retardation are the defaults",
                     data.material, materials(), "solid board"),
          row("thickness", "mm", "thickness of the strip, or of the tube's wall", data.thickness, 0.01, 100,
              "solid board"),
          row("width", "mm", "width of the strip, or outer diameter of the tube", data.width, 1, 10000,
              "a narrow line"),
          row("density", "kg/m3", "density of the material", data.density, 10, 20000, "solid board"),
          row("shear_strength", "MPa", "shear resistance of the material, mean over the length of the blade",
              data.shear_strength, 0, 2000, "estimate: solid board, blade with a slight helix"),
          row("elastic", "the web stretches between line drive, measuring wheel and cut", data.strip.on,
              "off: a rigid web"),
          row("elasticity", "MPa", "modulus of elasticity along the line, of an elastic web",
              data.strip.elasticity, 1, 1e6, "estimate: solid board along the machine"),
          row("retardation", "us", "damping over stiffness of the material, of an elastic web",
              data.strip.retardation, 0, 1e5, "estimate: loss factor of 3 % at 100 Hz"),
          row("guide_distance", "mm",
              "free length between guides, over which an elastic web that is pushed buckles (Euler)",
              data.strip.guide_distance, 1, 100000, "estimate: table with holding-down rollers"),
          row("loop_limit", "mm", "material in loops that is reported as slack", data.strip.loop_limit, 0,
              10000, "estimate: a loop that is seen"),
          live(row("mass", "kg", "mass that moves with the web", data.mass, 0.01, 1e5,
                   "estimate: 10 m of strip, 2 kg, and the rolls that it drives")),
          row("lead", "mm", "web beyond the cut at the start; the first piece is longer by it", data.lead, 0,
              100000, "the lead end is at the cut"),
          live(row("drive.acceleration", "m/s2", "largest acceleration of the line drive",
                   data.drive.acceleration, 1e-3, 1000, "estimate: a second to 120 m/min")),
          live(row("drive.stiffness", "N/m", "stiffness of the web between line drive and cut",
                   data.drive.stiffness, 1, 1e9, "estimate: 16 Hz with 20 kg")),
          live(row("drive.damping", "N s/m", "damping of the line drive's speed loop on the web",
                   data.drive.damping, 0, 1e7, "estimate: 70 % of critical")),
          live(row("drive.max_force", "N", "largest force of the line drive before it slips",
                   data.drive.max_force, 0.1, 1e6, "estimate")),
          row("drive.distance", "mm", "from the line drive's rolls to the cut", data.strip.puller_distance,
              10, 100000, "a short line"),
          row("outfeed.speed_factor", "", "speed of the outfeed belt over line speed",
              data.outfeed.speed_factor, 1, 10, "usual 10 to 30 % faster"),
          row("outfeed.friction", "", "Coulomb friction coefficient, piece on belt", data.outfeed.friction,
              0.01, 2, "estimate: board on rubber"),
          row("outfeed.start", "mm", "where the outfeed belt begins behind the cut", data.outfeed.start, 0,
              10000, "estimate"),
          row("outfeed.length", "mm", "length of the outfeed belt", data.outfeed.length, 100, 100000,
              "estimate"),
      },
      group("wheel.", wheel_parameters(data.wheel)),
      Parameters{
          row("wheel.distance", "mm", "from the measuring wheel to the cut", data.strip.wheel_distance, 1,
              100000, "behind the line drive of a short line"),
          row("wheel.mass", "kg", "inertia of the wheel over the square of its radius, on an elastic web",
              data.strip.wheel_mass, 0, 100, "estimate: aluminium wheel of 500 mm"),
      },
      group("marks.", print_mark_parameters(data.marks)));
}

std::vector<PlantDefinition::Objection> WebDefinition::objections(double h) {
  AxisObjections found("web", h);
  found.pair("drive.stiffness", "drive.damping", {data.drive.stiffness, data.drive.damping, data.mass},
             "web and line drive");
  if (data.strip.wheel_distance >= data.strip.puller_distance)
    found.object(
        "plant.parameters-contradict"_code, "wheel.distance",
        fmt::format("the wheel, {:g} mm before the cut, is not behind the line drive, {:g} mm before it",
                    data.strip.wheel_distance * 1000, data.strip.puller_distance * 1000),
        fmt::format("less than {:g} mm, or more drive.distance", data.strip.puller_distance * 1000));
  else if (data.strip.on) {
    const StripSprings springs = data.springs();
    found.pair("elasticity", "retardation", springs.at_puller(data.mass), "web between line drive and wheel");
    found.pair("elasticity", "retardation", springs.at_cut(), "web between wheel and cut");
  }
  found.add(wheel_objections(data.wheel));
  if (data.section == "tube" && 2 * data.thickness > data.width)
    found.object(
        "plant.parameters-contradict"_code, "thickness",
        fmt::format("a tube of {:g} mm has no wall of {:g} mm", data.width * 1000, data.thickness * 1000),
        fmt::format("at most {:g} mm", data.width * 500));
  const auto& marks = data.marks;
  if (marks.pitch > 0 && marks.pitch <= marks.width + 2 * marks.hysteresis + 6 * marks.scatter)
    found.object(
        "plant.parameters-contradict"_code, "marks.pitch",
        fmt::format("marks of {:g} mm at {:g} mm leave no gap", marks.width * 1000, marks.pitch * 1000),
        fmt::format("more than {:g} mm (width, twice the hysteresis, six times the scatter)",
                    (marks.width + 2 * marks.hysteresis + 6 * marks.scatter) * 1000));
  if (marks.pitch > 0 && data.drive.speed * h > marks.width)
    found.object("plant.step-too-long"_code, "marks.width",
                 fmt::format("at {:g} m/min a mark of {:g} mm is past the photocell within a step of {:g} us",
                             data.drive.speed * units::metres_a_minute, marks.width * 1000, h * 1e6),
                 step_remedy(marks.width / data.drive.speed));
  return found.take();
}

std::unique_ptr<Plant> WebDefinition::build(World& world,
                                            const std::function<Plant*(std::string_view)>& find) {
  (void)find;
  return std::make_unique<Web>(data, world);
}

}  // namespace drycut::plants
