#include "plants/turning_transducers.hpp"

#include <string>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

PositionSwitchData in_turns(const PositionSwitchData& radians) {
  return {radians.centre / units::turn, radians.width / units::turn, radians.hysteresis / units::turn,
          radians.delay};
}

}  // namespace

double TurningTransducersData::counts_per_radian(double ratio) const {
  return 4.0 * encoder.lines * (encoder_on_load ? 1 : ratio) / units::turn;
}

TurningTransducers::TurningTransducers(const TurningTransducersData& data, const Shaft& rotor,
                                       const Shaft& load, Random noise)
    : on_load_(data.encoder_on_load),
      encoder_(data.encoder, (on_load_ ? load : rotor).revolutions(), noise),
      home_(in_turns(data.home), 1, load.part) {}

void TurningTransducers::offer_ports(std::vector<Port>& ports, const char* encoder, const char* home) {
  ports.push_back({"encoder", &encoder_.pulses.port, encoder});
  ports.push_back({"encoder.index", &encoder_.index, "its index pulse, once a turn"});
  ports.push_back({"home", &home_.port, home});
}

void TurningTransducers::offer_channels(std::vector<Channel>& channels) const {
  channels.push_back({"encoder.count", "", [this] { return static_cast<double>(encoder_.pulses.port.count); },
                      "count of the encoder (x4), after faults"});
  channels.push_back(on_off("home", home_.port.level, "home switch"));
}

void TurningTransducers::offer_faults(std::vector<Fault>& faults) {
  encoder_.pulses.offer_faults(faults, "encoder");
  home_.offer_faults(faults, "home");
}

void TurningTransducers::visit(StateArchive& archive) { STATE(archive, encoder_, home_); }

Parameters turning_transducer_parameters(TurningTransducersData& data, const TurningTransducersWords& words) {
  return joined(
      Parameters{
          row("encoder.lines", "lines of the encoder per turn; counted four times", data.encoder.lines, 1,
              1000000, words.lines_from),
          row(std::string(words.on_load), words.on_load_meaning, data.encoder_on_load, "motor encoder"),
          row("encoder.reverse", words.reverse_meaning, data.encoder.reverse, "wired the usual way"),
      },
      group("encoder.", encoder_error_parameters(data.encoder)),
      Parameters{
          row("home.angle", "deg", words.home_meaning, data.home.centre, -360, 360, words.home_from),
          row("home.width", "deg", "width of the home target", data.home.width, 0.1, 350, "estimate"),
          row("home.hysteresis", "deg", "the home switch lets go this far behind the target",
              data.home.hysteresis, 0, 10, words.hysteresis_from),
          row("home.delay", "ms", "delay of the home switch", data.home.delay, 0, 100,
              "estimate: proximity switch of 1 kHz"),
      });
}

std::vector<PlantDefinition::Objection> turning_transducer_objections(const TurningTransducersData& data) {
  auto found = encoder_objections(data.encoder);
  if (data.home.width + 2 * data.home.hysteresis >= units::turn)
    found.push_back({"plant.parameters-contradict"_code, "home.width",
                     "target and hysteresis cover the whole turn: the switch never lets go",
                     "a narrower target"});
  return found;
}

}  // namespace drycut::plants
