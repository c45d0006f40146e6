#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/compare/overlays.hpp"

namespace drycut::sim::studies {

// A scene that runs several scenarios and compares them: `compare` in place of plants and controller.

struct ComparisonScene {
  std::filesystem::path file;
  std::vector<std::string> sources;  ///< the file, then what it extends
  scenario::Text extends;            ///< never kept: for the schema
  std::vector<scenario::VariableEntry> variables;
  std::string title;
  struct Channel {
    scenario::Text name;  ///< what all runs call it
    scenario::Text of;    ///< an expression over what this run records
    std::string unit;
  };
  struct Member {
    scenario::Text name;      ///< of the run: its folder, its label, its name in checks; default: the file's
    scenario::Text scenario;  ///< path, relative to the scene
    std::vector<std::pair<scenario::Override, scenario::ScenePlace>> set;
    std::vector<Channel> channels;
  };
  std::vector<Member> members;
  std::optional<Time> from;  ///< figures look from here on; absent: the whole run
  struct FigureRequest {
    scenario::Text name;  ///< in checks: RUN.name
    std::string title;    ///< default: the name
    scenario::Text of;    ///< terms as in `drycut tune`
    std::string unit;
  };
  std::vector<FigureRequest> figures;
  std::vector<OverlayRequest> plots;
  struct Check {
    scenario::Text name;
    scenario::Text expect;  ///< over RUN.figure and RUN.passed (1 or 0)
  };
  std::vector<Check> checks;

  [[nodiscard]] Problem problem(Code code, const scenario::ScenePlace& place, std::string what,
                                std::string remedy) const {
    return {code,
            sources.at(static_cast<std::size_t>(place.source)),
            place.line,
            place.column,
            std::move(what),
            std::move(remedy)};
  }
};

/// Reads the scene; nothing, and no problem, if the file is none that compares. Problems are told as
/// read_scenario tells them.
std::optional<ComparisonScene> read_comparison(const std::filesystem::path& file, Problems& problems);

void visit(scenario::Archive& archive, ComparisonScene& scene);
/// JSON Schema of scenarios, of scenes that compare and of recordings (sim/scenario/json_schema.hpp).
std::string json_schema();

/// The scene as YAML with every default in force.
std::string expand(const ComparisonScene& scene);

/// The scenario of a member with what the scene sets, then what the command line sets.
scenario::Scenario read_member(const ComparisonScene& scene, const ComparisonScene::Member& member,
                               const std::vector<scenario::Override>& overrides, Problems& problems);
/// Gives problems of a member's settings their place in the scene.
void place_in_scene(const ComparisonScene& scene, const ComparisonScene::Member& member, Problems& problems);

}  // namespace drycut::sim::studies
