#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "plants/plant.hpp"
#include "sim/time.hpp"

namespace drycut::devices {
class Controller;
}

namespace drycut::sim::scenario {

// A scenario file as plain structs with defaults: the schema, the reader's target and the writer's source
// (design §5). Everything that can be wrong later (a name that no plant has) keeps its place in the file.

/// Where in the scenario something stands: line and column (in characters), 1-based.
struct ScenePlace {
  int line = 0;
  int column = 0;
  /// Which text: 0 the scenario file, n the n-th override, then files that it extends; index of
  /// Scenario::sources.
  int source = 0;
  bool operator==(const ScenePlace&) const = default;
};
struct Text {
  std::string text;
  ScenePlace place;  ///< of the first character of `text`, inside quotes if it has some
  /// From byte `offset` of `text` on, the file continues at `place` (escapes, folded lines, UTF-8).
  struct Break {
    std::size_t offset = 0;
    ScenePlace place;
  };
  std::vector<Break> breaks = {};
  /// Where byte `offset` of `text` stands.
  [[nodiscard]] ScenePlace at(std::size_t offset) const;
};

struct SceneSection {
  std::string title;
  Time step = 100 * microsecond;
  Time duration = 10 * second;
  std::uint64_t seed = 1;
  ScenePlace step_place;
};

struct PlantEntry {
  Text name;
  Text type;
  std::unique_ptr<plants::PlantDefinition> definition;     ///< parameters already read
  std::vector<std::pair<std::string, ScenePlace>> places;  ///< of the parameters that the file gives
  /// A parameter that the model of a motor gives, or a class.
  struct Modelled {
    std::string parameter;
    std::string from;       ///< "HG-SR202, sheet: ..."
    ScenePlace place;       ///< where the scenario names it
    bool by_class = false;  ///< of gear, motor or encoder
    double value = 0;       ///< that a model gives, of a number [SI]
  };
  std::vector<Modelled> modelled = {};
  /// Those that the file gives and that were learnt from recordings, each with where from.
  std::vector<Modelled> fitted = {};
  /// Of a foreign FMU: variables that declare no unit, and the units that the scenario gives them.
  std::vector<std::pair<Text, Text>> units = {};
};

class Archive;
struct Scenario;

/// What a scenario says of its controller. What a kind of it is, is in its file of
/// sim/controllers/.
struct ControllerSection {
  ControllerSection() = default;
  virtual ~ControllerSection() = default;
  ControllerSection(const ControllerSection&) = delete;
  ControllerSection& operator=(const ControllerSection&) = delete;

  Text retentive;  ///< file that keeps retentive values over power cycles and runs, "" = memory only
  bool retains =
      true;  ///< a run writes it at its end; not of a recorded session, which begins again as it did
  std::vector<std::pair<Text, double>> set;  ///< values before power-up, after the retentive file
  /// From the latch of the counters to the analogue output: what a device takes to compute. At most its
  /// sampling time.
  Time compute_time = 0;
  ScenePlace place;

