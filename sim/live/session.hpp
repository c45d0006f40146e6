#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/trace_files.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::live {

// A session is all that came from outside into a line that ran live, by the step at which it acted: with it
// the run can be had again to the byte, offline. What came is an entry of a timeline, as scenarios have them;
// so a session is a scenario and a timeline that was not known beforehand.

/// An entry of the timeline that acts at `at`: {set: ...}, {ramp: ..., over: ...}, {fault: ...} or {power:
/// ...}, as YAML or JSON. nullopt after a problem; `name` is what messages call it.
std::optional<scenario::Stimulus> read_act(std::string_view text, const std::string& name, Time at,
                                           Problems& problems);

/// What it is called in its folder; and the retentive values that it began with, where the scenario keeps
/// some.
inline constexpr auto* session_file = "session.yaml";
inline constexpr auto* retentive_copy = "retentive.txt";

/// Whether a file is one.
bool is_session(const std::filesystem::path& file);

struct Session {
  std::filesystem::path scenario;  ///< as it was given, from the session's folder if it is relative
  std::vector<scenario::Override> set;
  std::uint64_t fingerprint = 0;  ///< of the scenario and its files, as they were
  std::vector<scenario::Stimulus> acts;
  Time reached = 0;  ///< it ran until then
};

/// Of a scenario and its files; those of the session are to be compared with it. Of retentive values it is
/// what they are, not where they are kept.
std::uint64_t fingerprint_of(scenario::Scenario& scenario);

/// The file that a live run writes: a line an act, each complete on the disk a second later at the latest.
/// Whatever ends the program, the file is a session up to there.
class SessionFile {
 public:
  /// Makes the file anew, and the copy of retentive values beside it. Throws std::runtime_error if one cannot
  /// be written.
  SessionFile(const std::filesystem::path& file, const scenario::Scenario& scenario,
              std::uint64_t fingerprint);
  /// Goes on behind what is in it.
  explicit SessionFile(const std::filesystem::path& file) : lines_(file, true) {}
  void add(const scenario::Stimulus& act);
  /// The run has come so far; to the disk.
  void reached(Time now);
  /// Bytes that it has.
  [[nodiscard]] std::uint64_t end() const { return lines_.end(); }

 private:
  record::GrowingFile lines_;
};

/// A session to be run again: simulated to `reached`, it is what the live line was.
struct Replay {
  scenario::Scenario scenario;    ///< the acts are the end of its timeline
  std::size_t acts = 0;           ///< so many
  std::uint64_t fingerprint = 0;  ///< of the scenario and its files without the acts
  Time reached = 0;
};

/// Reads a session and its scenario, of the acts those before `until` only. A last line that was cut short is
/// left out. That the scenario or one of its files is another one than it was is said in `notes`.
std::optional<Replay> read_session(const std::filesystem::path& file, std::optional<Time> until,
                                   std::vector<Finding>& notes, Problems& problems);

/// The same as a scenario of its own: extends, duration and the whole timeline, to be written to the file
/// `to`. A problem if an override of the session, or retentive values that it began with, have no place
/// there, or if `to` is one of the scenario's own files.
std::string scenario_of_session(const std::filesystem::path& file, const std::filesystem::path& to,
                                std::vector<Finding>& notes, Problems& problems);

}  // namespace drycut::sim::live
