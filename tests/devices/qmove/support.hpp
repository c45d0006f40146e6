#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/qmove_controller.hpp"

// A small device and a bench for tests of the QMOVE controller: no real device is needed to test it.
namespace drycut::devices::qmove::testing {

/// PUPPET: a position that only programs move. DELCNT adds `delta` to `posit`, once a sample however often
/// it was given; GO needs st_still and clears it, HALT sets it.
class Puppet : public Device {
 public:
  enum Variables { posit, delta, gain, reading, kept, word, code };
  enum States { st_init, st_still, st_locked, st_int };
  enum Commands { init, halt, go, delcnt, lock };

  Puppet(Resources resources, Cards& cards)
      : Device(table()), resources_(std::move(resources)), cards_(cards) {}

  static constexpr DeviceVariable variable(std::string_view name, Size size, std::string_view unit,
                                           double limit, Retention retention,
                                           Access access = Access::read_write, int rows = 1) {
    return {name, size, unit, -limit, limit, access, retention, {}, "", "", rows};
  }

  static const DeviceType& table() {
    constexpr Retention zero = Retention::zero;
    constexpr Retention kept_value = Retention::retentive;
    static constexpr std::array variables = {
        variable("posit", Size::L, "Um", 999999, zero),
        variable("delta", Size::L, "Um", 999999, kept_value),
        variable("gain", Size::W, "", 1000, kept_value),
        variable("reading", Size::L, "bits", 0, zero, Access::read),
        variable("kept", Size::L, "", 999999, kept_value),
        variable("word", Size::W, "", 32767, kept_value),
        variable("code", Size::L, "", 255, kept_value, Access::read_write, 4)};
    static constexpr std::array states = {
        State{"st_init", zero, "", ""}, State{"st_still", Retention::one, "", ""},
        State{"st_locked", kept_value, "", ""}, State{"st_int", zero, "", ""}};
    static constexpr std::array commands = {
        DeviceCommand{"INIT", {}, "", ""}, DeviceCommand{"HALT", {1, 1, {}}, "", ""},
        DeviceCommand{"GO", {3, 3, {}}, "", ""}, DeviceCommand{"DELCNT", {1, 1, {}}, "", ""},
        DeviceCommand{"LOCK", {1, 1, {}}, "", ""}};
    static constexpr std::array fields = {
        Field{"TCamp", Field::Kind::period_ms, 1, 250, ""},   Field{"Count", Field::Kind::counter, 0, 0, ""},
        Field{"IntL", Field::Kind::interrupt_line, 1, 8, ""}, Field{"IAZero", Field::Kind::input, 0, 0, ""},
        Field{"IoutA", Field::Kind::analogue, 0, 0, ""},      Field{"Out", Field::Kind::output, 0, 0, ""}};
    static constexpr std::array aliases = {Alias{"quota", "posit"}};
    static constexpr DeviceType type{"PUPPET", "", variables, states, commands, fields, aliases};
    return type;
  }

  [[nodiscard]] int period_ms() const override { return resources_[0].number; }
  void interrupt(int line, bool rising) override {
    if (line == resources_[2].number) set_state(st_int, rising);
  }

 protected:
  void latch() override {
    if (resources_[1].address)
      value(reading) = static_cast<std::int32_t>(cards_.counters.at(*resources_[1].address).count);
  }
  void initialise() override {}
  void execute(int command) override {
    if (command == halt) set_state(st_still, true);
    if (command == go) set_state(st_still, false);
    if (command == delcnt) value(posit) += value(delta);
    if (command == lock) set_state(st_locked, true);
  }
  void step() override {
    if (resources_[4].address)
      cards_.analogue_outputs.at(*resources_[4].address).word = static_cast<std::int16_t>(value(word));
  }

