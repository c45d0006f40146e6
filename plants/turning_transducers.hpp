#pragma once
#include <string_view>
#include <vector>

#include "plants/plant.hpp"
#include "plants/transducers.hpp"

namespace drycut::plants {

/// What the angle of a load that turns without end is measured with: an encoder, and a home switch at the
/// load.
struct TurningTransducersData {
  EncoderData encoder = {};
  bool encoder_on_load = false;  ///< else it is on the motor
  PositionSwitchData home = {};  ///< angles [rad]

  /// Counts (x4) for a radian of the load, behind a gear of `ratio`.
  [[nodiscard]] double counts_per_radian(double ratio) const;
};

/// How a machine speaks of them in its table, and where its defaults are from.
struct TurningTransducersWords {
  std::string_view on_load;  ///< the parameter: "encoder.on_drum"
  std::string_view on_load_meaning;
  std::string_view reverse_meaning;
  std::string_view home_meaning;
  std::string_view lines_from;
  std::string_view home_from;
  std::string_view hysteresis_from;
};

/// Rows for a parameter table: `encoder.`, `home.`.
Parameters turning_transducer_parameters(TurningTransducersData& data, const TurningTransducersWords& words);
/// What is wrong with the data taken together.
std::vector<PlantDefinition::Objection> turning_transducer_objections(const TurningTransducersData& data);

/// The encoder counts 0 at the start.
class TurningTransducers {
 public:
  TurningTransducers(const TurningTransducersData& data, const Shaft& rotor, const Shaft& load, Random noise);

  /// Follows the bodies over the last step of `h` seconds.
  void sense(const Shaft& rotor, const Shaft& load, double h) {
    encoder_.sense(on_load_ ? load : rotor, h);
    home_.sense(load.part_before, load.part, h);
  }

  // What they add to a plant's lists.
  void offer_ports(std::vector<Port>& ports, const char* encoder, const char* home);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);

  void visit(StateArchive& archive);

 private:
  const bool on_load_;
  Encoder encoder_;
  PositionSwitch home_;
};

}  // namespace drycut::plants
