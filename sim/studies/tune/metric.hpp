#pragma once
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loop/known_events.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/loop/watch.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/expression.hpp"

namespace drycut::sim::studies {

/// What a metric looks at: a channel, or a value of every event.
struct MetricName {
  std::string text;        ///< as written: "AxisX.follerr", "cut.length"
  std::size_t offset = 0;  ///< where, in the metric's text
  std::string event;       ///< "cut", "knife.cut"; "" = a channel
  std::string value;       ///< of the event
};

/// What was measured at the position loop, for constraints; NaN = not measured.
struct LoopFigures {
  double phase_margin = std::numeric_limits<double>::quiet_NaN();     ///< [deg]
  double gain_margin = std::numeric_limits<double>::quiet_NaN();      ///< [dB]
  double max_sensitivity = std::numeric_limits<double>::quiet_NaN();  ///< largest |1 / (1 + L)|
};

/// One number out of a whole recording: a formula over statistics (max, min, mean, rms, sd, count, pNN of an
/// expression over channels, or over the values of one event, and settling(expression, band)), as checks have
/// them. max and min with several arguments are the plain ones.
///
/// A name EVENT.VALUE or SOURCE.EVENT.VALUE of an event that the scenario knows means the event's; any other
/// is a channel. A limit may also name the loop's figures phase_margin, gain_margin and max_sensitivity,
/// outside of terms. One object must not be used by two threads at once.
class Metric {
 public:
  enum class Kind {
    number,  ///< something to minimise
    limit    ///< terms and figures of the loop, compared by < <= > >=, joined by &&
  };
  /// The unit of a channel; nothing if it is not known yet.
  using UnitOf = std::function<std::optional<std::string>(const std::string& channel)>;
  /// Compiles `text`; what is wrong is added to `faults`, and then nothing is returned. Channels are not
  /// looked up here.
  static std::optional<Metric> compile(std::string_view text, Kind kind,
                                       const std::vector<loop::KnownEvent>& events,
                                       std::vector<scenario::ExpressionFault>& faults,
                                       const UnitOf& unit_of = {});

  /// Before a run: its channels are taken from `watch`, by take(), from `from` on. False if it looks at none.
  bool follow(loop::Watch& watch, Time from);
  /// The watch has been updated.
  void take(Time now);

  /// A number: its value. A limit: the room left, negative beyond it. Over instants and events from `from`
  /// on. Channels are those that were followed; else they must have been recorded. NaN where a term has
  /// nothing to look at.
  [[nodiscard]] double value(const record::Recording& recording, Time from, const LoopFigures& loop = {});
  /// True if a figure of the loop is in it.
  [[nodiscard]] bool needs_loop() const;
  /// Every name, once.
  [[nodiscard]] std::vector<MetricName> names() const;
  /// Of a number: its unit. Of a limit: that of the room left. "" where none can be said, as in a formula of
  /// several terms.
  [[nodiscard]] std::string unit() const;

 private:
  struct Slot {
    MetricName name;
    double number = 0;
    const double* followed = nullptr;
  };
  struct Figure {
    double LoopFigures::*figure;
    double number = 0;
  };
  class Compiler;

  void take(std::size_t term, const record::Recording& recording, Time from);
  [[nodiscard]] bool follows(std::size_t term) const { return terms_[term][0]->followed != nullptr; }

  std::string text_;
  std::deque<Slot> slots_;
  std::vector<std::vector<Slot*>> terms_;  ///< what each statistic of the formula looks at
  std::deque<Figure> figures_;
  std::optional<scenario::Expression> formula_;
  Kind kind_ = Kind::number;
  Time from_ = 0;  ///< what is followed counts from here on
};

/// Takes what metrics look at every step of a run, as checks do: whatever is recorded. It lives until the
/// run's end.
class MetricSteps : public record::Observer {
 public:
  MetricSteps(loop::Simulation& simulation, const std::vector<Metric*>& metrics, Time from);
  void stepped(Time now) override;

 private:
  loop::Watch watch_;
  std::vector<Metric*> metrics_;  ///< those that look at channels
};

}  // namespace drycut::sim::studies
