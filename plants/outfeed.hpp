#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "plants/part.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The belt that takes the cut pieces away. Positions along the line [m], the cut at 0.
struct OutfeedData {
  double speed_factor = 1.2;  ///< belt speed over line speed: opens a gap between the pieces
  double friction = 0.4;      ///< Coulomb, piece on belt
  double start = 0.15;        ///< of the belt [m]
  double length = 2;          ///< of the belt [m]; a piece whose middle has passed its end is gone
};

/// The cut pieces on the outfeed belt: rigid bodies of their own, moved in the slow world. A fixed pool; when
/// it is used up the oldest piece makes room.
class Outfeed {
 public:
  static constexpr int pool_size = 12;

  /// Every piece body has the mass of a piece of 1 m: Coulomb friction by weight does not depend on it.
  Outfeed(const OutfeedData& data, double mass_per_metre, World& world);

  /// A piece came off at `fraction` of the last step of `h` seconds, its tail at `tail` then, with the speed
  /// of the web.
  void add(double tail, double length, double speed, double fraction, double h);
  /// Belt forces for the coming step of `h` seconds.
  void drive(double line_speed, double h);

  [[nodiscard]] int on_belt() const;
  [[nodiscard]] double belt_travel() const { return belt_travel_; }

  struct Piece {
    Slide* body = nullptr;  ///< position of its middle [m]
    double length = 0;      ///< [m]
  };
  [[nodiscard]] const std::array<Piece, pool_size>& pieces() const { return pieces_; }

 private:
  OutfeedData data_;
  World& world_;
  std::array<Piece, pool_size> pieces_;
  int next_ = 0;
  double belt_travel_ = 0;
};

}  // namespace drycut::plants
