#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/problem.hpp"
#include "sim/time.hpp"

namespace drycut::sim::live {

class LineRun;

/// Who asked, so that the answer finds its way: 0 = nobody waits for one.
using Asker = std::uint64_t;

// What can be asked of a line. Each acts between two cycles.

/// Something is done to the line, as a timeline does it: JSON or YAML, see read_act().
struct Act {
  std::string text;
};
/// Run, or stand still.
struct Go {
  bool on = false;
};
/// So much machine time, then stand still.
struct Advance {
  Time by = 0;
};
/// As fast as it goes to the next event of that name ("cut", "knife.cut"), "" = of any; then stand still.
struct UntilEvent {
  std::string name;
};
/// Machine seconds a second; 0 = as fast as it goes.
struct Pace {
  double value = 1;
};
/// From the beginning, with scenario and programs read again.
struct Restart {};
/// What the asker wants to have sampled every cycle, in place of what it wanted before.
struct Sample {
  std::vector<std::string> names;
  std::size_t watched = 0;  ///< of so many at the end the latest value is enough
  bool programs = false;    ///< and where the programs stand
  bool operator==(const Sample&) const = default;
};
/// The asker is gone.
struct Leave {};
/// Some values as they are now, told at once, in the line's thread; whoever asked is not answered otherwise.
struct Read {
  std::vector<std::string> names;
  std::function<void(const Problems&, const std::vector<double>&)> told;
};
/// What was to be seen of the run at a time that it has behind it.
struct Seen;
/// It is told that, from another thread, while the line goes on; whoever asked is not answered otherwise. Who
/// asks again before that is told of the later one only: the earlier one is a problem then.
struct Look {
  Time time = 0;
  std::vector<std::string> names;  ///< whose values are wanted
  bool programs = false;           ///< and where the programs stood
  std::function<void(const Problems&, const Seen&)> told;
};
/// The run as it was then goes on as the next one, with all that was done before that.
struct GoOn {
  Time from = 0;
};
/// Looks at the run and does something to it, in the line's thread; whoever asked is not answered otherwise.
struct Visit {
  std::function<void(LineRun&)> visit;
};

struct Request {
  Asker asker = 0;
  std::variant<Act, Go, Advance, UntilEvent, Pace, Restart, Sample, Leave, Read, Look, GoOn, Visit> what;
  std::size_t bytes = 0;  ///< of the message that it came as
};

}  // namespace drycut::sim::live
