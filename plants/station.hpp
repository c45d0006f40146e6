#pragma once
#include <utility>
#include <vector>

#include "plants/plant.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

/// Where a machine that cuts stands on the line, and which of its pieces drop out.
struct StationData {
  double place = 0;          ///< behind the first cut of the web, x = 0 [m]
  double scrap_shorter = 0;  ///< a shorter piece that it cuts off drops out [m]; 0 = none
  int scrap_every = 0;       ///< every n-th piece is dropped; 0 = none

  [[nodiscard]] bool drops() const { return scrap_shorter > 0 || scrap_every > 0; }
};

Parameters station_parameters(StationData& data);
/// What is wrong with a station on that web.
std::vector<PlantDefinition::Objection> station_objections(const StationData& data, const WebData& web);

/// A place on the line where a machine cuts what lies there: at x = 0 always the web, further down the web as
/// far as it reaches, or a piece that a station before has cut off and the outfeed belt has brought, or
/// nothing. A piece that is cut comes apart in two, of which the front one counts as cut off.
///
/// Event `scrap` (length, number, total) of a piece that drops out behind the cut.
class Station {
 public:
  /// It takes the line from `from` to `to`, seen from its place [m].
  Station(const StationData& data, Web& web, double from, double to);

  /// What lies under the blade, `x` behind the station's place [m], now; what moves with it at `speed` [m/s]
  /// where nothing does. Asked before the forces of a step and again before what the step has cut.
  Slide& under(double x, double speed) { return data_.place == 0 ? *material_ : found(x, speed); }
  [[nodiscard]] Slide& material() const { return *material_; }  ///< that was there last
  [[nodiscard]] bool is_empty() const { return material_ == &air_; }
  /// True where a stiff damper on the material is to be taken implicitly: it may weigh next to nothing.
  [[nodiscard]] bool is_light() const { return web_.data().strip.on || material_ != &web_.material(); }

  /// The material came apart at `fraction` of the last step of `h` seconds; `mark` is the position of the
  /// material less that of the blade, from the station's place, where they met [m].
  void cut(double fraction, double mark);

  [[nodiscard]] double length() const { return length_; }  ///< of the piece that came off last [m]
  /// What the event `cut` says of it: rest, of a station behind the first one; register, of a printed web.
  void describe(MachineEvent& cut) const;
  void describe(EventType& cut) const;
  void offer_events(std::vector<EventType>& types) const;
  [[nodiscard]] std::vector<MachineEvent> take_events() { return std::exchange(events_, {}); }

  /// Between two steps, as its events have been taken.
  void visit(StateArchive& archive);

 private:
  Slide& found(double x, double speed);

  const StationData data_;
  Web& web_;
  Slide air_ = {.mass = 1e-9};  // yields to everything
  Slide* material_;
  std::vector<MachineEvent> events_;
  double length_ = 0;
  double rest_ = 0;  // of the piece, behind the cut [m]
  int cuts_ = 0;
  int dropped_ = 0;
  double dropped_length_ = 0;  // [m]
};

}  // namespace drycut::plants
