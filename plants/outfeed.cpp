#include "plants/outfeed.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"

namespace drycut::plants {

Outfeed::Outfeed(const OutfeedData& data, double mass_per_metre, World& world) : data_(data), world_(world) {
  int number = 1;
  for (Piece& piece : pieces_) {
    piece.body =
        &world.add_slide({.name = fmt::format("piece {}", number++), .mass = mass_per_metre, .slow = true});
    piece.body->awake = false;
  }
}

void Outfeed::add(double tail, double length, double speed, double fraction, double h) {
  Piece& piece = pieces_[static_cast<std::size_t>(next_)];
  next_ = (next_ + 1) % pool_size;
  Slide& body = *piece.body;
  piece.length = length;
  body.awake = true;
  body.force = 0;
  body.speed = body.speed_before = speed;
  // The slow world moves it for the whole of its next step; what has passed of that before the cut is taken
  // off.
  const double early = (world_.since_slow() - 1 + fraction) * h;
  const double since = world_.since_slow() == 0 ? (1 - fraction) * h : -early;
  body.position = body.position_before = tail + length / 2 + speed * since;
  body.remainder = 0;
}

void Outfeed::drive(double line_speed, double h) {
  belt_travel_ += line_speed * data_.speed_factor * h;
  if (!world_.slow_due()) return;
  const double belt_speed = line_speed * data_.speed_factor;
  const double slow_h = World::slow_steps * h;
  for (Piece& piece : pieces_) {
    Slide& body = *piece.body;
    if (!body.awake) continue;
    if (body.position > data_.start + data_.length) {
      body.awake = false;
      continue;
    }
    // The belt carries what lies on it: the share of the piece beyond the start of the belt.
    const double lead = body.position + piece.length / 2;
    const double share = std::clamp((lead - data_.start) / piece.length, 0.0, 1.0);
    const double limit = data_.friction * body.mass * units::gravity * share;
    body.add_force(std::clamp((belt_speed - body.speed) * body.mass / slow_h, -limit, limit));
  }
}

int Outfeed::on_belt() const {
  return static_cast<int>(
      std::count_if(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.body->awake; }));
}

}  // namespace drycut::plants
