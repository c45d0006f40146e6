#pragma once
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loop/checks.hpp"
#include "sim/loop/recorder.hpp"
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

/// One number out of a whole recording: a formula over the terms max, min, mean, rms, sd, count (of an
/// expression over channels, or over the values of one event) and settling(expression, band). max and min
/// with several arguments are the plain ones. settling is the time [s] from the window's start until
/// |expression| stays at or below the band; the whole window if it never does. sd is that of a sample (n -
/// 1).
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
  /// Compiles `text`; what is wrong is added to `faults`, and then nothing is returned. Channels are not
  /// looked up here.
  static std::optional<Metric> compile(std::string_view text, Kind kind,
                                       const std::vector<loop::KnownEvent>& events,
                                       std::vector<scenario::ExpressionFault>& faults);

  /// A number: its value. A limit: the room left, negative beyond it. Over instants and events from `from`
  /// on; the channels must have been recorded. NaN where a term has nothing to look at.
  [[nodiscard]] double value(const loop::Recording& recording, Time from, const LoopFigures& loop = {});
  /// True if a figure of the loop is in it.
  [[nodiscard]] bool needs_loop() const;
  /// Every name, once.
  [[nodiscard]] std::vector<MetricName> names() const;

 private:
  enum class Function { max, min, mean, rms, sd, count, settling };
  struct Slot {
    MetricName name;
    double number = 0;
  };
  struct Term {
    Function function = Function::max;
    std::deque<Slot> slots;
    std::optional<scenario::Expression> expression;  ///< margin = the value
    double band = 0;
    double result = 0;
  };
  struct Figure {
    double LoopFigures::*figure;
    double number = 0;
  };
  struct Numbers {
    std::vector<double> times;  ///< [s]
    std::vector<double> numbers;
  };
  class Compiler;

  static Numbers series_of(Term& term, const loop::Recording& recording, Time from);
  static double reduce(const Term& term, const Numbers& series, double from);

  std::deque<Term> terms_;
  std::deque<Figure> figures_;
  std::optional<scenario::Expression> formula_;
};

}  // namespace drycut::sim::studies
