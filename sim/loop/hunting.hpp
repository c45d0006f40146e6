#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

/// Finds axes that hunt: they swing to and fro, and the swings do not die away.
class Hunting : public record::Observer {
 public:
  explicit Hunting(devices::Controller& controller);

  void sample(Time now) override;
  void visit(StateArchive& archive) override;

  /// Since when [s], and "AxisX hunts from 1.06 s on: it swings by 1570 bits x4, 3.1 times a second": the
  /// first that did.
  [[nodiscard]] std::optional<std::pair<double, Finding>> found() const;

 private:
  struct Turn {
    double at = 0;  ///< [s]
    std::int64_t counts = 0;
  };
  struct Axis {
    std::string name;
    std::function<std::int64_t()> counts;
    Turn extreme = {};            ///< how far it has come since it turned last
    bool forward = true;          ///< which way it goes
    std::deque<Turn> turns = {};  ///< the last of them
    std::optional<double> since = {};
    std::int64_t swing = 0;  ///< [bits x4]
    double rate = 0;         ///< [1/s]
  };

  std::vector<Axis> axes_;
};

}  // namespace drycut::sim::loop
