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
  std::vector<std::pair<std::string, std::string>> overrides;  ///< of it
  std::uint64_t seed = 0;
  std::vector<std::pair<std::string, std::string>> parts;  ///< "plants", "programs/knife.mod"

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
  Time every = never;                                   ///< how often it was kept
  std::uint64_t journal = 0;                            ///< bytes of it that belong to the state ...
  std::uint64_t journal_sum = StateArchive::first_sum;  ///< ... and their sum
  bool plain = false;                                   ///< the run draws nothing
};

/// The beginning of all states of an origin: their members are appended.
StateArchive::Bytes begun_state(StateOrigin origin);
/// The head, but for its origin, and a sum over all take their place in a state that has its members.
void seal(StateArchive::Bytes& state, const StateHead& head);

/// A state that was kept.
struct OpenedState {
  StateHead head;
  std::span<const std::byte> members;  ///< in the bytes
};
/// Throws BadState with a sentence that says what is wrong: no state, cut short, changed, of another format.
/// Of the origin of `own` states, which begin so, nothing is read: the head has none then.
OpenedState open_state(std::span<const std::byte> bytes, std::span<const std::byte> own = {});

}  // namespace drycut::sim::loop
