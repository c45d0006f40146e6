#pragma once
#include <cstddef>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The belt that takes the cut pieces away. Positions along the line [m], the cut at 0.
struct OutfeedData {
  double speed_factor = 1.2;  ///< belt speed over line speed: opens a gap between the pieces
  double friction = 0.4;      ///< Coulomb, piece on belt
  double start = 0.15;        ///< of the belt [m]
  double length = 2;          ///< of the belt [m]; a piece whose middle has passed its end is gone
};

/// The cut pieces on the outfeed belt: rigid bodies of their own, moved in the slow world, or in every step
/// where a station further down the line cuts them again. A fixed pool; when it is used up the oldest piece
/// makes room.
class Outfeed {
 public:
  static constexpr int pool_size = 12;
  static constexpr int close_pool_size = 36;  ///< where pieces are cut again

  /// In the slow world every piece body has the mass of a piece of 1 m: Coulomb friction by weight does not
  /// depend on it.
  Outfeed(const OutfeedData& data, double mass_per_metre, World& world);
  /// Moves the pieces in every step from now on, each with its own mass. Before the first piece.
  void follow_closely();

  struct Piece {
    Slide* body = nullptr;  ///< position of its middle [m]
    double length = 0;      ///< [m]
    double mark = 0;        ///< of its tail: travel of the web when that passed x = 0 [m]

    void visit(StateArchive& archive);
  };
  /// What comes off.
  struct Cut {
    double tail;    ///< where its tail is then [m]
    double length;  ///< [m]
    double mark;    ///< as that of a piece
  };
  /// A piece came off at `fraction` of the last step of `h` seconds, with the speed of the web.
  void add(const Cut& cut, double speed, double fraction, double h);
  /// The piece of this body, on the belt, comes apart at the end of the last step of `h` seconds: in one of
  /// `length` in front and the rest. Both are bodies anew; `drop`: the front one is gone.
  void divide(Slide& body, double length, bool drop, double h);
  /// Belt forces for the coming step of `h` seconds.
  void drive(double line_speed, double h);

  [[nodiscard]] int on_belt() const;
  [[nodiscard]] double belt_travel() const { return belt_travel_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// The piece at `x` now [m], null where none is.
  [[nodiscard]] const Piece* lying_at(double x) const;
  [[nodiscard]] const Piece& piece_of(const Slide& body) const;

  void visit(StateArchive& archive);

 private:
  void make_pool(int size, bool slow);
  Piece& next(const Cut& cut, double speed);

  const OutfeedData data_;
  World& world_;
  const double mass_per_metre_;
  std::vector<Piece> pieces_;
  std::size_t next_ = 0;
  bool closely_ = false;  // since it was built
  double belt_travel_ = 0;
};

}  // namespace drycut::plants
