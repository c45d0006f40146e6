#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "plants/guest.hpp"

namespace drycut::sim::scenario {

class Findings;
struct Form;
struct PlantEntry;
struct Text;
struct YamlNode;

/// Why a foreign FMU is not taken: what is wrong with it, or with its description.
class GuestRefused : public std::runtime_error {
 public:
  GuestRefused(Code code, const std::string& what, std::string remedy)
      : std::runtime_error(what), code_(code), remedy_(std::move(remedy)) {}
  [[nodiscard]] Code code() const { return code_; }
  [[nodiscard]] const std::string& remedy() const { return remedy_; }

 private:
  Code code_;
  std::string remedy_;
};

/// [bytes]
inline constexpr std::uintmax_t largest_guest = std::uintmax_t{1} << 30U;

/// What the FMU of these bytes says of itself, called `name` in messages; in sim/fmi/foreign/. Nothing of it
/// is run. Throws GuestRefused.
std::shared_ptr<const plants::GuestType> open_guest(std::string bytes, const std::string& name);

/// A foreign FMU says itself which parameters it has: its file is opened, with the units that the scenario
/// gives to its variables. True of any other plant; false, and told, where it cannot be asked.
bool read_guest(const YamlNode& plant, PlantEntry& entry, const std::filesystem::path& folder,
                Findings& findings);
/// read_guest() has read them.
Form guest_units_form(const std::vector<std::pair<Text, Text>>& units);

}  // namespace drycut::sim::scenario
