#pragma once
#include <drycut/problem.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace drycut {
class StateArchive;
}

namespace drycut::plants {

/// The word by which a reference parameter names no plant, where its default does.
inline constexpr std::string_view no_plant = "none";

/// The word by which a group of a motor's values names no model of a catalogue.
inline constexpr std::string_view no_model = "none";

/// A choice of a word that stands for values of other parameters of the same table, "steel" for its density
/// and more. Whoever fills the table takes these values first, then those that are given beside it.
struct Preset {
  struct Value {
    std::string_view parameter;
    double value;              ///< [SI]
    std::string_view source;   ///< where it is from
    std::string_view of = {};  ///< the parameter of which `value` is the share; "" = it is the value itself
  };
  std::string_view name;
  std::string_view meaning;
  std::vector<Value> values;
};

/// One parameter of a plant, bound to the member that holds it. A plain struct with defaults is the schema:
/// this table over it is what the scenario reader fills, `drycut check --expand` writes and `drycut plants`
/// prints.
struct Parameter {
  std::string name;          ///< as in the scenario; a dot is a nested map ("servo.rated_torque")
  std::string_view unit;     ///< unit in which it is printed and in which min and max are given; "" = pure
                             ///< number. The bound member always holds SI (m, kg, s, rad, N m, V).
  std::string_view meaning;  ///< one sentence
  /// What it is bound to: a quantity or number, an integer, a switch, a word.
  std::variant<double*, int*, bool*, std::string*> value;
  double min = 0;  ///< smallest and largest legal value, in `unit`
  double max = 0;
  std::vector<std::string> choices = {};  ///< of a word; empty = free
  std::string_view reference = {};        ///< of a word: it names another plant of this type
  std::string_view source = {};           ///< where the default is from ("data sheet ...", "estimate")
  bool sole = false;                      ///< of a reference: no other plant may refer to the same one so
  const std::vector<Preset>* presets = nullptr;  ///< of a word: what each choice stands for
  bool live = false;                             ///< of a quantity: the running machine takes another one
};
using Parameters = std::vector<Parameter>;

// The rows of a table: a quantity, a whole number, a switch, a word of `choices`, the name of a plant of
// `type`. `source`: where the default is from.

inline Parameter row(std::string name, std::string_view unit, std::string_view meaning, double& value,
                     double min, double max, std::string_view source) {
  return {std::move(name), unit, meaning, &value, min, max, {}, {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, int& value, double min, double max,
                     std::string_view source) {
  return {std::move(name), "", meaning, &value, min, max, {}, {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, bool& value, std::string_view source) {
  return {std::move(name), "", meaning, &value, 0, 1, {}, {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, std::string& value,
                     std::vector<std::string> choices, std::string_view source) {
  return {std::move(name), "", meaning, &value, 0, 0, std::move(choices), {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, std::string& value, std::string_view type,
                     std::string_view source, bool sole) {
  return {std::move(name), "", meaning, &value, 0, 0, {}, type, source, sole};
}

/// A word whose choices are the names of `presets`, which outlive the table.
inline Parameter preset_row(std::string name, std::string_view meaning, std::string& value,
                            const std::vector<Preset>& presets, std::string_view source) {
  std::vector<std::string> names;
  names.reserve(presets.size());
  for (const Preset& preset : presets) names.emplace_back(preset.name);
  Parameter made = row(std::move(name), meaning, value, std::move(names), source);
  made.presets = &presets;
  return made;
}

/// The model of a motor, "servo.model", before its group: whoever fills the table knows a catalogue, plants
/// know none.
inline Parameter model_row(std::string name, std::string& value) {
  return row(std::move(name),
             "motor of the catalogue, whose values are the defaults of this group: drycut plants --motors",
             value, {}, "none: the defaults are those below");
}
/// The same row of a parameter that may change in mid-run: see Plant::live_parameters.
inline Parameter live(Parameter row) {
  row.live = true;
  return row;
}
/// Those rows of a table alone.
inline Parameters live_rows(Parameters rows) {
  std::erase_if(rows, [](const Parameter& row) { return !row.live; });
  return rows;
}

/// The rows of a group, "gear.": each name with the prefix.
inline Parameters group(std::string_view prefix, Parameters rows) {
  for (Parameter& row : rows) row.name.insert(0, prefix);
  return rows;
}
/// One table after the other.
template <class... Tables>
Parameters joined(Parameters first, Tables... more) {
  (first.insert(first.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end())),
   ...);
  return first;
}

/// A rigid pose in the world [m], quaternion x y z w. World axes: x along the line in web direction, y up,
/// z across the line towards the operator.
struct Pose {
  std::array<double, 3> position = {0, 0, 0};
  std::array<double, 4> rotation = {0, 0, 0, 1};
};

/// Where a part is now. Parts that come and go (cut pieces) are of a fixed set and hidden while unused.
struct PartPose {
  PartPose(const Pose& where = {}, bool shown = true, const std::array<double, 3>& stretch = {1, 1, 1})
      : pose(where), visible(shown), scale(stretch) {}
  Pose pose;
  bool visible;
  std::array<double, 3> scale;  ///< of the part along its own axes
};

/// What parts are fastened to, a carriage or a drum: tells where it is now, and whether and how stretched its
/// parts are seen. Empty: the floor, which is the world.
using Frame = std::function<PartPose()>;

/// What a machine part looks like: a primitive, or a model of scenes/meshes/ stretched to the same size. For
/// pictures only, physics never reads it.
struct Part {
  enum class Shape { box, cylinder, wedge };  ///< cylinder axis: z; wedge: a blade, edge towards -y
  std::string name;                           ///< unique in its plant: "drum", "blade 1"
  Shape shape = Shape::box;
  std::array<double, 3> size = {1, 1,
                                1};  ///< box: x y z; cylinder: diameter, diameter, length; wedge: x y z [m]
  std::array<float, 3> colour = {0.6F, 0.6F, 0.6F};
  std::string material = "steel";  ///< "steel", "paint", "rubber", "web", "blade"
  std::string model = {};          ///< drawn in place of the shape: "servo_motor"; "" = none
  Frame frame = {};
  Pose offset = {};  ///< of its middle in the frame
  std::optional<std::array<double, 3>> tip =
      {};                  ///< in its own coordinates [m]: what leaves a trail in pictures
  bool ends_kept = false;  ///< one long across the line (z) stretches its model in the middle only
  double pitch = 0;  ///< it looks the same again after this angle, as a drum after one of its blades [rad];
                     ///< 0 = a film need not show how it turns

  [[nodiscard]] PartPose now() const;
};

/// What a picture points out on the machine at this instant.
struct Callout {
  enum class Kind { length, force, speed };
  Kind kind = Kind::length;
  std::string text;  ///< a length: "800.0 mm"; a force: what it is, "cut"; a speed: what moves, "tube"
  std::array<double, 3> at = {0, 0, 0};  ///< one end of the length, or where the arrow begins [m, world]
  std::array<double, 3> to = {0, 0, 0};  ///< the other end [m, world], the force [N], the speed [m/s]
};

/// Where an axis is to go, as a picture shows it: a line across it [m, world].
struct QuotaLine {
  std::array<double, 3> left = {0, 0, 0};
  std::array<double, 3> right = {0, 0, 0};
  double miss = 0;  ///< where the axis is now less the quota [m]
};

// The plugs of a plant, named from the plant's side. The bus (sim) copies between these and the controller's
// terminals once a step; a plant never knows what is plugged in.

/// A quadrature transducer, after its faults: what a counter input sees.
struct EncoderPort {
  std::int64_t count = 0;  ///< bits x4 since the start
  double before = 0;       ///< exact position at the start of the last step [bits x4]
  double now = 0;          ///< exact position at its end [bits x4]
  /// The count at a fraction 0..1 of the last step. Edges lie half-way between whole positions, so that a
  /// machine that stands on a whole position, an index pulse for one, counts the same whatever the last digit
  /// says.
  [[nodiscard]] std::int64_t count_at(double fraction) const {
    return static_cast<std::int64_t>(std::floor(before + (now - before) * fraction + 0.5));
  }
  void visit(StateArchive& archive);
};

/// A signal that the plant gives: sensor, index pulse, in-position.
struct SignalPort {
  struct Edge {
    bool rising = false;
    double fraction = 0;  ///< when in the last step, 0..1
    double width = 0;     ///< of the zero pulse that begins here, in steps; 0 = as its falling edge says
    void visit(StateArchive& archive);
  };
  bool level = false;       ///< at the end of the last step
  std::vector<Edge> edges;  ///< of the last step, in order of time
  void add_edge(bool rising, double fraction, double width = 0) {
    edges.push_back({rising, fraction, width});
  }
  /// Takes the level, with an edge at `fraction` of the step where it changes; true then.
  bool show(bool now, double fraction = 1) {
    if (now == level) return false;
    level = now;
    add_edge(now, fraction);
    return true;
  }
  void visit(StateArchive& archive);
};

/// A signal that the plant takes: enable, forward, brake release.
struct CommandPort {
  bool level = false;
  void visit(StateArchive& archive);
};

/// An analogue reference that the plant takes [V].
struct ReferencePort {
  double volts = 0;
  void visit(StateArchive& archive);
};

/// A pulse train that the plant takes: pulses since the start, each one counted whatever its direction, which
/// is a signal of its own as on the cable. Never decreases; the pulses of a step come evenly within it.
struct PulsePort {
  std::int64_t pulses = 0;
  void visit(StateArchive& archive);
};

class World;
class PowerStage;

/// A plug of a plant: its name within the plant ("encoder", "servo.reference") and where it is.
struct Port {
  std::string name;
  std::variant<EncoderPort*, SignalPort*, CommandPort*, ReferencePort*, PulsePort*> plug;
  std::string meaning;
};

/// A number that can be recorded, checked and plotted, already in `unit`.
struct Channel {
  std::string name;  ///< within the plant: "angle", "motor.torque"
  std::string unit;  ///< as written in trace.csv, "" = pure number
  std::function<double()> read;
  std::string meaning;
};

/// What a setting or fault takes, in its unit. The default is a switch: 0 or 1.
struct Range {
  double min = 0;
  double max = 1;
  bool whole = true;
};
inline constexpr Range in_percent = {0, 100, false};                     ///< a share
inline constexpr Range in_counts = {-2147483648.0, 2147483647.0, true};  ///< what counters hold

/// A number that the timeline can set or ramp: the line speed, a bench input. Value in SI.
struct Setting {
  std::string name;       ///< within the plant: "speed"
  std::string_view unit;  ///< display unit, for dimension checks; "" = pure number
  std::function<void(double)> write;
  std::function<double()> read;
  std::string meaning;
  Range range = {};  ///< whoever writes keeps to it
};

/// A fault that a component offers. Value in SI.
struct Fault {
  std::string component;  ///< within the plant: "encoder", "servo"
  std::string name;       ///< "lose_counts", "stuck", "drift"
  std::string_view unit;  ///< "" = pure number
  std::function<void(double)> act;
  std::string meaning;
  Range range = {};  ///< whoever acts keeps to it
  /// What the machine has without the fault, where it stands in for a parameter; none = 0.
  std::function<double()> without = {};
  double strong =
      1;  ///< a value that shows, to try the fault with [SI, as the value]; 0 = it alone does nothing
};

// Rows of the lists above for what is kept in a member.

/// 1 while `state` is on.
inline Channel on_off(std::string name, const bool& state, std::string meaning) {
  return {std::move(name), "", [&state] { return state ? 1.0 : 0.0; }, std::move(meaning)};
}
/// 1: `state` is on, 0: off again.
inline Fault fault_state(std::string component, std::string name, bool& state, std::string meaning) {
  return {std::move(component), std::move(name), "", [&state](double v) { state = v != 0; },
          std::move(meaning)};
}
inline Fault fault_value(std::string component, std::string name, std::string_view unit, double& value,
                         std::string meaning, Range range, double strong = 1) {
  return {std::move(component), std::move(name), unit, [&value](double v) { value = v; },
          std::move(meaning),   range,           {},   strong};
}

/// Something that happened in the machine, at an exact time inside the step.
struct MachineEvent {
  struct Value {
    std::string_view name;
    double number;
    std::string_view unit;
  };
  std::string_view name;      ///< "cut", "tear", "buckle"
  double fraction = 1;        ///< when in the last step, 0..1
  std::vector<Value> values;  ///< already in their units
};

/// An event that a plant can report and the values that come with it, for checks and messages.
struct EventType {
  struct Value {
    std::string_view name;
    std::string_view unit;
  };
  std::string_view name;
  std::vector<Value> values;
  std::string_view meaning;
  Severity severity = Severity::note;
};

/// What severs the web tells so with an event of this name: its plant is a cutter.
inline constexpr std::string_view cut_event = "cut";

/// What a motor and its drive are rated for, over the speed of the motor [rad/s, either sign].
struct DriveRatings {
  double rotor_inertia = 0;        ///< [kg m2]
  double stall_torque = 0;         ///< for ever, at standstill [N m]
  double rated_torque = 0;         ///< for ever, at rated speed [N m]
  double peak_torque = 0;          ///< up to rated speed [N m]
  double torque_at_max_speed = 0;  ///< largest there, falling linearly from rated speed [N m]
  double rated_speed = 0;          ///< [rad/s]
  double max_speed = 0;            ///< [rad/s]; no driving torque is left 5 % above
  /// The torque limit acts in normal work: an inverter's ramp waits at it, a motor on the mains passes its
  /// pull-out torque whenever it starts.
  bool works_at_limit = false;

  [[nodiscard]] double continuous(double speed) const;  ///< torque for ever: S1 [N m]
  [[nodiscard]] double peak(double speed) const;        ///< largest driving torque [N m]

  bool operator==(const DriveRatings&) const = default;
  /// Names every member to `archive`, as archive(key, member).
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("rotor_inertia", self.rotor_inertia);
    archive("stall_torque", self.stall_torque);
    archive("rated_torque", self.rated_torque);
    archive("peak_torque", self.peak_torque);
    archive("torque_at_max_speed", self.torque_at_max_speed);
    archive("rated_speed", self.rated_speed);
    archive("max_speed", self.max_speed);
    archive("works_at_limit", self.works_at_limit);
  }
};

/// A drive of a plant, for whoever judges it.
struct DriveOfPlant {
  std::string name;          ///< within the plant: "servo", "drive"
  PowerStage* stage;         ///< lives as long as the plant
  double load_inertia = 0;   ///< all that the motor turns but its rotor, seen at the motor [kg m2]
  double efficiency = 1;     ///< of all between motor and load while it drives; 1: no losses are counted
  int alike = 1;             ///< drives that do the same, of which this is one
  double cogging = 0;        ///< amplitude of the motor's torque without current [N m]
  double torque_ripple = 0;  ///< amplitude over its torque
};

/// Something that turns with the line: what is wrong with it comes back once a turn.
struct Recurrence {
  std::string name;   ///< within the plant: "wheel"
  double travel = 0;  ///< of the web in a turn [m]; 0: it goes by the cuts
  double cuts = 0;    ///< in a turn
};

/// What the signal of a plug is of the motion that it stands for.
struct PlugScale {
  double value = 0;  ///< encoder: counts (x4) a metre or radian of what is driven; reference: its speed at 10
                     ///< V [m/s or rad/s]
  bool turns = false;  ///< what is driven turns: radians
  double radius = 0;   ///< of what turns: where it touches the material [m], 0 = it does not
};

/// A machine or a part of a line. Bodies live in the World; everything else that acts is explicit.
/// Per step h: drive() of all plants, World::step(), sense() of all plants, in scenario order.
class Plant {
 public:
  Plant() = default;
  virtual ~Plant() = default;
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  /// Applies drive, transmission, friction and process forces for the coming step of `h` seconds.
  virtual void drive(double h) = 0;
  /// Updates transducers, cuts and events from what the bodies did in the last step of `h` seconds.
  virtual void sense(double h) = 0;

  /// All that changes while it runs, but the bodies, which are the world's, and the live parameters. Between
  /// two steps, as its events have been taken.
  virtual void visit(StateArchive& archive) = 0;
  /// The same with the live parameters: what whoever keeps a state visits. Before the world, whose bodies
  /// have the last word on their masses.
  void visit_all(StateArchive& archive);

  // What it offers; asked once after construction. Pointers and functions stay valid as long as the plant.
  virtual std::vector<Port> ports() { return {}; }
  virtual std::vector<Channel> channels() { return {}; }
  virtual std::vector<Setting> settings() { return {}; }
  virtual std::vector<Fault> faults() { return {}; }
  virtual std::vector<EventType> event_types() { return {}; }
  virtual std::vector<DriveOfPlant> drives() { return {}; }
  virtual std::vector<Recurrence> recurrences() { return {}; }
  /// Of the plug of that name, as its parameters say, errors of them left out; nothing where it has none.
  [[nodiscard]] virtual std::optional<PlugScale> scale_of(std::string_view /*port*/) const { return {}; }
  virtual std::vector<Part> parts() { return {}; }
  /// The parameters that may change while it runs, bound to the machine itself: the rows of its table that
  /// are `live`. Whoever writes one keeps to its range and calls parameters_changed() then.
  virtual Parameters live_parameters() { return {}; }
  /// Takes over what was written there. A body of another mass or inertia keeps its speed, not its momentum:
  /// what is put on it comes with that speed.
  virtual void parameters_changed() {}
  /// Adds what a picture points out now; called only when a frame is taken.
  virtual void callouts(std::vector<Callout>& out) { (void)out; }
  /// Where a picture shows the quota that the machine is driven to [m, along its axis]; none if it has no
  /// such line.
  [[nodiscard]] virtual std::optional<QuotaLine> quota_line(double /*quota*/) const { return {}; }

  [[nodiscard]] bool has_events() const { return !events_.empty(); }
  [[nodiscard]] std::vector<MachineEvent> take_events() { return std::exchange(events_, {}); }

 protected:
  void happened(MachineEvent event) { events_.push_back(std::move(event)); }
  /// What happened to its drive, with the motor's `rotor`.
  template <class Drive, class Rotor>
  void happened_to(Drive& drive, const Rotor& rotor) {
    if (!drive.has_events()) return;
    for (MachineEvent& event : drive.take_events(rotor)) happened(std::move(event));
  }

 private:
  std::vector<MachineEvent> events_;
  std::optional<Parameters> live_;  ///< once a state was kept
};

/// The definition of one plant in a scenario: parameters with defaults, then the machine built from them.
class PlantDefinition {
 public:
  virtual ~PlantDefinition() = default;
  /// The parameter table, bound to this definition.
  virtual Parameters parameters() = 0;
  /// What is wrong with the parameters taken together ("blade_count 0 ..."), each naming its parameter, where
  /// the simulation steps by `h` seconds; ranges of single parameters are checked by the reader.
  struct Objection {
    Code code;
    std::string parameter;
    Prose what;
    Prose remedy;
  };
  virtual std::vector<Objection> objections(double h) {
    (void)h;
    return {};
  }
  /// Gives the definition of the plant of that name, null where there is none.
  using FindDefinition = std::function<PlantDefinition*(std::string_view)>;
  /// What is wrong with the parameters together with those of the plants that they refer to.
  virtual std::vector<Objection> objections_with(const FindDefinition& find, double h) {
    (void)find;
    (void)h;
    return {};
  }
  /// The stretch of a line that the machine takes [m], where it works on one: no other may stand there.
  struct Stretch {
    double from;
    double to;
  };
  [[nodiscard]] virtual std::optional<Stretch> stretch() const { return {}; }
  /// Builds the machine into `world`. `find` gives the already built plant that a reference parameter names.
  virtual std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) = 0;
};

/// The plant that a reference parameter names, already built: of class `Machine`, in a scenario `type`.
/// Throws std::invalid_argument that tells how to name one; `or_none` where none may be named too.
template <class Machine>
Machine& referred(const std::function<Plant*(std::string_view)>& find, std::string_view parameter,
                  const std::string& name, std::string_view type, std::string_view or_none = "") {
  auto* machine = dynamic_cast<Machine*>(find(name));
  if (machine == nullptr)
    throw std::invalid_argument(std::string(parameter)
                                    .append(": '" + name + "' is no plant of type ")
                                    .append(type)
                                    .append("; name one that stands before this one")
                                    .append(or_none));
  return *machine;
}

/// One type of plant: the registry behind `type:` in a scenario and `drycut plants`.
struct PlantType {
  std::string_view name;  ///< "rotary_knife"
  std::string_view summary;
  std::unique_ptr<PlantDefinition> (*define)();
};

/// All plant types, in order of name.
const std::vector<PlantType>& plant_types();

}  // namespace drycut::plants
