#pragma once
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "plants/plant.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::live {

/// What is seen of a line at one moment.
struct Sight {
  std::vector<plants::PartPose> poses;  ///< as LineDescription::parts
  std::vector<double> values;           ///< as LineDescription::targets
  std::vector<double> lamps;            ///< as LineDescription::lamps
};

/// A simulation of the line's scenario, and what is seen of it.
class LineView final : public record::Observer {
 public:
  /// May be used if there are no problems; `scenario` outlives it.
  LineView(const scenario::Scenario& scenario, Problems& problems);

  [[nodiscard]] loop::Simulation& simulation() { return *simulation_; }
  [[nodiscard]] Time now() const { return simulation_->time(); }
  /// Who hears of it, in that order: nobody else does any more.
  void tell(std::vector<record::Observer*> to) { to_ = std::move(to); }
  void sample(Time time) override;
  void happened(const record::RecordedEvent& event) override;

  /// What an operator sets: switches of the panel, settings of plants.
  [[nodiscard]] const std::vector<loop::Target>& targets() const { return targets_; }
  [[nodiscard]] const std::vector<loop::Reading>& lamps() const { return lamps_; }
  /// How a value is read, nullptr if there is none of that name.
  [[nodiscard]] const std::function<double()>* known(const std::string& name);
  /// The values of these channels now, in their units; none after a problem.
  [[nodiscard]] Problems values_of(const std::vector<std::string>& names, std::vector<double>& values);
  void look(Sight& sight) const;
  /// Whether somebody looks at its programs.
  void watch_programs(bool on);
  [[nodiscard]] bool watches_programs() const { return watches_; }

 private:
  std::unique_ptr<loop::Simulation> simulation_;
  std::vector<record::Observer*> to_;
  std::vector<plants::Part> shown_;
  std::vector<loop::Target> targets_;
  std::vector<loop::Reading> lamps_;
  std::unordered_map<std::string, std::function<double()>> known_;  ///< what has been looked up
  bool watches_ = false;
};

}  // namespace drycut::sim::live
