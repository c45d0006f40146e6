#include "sim/loop/whereabouts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/state_archive.hpp"
#include "sim/loop/program_words.hpp"
#include "sim/loop/wires.hpp"

namespace drycut::sim::loop {

namespace {

constexpr double told_scale = 0.1;  // of the way
constexpr double told_place = 2;    // [mm], more than a play
constexpr double told_zero = 10;    // [mm], more than play and twist of a gear at the turn of a stroke
constexpr double enough_way = 10;   // [mm]
constexpr double rounding = 0.1;    // [mm] a step of either and the time between two looks

}  // namespace

Whereabouts::Whereabouts(const scenario::Scenario& scenario, devices::Controller& controller, Names& names) {
  for (auto& loop : controller.position_loops()) {
    const auto posit = controller.find(loop.name + ".posit");
    const auto decpt = controller.find(loop.name + ".decpt");
    const auto* wire = loop.counter ? wire_at(scenario, controller, *loop.counter) : nullptr;
    if (!posit || !decpt || wire == nullptr) continue;
    const auto plant = wire->plug.text.substr(0, wire->plug.text.find('.')) + ".position";
    const auto position = names.reading(plant);
    if (!position || position->unit != "mm") continue;
    axes_.push_back({loop.name, loop.drive, posit->read, decpt->read, plant, position->read,
                     presets(controller, loop.name)});
  }
}

double Whereabouts::unit_position(const Axis& axis) { return axis.posit() / std::pow(10.0, axis.decpt()); }

void Whereabouts::sample(Time /*now*/) {
  for (auto& axis : axes_) {
    const double posit = unit_position(axis);
    const double position = axis.position();
    if (!axis.driven && axis.drive() != 0) {
      axis.driven = true;
      axis.began_posit = posit;
      axis.began = position;
    }
    const double moved = position - axis.last_position;
    const double went = posit - axis.last_posit;
    axis.last_posit = posit;
    axis.last_position = position;
    if (!axis.driven) continue;
    if (std::abs(moved) < rounding) {
      axis.rests_posit = posit;
      axis.rests = position;
      if (std::abs(went) < told_place) continue;
      axis.began_posit = posit;  // a program has set it while the machine stands
      axis.began = position;
      continue;
    }
    axis.went += std::abs(went);
    axis.moved += std::abs(moved);
  }
}

std::vector<Finding> Whereabouts::texts() const {
  std::vector<Finding> texts;
  for (const auto& axis : axes_) {
    if (axis.homed || axis.moved < enough_way) continue;
    if (std::abs(axis.went - axis.moved) > told_scale * axis.moved)
      texts.emplace_back("loop.other-scale"_code, fmt::format("{} counted {:.4g} where {} went {:.4g} mm",
                                                              axis.name, axis.went, axis.plant, axis.moved));
    else if (std::abs(axis.began_posit - axis.began) > told_place)
      texts.emplace_back("loop.other-place"_code,
                         fmt::format("{} stood at {:.6g} when it was driven first, and {} at {:.6g} mm",
                                     axis.name, axis.began_posit, axis.plant, axis.began));
  }
  return texts;
}

std::vector<Finding> Whereabouts::zeros() const {
  std::vector<Finding> texts;
  for (const auto& axis : axes_) {
    const bool same_unit = std::abs(axis.went - axis.moved) <= told_scale * axis.moved;
    if (!axis.homed || axis.moved < enough_way || !same_unit) continue;
    if (std::abs(axis.rests_posit - axis.rests) > told_zero)
      texts.emplace_back("loop.other-zero"_code,
                         fmt::format("{} is at {:.6g} where {} is {:.6g} mm: another zero", axis.name,
                                     axis.rests_posit, axis.plant, axis.rests));
  }
  return texts;
}

void Whereabouts::visit(StateArchive& archive) {
  archive.each("axes_", axes_, [&](Axis& axis) {
    STATE(archive, axis.last_posit, axis.last_position, axis.went, axis.moved, axis.driven, axis.began_posit,
          axis.began, axis.rests_posit, axis.rests);
  });
}

}  // namespace drycut::sim::loop
