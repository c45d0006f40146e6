#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sim/loop/band_noise.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/time.hpp"

namespace drycut::sim::loop {

/// What a scenario adds to settings, live parameters and faults of its plants, each entry with a generator of
/// its own. Added to what the timeline sets, a ramp included; the sum keeps to the target's range. Faults
/// count from what the machine has without them, mostly 0.
class Disturbances {
 public:
  /// Binds names and converts quantities; what does not fit is reported with its place in the scenario.
  /// Whoever asks `names` for a disturbed target from now on sets what the disturbance is added to.
  Disturbances(const scenario::Scenario& scenario, Names& names, Problems& problems);
  // Its targets are known by their place.
  Disturbances(const Disturbances&) = delete;
  Disturbances& operator=(const Disturbances&) = delete;

  /// Adds what is due at `now`, once a step.
  void run(Time now) {
    if (now >= next_) work(now);
  }
  void visit(StateArchive& archive);

 private:
  struct Sum {
    Target target;
    double low = 0;  ///< range, in what the target's write takes
    double high = 0;
    double base = 0;
    bool is_fault = false;
    double added = 0;
    bool active = false;  ///< something is added now
    bool was_active = false;
    void put() const;
  };
  struct Source {
    const scenario::Disturbance* of = nullptr;
    Sum* sum = nullptr;
    double amplitude = 0;  ///< in what the target's write takes
    double step = 0;
    plants::Random random;
    std::optional<BandNoise> noise = {};
    double value = 0;  ///< of steps and walks
    Time next = 0;     ///< the next of them
    [[nodiscard]] bool active(Time now) const { return now >= of->from && (!of->to || now < *of->to); }
    double at(Time now);
  };

  Sum* sum_of(const scenario::Text& name, const scenario::Scenario& scenario, Names& names,
              Problems& problems);
  void work(Time now);

  std::deque<Sum> sums_;
  std::vector<Source> sources_;
  Time next_ = never;
};

}  // namespace drycut::sim::loop
