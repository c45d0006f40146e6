#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/controller.hpp"
#include "devices/plcopen/axis_parameters.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::devices::plcopen {
class PlcopenController;
namespace st {
enum class StDialect : std::uint8_t;
}
}  // namespace drycut::devices::plcopen

namespace drycut::sim::controllers {

// What each kind of controller is in a scenario: its keys, its files, how it is loaded; one a file of this
// folder.

/// controller: qmove: ...
struct QmoveSection final : scenario::ControllerSection {
  scenario::Text configuration;       ///< path of the .CNF, relative to the scenario
  std::vector<scenario::Text> tasks;  ///< paths of the QCL units, one task each
  Time cycle = 2 * millisecond;       ///< a round of all tasks begins every `cycle`
  Time statement_time = 0;            ///< what a statement takes

  [[nodiscard]] std::string_view kind() const override { return "qmove"; }
  void visit(scenario::Archive& archive) override;
  [[nodiscard]] Period period() const override { return {"cycle", cycle}; }
  [[nodiscard]] std::vector<scenario::Text> files() const override;
  [[nodiscard]] std::string_view settable() const override;
  std::unique_ptr<devices::Controller> load(const scenario::Scenario& scenario, Problems& problems,
                                            std::vector<Finding>* notes) const override;
};

/// controller: lx3vp: ...
struct Lx3vpSection final : scenario::ControllerSection {
  scenario::Text program;       ///< path of the instruction list, relative to the scenario
  scenario::Text registers;     ///< path of a CSV with register values before power-up, "" = none
  Time scan = 1 * millisecond;  ///< a scan of the program begins every `scan`
  Time step_time = 0;           ///< what an instruction takes

  [[nodiscard]] std::string_view kind() const override { return "lx3vp"; }
  void visit(scenario::Archive& archive) override;
  [[nodiscard]] Period period() const override { return {"scan", scan}; }
  [[nodiscard]] std::vector<scenario::Text> files() const override;
  [[nodiscard]] std::string_view settable() const override;
  std::unique_ptr<devices::Controller> load(const scenario::Scenario& scenario, Problems& problems,
                                            std::vector<Finding>* notes) const override;
};

/// controller: plcopen: ...
struct PlcopenSection final : scenario::ControllerSection {
  /// Files and folders of Structured Text, relative to the scenario: what stands there.
  std::vector<scenario::Text> program;
  std::vector<scenario::Text> program_files;  ///< the same, of a folder its *.st by name
  Time cycle = 2 * millisecond;               ///< of the axes
  Time task_cycle = 2 * millisecond;  ///< of the program, a whole multiple of it; `cycle` if not given
  Time statement_time = 0;            ///< what a statement takes
  std::optional<devices::plcopen::st::StDialect>
      dialect;  ///< of the program; not given: CODESYS's, with notes
  struct Axis {
    scenario::Text name;
    devices::plcopen::AxisConfiguration configuration = {};
    std::vector<std::pair<std::string, scenario::ScenePlace>> places =
        {};                           ///< of the parameters that the file gives
    std::vector<Finding> notes = {};  ///< numbers without a unit beside others that have one
  };
  std::vector<Axis> axes;
  struct Table {
    scenario::Text file;  ///< .tab or .csv, relative to the scenario
    int id = 0;           ///< in place of the file's own; 0 = that
  };
  std::vector<Table> tables;
  struct Task {
    scenario::Text name;
    Time cycle = 0;                        ///< a whole multiple of the axes' `cycle`
    int priority = 0;                      ///< 0 runs first
    std::vector<scenario::Text> programs;  ///< of the program's file
  };
  std::vector<Task> tasks;  ///< of several PROGRAMs; others run every `task_cycle`
  struct ModbusBit {
    scenario::Text address;
    scenario::Text value;  ///< of the controller
  };
  enum class WordOrder { low_first, high_first };
  struct ModbusWord {
    scenario::Text address;
    scenario::Text value;
    devices::ModbusFormat type = devices::ModbusFormat::int16;
    WordOrder order = WordOrder::low_first;
  };
  struct Modbus {
    std::vector<ModbusBit> coils;
    std::vector<ModbusBit> discrete_inputs;
    std::vector<ModbusWord> holding_registers;
    std::vector<ModbusWord> input_registers;
  };
  Modbus modbus;  ///< beside what the program has AT %M

  [[nodiscard]] std::string_view kind() const override { return "plcopen"; }
  void visit(scenario::Archive& archive) override;
  [[nodiscard]] Period period() const override { return {"cycle", cycle}; }
  [[nodiscard]] std::vector<scenario::Text> files() const override;
  [[nodiscard]] std::string_view settable() const override;
  [[nodiscard]] std::vector<Finding> contradictions(const scenario::Scenario& scenario,
                                                    const ScaleOf& scale_of) const override;
  std::unique_ptr<devices::Controller> load(const scenario::Scenario& scenario, Problems& problems,
                                            std::vector<Finding>* notes) const override;

 private:
  void find_program_files(scenario::Findings& findings);
  void visit_modbus(scenario::Archive& archive);
  void fill_modbus(devices::plcopen::PlcopenController& controller, const scenario::Scenario& scenario,
                   Problems& problems) const;
};
void visit(scenario::Archive& archive, PlcopenSection::Axis& axis);
void visit(scenario::Archive& archive, PlcopenSection::Table& table);
void visit(scenario::Archive& archive, PlcopenSection::ModbusBit& bit);
void visit(scenario::Archive& archive, PlcopenSection::ModbusWord& word);

/// The scenario's controller if it is of this kind, else nullptr.
template <typename Section>
const Section* controller_of(const scenario::Scenario& scenario) {
  return dynamic_cast<const Section*>(scenario.controller.get());
}

/// The keys that every kind has: its retentive file and the values before power-up.
void visit_memory(scenario::Archive& archive, scenario::ControllerSection& section);
/// The key of those with analogue outputs: how long they compute.
void visit_compute_time(scenario::Archive& archive, scenario::ControllerSection& section);
/// Reads the file that a section names; one that cannot be read is a problem at its name.
std::optional<std::string> read_named(const scenario::Text& path, const scenario::Scenario& scenario,
                                      Problems& problems);
/// The same for a table, its cells with variables of the scenario computed.
std::optional<std::string> read_named_table(const scenario::Text& path, const scenario::Scenario& scenario,
                                            Problems& problems);

}  // namespace drycut::sim::controllers
