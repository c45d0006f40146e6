#include "plants/efficiency.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "base/problem.hpp"

namespace drycut::plants {

namespace {

struct Kind {
  std::string_view name;
  std::string_view meaning;
  double driving;
  std::string_view source;
};

template <std::size_t N>
std::vector<Preset> presets(const std::array<Kind, N>& kinds, std::string_view efficiency) {
  std::vector<Preset> made;
  made.reserve(N);
  for (const auto& [name, meaning, driving, source] : kinds)
    made.push_back({name, meaning, {{efficiency, driving, source}}});
  return made;
}

constexpr std::string_view ideal = "nothing is lost: the torque of a real machine is higher";

}  // namespace

Efficiency in_series(const Efficiency& gear, const Efficiency& behind) {
  // What locks itself must be driven even where its load pushes.
  const double driven = behind.backwards() > 0 ? gear.backwards() : 1 / gear.driving;
  return {gear.driving * behind.driving, driven * behind.backwards()};
}

const std::vector<Preset>& gear_types() {
  static const auto all = presets(
      std::array<Kind, 8>{{
          {"loss_free", "gear without losses", 1, ideal},
          {"coupling", "no gear: motor on the shaft", 1, "a coupling loses nothing"},
          {"planetary", "planetary gear of one stage", 0.97, "usual: sheets of one stage say 0.97"},
          {"planetary_2", "planetary gear of two stages", 0.94, "usual: sheets of two stages say 0.94"},
          {"helical", "helical gear of two or three stages", 0.96, "usual: 0.985 a stage"},
          {"bevel", "bevel or bevel-helical gear", 0.94, "usual: sheets say 0.94 to 0.95"},
          {"worm", "worm gear of a ratio of about 20", 0.75,
           "estimate: 0.9 at a ratio of 5 down to 0.6 at 50; take it from the sheet"},
          {"belt", "toothed belt", 0.95, "usual: 0.95 to 0.98, less when it is tight"},
      }},
      "gear.efficiency");
  return all;
}

const std::vector<Preset>& slide_types() {
  static const auto all =
      presets(std::array<Kind, 6>{{
                  {"loss_free", "screw, belt or rack without losses", 1, ideal},
                  {"ball_screw", "ball screw", 0.9, "usual: ball screw 0.9"},
                  {"trapezoidal_screw", "trapezoidal screw, which locks itself", 0.35,
                   "usual: 0.3 to 0.4, single thread, greased"},
                  {"roller_screw", "planetary roller screw", 0.85, "usual: 0.8 to 0.9"},
                  {"belt", "toothed belt over a pulley", 0.95, "usual: 0.95 to 0.98"},
                  {"rack", "rack and pinion", 0.9, "estimate: 0.97 of the teeth, less of pinion bearings"},
              }},
              "efficiency");
  return all;
}

Parameters efficiency_parameters(Efficiency& efficiency, std::string_view source) {
  return {
      row("efficiency", "", "torque that arrives over torque of the motor, while the motor drives",
          efficiency.driving, 0.05, 1, source),
      row("back_efficiency", "",
          "the same backwards, while the load drives the motor; 0 or less: self-locking; -20: by the same "
          "friction both ways, 2 - 1/efficiency",
          efficiency.driven, Efficiency::follows, 1,
          efficiency.driven > Efficiency::follows ? source : "2 - 1/efficiency")};
}

std::vector<PlantDefinition::Objection> efficiency_objections(const Efficiency& efficiency,
                                                              const std::string& group) {
  constexpr double apart = 0.1;  // sheets have a ball screw's 0.9 beside 0.8
  const double even = 2 - 1 / efficiency.driving;
  if (efficiency.backwards() <= even + apart) return {};
  return {{"plant.parameters-contradict"_code, group + "back_efficiency",
           fmt::format("{:.3g} backwards beside {:.3g} forwards: the same friction would leave {:.3g}",
                       efficiency.driven, efficiency.driving, even),
           fmt::format("leave it out: {:.3g}; at most 0.1 more", even)}};
}

}  // namespace drycut::plants
