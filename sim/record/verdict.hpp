#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/record/outcome.hpp"

namespace drycut::sim::record {

/// Exit status of the program (design §6).
enum ExitStatus : int {
  all_passed = 0,
  check_failed = 1,
  bad_input = 2,            ///< one line a problem on standard error; nothing was written
  simulation_failed = 3,    ///< diverged, or a result could not be written; what was recorded is kept
  interrupted_status = 130  ///< by a signal, where that itself does not end it
};

/// What a run or a study came to, as a program asks for it: verdict.json in its folder.
struct Verdict {
  enum class Came { none, passed, failed };  ///< none: it judges nothing

  int format = 1;
  std::string kind = {};  ///< "run", "sweep": what wrote it
  Came verdict = Came::none;
  int exit = all_passed;                         ///< status of a command that does this alone
  Prose sentence = {};                           ///< "2 of 5 checks failed: ..."
  std::vector<std::string> codes{};              ///< of what was found
  std::map<std::string, long long> counts = {};  ///< "checks", "failed"; no Time, which is written in seconds
  std::vector<std::string> scenarios = {};       ///< files, as they were named
  std::vector<std::string> files = {};           ///< in the folder, this one among them
  Prose title = {};                              ///< of what was asked
  Prose word = {};                               ///< in place of PASS or FAIL: "SAME", "3 FIT"
  std::string drycut = {};                       ///< the version
  std::optional<double> simulated = {};          ///< [s] of a run

  /// It judges, and says so by its exit status.
  void judge(bool passed);
  /// The simulation itself failed, wholly or of some points: it says nothing of the rest.
  void stopped(int status = simulation_failed);
  /// Their codes, each once.
  void found(const std::vector<Finding>& findings);
  /// What a page is headed with.
  [[nodiscard]] std::string headword() const;

  bool operator==(const Verdict&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("format", self.format);
    archive("kind", self.kind);
    archive("verdict", self.verdict);
    archive("exit", self.exit);
    archive("sentence", self.sentence);
    archive("codes", self.codes);
    archive("counts", self.counts);
    archive("scenarios", self.scenarios);
    archive("files", self.files);
    archive("title", self.title);
    archive("word", self.word);
    archive("drycut", self.drycut);
    archive("simulated", self.simulated);
  }
};

inline constexpr std::array<std::string_view, 3> words_of(Verdict::Came) {
  return {"none", "passed", "failed"};
}

inline constexpr auto* verdict_file = "verdict.json";
inline constexpr auto* checks_file = "checks.json";

/// Of a run: what its checks came to, those that failed by their names, and why if that is known.
Verdict verdict_of(const Outcome& outcome);

/// Writes it into the folder, with the folder's kind and files, as the last of these. Throws
/// std::runtime_error if that cannot be done.
void write_verdict(Verdict verdict, OutputFolder& folder);

/// The verdict in a folder; nullopt if there is none that can be read. Of a run of an earlier release, which
/// wrote none, what checks.json says.
std::optional<Verdict> read_verdict(const std::filesystem::path& folder);

}  // namespace drycut::sim::record
