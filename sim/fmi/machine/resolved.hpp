#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/time.hpp"

namespace drycut::sim::fmi {

/// A number, a switch (0 or 1) or a whole number as a double, which holds each of them exactly; or a word.
using FmiValue = std::variant<double, std::string>;

/// What a number in a unit is in SI: si = number * factor + offset.
struct SiScale {
  double factor = 1;
  double offset = 0;
  [[nodiscard]] double to_si(double number) const { return number * factor + offset; }
};

/// The machine of a scenario with every value in force, in SI: what an FMU carries as resources/machine.json,
/// so that whoever builds it needs neither YAML nor a table of units.
struct ResolvedMachine {
  struct PlantValues {
    std::string name;
    std::string type;
    std::vector<std::pair<std::string, FmiValue>> parameters;  ///< all of its table
  };
  std::string made_by;  ///< version of drycut
  Time step = 0;
  std::uint64_t seed = 1;
  std::map<std::string, SiScale> units = {};  ///< of the ranges in the plants' tables
  std::vector<PlantValues> plants = {};       ///< in the order in which they are built and stepped
};

/// As JSON; the same machine gives the same bytes.
std::string machine_text(const ResolvedMachine& machine);
/// Back from there. Throws std::exception if it is none.
ResolvedMachine read_machine(std::string_view text);

/// The token (in 2.0: guid) of an FMU that carries this text; another text has another one.
std::string token_of(std::string_view machine_text);

}  // namespace drycut::sim::fmi
