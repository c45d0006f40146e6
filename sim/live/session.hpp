#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/loop/trace_files.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::live {

// A session is all that came from outside into a line that ran live, by the step at which it acted: with it
// the run can be had again to the byte, offline. What came is an entry of a timeline, as scenarios have them;
// so a session is a scenario and a timeline that was not known beforehand.

/// An entry of the timeline that acts at `at`: {set: ...}, {ramp: ..., over: ...}, {fault: ...} or {power:
/// ...}, as YAML or JSON. nullopt after a problem; `name` is what messages call it.
std::optional<scenario::Stimulus> read_act(std::string_view text, const std::string& name, Time at,
                                           Problems& problems);

/// What it is called in its folder.
inline constexpr auto* session_file = "session.yaml";

/// Whether a file is one.
bool is_session(const std::filesystem::path& file);

struct Session {
  std::filesystem::path scenario;  ///< as it was given, from the session's folder if it is relative
  std::vector<scenario::Override> set;
  std::uint64_t fingerprint = 0;  ///< of the scenario and its files, as they were
  std::vector<scenario::Stimulus> acts;
  Time reached = 0;  ///< it ran until then
};

/// Of a scenario and its files; those of the session are to be compared with it.
std::uint64_t fingerprint_of(const scenario::Scenario& scenario);

/// The file that a live run writes: a line an act, each complete on the disk a second later at the latest.
/// Whatever ends the program, the file is a session up to there.
class SessionFile {
 public:
  /// Makes the file anew. Throws std::runtime_error if it cannot be written.
  SessionFile(const std::filesystem::path& file, const scenario::Scenario& scenario,
              std::uint64_t fingerprint);
  void add(const scenario::Stimulus& act);
  /// The run has come so far; to the disk.
  void reached(Time now);

 private:
  loop::GrowingFile lines_;
};

/// Reads a session and its scenario, which then has the acts at the end of its timeline and the session's
/// duration: run, it is what the live line was. A last line that was cut short is left out. That the scenario
/// or one of its files is another one than it was is said in `notes`.
std::optional<scenario::Scenario> read_session(const std::filesystem::path& file,
                                               std::vector<std::string>& notes, Problems& problems);

/// The same as a scenario of its own: extends, duration and the whole timeline, for a file in `folder`. A
/// problem if an override of the session has no place there.
std::string scenario_of_session(const std::filesystem::path& file, const std::filesystem::path& folder,
                                Problems& problems);

}  // namespace drycut::sim::live
