#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::studies {

/// One thing in which what fails is not what is good; it can be taken without the others.
struct Difference {
  enum class Kind {
    value,  ///< of the scenario
    entry,  ///< of a list of the scenario: of the timeline, a check
    line    ///< of a program, a row of a cam
  };
  Kind kind = Kind::value;
  std::string where;   ///< "plants.knife.gear", "timeline[2]", "programs/knife.mod:12"
  std::string good;    ///< "" = there is none there
  std::string failed;  ///< likewise

  /// "plants.knife.gear: 5 -> 5.1", "programs/knife.mod:12: only there: ..."
  [[nodiscard]] std::string text() const;
  /// The value that a controller has before it is switched on; "" = it is none: "AxisX.pgain".
  [[nodiscard]] std::string preset() const;
};

/// Which of two sides a mixture has where they differ. Late: an entry that only what fails has stays, so that
/// all others keep their places, but is never due.
enum class TakenSide { good, failed, late };
/// Is asked once of each difference, always in the same order.
using Take = std::function<TakenSide(const Difference&)>;

/// A scenario's tree, without what changes no run: pictures, titles, channels that are recorded.
scenario::YamlNode without_looks(scenario::YamlNode root);
/// The tree between two.
scenario::YamlNode mixed_tree(const scenario::YamlNode& good, const scenario::YamlNode& failed,
                              const Take& take);
/// All values and entries in which a scenario is another, looks apart.
std::vector<Difference> differences_between(const scenario::Scenario& one, const scenario::Scenario& other);
/// A text between two, line by line; `name`: what its lines are called.
std::string mixed_lines(const std::string& name, const std::string& good, const std::string& failed,
                        const Take& take);
/// The tree as a text that is read back as the same tree.
std::string text_of(const scenario::YamlNode& node);

/// True if two programs have the same statements and only other numbers in them: what one has come to fits
/// the other.
bool same_but_numbers(std::string_view one, std::string_view other);

}  // namespace drycut::sim::studies
