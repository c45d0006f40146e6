#include "plants/station.hpp"

#include <fmt/format.h>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

Parameters station_parameters(StationData& data) {
  return {
      row("place", "mm", "where it stands on the line, behind the web's first cut", data.place, 0, 100000,
          "the first one"),
      row("scrap.shorter", "mm", "a shorter piece that it cuts off drops out; 0: none", data.scrap_shorter, 0,
          100000, "nothing drops out"),
      row("scrap.every", "every n-th piece is dropped; 0 = none", data.scrap_every, 0, 1000,
          "nothing drops out"),
  };
}

std::vector<PlantDefinition::Objection> station_objections(const StationData& data, const WebData& web) {
  const double end = web.outfeed.start + web.outfeed.length;
  if (data.place == 0 || data.place < end) return {};
  return {{"plant.parameters-contradict"_code, "place",
           fmt::format("the outfeed belt ends at {:g} mm: it brings no piece to {:g} mm",
                       end * units::millimetres, data.place * units::millimetres),
           fmt::format("a place before, or an outfeed.length of the web of more than {:g} mm",
                       (data.place - web.outfeed.start) * units::millimetres)}};
}

Station::Station(const StationData& data, Web& web, double from, double to)
    : data_(data), web_(web), material_(&web.material()) {
  if (data.place > 0) web.make_room(data.place + from, data.place + to);
}

Slide& Station::found(double x, double speed) {
  material_ = web_.lying_at(data_.place + x);
  if (material_ != nullptr) return *material_;
  material_ = &air_;
  air_.speed = air_.speed_before = speed;
  air_.force = 0;
  return air_;
}

void Station::cut(double fraction, double mark) {
  const Web::Severed found = web_.sever_at(*material_, mark - data_.place);
  length_ = found.length;
  rest_ = found.rest;
  ++cuts_;
  const bool its_turn = data_.scrap_every > 0 && cuts_ % data_.scrap_every == 0;
  // What a web leaves that has run back is no piece.
  const bool drop = length_ > 0 && (length_ < data_.scrap_shorter || its_turn);
  web_.sever(*material_, fraction, mark - data_.place, drop);
  if (!drop) return;
  ++dropped_;
  dropped_length_ += length_;
  events_.push_back({"scrap",
                     fraction,
                     {{"length", length_ * units::millimetres, "mm"},
                      {"number", static_cast<double>(dropped_), ""},
                      {"total", dropped_length_ * units::millimetres, "mm"}}});
}

void Station::describe(MachineEvent& cut) const {
  if (data_.place > 0) cut.values.push_back({"rest", rest_ * units::millimetres, "mm"});
  if (web_.marks().printed())
    cut.values.push_back({"register", web_.register_error() * units::millimetres, "mm"});
}

void Station::describe(EventType& cut) const {
  if (data_.place > 0) cut.values.push_back({"rest", "mm"});
  if (web_.marks().printed()) cut.values.push_back({"register", "mm"});
}

void Station::offer_events(std::vector<EventType>& types) const {
  if (data_.drops())
    types.push_back({"scrap",
                     {{"length", "mm"}, {"number", ""}, {"total", "mm"}},
                     "a piece that it cut off drops out, being short or its turn: length, number since the "
                     "start, length of all"});
}

void Station::visit(StateArchive& archive) {
  std::vector<Slide*> bodies = {&web_.material(), &air_};
  for (const Outfeed::Piece& piece : web_.outfeed().pieces()) bodies.push_back(piece.body);
  archive.pointer("material_", material_, bodies);
  STATE(archive, air_, length_, rest_, cuts_, dropped_, dropped_length_);
  if (archive.restores()) events_.clear();
}

}  // namespace drycut::plants
