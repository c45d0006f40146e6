#pragma once
#include <array>
#include <string>

#include "plants/exact_sum.hpp"
#include "plants/plant.hpp"

namespace drycut::plants {

/// A test bench without physics: counters that the timeline turns at stated rates, switches that it sets, and
/// everything that the controller puts out.
class Bench : public Plant {
 public:
  static constexpr int counters = 4;
  static constexpr int digital = 16;
  static constexpr int analogue = 4;

  Bench();

  void drive(double h) override { (void)h; }
  void sense(double h) override;
  void visit(StateArchive& archive) override;
  std::vector<Port> ports() override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;

 private:
  struct CounterInput {
    EncoderPort port;
    SignalPort index;
    ExactSum position;  // [bits x4]
    double rate = 0;    // [bits x4 / s]
    int pulses_wanted = 0;
    int pulses = 0;
    void sense(double h);
    void set_count(double count);
    void visit(StateArchive& archive);
  };
  struct DigitalInput {
    SignalPort port;
    bool shown = false;  // level for which an edge was given
    void visit(StateArchive& archive);
  };
  std::array<CounterInput, counters> counters_;
  std::array<DigitalInput, digital> inputs_;
  std::array<CommandPort, digital> outputs_;
  std::array<ReferencePort, analogue> analogue_;
};

class BenchDefinition : public PlantDefinition {
 public:
  Parameters parameters() override { return {}; }
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
