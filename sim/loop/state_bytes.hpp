#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/state_archive.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/time.hpp"

namespace drycut::sim::loop {

/// Where a state is from, and what it goes with: the build of the program, the sections of the scenario with
/// every value in force, the controller's files, each by its fingerprint.
struct StateOrigin {
  std::string version;
  std::string build;
  std::string file;                                            ///< the scenario's, absolute
  std::vector<std::pair<std::string, std::string>> overrides;  ///< of it, and its seed
  std::vector<std::pair<std::string, std::string>> parts;      ///< "plants", "programs/knife.mod"

  explicit StateOrigin(const scenario::Scenario& scenario);
  StateOrigin() = default;
  void visit(StateArchive& archive);
  /// "plants, programs/knife.mod": what of `other` is another; "" = all is the same.
  [[nodiscard]] std::string differs_from(const StateOrigin& other) const;
};

/// What stands before a state.
struct StateHead {
  StateOrigin origin;
  Time time = 0;
  Time every = never;                                    ///< how often it was kept
  std::uint64_t journal = 0;                            ///< bytes of it that belong to the state ...
  std::uint64_t journal_sum = StateArchive::first_sum;  ///< ... and their sum
};

/// A state as it is kept: head, members, and a sum over both.
StateArchive::Bytes seal(StateHead head, const StateArchive::Bytes& members);
/// A state that was kept.
struct OpenedState {
  StateHead head;
  std::span<const std::byte> members;  ///< in the bytes
};
/// Throws BadState with a sentence that says what is wrong: no state, cut short, changed, of another format.
OpenedState open_state(std::span<const std::byte> bytes);

}  // namespace drycut::sim::loop
