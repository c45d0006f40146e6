#pragma once
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loop/known_events.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/watch.hpp"
#include "sim/record/outcome.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/expression.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Evaluates the checks of a scenario while it runs. always / eventually look at every record instant, the
/// others at every event; an expression has a channel's number in the unit of its trace.csv column. So do
/// statistics: of `all` at every event, else at every physics step, whatever is recorded, over a window of
/// time or, of `each`, from behind one event to the next.
class Checks : public record::Observer {
 public:
  Checks(const scenario::Scenario& scenario, Watch& watch, Names& names,
         const std::vector<KnownEvent>& events, Problems& problems);
  Checks(const Checks&) = delete;
  Checks& operator=(const Checks&) = delete;

  /// A check has statistics of every step: only then need stepped() be told.
  [[nodiscard]] bool looks_at_steps() const { return !stepped_.empty(); }
  void stepped(Time now) override;
  /// The watch has been updated for this record instant.
  void sample(Time now) override;
  /// An event; the watch has been updated for it.
  void happened(const record::RecordedEvent& event) override;
  void visit(StateArchive& archive) override;
  /// As if the run ended at `end`, now; it may go on. `stopped`: it ended before its time, so that what has
  /// held so far is no verdict where there would have been more to judge.
  [[nodiscard]] std::vector<record::CheckResult> results(Time end, bool stopped = false);
  /// The limits that checks set for values of events, with the check's name, whether any event came or not.
  [[nodiscard]] std::vector<std::pair<std::string, record::Tolerance>> stated() const;

 private:
  struct Series {
    std::string value;
    std::string unit;
    std::vector<double> numbers;
  };
  struct Slot {
    std::string name;
    std::string unit;
    double number = 0;
  };
  /// A name in an expression, where its number is, and its unit.
  struct Operand {
    std::string name;
    const double* number;
    std::string unit;
    double noted = 0;                                      ///< the number at an instant to tell of
    double failed = 0;                                     ///< when it did not hold last
    double worst = 0;                                      ///< eventually: at the nearest instant
    double low = std::numeric_limits<double>::infinity();  ///< over all instants, as long as none held
    double high = -std::numeric_limits<double>::infinity();
  };
  /// What a check has come to so far.
  struct Tally {
    int count = 0;  ///< events or instants looked at
    int failed = 0;
    std::optional<double> worst;
    std::optional<double> used;  ///< of its limit, then
    double worst_at = 0;
    std::string worst_values;
    double first_failed_at = 0;
    double last_failed_at = 0;
    double last_at = 0;             ///< instant looked at last
    std::optional<double> held_at;  ///< eventually: first time
    std::string last_window;        ///< what the last one came to
  };
  struct State : Tally {
    scenario::CheckRequest check;
    std::optional<scenario::Expression> expression;
    std::vector<Operand> operands;  ///< what the expression names
    std::deque<Slot> slots;         ///< event values or statistics, by name in the expression
    std::deque<Slot> values;        ///< all: event values, inside statistics
    std::vector<Series> series;     ///< all: the numbers behind the statistics
    std::string unit;               ///< common to all names in the expression
    bool windowed = false;          ///< its expression has statistics
    Time begin = 0;                 ///< always, eventually: of the present window
    double began = 0;               ///< [s] the same, of each too
    bool open = false;              ///< each: a cycle has begun
    bool done = false;              ///< there are no more windows
    bool taken = false;             ///< the present window has seen something
    std::string rate;               ///< of its statistics: ", at each step of 100 us (10 kHz)"
  };

  /// `known`: the names that may be suggested; left as it was.
  void bind(State& state, const scenario::Scenario& scenario, std::vector<std::string>& known,
            const std::vector<KnownEvent>& events, Problems& problems);
  static const KnownEvent* bind_event(State& state, const scenario::Scenario& scenario,
                                      const std::vector<KnownEvent>& events, Problems& problems);
  static void visit(StateArchive& archive, State& state);
  static void start_window(State& state, double at);
  /// Judges the window that ends at a time [s].
  void judge_window(State& state, double at);
  /// Judges the windows that have ended before `now`.
  void close_windows(State& state, Time now);
  void take_into_window(State& state, Time now);
  static bool concerns(const State& state, const record::RecordedEvent& event);
  static void evaluate(State& state, double at, std::string_view values = {});
  static void note_operands(State& state);
  static std::string operands_text(const State& state, double Operand::*number = &Operand::noted);
  static std::string failed_text(const State& state);
  static std::string throughout(const State& state);
  static void finish_statistics(State& state);
  static std::string looked_at(const State& state);
  record::CheckResult result(State& state, Time end);
  static std::vector<record::Tolerance> tolerances_of(const State& state);
  static std::vector<std::string> names_of(const State& state);

  Watch& watch_;
  Watch at_steps_;  ///< what statistics of every step look at
  std::deque<State> states_;
  std::vector<State*> stepped_;  ///< those that have such
};

}  // namespace drycut::sim::loop
