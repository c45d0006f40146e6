#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace drycut::sim::cluster {

class Engine;

/// One of many runs that know nothing of each other.
struct Ask {
  std::string text;                   ///< what is asked, JSON: with the round's question all that it takes
  std::function<std::string()> here;  ///< answers it in this process
};
/// What came of it.
struct WorkerAnswer {
  std::string text;  ///< in one line
  std::string lost;  ///< why there is none: whoever ran it died, each time. "" = there is one
};

/// A round of runs: what they have in common and what each is.
struct Round {
  std::string kind;      ///< who can answer: "point", "trial", "fault" (sim/cli/work_command.cpp)
  std::string question;  ///< JSON
  std::size_t count = 0;
  /// Reads run `i`, on several threads at once; nothing if its answer is known.
  std::function<std::optional<Ask>(std::size_t i)> ask;
  /// Is given the answers as they come, one at a time.
  std::function<void(std::size_t i, const WorkerAnswer& answer)> take;
};

/// Whoever does the runs of a study: threads of this process, or an engine on other machines. The answers do
/// not depend on it.
class Workers {
 public:
  /// Threads of this process.
  Workers(int jobs) : jobs_(jobs) {}  // NOLINT(google-explicit-constructor): a number of jobs is all it takes
  /// `jobs` threads read, `engine` runs.
  Workers(int jobs, std::shared_ptr<Engine> engine) : jobs_(jobs), engine_(std::move(engine)) {}

  /// Throws what a run here throws; of an engine std::runtime_error if it cannot go on, and Interrupted.
  void run(const Round& round) const;

 private:
  int jobs_;
  std::shared_ptr<Engine> engine_;  ///< none = here
};

}  // namespace drycut::sim::cluster
