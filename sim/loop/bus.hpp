#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "plants/plant.hpp"
#include "sim/loop/wire_cuts.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// What a filter of a card did not let through, for events.
struct Loss {
  std::string event;  ///< counts_lost, pulse_lost
  std::string text;
};

/// The filters of the cards' inputs: each stands in a wire, from a plug of a plant to what the terminal sees.
class InputFilters {
 public:
  /// A counter that follows `hertz` of one phase, four counts each, and loses what is beyond.
  const plants::EncoderPort* counter(const plants::EncoderPort* from, std::string terminal, double hertz);
  /// A line that sees zero pulses of `seconds` or more.
  const plants::SignalPort* zero_pulse(const plants::SignalPort* from, std::string terminal, double seconds);
  /// An input that takes a level when it has lasted `seconds`; shorter ones are swallowed. It gives no edges.
  const plants::SignalPort* input(const plants::SignalPort* from, double seconds);

  void visit(StateArchive& archive);

  /// Lets the last step of `h` seconds through.
  void pass(double h);

  /// When a loss begins, once for each time that it does. A counter that was below its limit for 100 ms, a
  /// line that saw a pulse, begin anew.
  [[nodiscard]] bool has_losses() const { return !losses_.empty(); }
  [[nodiscard]] std::vector<Loss> take_losses() { return std::exchange(losses_, {}); }
  /// What was lost in all, a line a terminal.
  [[nodiscard]] std::vector<Finding> lost() const;

 private:
  struct CounterFilter {
    const plants::EncoderPort* from;
    std::string terminal;
    double hertz;
    plants::EncoderPort to = {};
    double behind = 0;  // the count stays behind by so much
    double lost = 0;    // in either direction
    double calm = 1;    // since it lost the last ones [s]
  };
  struct PulseFilter {
    const plants::SignalPort* from;
    std::string terminal;
    double least;  // [s]
    plants::SignalPort to = {};
    std::int64_t lost = 0;
    bool losing = false;
  };
  struct LevelFilter {
    const plants::SignalPort* from;
    double delay;  // [s]
    plants::SignalPort to = {};
    double lasted = 0;  // the level that is not let through yet [s]
  };
  void pass(CounterFilter& filter, double h);
  void pass(PulseFilter& filter, double h);
  static void pass(LevelFilter& filter, double h);

  // Their ports are known by their place.
  std::deque<CounterFilter> counters_;
  std::deque<PulseFilter> pulses_;
  std::deque<LevelFilter> levels_;
  std::vector<Loss> losses_;
};

/// A plant of the running scenario, by its name there.
struct NamedPlant {
  std::string name;
  plants::Plant* plant = nullptr;
};

/// The operator's panel: switches that the timeline works and lamps that the controller lights. What it has
/// is what is wired: a `panel.` plug on an input or interrupt terminal is a switch, on an output it is a
/// lamp.
struct OperatorPanel {
  std::map<std::string, plants::SignalPort> switches;
  std::map<std::string, plants::CommandPort> lamps;
  std::set<std::string> pressed;  ///< switches that have been on
  bool has_edges = false;         ///< of switches, in the coming step

  /// Works a switch at the start of the coming step.
  void set(const std::string& name, bool on);
};

/// The wires between the controller's terminals and the plants' plugs. Type-checked when connected: a counter
/// takes an encoder or a pulse output of its own controller, an input or interrupt line a signal, an output
/// drives a command or a pulse train, an analogue output a reference; a plug that the controller drives has
/// one driver.
class Bus {
 public:
  /// Makes the scenario's wires; what cannot be connected is reported with its place and left out.
  void connect(const scenario::Scenario& scenario, devices::Controller& controller,
               const std::vector<NamedPlant>& plants, Problems& problems);

  /// What the cards' filters lost since the last call, and in all.
  [[nodiscard]] bool has_losses() const { return filters_ && filters_->has_losses(); }
  [[nodiscard]] std::vector<Loss> take_losses() {
    return filters_ ? filters_->take_losses() : std::vector<Loss>();
  }
  [[nodiscard]] std::vector<Finding> lost() const {
    return filters_ ? filters_->lost() : std::vector<Finding>();
  }

  /// Terminals that the controller uses and nothing is wired to.
  [[nodiscard]] std::vector<std::string> unwired() const;

  /// Controller outputs to plant commands and references; the references so many steps late, at most as many
  /// as lie between two changes of them.
  void outputs_to_plants();
  void compute_for(std::int64_t steps) { compute_steps_ = steps; }
  /// Transducers and sensors to the controller; interrupt edges latch the counters and are passed on in order
  /// of their time inside the step.
  void plants_to_inputs();

  /// The wire of an analogue output. A measurement may add volts to it on the way, as a generator in series
  /// would.
  struct AnalogueWire {
    devices::Address terminal;
    std::string terminal_name;
    std::string plug;
    const devices::AnalogueOutput* from;
    plants::ReferencePort* to;
    double added = 0;                                                ///< [V]
    double computed = 0;                                             ///< that is to come [V]
    std::int64_t until = 0;                                          ///< steps until it does; 0: it has
    [[nodiscard]] double total() const { return output() + added; }  ///< what goes on its way to the plug [V]
    [[nodiscard]] double output() const {                            ///< of the controller [V]
      return from->word * (devices::dac_full_scale_volts / devices::dac_full_scale);
    }
  };
  [[nodiscard]] std::vector<AnalogueWire>& analogue_wires() { return analogue_outputs_; }

  /// What is on its way: levels of switches and lamps, filters, outputs that are computed.
  void visit(StateArchive& archive);

  /// Of its wires, each under the component "wire.2.INP01".
  [[nodiscard]] std::vector<std::pair<std::string, plants::Fault>> faults() { return cuts_.faults(); }

  [[nodiscard]] OperatorPanel& panel() { return panel_; }
  [[nodiscard]] const OperatorPanel& panel() const { return panel_; }

 private:
  struct CounterWire {
    const plants::EncoderPort* from;
    devices::Counter* to;
  };
  struct InputWire {
    const plants::SignalPort* from;
    devices::DigitalInput* to;
  };
  struct InterruptWire {
    const plants::SignalPort* from;
    int line;
    devices::DigitalInput* level;
  };
  struct OutputWire {
    const devices::DigitalOutput* from;
    plants::CommandPort* to;
  };

  struct PulseWire {
    const devices::PulseTrain* from;
    plants::PulsePort* to;
  };
  struct LoopWire {
    const devices::PulseTrain* from;
    devices::Counter* to;
  };

  void deliver_interrupts();
  /// Every wire can be cut; `made`: which terminal each has, by list.
  void offer_cuts(const std::array<std::vector<std::string>, 7>& made);

  devices::Controller* controller_ = nullptr;
  double h_ = 0;                           ///< [s]
  std::unique_ptr<InputFilters> filters_;  ///< nullptr without any
  OperatorPanel panel_;
  std::vector<CounterWire> counters_;
  std::vector<InputWire> inputs_;
  std::vector<InterruptWire> interrupts_;
  std::vector<OutputWire> outputs_;
  std::vector<PulseWire> pulses_;
  std::vector<LoopWire> loops_;
  std::vector<AnalogueWire> analogue_outputs_;
  WireCuts cuts_;
  std::int64_t compute_steps_ = 0;
  std::set<devices::Address> wired_;
  std::set<devices::Address> looped_;  ///< pulse outputs that a counter of the controller counts
  friend class Connector;
};

}  // namespace drycut::sim::loop
