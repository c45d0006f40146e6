#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/loop/checks.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/loop/watch.hpp"
#include "sim/studies/faults/question.hpp"

namespace drycut::sim::studies {

/// What came of a fault at a moment.
struct FaultCell {
  enum class Kind {
    unharmed,  ///< good product, as if nothing had been
    told,      ///< somebody is told in time
    wrong,     ///< wrong product or none, and nobody is told in time
    damage,    ///< something broke, or may have
    stopped,   ///< the simulation itself failed
    lost       ///< its worker on a cluster was lost
  };
  Kind kind = Kind::unharmed;
  std::string told_by = {};               ///< "Knife errorstop: following error"
  std::optional<double> told_after = {};  ///< [s] after the fault
  std::string harm = {};                  ///< the check that failed first, "no more cuts", "saw.crash"
  std::string detail = {};                ///< of the check
  std::optional<double> harm_after = {};  ///< [s]
  int cuts = 0;                           ///< after the fault
  bool goes_on = false;                   ///< there are cuts in the last cycles

  /// Nobody accepts it unasked.
  [[nodiscard]] bool is_red() const { return kind == Kind::wrong || kind == Kind::damage; }

  bool operator==(const FaultCell&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("kind", self.kind);
    archive("told_by", self.told_by);
    archive("told_after", self.told_after);
    archive("harm", self.harm);
    archive("detail", self.detail);
    archive("harm_after", self.harm_after);
    archive("cuts", self.cuts);
    archive("goes_on", self.goes_on);
  }
};

inline constexpr std::array<std::string_view, 6> words_of(FaultCell::Kind) {
  return {"unharmed", "told", "wrong", "damage", "stopped", "lost"};
}

/// A line at which faults are tried, one after the other. Everything is as in a run of its scenario; it is
/// watched by product checks of its own, which begin anew with each fault.
class FaultBench final : public record::Observer {
 public:
  FaultBench(const scenario::Scenario& scenario, Problems& problems);
  FaultBench(const FaultBench&) = delete;
  FaultBench& operator=(const FaultBench&) = delete;

  [[nodiscard]] loop::Simulation& simulation() { return simulation_; }
  /// False if the simulation failed.
  bool run_to(Time until);
  FaultCell cell(const FaultQuestion& question, const TriedFault& fault, const FaultMoment& moment);

  struct Happened {
    Time time;
    double at;  ///< [s]
    std::string source;
    std::string event;
    Severity severity;
  };
  /// Since it was built, or since the fault.
  [[nodiscard]] const std::vector<Happened>& seen() const { return seen_; }
  /// What the product checks have come to since then.
  [[nodiscard]] std::vector<record::CheckResult> product() { return checks_.results(simulation_.time()); }

  void happened(const record::RecordedEvent& event) override;
  void stepped(Time now) override;
  void sample(Time now) override;

 private:
  void watch_anew();
  void tell(Time now, std::string by);
  [[nodiscard]] bool of_plant(const std::string& source) const;

  const scenario::Scenario& scenario_;
  loop::Simulation simulation_;
  loop::Watch watch_;
  loop::Checks checks_;
  StateArchive::Bytes fresh_;  ///< the checks before anything
  std::optional<scenario::Expression> told_;
  struct Enable {
    std::string plug;
    const devices::DigitalOutput* output;
    bool was_on = false;
  };
  std::vector<Enable> enables_;
  Time look_every_;
  Time next_look_ = 0;
  bool held_ = false;  ///< what `told` says at the last look
  std::vector<Happened> seen_;
  std::optional<std::pair<Time, std::string>> told_by_;
};

}  // namespace drycut::sim::studies
