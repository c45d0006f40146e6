#include "sim/loop/opcua_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace drycut::sim::loop {

void check_opcua_names(const scenario::Scenario& scenario, Names& names,
                       const std::vector<KnownEvent>& events, Problems& problems) {
  const auto& opcua = scenario.opcua;
  const auto value = [&](const scenario::Text& name) {
    if (name.text.empty() || names.reading(name.text)) return;
    problems.push_back(scenario::problem_at("controller.unknown-name"_code, scenario, name.place,
                                            fmt::format("there is no value '{}'", name.text),
                                            names.suggest_reading(name.text)));
  };
  value(opcua.packml.state);
  value(opcua.packml.mode);
  value(opcua.machinery.executing);
  value(opcua.machinery.out_of_service);
  value(opcua.machinery.mode);
  std::vector<std::string> cutters;
  for (const auto& event : events)
    if (event.name == plants::cut_event) cutters.push_back(event.source);
  for (const auto& cutter : opcua.cutters) {
    value(cutter.length);
    if (std::find(cutters.begin(), cutters.end(), cutter.plant.text) != cutters.end()) continue;
    problems.push_back(
        scenario::problem_at("wiring.no-plug"_code, scenario, cutter.plant.place,
                             fmt::format("no plant '{}' cuts", cutter.plant.text),
                             did_you_mean(cutter.plant.text, cutters,
                                          "name one that reports cuts: a rotary_knife, a flying_saw")));
  }
}

}  // namespace drycut::sim::loop
