#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/state_archive.hpp"
#include "sim/live/record.hpp"
#include "sim/time.hpp"

namespace drycut::sim::live {

/// A moment of a line that was kept.
struct Moment {
  Time time = 0;
  std::size_t acts = 0;                       ///< so many had been done
  std::optional<SessionRecord::Reach> reach;  ///< of the record; nothing = there was none, or it had ended
  std::shared_ptr<const StateArchive::Bytes> state;
};

/// The moments of a run: one a second of machine time. When they have no more room half as many come from
/// then on, and every second one of those before makes room for them. That of time zero stays.
class Moments {
 public:
  static constexpr std::size_t most_bytes = std::size_t{64} << 20U;

  explicit Moments(std::size_t most = most_bytes) : most_(most) {}

  /// When the next one is to be kept.
  [[nodiscard]] Time next() const { return next_; }
  void keep(Moment moment);
  /// The newest one at or before `time`; there is one.
  [[nodiscard]] const Moment& before(Time time) const;
  /// The newest one of those that had no more acts than that.
  [[nodiscard]] const Moment& with_acts(std::size_t most) const;
  /// Those behind `time` go.
  void cut(Time time);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] const std::vector<Moment>& all() const { return kept_; }
  /// At most so far apart they are.
  [[nodiscard]] Time apart() const { return apart_; }

 private:
  void thin();

  std::size_t most_;
  std::size_t bytes_ = 0;
  std::vector<Moment> kept_;  ///< by time
  Time apart_ = second;
  Time next_ = 0;
};

/// What a session's folder has of them, for `live --from`: without the file, or with one that is damaged, the
/// session is simulated from zero.
inline constexpr auto* moments_file = "moments.bin";

/// Leaves them beside the session that they are of; what cannot be written is left out.
void write_moments(const std::filesystem::path& folder, const Moments& moments);
/// Those of a session's folder until then; none if the file is no more of that session, whose acts may have
/// been edited.
std::vector<Moment> read_moments(const std::filesystem::path& folder, Time until);

}  // namespace drycut::sim::live
