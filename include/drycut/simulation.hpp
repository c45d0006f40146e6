#pragma once
#include <drycut/check.hpp>
#include <drycut/problem.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// Drycut as a library: a scenario loaded, stepped and read from a program of your own.
namespace drycut {

/// What was given does not fit. what() has a line a problem: `file:line:column: what is wrong; what would be
/// right`.
class BadInput : public std::invalid_argument {
 public:
  explicit BadInput(const std::string& what) : std::invalid_argument(what) {}
  explicit BadInput(Problems problems);
  Problems problems = {};  ///< of files and overrides; none where a call itself was wrong
};

/// The simulation itself cannot go on: it diverged.
class Diverged : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something that happened: in a plant ("web", "cut"), a device, a task or the timeline.
struct Event {
  double time = 0;  ///< [s] since the beginning of the run; it may lie inside a step
  std::string source;
  std::string name;
  std::map<std::string, double> values = {};  ///< in the units that events.csv gives
  std::string text = {};                      ///< of a remark, "" = none
};

/// A scenario put together and run step by step: the controller with its program, the machine, wires,
/// timeline and checks as `drycut run` has them; no pictures, no files. One object is one run from time zero.
/// The same calls give the same numbers. Objects know nothing of each other: each may have a thread of its
/// own.
class Simulation {
 public:
  /// Reads the scenario (.yaml). `set` overrides values of it as --set does: {"plants.web.speed", "80
  /// m/min"}. Throws BadInput with all problems.
  explicit Simulation(const std::filesystem::path& scenario,
                      const std::map<std::string, std::string>& set = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// One step of the machine, scene.step long. Throws Diverged, then and at every later call.
  void step();
  /// So many seconds, 0 or more, rounded to whole steps. Throws Diverged; BadInput for other numbers.
  /// `meanwhile` is called every few thousand steps; what it throws ends it there.
  void advance(double seconds, const std::function<void()>& meanwhile = {});
  /// [s] since the beginning of the run.
  [[nodiscard]] double time() const;
  /// [s] of a step.
  [[nodiscard]] double step_length() const;
  /// [s] that `drycut run` would run; a program may go on beyond it.
  [[nodiscard]] double duration() const;

  /// All names that read() takes: channels of plants, panel, values of the controller.
  [[nodiscard]] std::vector<std::string> names() const;
  /// The number under a name as it is now, in unit(name). Throws BadInput if nothing has this name.
  [[nodiscard]] double read(const std::string& name);
  /// Of what is read or written under a name; "" = a pure number. Throws BadInput if nothing has this name.
  [[nodiscard]] std::string unit(const std::string& name);
  /// Sets what a timeline may set: a plant's setting, a panel switch (0, 1), a value of the controller, which
  /// takes it as from an HMI. In unit(name). Throws BadInput if nothing has this name, it can only be read,
  /// or the number is beyond its range.
  void write(const std::string& name, double value);

  /// This moment: bytes for any file or process. With them this object, or another one of the same scenario,
  /// `set` and build of Drycut, comes back to it and goes on as if nothing had been between.
  [[nodiscard]] std::vector<std::byte> save();
  /// Comes back to a moment, from whatever moment this has come to. take_events() gives what happens from
  /// then on. Throws BadInput, which says what differs, for bytes that are no such moment; then nothing has
  /// changed.
  void restore(const std::vector<std::byte>& moment);

  /// What happened since the last call.
  [[nodiscard]] std::vector<Event> take_events();
  /// The checks of the scenario as if the run ended now.
  [[nodiscard]] std::vector<Check> checks();

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

}  // namespace drycut
