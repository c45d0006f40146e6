#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/controller.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

/// What an axis did with one cam table in a run: a sample every record period while its slave was on the cam.
/// Master and slave in the table's units.
struct PlayedCam {
  struct Sample {
    Time time = 0;
    bool begins = false;  ///< the first one since the cam was entered
    double master = 0;
    double set = 0;     ///< where the device wanted the slave
    double behind = 0;  ///< set minus measured; not a number if nothing measures
    double turn = 0;    ///< both are known but for whole turns of this length; 0 = they are known
  };
  std::string axis;
  std::shared_ptr<const devices::CamTable> table;  ///< as the device held it when it took it over
  std::vector<Sample> samples = {};
  std::string text = {};  ///< of a cam of MC_CamIn that is read from its file: no device held it
  /// The fastest that the master was, over 20 ms or a record period [its unit/s]; 0 if it cannot be told.
  double fastest = 0;
  std::size_t left_out = 0;  ///< earlier samples: of a long run the last ones are kept

  void take(const Sample& sample);
  // A log of the samples.
  [[nodiscard]] std::size_t grown() const { return left_out + samples.size(); }
  void shorten(std::size_t size);
  void entries(StateArchive& archive, std::size_t from, std::size_t to);
};

/// Follows the cams of a controller through a run.
class CamRecorder : public record::Observer {
 public:
  /// How far the drive behind a pulse output is behind its pulses, or nothing if none tells.
  using Deviation = std::function<std::function<double()>(const devices::Address& pulses)>;
  /// Without `keeps_samples` tables and speeds are all that is kept: a long run takes no more room.
  CamRecorder(std::vector<devices::CamAxis> axes, const Deviation& deviation, bool keeps_samples = true);

  /// After each step of the devices: takes the tables of the cams that have started.
  void step();
  void sample(Time time) override;
  void visit(StateArchive& archive) override;
  /// What was played, by axis and table in the order of their first start; of an axis that never started its
  /// cam the table that it holds now. Tables of an axis beyond the first 8 are left out and counted in
  /// `untold`.
  [[nodiscard]] std::vector<PlayedCam> played() const;
  [[nodiscard]] std::size_t untold() const { return untold_; }

 private:
  struct Follower {
    devices::CamAxis axis;
    std::function<double()> deviation;
    std::uint64_t start = 0;
    bool followed = false;                       ///< at the last sample, since the last start
    std::deque<std::pair<Time, double>> window;  ///< the latest samples' times and masters
    std::vector<std::size_t> cams;               ///< indices into played_
    std::size_t now = none;                      ///< that is played; none = its table was left out
  };
  void take_speed(Follower& follower, Time time, double master, bool begins);
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  void take_table(Follower& follower);

  bool keeps_samples_;
  std::vector<Follower> followers_;
  std::vector<PlayedCam> played_;
  std::size_t untold_ = 0;
};

}  // namespace drycut::sim::loop
