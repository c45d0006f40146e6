#pragma once
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

// The readers of the sections, one a section; used by read_scenario only. Each takes the section's value.

/// Plants with their parameters, each after the plants that it refers to; judged for the scenario's step.
std::vector<PlantEntry> read_plants(const YamlNode& node, std::span<const plants::PlantType> types, Time step,
                                    Findings& findings);
PlcopenSection read_plcopen(const YamlNode& node, const Place& place, Findings& findings);
/// The `set` of a controller called `of`: values before power-up.
void read_preset(MapReader& reader, const std::string& of, std::vector<std::pair<Text, double>>& values,
                 Findings& findings);
std::vector<Stimulus> read_timeline(const YamlNode& node, Findings& findings);
std::vector<Check> read_checks(const YamlNode& node, Findings& findings);
PicturesSection read_pictures(const YamlNode& node, Findings& findings);
/// Three quantities along x, y and z, in SI: at: [0 mm, 20 mm, 0 mm]
void read_triple(MapReader& reader, std::string_view key, std::string_view unit,
                 std::array<double, 3>& values, Findings& findings);
/// pictures.meshes
std::vector<PicturesSection::MeshRequest> read_meshes(const YamlNode& node, Findings& findings);
/// One of pictures.plots; `name` is its full name in messages.
PlotRequest read_plot(const YamlNode& node, const std::string& name, Findings& findings);
/// around, before and after of a map: a window about an event; absent without `around`.
std::optional<PicturesSection::Around> read_around_window(MapReader& reader, Findings& findings);
/// Says that a window ends before it begins.
void refuse_empty_window(MapReader& reader, Time from, const std::optional<Time>& until, Findings& findings);

/// Puts override number `source` (of Findings::sources) into the tree before it is read: lists by index,
/// missing keys added where a default stands.
void apply_override(YamlNode& root, const Override& override, int source, Findings& findings);

/// The sections of a scenario, in the order in which they are written.
const std::vector<std::string>& section_names();

}  // namespace drycut::sim
