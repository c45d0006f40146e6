#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/severity.hpp"
#include "plants/parameters.hpp"
#include "plants/part.hpp"
#include "plants/ports.hpp"

namespace drycut::plants {

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
                         std::string meaning, Range range) {
  return {std::move(component),
          std::move(name),
          unit,
          [&value](double v) { value = v; },
          std::move(meaning),
          range};
}

/// Something that happened in the machine, at an exact time inside the step.
struct Event {
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

/// A drive of a plant, for whoever judges it.
struct DriveOfPlant {
  std::string name;         ///< within the plant: "servo", "drive"
  PowerStage* stage;        ///< lives as long as the plant
  double load_inertia = 0;  ///< all that the motor turns but its rotor, seen at the motor [kg m2]
  int alike = 1;            ///< drives that do the same, of which this is one
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
  [[nodiscard]] std::vector<Event> take_events() { return std::exchange(events_, {}); }

 protected:
  void happened(Event event) { events_.push_back(std::move(event)); }

 private:
  std::vector<Event> events_;
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
    std::string parameter;
    std::string what;
    std::string remedy;
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
