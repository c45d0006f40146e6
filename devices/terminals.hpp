#pragma once
#include <map>

#include "devices/device.hpp"

// How devices take hold of the terminals that their .CNF record names.
namespace drycut::devices {

/// The terminal of `resource` in `terminals`, added if it is not there; nullptr if the field is unused (X.X).
template <typename Terminal>
Terminal* connect(std::map<Address, Terminal>& terminals, const Resource& resource) {
  return resource.address ? &terminals[*resource.address] : nullptr;
}

/// Count of a counter [bits x4]; 0 without one.
inline std::int64_t count_of(const Counter* counter) { return counter ? counter->count : 0; }

/// Level of an input; off without one.
inline bool is_on(const DigitalInput* input) { return input && input->level; }

}  // namespace drycut::devices
