#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/names.hpp"
#include "sim/loop/watch.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/expression.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Works the stimuli of a scenario: sets, ramps, faults, power. Conditions (`when`) are looked at every
/// millisecond, or every step if that is longer; everything else acts at the first step at or after its time.
class Timeline {
 public:
  /// Binds names and converts quantities; what does not fit is reported with its place in the scenario.
  Timeline(const scenario::Scenario& scenario, Names& names, devices::Controller* controller,
           Problems& problems);

  /// Takes another entry, as if it had stood behind the others from the beginning; false, and nothing taken,
  /// if something does not fit.
  bool add(const scenario::Stimulus& stimulus, Problems& problems);

  /// Acts on everything due at `now`; what was done is told to `record`.
  void run(Time now, record::Recording& recording) {
    if (now >= next_) work(now, recording);
  }

  void visit(StateArchive& archive);

  /// What did not happen in a run that ended at `end`, a line each: a fault that never came proves nothing.
  [[nodiscard]] std::vector<Finding> left_undone(Time end) const;
  /// When an entry of that line that has not acted yet is due; nothing of one that waits for its `when`.
  [[nodiscard]] std::optional<Time> due(int line) const;

 private:
  struct Write {
    Target target;
    double value = 0;  ///< in what the target's write takes
    std::string text;  ///< "web.speed = 80 m/min"
  };
  struct FaultWrite {
    std::function<void(double)> act;
    double value = 0;
    std::string text;
  };
  struct Entry {
    std::optional<scenario::Expression> when;  ///< still waited for
    Time from = 0;                             ///< `when` is not looked at before
    Time due = 0;                              ///< acts then, unless it waits
    Time after = 0;
    std::optional<Time> every;
    Time over = 0;
    std::vector<Write> sets;
    std::vector<Write> ramps;
    std::vector<FaultWrite> faults;
    std::optional<bool> power;
    int line = 0;  ///< of the scenario
    bool acted = false;
  };
  struct Ramp {
    Target target;
    double from = 0;
    double to = 0;
    Time start = 0;
    Time over = 0;
  };

  [[nodiscard]] Entry bind(const scenario::Stimulus& stimulus, const std::vector<std::string>& known,
                           Problems& problems);
  void take(Entry entry);
  void work(Time now, record::Recording& recording);
  /// Makes the entries anew that were done since, and lets those go that came since.
  void take_again(std::size_t taken, const std::vector<std::size_t>& gone);
  [[nodiscard]] const scenario::Stimulus& stimulus(std::size_t number) const;
  void trigger(Time now);
  void act(const Entry& entry, Time now, record::Recording& recording);
  void move_ramps(Time now);
  [[nodiscard]] Time next_after(Time now) const;

  const scenario::Scenario& scenario_;
  Names& names_;
  Watch watch_;
  devices::Controller* controller_;
  Time look_every_;
  Time next_look_ = 0;
  Time next_ = 0;
  // A recorded day has a hundred thousand entries: what is done for good goes, and only what is due is
  // touched.
  std::map<std::size_t, Entry> entries_;  ///< by the order in which they stand
  std::size_t taken_ = 0;
  std::vector<scenario::Stimulus> added_;         ///< by add()
  std::set<std::size_t> waiting_;                 ///< those with a `when`
  std::set<std::pair<Time, std::size_t>> timed_;  ///< the others, by when they are due
  std::vector<Ramp> ramps_;
};

}  // namespace drycut::sim::loop
