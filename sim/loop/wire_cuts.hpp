#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "devices/cards.hpp"
#include "plants/plant.hpp"

namespace drycut::sim::loop {

/// The wires of a bus that a fault can cut. An open end stands in place of the plug then: an input is low, a
/// counter counts no more, a plug that the controller drives sees 0 V, no command and no pulses. A wire that
/// is mended goes on from there: what was not counted is lost.
class WireCuts {
 public:
  /// A wire by its terminal; `end` is the one at the plug, and stays where it is.
  template <typename Port>
  void add(std::string terminal, Port*& end) {
    wires_.emplace_back(Wire<Port>{std::move(terminal), &end, end});
  }

  /// Of each wire, under the component "wire.2.INP01".
  [[nodiscard]] std::vector<std::pair<std::string, plants::Fault>> faults();

  /// One has been cut: only then need the others be called.
  [[nodiscard]] bool any() const { return any_; }
  /// Of open ends that count: before they are read.
  void count();
  /// After edges have been read.
  void clear_edges();

  void visit(StateArchive& archive);

 private:
  template <typename Port>
  struct Wire {
    std::string terminal;
    Port** end;
    Port* plug;
    std::remove_const_t<Port> open = {};
    std::int64_t behind = 0;  ///< counts or pulses lost
    bool touched = false;     ///< it was cut once
    bool cut = false;
  };
  using AnyWire = std::variant<Wire<const plants::EncoderPort>, Wire<const plants::SignalPort>,
                               Wire<const devices::PulseTrain>, Wire<plants::CommandPort>,
                               Wire<plants::ReferencePort>, Wire<plants::PulsePort>>;
  template <typename Port>
  static void set(Wire<Port>& wire, bool cut);
  template <typename Port>
  static void lead(Wire<Port>& wire);

  std::deque<AnyWire> wires_;  ///< open ends are known by their place
  bool any_ = false;
};

}  // namespace drycut::sim::loop