 private:
  Resources resources_;
  Cards& cards_;
};

inline std::unique_ptr<Device> make_puppet(const Resources& resources, Cards& cards) {
  return std::make_unique<Puppet>(resources, cards);
}

/// A type with the fields of CAMMING4 and nothing else, for records.
inline const DeviceType& camming_fields() {
  using FieldKind = Field::Kind;
  static constexpr std::array fields = {Field{"TCamp", FieldKind::period_ms, 1, 250, ""},
                                        Field{"CountS", FieldKind::counter, 0, 0, ""},
                                        Field{"CountMA", FieldKind::counter, 0, 0, ""},
                                        Field{"CountMB", FieldKind::counter, 0, 0, ""},
                                        Field{"IntL", FieldKind::interrupt_line, 1, 8, ""},
                                        Field{"IAZero", FieldKind::input, 0, 0, ""},
                                        Field{"IntLM", FieldKind::interrupt_line, 1, 8, ""},
                                        Field{"IAZeroM", FieldKind::input, 0, 0, ""},
                                        Field{"InG", FieldKind::input, 0, 0, ""},
                                        Field{"InGInt", FieldKind::interrupt_line, 1, 8, ""},
                                        Field{"IoutA", FieldKind::analogue, 0, 0, ""},
                                        Field{"Out", FieldKind::output, 0, 0, ""}};
  static constexpr std::array states = {State{"st_init", Retention::zero, "", ""}};
  static constexpr std::array commands = {DeviceCommand{"INIT", {}, "", ""}};
  static constexpr DeviceType type{"CAMMING4", "", {}, states, commands, fields, {}};
  return type;
}

inline std::span<const CatalogueEntry> puppets() {
  static const std::array entries = {CatalogueEntry{&Puppet::table(), make_puppet},
                                     CatalogueEntry{&camming_fields(), nullptr}};
  return entries;
}

inline constexpr std::string_view usual_cnf =
    "CONST\n"
    "cTen 10\n"
    "cHalf 0.5\n"
    "cMinus -3\n"
    "SYSTEM\n"
    "slR L\nslA L\nslB L\nsfKept F\nsbKept B\nswKept W\nssR S\nssA S\n"
    "GLOBAL\n"
    "glI L\nglJ L\ngfDone F\ngbSmall B\ngwMid W\ngsReal S\n"
    "ARRSYS\nasKept L 3\nasReal S 2\n"
    "ARRGBL\nagTemp W 5\n"
    "TIMER\ntmWait\n"
    "DATAGROUP\ndgCam\nDATAPROGRAM 2\nddlHead L\nSTEP 3\nddbCode B\nddsReal S\n"
    "BUS\n1 1CPUB 02\n2 1MIXA 00\n"
    "INPUT\nifStart F 2.INP01\nifStop F 2.INP02\n"
    "OUTPUT\nofLamp F 2.OUT01\nofHorn F 2.OUT02\n"
    "INTDEVICE\nAxis PUPPET 4 2.CNT01 5 2.INP08 2.AN01 2.OUT08\n"
    "END\n";

inline std::string text_of(const Problems& problems) {
  std::string text;
  for (const Problem& problem : problems) text += to_string(problem) + "\n";
  return text;
}

/// Compiles texts into a controller; `problems` says what was wrong with them.
struct Bench {
  Problems problems;
  Configuration configuration;
  std::unique_ptr<QmoveController> controller;
  std::int64_t now = 0;

  explicit Bench(const std::vector<std::string>& modules, int cycle_ms = 1, std::string_view cnf = usual_cnf)
      : configuration(parse_configuration(cnf, "test.cnf", puppets(), problems)) {
    std::vector<QclProgram> programs;
    for (std::size_t i = 0; i < modules.size(); ++i)
      programs.push_back(compile_module(modules[i], "task" + std::to_string(i) + ".mod", configuration,
                                        puppets(), problems));
    if (problems.empty())
      controller =
          std::make_unique<QmoveController>(configuration, programs, puppets(), cycle_ms * 1'000'000);
  }

  /// One millisecond: devices, then tasks, as the simulation does.
  void step() {
    controller->run_devices(now);
    controller->run_tasks(now);
    now += 1'000'000;
  }
  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) step();
  }
  double operator[](const std::string& name) const { return controller->find(name).value().read(); }
  void set(const std::string& name, double value) const { controller->find(name).value().write(value); }
};

/// What the controller had to say since it was last asked.
inline std::vector<std::string> events(const Bench& bench) {
  std::vector<std::string> texts;
  for (const ControllerEvent& event : bench.controller->take_events())
    texts.push_back(event.source + " " + event.event + " " + event.text);
  return texts;
}

/// A program that leaves something behind wherever something can be kept.
inline const std::string powered_module =
    "glI = glI + 1\nslA = slA + 1\nagTemp[1] = agTemp[1] + 1\nasKept[1] = asKept[1] + 1\n"
    "ddbCode[1, 1] = ddbCode[1, 1] + 1\ntmWait = 10000\nSETOUT ofLamp\nINIT Axis\nWAIT Axis:st_init\n"
    "Axis:posit = 5\nAxis:kept = Axis:kept + 7\nLOCK Axis\nAxis:word = 3000\nWAIT 1\nslR = slR + 1\nWAIT "
    "0\nEND\n";

}  // namespace drycut::devices::qmove::testing
