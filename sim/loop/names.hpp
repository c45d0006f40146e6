#pragma once
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "plants/plant.hpp"

namespace drycut::sim::scenario {
struct Scenario;
struct Wire;
}  // namespace drycut::sim::scenario

namespace drycut::sim::loop {

struct NamedPlant;
struct OperatorPanel;

/// A number that can be recorded or used in an expression.
struct Reading {
  std::string name;
  std::string unit;  ///< of the number; "" = pure number
  std::function<double()> read;
  std::string meaning = {};  ///< "" where nothing says it
};

/// A number that the timeline can set or ramp; `write` takes it in `unit` as the timeline gives it (SI for
/// plants), "" = pure number.
using Target = devices::ControllerValue;

/// What a plant's setting or fault takes, in its unit.
devices::ValueRange range_of(const plants::Range& range);

/// Says which plants are called like something of the controller: their names would mean two things.
void refuse_shared_names(const scenario::Scenario& scenario, devices::Controller& controller,
                         Problems& problems);

/// The nearest name is looked for so often at most, for it takes a look at all names: of ten thousand slips
/// the first ones tell enough.
inline constexpr std::size_t most_suggestions = 100;

/// Every name of a running scenario: `knife.angle`, `AxisX.posit`, `panel.start`, `slLength`, `2.AN01`.
/// Plants come first, then the panel, then the controller; any of them may be absent.
class Names {
 public:
  Names(const std::vector<NamedPlant>& plants, devices::Controller* controller, OperatorPanel& panel);
  /// More faults, of what is no plant: wires.
  void offer(std::vector<std::pair<std::string, plants::Fault>> faults) { of_wires_ = std::move(faults); }
  /// For a scenario whose controller has problems of its own: every name that no plant and no panel could
  /// have is taken for one of the controller's, and the panel has what `wiring` names, so that only what is
  /// wrong is told.
  void assume_controller(const std::vector<scenario::Wire>& wiring);

  /// What can be recorded or checked under this name.
  std::optional<Reading> reading(const std::string& name);
  /// What can be set under this name.
  std::optional<Target> target(const std::string& name);
  /// The fault `fault` of `component` ("knife.encoder").
  std::optional<plants::Fault> fault(const std::string& component, const std::string& fault);

  /// What a disturbance can be added to under this name: a plant's setting, live parameter or fault, which is
  /// "component.fault" and reads what the machine has without it.
  std::optional<Target> disturbed(const std::string& name);
  /// True if it is a fault, which a setting of the same name goes before.
  [[nodiscard]] bool is_fault(const std::string& name) {
    return !settings_.contains(name) && fault_called(name) != nullptr;
  }
  /// From now on this stands for that target: whoever sets or reads it, does so here.
  struct StandIn {
    std::function<void(double)> write;
    std::function<double()> read;
  };
  void stand_in(const std::string& name, StandIn in_place);

  /// From now on `by` drives it, a recording or the end of a wire, and nothing else sets it.
  void drive(const std::string& name, const std::string& by = "a recording") { driven_.emplace(name, by); }
  /// "" if nothing does.
  [[nodiscard]] std::string driven_by(const std::string& name) const {
    const auto found = driven_.find(name);
    return found == driven_.end() ? "" : found->second;
  }
  [[nodiscard]] bool is_driven(const std::string& name) const { return driven_.contains(name); }

  /// Remedies for an unknown name: the nearest one, or what there is.
  [[nodiscard]] std::string suggest_reading(const std::string& name) const;
  [[nodiscard]] std::string suggest_target(const std::string& name) const;
  [[nodiscard]] std::string suggest_fault(const std::string& component) const;
  [[nodiscard]] std::string suggest_disturbed(const std::string& name) const;
  /// All names that `reading` knows.
  [[nodiscard]] std::vector<std::string> reading_names() const;
  /// What an operator works: switches of the panel, then settings and live parameters of plants.
  [[nodiscard]] std::vector<std::string> setting_names() const;
  /// "panel.in_sync"
  [[nodiscard]] std::vector<std::string> lamp_names() const;
  /// All of the plants, each under its component's full name.
  [[nodiscard]] const std::vector<std::pair<std::string, plants::Fault>>& faults() const { return faults_; }
  /// Likewise of the wires: "wire.2.INP01", cut.
  [[nodiscard]] const std::vector<std::pair<std::string, plants::Fault>>& faults_of_wires() const {
    return of_wires_;
  }

 private:
  // "knife.encoder.jitter"
  [[nodiscard]] plants::Fault* fault_called(const std::string& name);

  devices::Controller* controller_;
  [[nodiscard]] bool of_controller(const std::string& name) const;

  OperatorPanel& panel_;
  bool assumed_ = false;
  std::map<std::string, plants::Channel> channels_;
  std::map<std::string, plants::Setting> settings_;                         ///< and live parameters
  std::vector<std::pair<std::string, plants::Fault>> faults_;               ///< full component name, fault
  std::map<std::pair<std::string, std::string>, std::size_t> fault_index_;  ///< component and fault
  std::vector<std::pair<std::string, plants::Fault>> of_wires_;
  std::set<std::string> plant_names_;
  std::map<std::string, std::string> driven_;  ///< by whom
  mutable std::size_t suggestions_ = 0;        ///< made so far
};

}  // namespace drycut::sim::loop
