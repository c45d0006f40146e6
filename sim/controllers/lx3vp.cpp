#include <fmt/format.h>

#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/controllers/program_files.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::controllers {

namespace lx3vp = devices::lx3vp;

void Lx3vpSection::visit(scenario::Archive& archive) {
  archive.value({"program", "path of the instruction list, relative to the scenario"},
                scenario::path_form(program));
  archive.require("program", "add program: programs/saw.il");
  archive.value({"registers", "path of a CSV with register values before power-up"},
                scenario::path_form(registers));
  archive.value({"scan", "a scan of the program begins this often"},
                scenario::form(scan, scenario::Sign::positive));
  archive.value({"step_time",
                 "what an instruction takes, or a word that one moves: the outputs come at the end of the "
                 "scan; 0: a scan takes no time"},
                scenario::form(step_time, scenario::Sign::not_negative));
  visit_memory(archive, *this);
}

std::vector<scenario::Text> Lx3vpSection::files() const {
  if (registers.text.empty()) return {program};
  return {program, registers};
}

std::string_view Lx3vpSection::settable() const {
  return "name a register: D10, DD10 (32 bit), FD10 (float), D10.A, M0, S0, T0 or C0";
}

namespace {

/// A value before power-up, and where it is given.
struct GivenValue {
  lx3vp::RegisterName name;
  double value = 0;
  std::string place;
};

/// Of values that the first scan replaces nothing is left when the machine begins.
void note_overwritten(const lx3vp::il::IlProgram& program, Time scan, const std::vector<GivenValue>& given,
                      std::vector<Finding>& notes) {
  lx3vp::Lx3vpController trial(program, scan);
  std::vector<double> before;
  for (const auto& [name, value, place] : given) {
    lx3vp::write(trial.registers(), name, value);
    before.push_back(lx3vp::read(trial.registers(), name));
  }
  trial.run_devices(0);
  trial.run_tasks(0);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto& [name, value, place] = given[i];
    const double after = lx3vp::read(trial.registers(), name);
    if (after == before[i]) continue;
    notes.emplace_back("controller.value-overwritten"_code,
                       fmt::format("{}: {} = {}, and the program's first scan makes it {}", place,
                                   lx3vp::to_string(name), value, after));
  }
}

}  // namespace

std::unique_ptr<devices::Controller> Lx3vpSection::load(const scenario::Scenario& scenario,
                                                        Problems& problems,
                                                        std::vector<Finding>* notes) const {
  const auto before = problems.size();
  const auto path_of = [&](const scenario::Text& path) {
    return (scenario.file.parent_path() / path.text).string();
  };
  lx3vp::il::IlProgram compiled;
  if (const auto text = read_program("lx3vp.program", program, scenario, problems))
    compiled = lx3vp::il::compile(*text, path_of(program), problems);
  if (notes != nullptr)
    for (auto& doubt : lx3vp::il::doubts(compiled)) notes->push_back(std::move(doubt));
  compiled.file = program.text;  // a run says the same wherever it is started
  std::vector<lx3vp::RegisterValue> values;
  if (!registers.text.empty()) {
    if (const auto text = read_named_table(registers, scenario, problems))
      values = lx3vp::read_register_values(*text, path_of(registers), ',', problems);
  }
  if (problems.size() != before) return nullptr;
  if (notes != nullptr) {
    std::vector<GivenValue> given;
    for (const auto& [name, value, line] : values)
      given.push_back({name, value, fmt::format("{}:{}:1", path_of(registers), line)});
    for (const auto& [name, value] : set) {
      const auto place = scenario::named_at(scenario, name.place);
      if (const auto found = lx3vp::parse_register(name.text); found && lx3vp::is_served(*found))
        given.push_back({*found, value, fmt::format("{}:{}:{}", place.file, place.line, place.column)});
    }
    if (!given.empty()) note_overwritten(compiled, scan, given, *notes);
  }
  auto controller = std::make_unique<lx3vp::Lx3vpController>(std::move(compiled), scan, step_time);
  for (const auto& entry : values) lx3vp::write(controller->registers(), entry.name, entry.value);
  return controller;
}

}  // namespace drycut::sim::controllers
