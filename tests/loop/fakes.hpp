#pragma once
// A controller and a plant made of plain values, for tests of what connects them.
#include <map>
#include <string>
#include <vector>

#include "devices/controller.hpp"
#include "plants/plant.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::fakes {

/// Its devices listen to all interrupt lines.
class FakeController : public devices::Controller {
 public:
  FakeController() {
    for (int line = 1; line <= 8; ++line) cards_.interrupt_lines[line];
  }
  devices::Cards& cards() override { return cards_; }
  void visit(StateArchive& archive) override { cards_.visit(archive); }
  std::variant<devices::Address, devices::TerminalFault> terminal(const std::string& text) override {
    return devices::find_slot_terminal(cards_, text);
  }
  [[nodiscard]] bool takes_wire(const devices::Address& address) const override {
    return devices::slot_takes_wire(address);
  }
  [[nodiscard]] std::vector<Period> periods() const override { return {{"Axis TCamp", 2'000'000}}; }
  void run_devices(std::int64_t) override {}
  void run_tasks(std::int64_t) override {}
  void interrupt(int line, bool rising) override {
    const auto counter = cards_.counters.begin();
    interrupts.push_back({line, rising, counter == cards_.counters.end() ? 0 : counter->second.latched});
  }
  void power(bool on) override { powered = on; }
  std::optional<devices::ControllerValue> find(const std::string& name) override {
    const auto found = values.find(name);
    if (found == values.end()) return {};
    return devices::ControllerValue{name, "Um", [found] { return found->second; },
                                    [found](double v) { found->second = v; },
                                    devices::ValueRange{-2147483648.0, 2147483647.0, true}};
  }
  [[nodiscard]] std::vector<std::string> names() const override {
    std::vector<std::string> all;
    for (const auto& [name, value] : values) all.push_back(name);
    return all;
  }
  [[nodiscard]] bool has_events() const override { return false; }
  std::vector<devices::ControllerEvent> take_events() override { return {}; }

  struct Interrupt {
    int line;
    bool rising;
    std::int64_t latched;
    bool operator==(const Interrupt&) const = default;
  };
  std::vector<Interrupt> interrupts;
  std::map<std::string, double> values;
  bool powered = true;

 private:
  devices::Cards cards_;
};

class FakePlant : public plants::Plant {
 public:
  void drive(double) override {}
  void sense(double) override {}
  void visit(StateArchive& /*archive*/) override {}
  std::vector<plants::Port> ports() override {
    return {{"encoder", &encoder, ""},
            {"index", &index, ""},
            {"enable", &enable, ""},
            {"reference", &reference, ""}};
  }
  std::vector<plants::Channel> channels() override {
    return {{"speed", "m/min", [this] { return speed * 60; }, ""}};
  }
  std::vector<plants::Setting> settings() override {
    return {
        {"speed", "m/min", [this](double v) { speed = v; }, [this] { return speed; }, "", {0, 300, false}}};
  }
  std::vector<plants::Fault> faults() override {
    return {{"encoder", "lose_counts", "", [this](double v) { lost += v; }, "", plants::in_counts}};
  }

  plants::EncoderPort encoder;
  plants::SignalPort index;
  plants::CommandPort enable;
  plants::ReferencePort reference;
  double speed = 1;  ///< [m/s]
  double lost = 0;
};

inline scenario::Text text(std::string words, int line = 1, int column = 1) {
  return {std::move(words), {line, column}};
}

}  // namespace drycut::sim::fakes
