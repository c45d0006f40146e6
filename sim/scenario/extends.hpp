#pragma once
#include <filesystem>
#include <string_view>

#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::scenario {

/// The tree of a scenario's text, what it extends taken in: `extends: base.yaml`, relative to the file. Maps
/// are merged key by key over the base's, every other value replaces the base's, and `key: ~` leaves the
/// base's out. A list whose entries have names (checks, plots) may be changed by a map: each key names an
/// entry, whose map is merged, which `~` leaves out, or which is new and comes last. Names with dots of
/// plants and axes are the same as nested maps. A base that cannot be read, is none or extends what extends
/// it is a problem where it is named, and then the tree is empty.
YamlNode read_tree(std::string_view text, const std::filesystem::path& file, Findings& findings);

}  // namespace drycut::sim::scenario
