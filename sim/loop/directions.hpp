#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Finds axes that move away from where they are driven to: their count is the wrong way round, or forward
/// and backward are swapped. It looks at the first second in which an axis is driven. And axes that stand on
/// at a small reference: their drive has an offset.
class Directions : public record::Observer {
 public:
  Directions(const scenario::Scenario& scenario, devices::Controller& controller);

  void sample(Time now) override;
  void visit(StateArchive& archive) override;

  /// An axis that goes the wrong way or stands, as the end of a sentence.
  struct Found {
    double at = 0;  ///< [s] when it began
    Finding what;
  };
  [[nodiscard]] const std::vector<Found>& found() const { return found_; }

 private:
  struct Axis {
    devices::Controller::PositionLoop loop;
    std::string swapped;             ///< "2.OUT01 is wired to press.drive.backward", "" = it is not
    std::int64_t counts = 0;         ///< at the last instant
    std::optional<Time> begun = {};  ///< when it was driven first
    std::int64_t with = 0;           ///< counts gone where it was driven to ...
    std::int64_t against = 0;        ///< ... and the other way
    bool done = false;               ///< it is not looked at any more
    // Since when it has stood at which reference, and where.
    Time stood = 0;
    double volts = 0;
    std::int64_t place = 0;
    bool told = false;
  };
  void look_at_standing(Axis& axis, double drive, std::int64_t counts, Time now);
  void tell(const Axis& axis, Time now);

  std::vector<Axis> axes_;
  std::vector<Found> found_;
};

}  // namespace drycut::sim::loop
