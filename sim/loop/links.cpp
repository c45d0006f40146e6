#include "sim/loop/links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "base/text.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/guests.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::loop {

namespace {

std::string plant_in(const std::string& name) { return name.substr(0, name.find('.')); }

std::string what_is(const std::string& unit) {
  return unit.empty() ? "a pure number" : fmt::format("{} ({})", scenario::dimension_name(unit), unit);
}

}  // namespace

bool joins_plants(const scenario::Wire& wire, const scenario::Scenario& scenario) {
  const auto name = plant_in(wire.terminal.text);
  return name.size() < wire.terminal.text.size() &&
         std::ranges::any_of(scenario.plants, [&](const auto& plant) { return plant.name.text == name; });
}

/// Makes the links of one scenario.
class Linker {
 public:
  Linker(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants, Names& names,
         Problems& problems)
      : scenario_(scenario), names_(names), problems_(problems) {
    for (const auto& [name, plant] : plants)
      for (const auto& port : plant->ports()) ports_.emplace(name + "." + port.name, port);
  }

  void connect(Links& links) {
    for (const auto& wire : scenario_.wiring) {
      if (joins_plants(wire, scenario_)) {
        make(wire, links);
      } else if (!scenario_.controller) {
        problem("wiring.no-terminal"_code, wire.terminal.place,
                fmt::format("there is no controller that could have a terminal {}", wire.terminal.text),
                "a wire between plants is written {taker: giver}: load.speed: axis.speed");
      } else if (is_of_guest(wire.plug.text)) {
        drive(wire.plug, wire.terminal.text);
      }
    }
  }

 private:
  struct Taker {
    std::function<void(double)> write;
    std::string unit;
  };

  void problem(Code code, const scenario::ScenePlace& place, std::string what, std::string remedy) {
    problems_.push_back(scenario::problem_at(code, scenario_, place, std::move(what), std::move(remedy)));
  }

  [[nodiscard]] bool is_of_guest(const std::string& name) const {
    return std::ranges::any_of(scenario_.plants, [&](const auto& plant) {
      return plant.name.text == plant_in(name) && guest_of(plant) != nullptr;
    });
  }

  /// False, and told, if something else drives it already.
  bool drive(const scenario::Text& name, const std::string& by) {
    const auto [known, fresh] = drivers_.emplace(name.text, by);
    if (!fresh) {
      problem("wiring.twice"_code, name.place, fmt::format("{} already drives {}", known->second, name.text),
              "a plug has one driver; remove one of the wires");
      return false;
    }
    names_.drive(name.text, by);
    return true;
  }

  std::optional<Taker> taker(const scenario::Text& name) {
    if (const auto target = names_.target(name.text)) return Taker{target->write, target->unit};
    const auto port = ports_.find(name.text);
    if (port != ports_.end()) {
      const auto& plug = port->second.plug;
      if (auto* const* reference = std::get_if<plants::ReferencePort*>(&plug))
        return Taker{[to = *reference](double volts) { to->volts = volts; }, "V"};
      if (auto* const* command = std::get_if<plants::CommandPort*>(&plug))
        return Taker{[to = *command](double on) { to->level = on != 0; }, ""};
      if (auto* const* pulses = std::get_if<plants::PulsePort*>(&plug))
        return Taker{[to = *pulses](double count) {
                       constexpr double most = 9007199254740992.0;
                       if (count < most) to->pulses = std::max<std::int64_t>(to->pulses, std::llround(count));
                     },
                     ""};
      problem("wiring.kinds-differ"_code, name.place,
              fmt::format("{} gives a signal and takes none", name.text),
              "a wire between plants is written {taker: giver}");
      return {};
    }
    std::vector<std::string> takers;
    for (const auto& [plug, of] : ports_) takers.push_back(plug);
    for (const auto& setting : names_.setting_names()) takers.push_back(setting);
    problem("wiring.no-plug"_code, name.place, fmt::format("nothing called '{}' takes a signal", name.text),
            did_you_mean(name.text, takers, "drycut plants lists the settings and plugs of plants"));
    return {};
  }

  void make(const scenario::Wire& wire, Links& links) {
    const auto to = taker(wire.terminal);
    auto from = names_.reading(wire.plug.text);
    if (!from)
      problem("wiring.no-plug"_code, wire.plug.place,
              fmt::format("nothing called '{}' can be read", wire.plug.text),
              names_.suggest_reading(wire.plug.text));
    if (!to || !from) return;
    const bool fits = to->unit.empty() || from->unit.empty() ? to->unit == from->unit
                                                             : scenario::same_dimension(to->unit, from->unit);
    if (!fits) {
      problem("scenario.wrong-unit"_code, wire.plug.place,
              fmt::format("{} takes {}, {} is {}", wire.terminal.text, what_is(to->unit), wire.plug.text,
                          what_is(from->unit)),
              "wire something of the same kind");
      return;
    }
    if (!drive(wire.terminal, wire.plug.text)) return;
    Links::Link link{from->read, 1, 0, to->write};
    if (!from->unit.empty()) {
      link.offset = scenario::to_si(0, from->unit);
      link.factor = scenario::to_si(1, from->unit) - link.offset;
    }
    links.links_.push_back(std::move(link));
  }

  const scenario::Scenario& scenario_;
  Names& names_;
  Problems& problems_;
  std::map<std::string, plants::Port> ports_;
  std::map<std::string, std::string> drivers_;
};

Links::Links(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants, Names& names,
             Problems& problems) {
  Linker(scenario, plants, names, problems).connect(*this);
}

}  // namespace drycut::sim::loop
