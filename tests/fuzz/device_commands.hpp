#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "devices/camming4/sector.hpp"
#include "devices/qmove/catalogue.hpp"

// Bytes played as what can happen to a device inside a controller: writes and commands of a program, counts,
// inputs and index pulses of a machine, samples, power cycles. For fuzzers, which find the bytes, and for
// tests, which draw them from a seed. Nothing here is undefined for any bytes; what the device makes of them
// must not be either.
namespace drycut::fuzz {

/// A record for a device with every terminal connected: the first counter is `slot`.CNT01 (slot 1:
/// simulated), the second 2.CNT02, inputs 2.INP01 on, outputs 2.OUT01 on, the DAC 2.AN01, interrupt lines 1
/// on.
inline devices::Resources wired(const devices::DeviceType& type, int period_ms, int slot = 2) {
  using Kind = devices::Field::Kind;
  std::array<int, 7> used{};
  devices::Resources resources;
  for (const devices::Field& field : type.fields) {
    const int number = ++used.at(static_cast<std::size_t>(field.kind));
    switch (field.kind) {
      case Kind::period_ms:
        resources.push_back({std::clamp(period_ms, field.min, field.max), {}});
        break;
      case Kind::port:
      case Kind::interrupt_line:
        resources.push_back({number, {}});
        break;
      case Kind::counter:
        resources.push_back({0, devices::Address{devices::Kind::counter, number == 1 ? slot : 2, number}});
        break;
      case Kind::input:
        resources.push_back({0, devices::Address{devices::Kind::input, 2, number}});
        break;
      case Kind::output:
        resources.push_back({0, devices::Address{devices::Kind::output, 2, number}});
        break;
      case Kind::analogue:
        resources.push_back({0, devices::Address{devices::Kind::analogue, 2, number}});
        break;
    }
  }
  return resources;
}

/// Bytes read one after the other; zeros after the last.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool left() const { return next_ < bytes_.size(); }
  std::uint8_t byte() { return left() ? bytes_[next_++] : std::uint8_t{0}; }
  int below(std::size_t count) { return static_cast<int>(byte() % count); }
  std::int8_t small() { return static_cast<std::int8_t>(byte()); }
  std::int32_t number() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return static_cast<std::int32_t>(value);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

/// Devices of the catalogue that move an axis: they count.
inline std::vector<const devices::CatalogueEntry*> axes() {
  std::vector<const devices::CatalogueEntry*> all;
  for (const auto& entry : devices::catalogue()) {
    const auto counts = [](const devices::Field& field) {
      return field.kind == devices::Field::Kind::counter;
    };
    if (std::any_of(entry.type->fields.begin(), entry.type->fields.end(), counts)) all.push_back(&entry);
  }
  return all;
}

/// One axis of the catalogue and the bytes that happen to it.
class DevicePlayer {
 public:
  DevicePlayer(const devices::CatalogueEntry& entry, int period_ms, int slot)
      : type(*entry.type), device(entry.make(wired(type, period_ms, slot), cards)) {}

  /// Writes values by name, those that the device has.
  void set(std::initializer_list<std::pair<std::string_view, std::int32_t>> values) {
    for (const auto& [name, value] : values)
      if (const auto symbol = devices::find_symbol(type, name)) device->write(*symbol, value);
  }
  /// The parameters of a small machine: 1 Um is 1 bit, 10 V are 5000 Um/s.
  void set_up() {
    set({{"measure", 1},   {"pulse", 1},     {"measurem", 1},  {"pulsem", 1},  {"cntratio", 400000},
         {"unitvel", 1},   {"maxvel", 5000}, {"tacc", 10},     {"tdec", 10},   {"taccdec", 10},
         {"minpos", -999}, {"maxpos", 999},  {"feedfw", 1000}, {"pgain", 500}, {"setvel", 2000},
         {"prsvel", 2000}, {"sprsvel", 500}, {"toll", 3},      {"tollp", 400}, {"tolln", 400},
         {"slowpos", 60},  {"slowdly", 4},   {"tbrake", 3},    {"toldly", 5},  {"tinvt", 2},
         {"prspos", 30},   {"enstol", 1}});
  }
  /// Parameters at the ends of what 32 bits hold, and in between.
  void set_up_anyhow(Bytes& bytes) {
    for (const devices::DeviceVariable& variable : type.variables)
      if (variable.rows == 1) set({{variable.name, extreme(bytes)}});
  }
  /// A cam of any sectors.
  void set_up_cam(Bytes& bytes) {
    for (const char row : {'1', '2', '3', '4', '5', '6'}) {
      const auto& codes = devices::camming4::codes;
      const auto name = [&](std::string_view column) { return std::string(column) + row; };
      set({{name("codeG"), codes.at(static_cast<std::size_t>(bytes.below(codes.size()))).code},
           {name("codeQm"), bytes.byte()},
           {name("codeQs"), bytes.small()},
           {name("codeQma"), bytes.byte()},
           {name("codeQsa"), bytes.small()}});
    }
  }

