#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sim/live/session.hpp"
#include "sim/record/recording.hpp"
#include "sim/record/trace_files.hpp"

namespace drycut::sim::live {

/// What a live run writes: its session, its trace and its events. When one of them cannot be written any more
/// (a full disk), the record ends there, in whole lines, and the run goes on without.
class SessionRecord final : public record::Observer {
 public:
  /// In a new folder in `folder`, which has the next number. `recording` has all its channels and outlives
  /// this.
  SessionRecord(const std::filesystem::path& folder, const scenario::Scenario& scenario,
                std::uint64_t fingerprint, const record::Recording& recording);

  /// So much of a record had been written at a moment [bytes].
  struct Reach {
    std::uint64_t session = 0;
    std::uint64_t trace = 0;
    std::uint64_t events = 0;
  };
  /// What was recorded up to a moment.
  struct Past {
    std::filesystem::path folder;
    std::optional<Reach> reach;  ///< nothing = it was lost before
  };
  /// The same, beginning with that much of another record.
  SessionRecord(const std::filesystem::path& folder, const Past& past, const record::Recording& recording);

  void sample(Time time) override;
  void happened(const record::RecordedEvent& event) override;
  /// Everything is in the files.
  void finish() override;
  /// Something was done to the line.
  void add(const scenario::Stimulus& act);
  /// The run has come so far; to the disk.
  void reached(Time now);

  /// So far it goes now; nothing if it has ended.
  [[nodiscard]] std::optional<Reach> reach() const;
  /// What could not be written and why, "" = nothing.
  [[nodiscard]] const std::string& lost() const { return lost_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  void write(const std::function<void()>& what);

  std::filesystem::path folder_;
  std::optional<SessionFile> session_;
  std::optional<record::TraceFiles> files_;
  std::string lost_;
};

}  // namespace drycut::sim::live
