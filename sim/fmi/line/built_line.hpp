#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/fmi/line/carried_line.hpp"
#include "sim/fmi/machine/fmi_model.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::fmi {

/// A line with its controller inside, and the table of its variables. The importer is the operator: the
/// timeline, recorded inputs and checks of the scenario are left out.
///
/// Inputs: switches of the panel, `set.web.speed` as the machine has it, `set.glLength` for each value of the
/// program that the timeline or the scenario's panel would have set, faults. Outputs: channels of plants,
/// lamps, values of the controller's devices and programs, events with their values, `alarms.count` and
/// `alarms.time` of what is an error or damage. Parameters: `parameters.length` of variables,
/// `parameters.knife.circumference` of plants, and what can be set of the controller's devices,
/// `parameters.AxisX.pgain`, tunable, which the program may set too. Lists and rows of cam tables are left
/// out.
class BuiltLine : public FmiModel, private record::Observer {
 public:
  /// `changed`: values of the scenario in place of those that it has. Throws Refusal with all problems.
  BuiltLine(const CarriedLine& line, const std::vector<scenario::Override>& changed);
  ~BuiltLine() override;
  BuiltLine(const BuiltLine&) = delete;
  BuiltLine& operator=(const BuiltLine&) = delete;

  void step() override;
  [[nodiscard]] bool had_event() const override { return had_event_; }
  [[nodiscard]] const std::string& failure() const override { return simulation_->failure(); }
  [[nodiscard]] Time time() const override { return simulation_->time(); }
  void visit(StateArchive& archive) override;

  [[nodiscard]] Time step_length() const { return scenario_.scene.step; }
  /// Those that are values of the scenario, by place in the table.
  [[nodiscard]] const std::map<std::uint32_t, LineParameter>& parameters() const { return parameters_; }
  /// Sets others before the first step.
  void take(const Given& given);

 private:
  struct Happening;
  struct Told;

  void happened(const record::RecordedEvent& event) override;
  void read(const CarriedLine& line, const std::vector<scenario::Override>& changed);
  void add_parameter(FmiVariable variable, const std::string& path);
  void add_variables_section();
  void add_plants();
  void add_controller();
  void add_inputs();
  void add_orders();
  void add_events();

  FileSet files_;
  scenario::Scenario scenario_;
  std::vector<std::string> orders_;
  std::set<std::string> live_;  ///< parameters of plants that the timeline could set
  std::unique_ptr<loop::Simulation> simulation_;
  std::map<std::uint32_t, LineParameter> parameters_;
  std::vector<std::unique_ptr<Happening>> happenings_;
  std::vector<std::unique_ptr<Told>> told_;
  std::vector<std::unique_ptr<std::string>> words_;
  bool had_event_ = false;
};

}  // namespace drycut::sim::fmi
