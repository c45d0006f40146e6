#include "plants/web.hpp"

#include <fmt/format.h>

#include "base/units.hpp"
#include "plants/axis_objections.hpp"

namespace drycut::plants {

namespace {

constexpr double fastest = 1000;  // [m/min]

}  // namespace

Web::Web(const WebData& data, World& world)
    : data_(data),
      world_(world),
      material_(world.add_slide({.name = "web", .mass = data.mass, .speed = data.drive.speed})),
      drive_(data.drive),
      wheel_(data.wheel, world.random("wheel"), data.drive.speed),
      marks_(data.marks, world.random("marks")),
      outfeed_(data.outfeed, section_area(data.cross_section()) * data.density, world),
      lead_end_(-data.lead) {}

void Web::drive(double h) {
  drive_.drive(material_, h);
  outfeed_.drive(drive_.roll_speed(), h);
}

void Web::sense(double h) {
  h_ = h;
  wheel_.sense(material_, h);
  marks_.sense(material_.position, h);
}

double Web::travel(double fraction) const {
  return within_step(material_.position_before, material_.position, material_.speed_before, material_.speed,
                     h_, fraction);
}

double Web::separate(double fraction) { return separate(fraction, travel(fraction)); }

double Web::separate(double fraction, double mark) {
  const double length = mark - lead_end_;
  lead_end_ = mark;
  ++pieces_;
  // A web that stands or has run back leaves nothing that a belt could carry.
  if (length > 0) outfeed_.add(travel(fraction) - mark, length, material_.speed, fraction, h_);
  return length;
}

std::vector<Port> Web::ports() {
  return {{"wheel", &wheel_.pulses.port, "encoder of the measuring wheel"},
          {"wheel.index", &wheel_.index, "its index pulse, once a turn of the wheel"},
          {"photocell", &marks_.photocell().port, "photocell over the printed marks"}};
}

std::vector<Channel> Web::channels() {
  return {
      {"speed", "m/min", [this] { return material_.speed * units::metres_a_minute; }, "speed of the web"},
      {"position", "mm", [this] { return material_.position * units::millimetres; },
       "travel of the web since the start"},
      {"set_speed", "m/min", [this] { return drive_.roll_speed() * units::metres_a_minute; },
       "set speed of the line drive after its acceleration limit"},
      {"drive.force", "N", [this] { return drive_.force(); }, "force of the line drive on the web"},
      {"wheel.count", "", [this] { return static_cast<double>(wheel_.pulses.port.count); },
       "count of the measuring wheel (x4), after faults"},
      {"lead", "mm", [this] { return (material_.position - lead_end_) * units::millimetres; },
       "web beyond the cut: the length of a piece cut now"},
      {"pieces", "", [this] { return static_cast<double>(pieces_); }, "pieces cut since the start"},
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
  if (material_.mass != data_.mass) world_.set_mass(material_, data_.mass);
}

Parameters web_parameters(WebData& data) {
  return joined(
      {
          row("speed", "m/min", "line speed at the start; the web already runs at it", data.drive.speed, 0,
              fastest, "a usual speed of a cut-to-length line"),
          row("section", "what the material is: a flat strip or a round tube", data.section,
              {"strip", "tube"}, "solid board"),
          row("thickness", "mm", "thickness of the strip, or of the tube's wall", data.thickness, 0.01, 100,
              "solid board"),
          row("width", "mm", "width of the strip, or outer diameter of the tube", data.width, 1, 10000,
              "a narrow line"),
          row("density", "kg/m3", "density of the material", data.density, 1, 20000, "solid board"),
          row("shear_strength", "MPa", "shear resistance of the material, mean over the length of the blade",
              data.shear_strength, 0, 2000, "estimate: solid board, blade with a slight helix"),
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
          row("outfeed.speed_factor", "", "speed of the outfeed belt over line speed",
              data.outfeed.speed_factor, 1, 10, "usual 10 to 30 % faster"),
          row("outfeed.friction", "", "Coulomb friction coefficient, piece on belt", data.outfeed.friction,
              0.01, 2, "estimate: board on rubber"),
          row("outfeed.start", "mm", "where the outfeed belt begins behind the cut", data.outfeed.start, 0,
              10000, "estimate"),
          row("outfeed.length", "mm", "length of the outfeed belt", data.outfeed.length, 100, 100000,
              "estimate"),
      },
      group("wheel.", wheel_parameters(data.wheel)), group("marks.", print_mark_parameters(data.marks)));
}

std::vector<PlantDefinition::Objection> WebDefinition::objections(double h) {
  AxisObjections found("web", h);
  found.pair("drive.stiffness", "drive.damping", {data.drive.stiffness, data.drive.damping, data.mass},
             "web and line drive");
  found.add(wheel_objections(data.wheel));
  if (data.section == "tube" && 2 * data.thickness > data.width)
    found.object(
        "thickness",
        fmt::format("a tube of {:g} mm has no wall of {:g} mm", data.width * 1000, data.thickness * 1000),
        fmt::format("at most {:g} mm", data.width * 500));
  const auto& marks = data.marks;
  if (marks.pitch > 0 && marks.pitch <= marks.width + 2 * marks.hysteresis + 6 * marks.scatter)
    found.object(
        "marks.pitch",
        fmt::format("marks of {:g} mm at {:g} mm leave no gap", marks.width * 1000, marks.pitch * 1000),
        fmt::format("more than {:g} mm (width, twice the hysteresis, six times the scatter)",
                    (marks.width + 2 * marks.hysteresis + 6 * marks.scatter) * 1000));
  if (marks.pitch > 0 && data.drive.speed * h > marks.width)
    found.object("marks.width",
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