  /// As the scenario writes it: "qmove".
  [[nodiscard]] virtual std::string_view kind() const = 0;
  /// The section's keys.
  virtual void visit(Archive& archive) = 0;
  /// The period that must be a whole multiple of the step, and its key.
  struct Period {
    std::string_view key;
    Time time;
  };
  [[nodiscard]] virtual Period period() const = 0;
  /// The files that it is made of, the retentive one apart.
  [[nodiscard]] virtual std::vector<Text> files() const = 0;
  /// What `set` can name, for messages.
  [[nodiscard]] virtual std::string_view settable() const = 0;
  /// What a plug of the machine makes of its motion: "knife.encoder".
  using ScaleOf = std::function<std::optional<plants::PlugScale>(const std::string& plug)>;
  /// Where the section and the machine say different things of one thing, a phrase each.
  [[nodiscard]] virtual std::vector<Finding> contradictions(const Scenario& scenario,
                                                            const ScaleOf& scale_of) const {
    (void)scenario;
    (void)scale_of;
    return {};
  }
  /// The controller with its programs read and compiled; nullptr after problems. `notes`, if given, takes
  /// what is no fault.
  virtual std::unique_ptr<devices::Controller> load(const Scenario& scenario, Problems& problems,
                                                    std::vector<Finding>* notes) const = 0;
};

/// A kind of controller that a scenario can name.
struct ControllerKind {
  std::string_view name;     ///< "qmove"
  std::string_view example;  ///< of its section: "{configuration: ...}"
  std::unique_ptr<ControllerSection> (*make)();
};
/// All of them, as sim/controllers/kinds.cpp lists them.
std::span<const ControllerKind> controller_kinds();
/// nullptr if there is none of that name.
const ControllerKind* controller_kind(std::string_view name);

/// wiring: {2.CNT01: knife.encoder}
struct Wire {
  Text terminal;  ///< of the controller
  Text plug;      ///< plant.port, or panel.switch
};

/// filters: {2.CNT01: {frequency: 100 kHz}, INT1: {pulse: 20 us}, 2.INP02: {delay: 3 ms}}
/// What a card makes of what comes to a terminal. The manuals name it and leave the figures to the papers of
/// the cards (000 and 002 §1.2.5.1, 001 §1.4.8): 0 = it takes what comes.
struct InputFilter {
  Text terminal;
  double frequency = 0;  ///< of a counter: highest of one phase [Hz]; counts beyond are lost
  Time pulse = 0;        ///< of an interrupt line: shorter zero pulses are not seen
  Time delay = 0;        ///< of an input: a level is taken when it has lasted so long
};

/// panel: {push_buttons: [acknowledge]}
/// How an operator works the switches of the panel; nothing of it changes a run.
struct PanelSection {
  std::vector<Text> push_buttons;  ///< on while they are pressed; names without `panel.`
};

/// A value written by the timeline. Plain numbers keep unit "" and are taken in the target's own display
/// unit.
struct Quantity {
  double number = 0;
  std::string unit;
  ScenePlace place;
};

/// One entry of the timeline: when, then what.
struct Stimulus {
  std::optional<Time> at;     ///< absolute
  std::optional<Text> when;   ///< expression; fires once, the first time it is true (from `at`, if given)
  Time after = 0;             ///< delay after the trigger
  std::optional<Time> every;  ///< repeats with this period after the first time
  std::vector<std::pair<Text, Quantity>> set;   ///< target: panel switch, plant setting, controller value
  std::vector<std::pair<Text, Quantity>> ramp;  ///< target reaches the value over `over`, linearly
  Time over = 0;
  struct FaultAction {
    Text component;  ///< plant.component
    Text fault;
    Quantity value;
  };
  std::vector<FaultAction> faults;
  std::optional<bool> power;  ///< controller power on or off
  ScenePlace place;
};

/// One entry of disturbances: what is added to a setting, a live parameter or a fault of a plant.
struct Disturbance {
  enum class Kind { sine, noise, step, walk };
  Text at;  ///< plant.setting, plant.parameter, plant.component.fault
  Kind kind = Kind::sine;
  Quantity amplitude;    ///< sine: peak; noise: rms; step: height, of random ones the largest; walk: bound
  double frequency = 0;  ///< of a sine [Hz]
  struct Band {
    double low = 0;  ///< [Hz]
    double high = 0;
    ScenePlace place;
  };
  Band band;       ///< of noise
  Quantity step;   ///< of a walk, up or down
  Time every = 0;  ///< walk: of its steps; step: of random ones, 0 = a single one
  Time ramp = 0;   ///< fades in over this
  Time from = 0;
  std::optional<Time> to;
  std::optional<std::uint64_t> seed;  ///< absent: from the scene's seed and the entry's place in the list
};

/// inputs: {web.speed: {recording: scope.yaml, channel: web.speed}}
/// What a recorded channel drives, from its recording's first sample on.
struct RecordedInput {
  enum class Between { linear, hold };
  enum class AfterEnd { hold, stop };
  Text name;       ///< what the timeline can set, or an analogue or digital plug of a plant that has no wire
  Text recording;  ///< its YAML (sim/recordings/recording_file.hpp), relative to the scenario
  Text channel;    ///< of the recording
  Between interpolate = Between::linear;
  AfterEnd after_end = AfterEnd::hold;
};

struct RecordSection {
  enum class Format { csv, hdf5 };
  Format format = Format::csv;
  Time every = 2 * millisecond;
  std::vector<Text> channels;
  ScenePlace place;
};

/// How the drives are judged by their ratings (sim/loop/drive_judge.hpp).
struct DrivesSection {
  Time cycle = 0;     ///< length of a machine cycle, 0 = from cut to cut
  bool judge = true;  ///< the check "drive within its ratings" is among the checks
};

struct CheckRequest {
  enum class Kind {
    each,        ///< every event of this name satisfies `expect`; with statistics: from one event to the next
    all,         ///< `expect` over statistics of all events of this name: count, mean_x, p99(x) ...
    always,      ///< the expression holds at every record instant, with statistics over every window
    eventually,  ///< it holds at one record instant at least, with statistics over one window
    never        ///< no event of this name happens
  };
  Text name;
  Kind kind = Kind::always;
  Text event;       ///< each, all, never: the event's name ("cut"), or source.name ("knife.cut")
  Text expression;  ///< expect, or the value of always / eventually
  Time from = 0;
  std::optional<Time> until;   ///< each, all, always, never
  std::optional<Time> within;  ///< eventually: not later than from + within
  std::optional<Time> every;   ///< always, eventually: statistics look at periods of this length
  int at_least = 1;            ///< each, all: fewer events than this fail the check
};

struct PlotRequest {
  Text name;  ///< file name, title unless one is given
  std::string title;
  struct Panel {
    std::string title;
    std::vector<Text> channels;  ///< curves over time
    std::vector<Text> lanes;     ///< instead: states over time, one lane each
    Text event;                  ///< instead: points, one an event of this name ("cut")
    std::vector<Text> values;    ///< of the event ("length")
    bool histogram = false;      ///< the event's value by how often it comes
    bool spectrum = false;       ///< what comes back regularly in it, over the web
    Text motor;  ///< instead: torque over speed of the servo motor of this plant, with its limits
    std::optional<std::pair<double, double>> limits;  ///< band drawn behind: [low, high], in the curves' unit
    /// Instead: a path in a plane, at equal scale. With `split`, one curve for each of that channel's whole
    /// values from 1, named by `labels`; nothing is drawn where it is 0.
    Text x;
    Text y;
    Text split;
    std::vector<Text> labels;
    struct Point {
      Text label;
      double x = 0;
      double y = 0;
    };
    std::vector<Point> points;  ///< named places on the plane, in the channels' units
    /// From `motor` on: its x axis is its own, and it stands alone in its plot.
    enum class Kind { curves, lanes, points, motor, path, histogram, spectrum };
    [[nodiscard]] Kind kind() const;
    [[nodiscard]] bool has_own_x() const { return kind() >= Kind::motor; }
    [[nodiscard]] std::vector<Text> recorded() const;  ///< channels that it draws, but for lanes and motors
  };
  std::vector<Panel> panels;
  Time from = 0;
  std::optional<Time> until;
  bool against_number =
      false;  ///< `against: number`: x is the event's number instead of time; event panels only
  /// Events drawn as vertical lines; absent = faults and power changes.
  std::optional<std::vector<Text>> marks;
};

struct PicturesSection {
  bool frames = false;  ///< the file has a `frames` map
  Time every = 40 * millisecond;
  Time from = 0;
  std::optional<Time> until;
  /// `around: cut[3]`: instead of from and until, a window about the third event of that name.
  struct Around {
    Text event;      ///< without the number
    int number = 1;  ///< from 1
    Time before = 100 * millisecond;
    Time after = 100 * millisecond;
  };
  std::optional<Around> around;
  int slow = 1;        ///< frames every `every` / slow: at the film's pace, that many times slower
  bool video = false;  ///< the frames as a film file too
  bool view = true;    ///< the machine in 3-D in the report, as long as the frames
  ScenePlace slow_place;
  /// A camera of the user's own in place of a named one.
  struct Eye {
    std::array<double, 3> eye = {0, 0, 0};     ///< [m]
    std::array<double, 3> target = {0, 0, 0};  ///< [m]
    double field_of_view = 0.61086523819801;   ///< vertical, 35 degrees [rad]
  };
  struct Camera {
    Text shows = {"operator",
                  {}};       ///< operator = the whole line, a plant by its name, or a part: "knife.blade"
    std::optional<Eye> own;  ///< in place of that
    /// True if it is to show one part: "knife.drum".
    [[nodiscard]] bool looks_at_part() const { return !own && shows.text.find('.') != std::string::npos; }
  };
  Camera camera;
  std::vector<Camera> cameras;  ///< two to four in its place that share the picture
  /// Those that there are.
  [[nodiscard]] std::vector<Camera> views() const {
    return cameras.empty() ? std::vector<Camera>{camera} : cameras;
  }
  Text follow;  ///< part that the first camera goes with ("saw.carriage"), "" = it stands
  int width = 960;
  int height = 540;
  std::vector<Text> caption;  ///< channels in the caption bar
  std::vector<Text> lamps;    ///< channels shown there as lamps: lit unless 0
  /// How large a unit is that the user chose: {Axis: 0.01 mm, glMiss: 0.01 mm}
  struct OwnUnit {
    Text of;        ///< a channel, or an axis: what of it is in Um, Um/s ...
    Quantity is{};  ///< with a unit
  };
  std::vector<OwnUnit> units;
  /// What 1 is of a channel that has `unit`; none if `units` does not say it.
  [[nodiscard]] std::optional<Quantity> own_unit(std::string_view channel, std::string_view unit) const;
  /// Where a plant is to go, as the frames show it.
  struct Quota {
    Text plant;
    Text at;                  ///< a channel: a length, or in a unit that `units` says
    double tolerance = 1e-4;  ///< on either side [m]
  };
  std::optional<Quota> quota;
  /// What is drawn over the frames.
  struct Overlays {
    bool trail = true;    ///< where a tool's tip has just been
    bool lengths = true;  ///< of the cut pieces, from cut to cut
    bool forces = true;   ///< as arrows, while they act
    bool speeds = true;   ///< as arrows in proportion
  };
  Overlays overlays;
  std::vector<Text> live;  ///< one or two channels that run along in the corner
  /// A user's own mesh in place of a part.
  struct MeshRequest {
    Text part;                                 ///< "knife.drum"
    Text file;                                 ///< relative to the scenario
    double scale = 1;                          ///< on the file's unit
    std::array<double, 3> at = {0, 0, 0};      ///< of its origin, from the part's middle [m]
    std::array<double, 3> rotate = {0, 0, 0};  ///< about x, then y, then z [rad]
  };
  std::vector<MeshRequest> meshes;
  std::vector<PlotRequest> plots;
};

/// opcua: {packml: {state: D510}}: what an OPC UA client of the live line is told of the machine as a whole.
/// Values are named as `record` names them.
struct OpcuaSection {
  struct Machine {
    std::string manufacturer;
    std::string model;
    std::string serial_number;
  };
  Machine machine;
  struct Packml {
    Text state;  ///< value with the number of the state, 1 Clearing to 17 Complete (ISA-TR88.00.02)
    Text mode;   ///< value with the number of the unit mode: 1 Production, 2 Maintenance, 3 Manual
  };
  Packml packml;
  struct Machinery {
    Text executing;       ///< value that is not 0 while the machine does its work
    Text out_of_service;  ///< value that is not 0 while it cannot
    Text mode;  ///< value with the number of OPC 40001-1: 0 None, 1 Maintenance, 2 Setup, 3 Processing
  };
  Machinery machinery;
  struct Cutter {
    Text plant;   ///< a rotary knife or a flying saw
    Text length;  ///< value with the length that is to be cut
  };
  std::vector<Cutter> cutters;
  [[nodiscard]] bool given() const;
};

/// An override from the command line: `--set plants.web.speed="80 m/min"`.
struct Override {
  std::string path;
  std::string value;
};

/// variables: {length: 800 mm}, used as ${length}
struct VariableEntry {
  Text name;
  Text value;                            ///< what it comes to: a quantity, a switch, a text
  std::vector<ScenePlace> uses = {};     ///< in the scenario; tables that it names are not looked at
  std::vector<std::string> beside = {};  ///< what is extended has none of this name but these
  bool given_anew = false;               ///< another value than what is extended or the file has
};

/// What `drycut faults` holds a fault to.
struct FaultsSection {
  std::optional<Text> told;  ///< expression; absent: an error of the controller, or a drive switched off
  Time within = 2 * second;  ///< after the fault
  std::vector<Text> product = {};  ///< names of checks; none: all that look at each cut
};

/// fitted: {plants.axis.mass: {low: 36.9 kg, high: 37.1 kg, from: move.csv}}: a value of a plant that was
/// learnt from recordings, as `drycut fit` writes it.
struct FittedEntry {
  Text path;  ///< "plants.axis.mass"
  Text low;   ///< a quantity of the row's dimension
  Text high;
  std::string from;  ///< "move.csv"
};

struct Scenario {
  std::filesystem::path file;
  Text extends;  ///< never kept: for the schema
  std::vector<VariableEntry> variables;
  SceneSection scene;
  std::vector<PlantEntry> plants;
  /// Those that are in force: the value stands in the same file as its limits and lies between them. One
  /// that --set, or a file that extends this one, gives anew is fitted no more.
  std::vector<FittedEntry> fitted;
  std::unique_ptr<ControllerSection> controller;  ///< nullptr without
  std::vector<Wire> wiring;
  std::vector<InputFilter> filters;
  PanelSection panel;
  std::vector<Stimulus> timeline;
  std::vector<Disturbance> disturbances;
  std::vector<RecordedInput> inputs;
  RecordSection record;
  DrivesSection drives;
  std::vector<CheckRequest> checks;
  PicturesSection pictures;
  OpcuaSection opcua;
  FaultsSection faults;
  /// True if the machine can be built: plants and controller have no problem and all periods are multiples
  /// of the step. Problems elsewhere do not stop a check of the names.
  bool buildable = false;
  bool on_trial = false;  ///< read with another value of a variable, to see what becomes of its problems
  std::vector<Override> overrides;   ///< that were applied
  std::vector<std::string> sources;  ///< names for messages: the file, then "--set PATH" of each override,
                                     ///< then other files that are read for it
};

/// Another value of a variable, put in its place as if the file had it, to see what becomes of the problems.
struct Trial {
  std::string variable;
  std::string value;
};

/// Whether it sets the controller's value, before power-up or in its timeline; a name alone is that of any
/// program.
bool sets(const Scenario& scenario, std::string_view value);

/// A problem at a place of the scenario, with the right file name.
/// A place of the scenario or of what it extends, with the file's name.
NamedAt named_at(const Scenario& scenario, const ScenePlace& place);
Problem problem_at(Code code, const Scenario& scenario, const ScenePlace& place, std::string what,
                   std::string remedy);

/// Reads a scenario. Syntax, unknown and duplicate keys, kinds, units, dimensions and ranges are checked and
/// reported with their place in `problems`, all of the file in one run. The scenario is usable only if no
/// problem was added. Problems of an override have the file name "--set PATH".
Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides,
                       Problems& problems, std::span<const plants::PlantType> types = plants::plant_types(),
                       const Trial* trial = nullptr);
/// The same from a text that is already in memory; `file` names it in messages and places relative paths.
Scenario read_scenario_text(std::string_view text, const std::filesystem::path& file,
                            const std::vector<Override>& overrides, Problems& problems,
                            std::span<const plants::PlantType> types = plants::plant_types(),
                            const Trial* trial = nullptr);

/// The scenario as YAML with every default in force; reading it back gives the same scenario.
std::string expand(const Scenario& scenario);

}  // namespace drycut::sim::scenario
