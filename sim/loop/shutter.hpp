#pragma once
#include <algorithm>
#include <deque>
#include <optional>
#include <vector>

#include "plants/plant.hpp"
#include "sim/loop/pose_keys.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Where every part was at the instant of a frame, and the captions' numbers.
struct Snapshot {
  Time time = 0;
  std::vector<plants::PartPose> poses;  ///< of all plants, in order
  std::vector<double> caption;          ///< one a caption channel, then one a lamp
  std::vector<plants::Callout> callouts;
  struct Quota {
    plants::QuotaLine line;
    double place = 0;  ///< [m]
  };
  std::optional<Quota> quota;
  std::vector<PoseKey> between;  ///< since the frame before, that of each part in order of time
  std::vector<double> turned;    ///< since then, one a part with a pitch [rad]

  void visit(StateArchive& archive);
};

/// Decides when a frame's poses are taken and keeps them: between two times, or around an event. As nobody
/// knows beforehand when an event happens, the poses of the stretch `before` it are held until then. From the
/// first frame on it looks at the parts between frames too, so that what moves fast can be followed.
class Shutter : public record::Observer {
 public:
  explicit Shutter(const scenario::PicturesSection& pictures);

  /// No shots any more.
  void close();
  /// A look is due at the first step at or after this time.
  [[nodiscard]] Time next() const { return std::min(next_, keys_.next()); }
  /// Looks at the parts of all plants, always the same ones. Gives the object to fill with the shot at `now`,
  /// which has the poses already; nullptr if no shot is due, or none is wanted after all.
  Snapshot* look(Time now, const std::vector<plants::Part>& parts);
  void happened(const record::RecordedEvent& event) override;
  void visit(StateArchive& archive) override;

  /// The shots of the film.
  [[nodiscard]] const std::vector<Snapshot>& kept() const { return kept_; }
  /// When the event that the film is about happened [s].
  [[nodiscard]] std::optional<double> event_at() const {
    return event_ ? std::optional(seconds(*event_)) : std::nullopt;
  }
  /// How often it has happened so far.
  [[nodiscard]] int seen() const { return seen_; }

 private:
  // A log of what is kept.
  friend class drycut::StateArchive;
  [[nodiscard]] std::size_t grown() const { return kept_.size(); }
  void shorten(std::size_t size) { kept_.resize(size); }
  void entries(StateArchive& archive, std::size_t from, std::size_t to);

  Snapshot* take(Time now);
  Snapshot* hold(Time now);

  PoseKeys keys_;
  Time period_;
  Time from_;
  std::optional<Time> until_;
  std::optional<scenario::PicturesSection::Around> around_;
  Time next_;                  ///< never: nothing more is wanted
  std::deque<Snapshot> held_;  ///< not older than `before`
  std::vector<Snapshot> kept_;
  int seen_ = 0;
  std::optional<Time> event_;
};

}  // namespace drycut::sim::loop
