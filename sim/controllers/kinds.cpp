#include "sim/controllers/kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/text.hpp"
#include "sim/controllers/program_files.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/variables.hpp"

namespace drycut::sim {

namespace {

using scenario::ControllerKind;

template <typename Section>
std::unique_ptr<scenario::ControllerSection> make() {
  return std::make_unique<Section>();
}

// All of them: what drycut can load is in this list and nowhere else.
constexpr std::array kinds = {
    ControllerKind{"qmove", "{configuration: ...}", make<controllers::QmoveSection>},
    ControllerKind{"lx3vp", "{program: ...}", make<controllers::Lx3vpSection>},
    ControllerKind{"plcopen", "{program: ...}", make<controllers::PlcopenSection>},
};

}  // namespace

namespace scenario {

std::span<const ControllerKind> controller_kinds() { return kinds; }

const ControllerKind* controller_kind(std::string_view name) {
  const auto* const found =
      std::find_if(kinds.begin(), kinds.end(), [&](const ControllerKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : found;
}

}  // namespace scenario

namespace controllers {

namespace {

/// What texts of programs end in, and the key that takes them.
struct Ending {
  std::string_view ending;
  std::string_view what;
  std::string_view key;
};
constexpr std::array endings = {
    Ending{".cnf", "a QMOVE configuration", "qmove.configuration"},
    Ending{".mod", "a QCL unit", "qmove.tasks"},
    Ending{".qcl", "a QCL unit", "qmove.tasks"},
    Ending{".il", "an instruction list", "lx3vp.program"},
    Ending{".st", "Structured Text", "plcopen.program"},
    Ending{".tab", "a cam table", "plcopen.tables"},
    Ending{".yaml", "a scenario", ""},
};

}  // namespace

void visit_memory(scenario::Archive& archive, scenario::ControllerSection& section) {
  archive.value({"retentive", "a file that keeps retentive values from run to run"},
                scenario::path_form(section.retentive));
  archive.value({"set", "values before power-up, as the controller counts them"},
                scenario::form(section.set));
}

void visit_compute_time(scenario::Archive& archive, scenario::ControllerSection& section) {
  archive.value({"compute_time",
                 "from the latch of the counters to the analogue output, at most the sampling "
                 "time; 0: the output follows in the same step"},
                scenario::form(section.compute_time, scenario::Sign::not_negative));
}

std::optional<std::string> read_named(const scenario::Text& path, const scenario::Scenario& scenario,
                                      Problems& problems) {
  return read_file(scenario.file.parent_path() / path.text, problems,
                   scenario::named_at(scenario, path.place));
}

std::optional<std::string> read_program(std::string_view key, const scenario::Text& path,
                                        const scenario::Scenario& scenario, Problems& problems) {
  const auto of = lower(std::filesystem::path(path.text).extension().string());
  for (const auto& [ending, what, home] : endings) {
    if (ending != of || home == key) continue;
    problems.push_back(scenario::problem_at(
        "controller.axis-value"_code, scenario, path.place,
        fmt::format("{} is {}, which controller.{} does not take", path.text, what, key),
        home.empty() ? "drycut run takes it" : fmt::format("controller.{} takes it", home)));
    return {};
  }
  return read_named(path, scenario, problems);
}

std::optional<std::string> read_named_table(const scenario::Text& path, const scenario::Scenario& scenario,
                                            Problems& problems) {
  const auto before = problems.size();
  auto text = read_named(path, scenario, problems);
  if (text)
    text = scenario::with_variables(*text, scenario.variables,
                                    (scenario.file.parent_path() / path.text).string(), problems);
  if (problems.size() != before) return {};
  return text;
}

}  // namespace controllers
}  // namespace drycut::sim