  /// Plays all `bytes`; the first law that the device broke, or "".
  std::string play(Bytes& bytes) {
    if (bytes.byte() % 4 != 0)
      set_up();
    else
      set_up_anyhow(bytes);
    set_up_cam(bytes);
    std::string broken;
    while (bytes.left() && broken.empty()) broken = happen(bytes);
    return broken;
  }

  /// Ends whatever runs as the manuals say, and asks for a START: "" if it is taken, else why not.
  std::string start_again() {
    for (const char* step : {"INIT", "EMRG", "STOP"}) {
      command(step);
      sample();
    }
    get_ready();
    // An on/off axis has no EMRG: STOP ends after toldly, at most 327.67 s.
    for (int ms = 0; get("st_still") == 0 && ms < 330'000; ms += device->period_ms()) sample();
    static_cast<void>(device->take_diagnostics());
    command("START");
    sample();
    for (const devices::Diagnostic& said : device->take_diagnostics())
      if (said.subject == "START" && said.kind == devices::Diagnostic::Kind::command_refused)
        return "START refused: " + said.text;
    return "";
  }

  std::int32_t get(std::string_view name) const { return device->read(*devices::find_symbol(type, name)); }
  /// Gives a command if the device has it.
  void command(std::string_view name) {
    if (const auto row = devices::find_command(type, name)) device->command(*row);
  }
  /// One sampling, the axis where the output drives it, the master on its way.
  void sample() {
    for (auto counter = std::next(cards.counters.begin()); counter != cards.counters.end(); ++counter)
      counter->second.count += master_;
    for (const auto& [address, dac] : cards.analogue_outputs) slave().count += dac.word / 64;
    if (cards.analogue_outputs.empty() && cards.outputs.size() > 1) {
      const auto on = [&](int number) { return cards.outputs.at({devices::Kind::output, 2, number}).level; };
      slave().count += (on(1) ? 20 : 0) - (on(2) ? 20 : 0);
    }
    device->sample();
  }

  const devices::DeviceType& type;
  devices::Cards cards;
  std::unique_ptr<devices::Device> device;

 private:
  devices::Counter& slave() { return cards.counters.begin()->second; }

  /// Out of the states in which nothing starts, as the manuals say.
  void get_ready() {
    for (const char* step : {"INIT", "RSERR", "RESUME", "CALOFF", "REGON", "LOOPON"}) {
      command(step);
      sample();
    }
  }

  int master_ = 0;  ///< bits a sample of all counters but the first

  /// The next thing that the bytes say.
  std::string happen(Bytes& bytes) {
    switch (bytes.byte() % 16) {
      case 0:
      case 1:
      case 2:
      case 3:
      case 4:
        write(bytes);
        return "";
      case 5:
      case 6:
      case 7:
        device->command(bytes.below(type.commands.size()));
        return "";
      case 8:
        master_ = bytes.small();
        return "";
      case 9:
        std::next(cards.counters.begin(), bytes.below(cards.counters.size()))->second.count += bytes.number();
        return "";
      case 10: {
        auto& input = std::next(cards.inputs.begin(), bytes.below(cards.inputs.size()))->second;
        input.level = !input.level;
        return "";
      }
      case 11:
        edge(bytes);
        return "";
      case 12:
        if (bytes.byte() % 8 == 0) device->power_up();
        get_ready();
        command(
            std::array{"START", "STARTCAM", "PRESET", "MANFW"}.at(static_cast<std::size_t>(bytes.below(4))));
        return "";
      default:
        for (int samples = 1 + bytes.byte() % 32; samples > 0; --samples) {
          sample();
          if (std::string broken = broken_law(); !broken.empty()) return broken;
        }
        return "";
    }
  }

  void write(Bytes& bytes) {
    const int index = bytes.below(type.variables.size());
    const devices::DeviceVariable& variable = type.variables[static_cast<std::size_t>(index)];
    const int row = bytes.below(static_cast<std::size_t>(std::min(variable.rows, 8)));
    device->write({devices::Symbol::Kind::variable, index, row}, value_of(variable, bytes));
  }

  static std::int32_t extreme(Bytes& bytes) {
    using Limits = std::numeric_limits<std::int32_t>;
    constexpr std::array ends{Limits::min(), Limits::min() + 1, -1,     0, 1, 2, 3,
                              Limits::max(), Limits::max() - 1, 999'999};
    return ends.at(static_cast<std::size_t>(bytes.below(ends.size())));
  }

  static std::int32_t value_of(const devices::DeviceVariable& variable, Bytes& bytes) {
    switch (bytes.byte() % 8) {
      case 0:
        return extreme(bytes);
      case 1:
        return bytes.number();
      case 2:
        return static_cast<std::int32_t>(variable.max);
      case 3:
        return static_cast<std::int32_t>(variable.min);
      case 4:  // inside the range
        return static_cast<std::int32_t>(variable.min + (variable.max - variable.min) * bytes.byte() / 255);
      case 5:
        return 130 + bytes.byte();  // G codes
      case 6:
        return bytes.byte() * 16;
      default:
        return bytes.small();
    }
  }

  void edge(Bytes& bytes) {
    for (auto& [address, counter] : cards.counters) counter.latched = counter.count - bytes.small() % 4;
    const int line = 1 + bytes.below(8);
    const bool rising = bytes.byte() % 2 == 0;
    if (const auto level = cards.interrupt_lines.find(line); level != cards.interrupt_lines.end())
      level->second.level = rising;
    device->interrupt(line, rising);
  }

  /// What holds after every sample, whatever happened.
  std::string broken_law() {
    static_cast<void>(device->take_diagnostics());
    for (const auto& [address, dac] : cards.analogue_outputs)
      if (dac.word < -devices::dac_full_scale) return "the DAC's word is beyond full scale";
    for (int index = 0; const devices::DeviceVariable& variable : type.variables) {
      const std::int32_t value = device->read({devices::Symbol::Kind::variable, index++, 0});
      const bool fits = devices::wrap(variable.size, value) == value;
      // A row number of 128 is in a byte that the manual gives too small.
      if (!fits && !(variable.max == 128 && value == 128))
        return std::string(variable.name) + " does not fit its size: " + std::to_string(value);
    }
    if (get("st_prson") == 1 && get("st_still") == 1) return "a preset search runs and the axis is still";
    return "";
  }
};

/// Plays bytes on one device each: the first says which, the second its TCamp, the third whether its counter
/// is simulated. The law that was broken, with the device's name, or "".
inline std::string play_device_commands(std::span<const std::uint8_t> data) {
  Bytes bytes(data);
  static const auto entries = axes();
  const auto& entry = *entries[static_cast<std::size_t>(bytes.below(entries.size()))];
  const int period_ms = bytes.byte();
  const int slot = bytes.byte() % 4 == 0 ? 1 : 2;
  DevicePlayer player(entry, period_ms, slot);
  std::string broken = player.play(bytes);
  if (broken.empty()) broken = player.start_again();
  return broken.empty() ? "" : std::string(entry.type->name) + ": " + broken;
}

}  // namespace drycut::fuzz
