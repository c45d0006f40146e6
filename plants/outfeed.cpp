#include "plants/outfeed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

Outfeed::Outfeed(const OutfeedData& data, double mass_per_metre, World& world)
    : data_(data), world_(world), mass_per_metre_(mass_per_metre) {
  make_pool(pool_size, true);
}

void Outfeed::make_pool(int size, bool slow) {
  pieces_.resize(static_cast<std::size_t>(size));
  int number = 1;
  for (Piece& piece : pieces_) {
    piece.body =
        &world_.add_slide({.name = fmt::format("piece {}", number++), .mass = mass_per_metre_, .slow = slow});
    piece.body->awake = false;
  }
}

void Outfeed::follow_closely() {
  if (closely_) return;
  closely_ = true;
  make_pool(close_pool_size, false);
}

Outfeed::Piece& Outfeed::next(const Cut& cut, double speed) {
  Piece& piece = pieces_[next_];
  next_ = (next_ + 1) % pieces_.size();
  piece.length = cut.length;
  piece.mark = cut.mark;
  Slide& body = *piece.body;
  body.awake = true;
  body.force = 0;
  body.speed = body.speed_before = speed;
  body.remainder = 0;
  if (closely_) world_.set_mass(body, mass_per_metre_ * cut.length);
  return piece;
}

void Outfeed::add(const Cut& cut, double speed, double fraction, double h) {
  Slide& body = *next(cut, speed).body;
  // The slow world moves it for the whole of its next step; what has passed of that before the cut is taken
  // off.
  const double early = (world_.since_slow() - 1 + fraction) * h;
  const double since = world_.since_slow() == 0 || closely_ ? (1 - fraction) * h : -early;
  body.position = body.position_before = cut.tail + cut.length / 2 + speed * since;
  if (closely_) body.position_before -= speed * h;
}

void Outfeed::divide(Slide& body, double length, bool drop, double h) {
  const Piece whole = piece_of(body);
  const double rest = whole.length - length;
  const double tail = body.position - whole.length / 2;
  body.awake = false;
  if (rest > 0) add({tail, rest, whole.mark}, body.speed, 1, h);
  if (length > 0 && !drop) add({tail + rest, length, whole.mark - rest}, body.speed, 1, h);
}

void Outfeed::drive(double line_speed, double h) {
  belt_travel_ += line_speed * data_.speed_factor * h;
  if (!closely_ && !world_.slow_due()) return;
  const double belt_speed = line_speed * data_.speed_factor;
  const double of_force = closely_ ? h : World::slow_steps * h;  // time for which a force acts
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
    body.add_force(std::clamp((belt_speed - body.speed) * body.mass / of_force, -limit, limit));
  }
}

const Outfeed::Piece* Outfeed::lying_at(double x) const {
  const auto found = std::find_if(pieces_.begin(), pieces_.end(), [x](const Piece& piece) {
    return piece.body->awake && std::abs(x - piece.body->position) <= piece.length / 2;
  });
  return found == pieces_.end() ? nullptr : &*found;
}

const Outfeed::Piece& Outfeed::piece_of(const Slide& body) const {
  const auto found = std::find_if(pieces_.begin(), pieces_.end(),
                                  [&body](const Piece& piece) { return piece.body == &body; });
  if (found == pieces_.end()) throw std::invalid_argument("Outfeed::piece_of: a body that is no piece");
  return *found;
}

int Outfeed::on_belt() const {
  return static_cast<int>(
      std::count_if(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.body->awake; }));
}

void Outfeed::Piece::visit(StateArchive& archive) { STATE(archive, length, mark); }

void Outfeed::visit(StateArchive& archive) { STATE(archive, pieces_, next_, belt_travel_); }

}  // namespace drycut::plants
