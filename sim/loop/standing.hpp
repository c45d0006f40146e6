#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Follows what is wired to the controller, from record instant to record instant: what never came, and what
/// came and stays.
class Standing : public record::Observer {
 public:
  Standing(const scenario::Scenario& scenario, devices::Controller& controller);

  void sample(Time now) override;
  void visit(StateArchive& archive) override;

  /// What tells of a machine that stands at `now`, a phrase each: "2.CNT02 (tube.wheel) counted nothing",
  /// "panel.too_long is on since 3.406 s", "never seen on: saw.clamp (2.OUT02)". That it has stopped counts
  /// where it was by `until` [s].
  [[nodiscard]] std::vector<Finding> texts(Time now, double until) const;

  /// "never seen on: saw.home (X10)": of the machine's switches that a program reads; nothing = all were.
  [[nodiscard]] std::optional<Finding> never_on() const;
  /// "saw.home (X10)" if it is such a switch and was never on, else "".
  [[nodiscard]] std::string never_on(const std::string& plug) const;

 private:
  struct Level {
    std::string terminal;
    std::string plug;
    const bool* level;
    bool last;
    bool was_on;
    bool is_wanted;  ///< once on: a program reads the input, a device works the lamp
    std::optional<Time> changed = {};
  };
  struct Count {
    std::string terminal;
    std::string plug;
    const devices::Counter* counter;
    std::int64_t first;
  };
  devices::Controller& controller_;
  std::vector<Level> lamps_;
  std::vector<Level> outputs_;  ///< that move the machine
  Time worked_ = 0;             ///< when one of them changed last ...
  Time longest_ = 0;            ///< ... and the longest time between two such changes
  std::vector<Level> inputs_;   ///< limits apart, which a sound machine never reaches
  std::vector<Count> counts_;
};

}  // namespace drycut::sim::loop
