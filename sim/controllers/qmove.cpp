#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/controllers/program_files.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::controllers {

namespace qmove = devices::qmove;

void QmoveSection::visit(scenario::Archive& archive) {
  archive.value({"configuration", "path of the .CNF, relative to the scenario"},
                scenario::path_form(configuration));
  archive.require("configuration", "add configuration: programs/line.cnf");
  archive.value({"tasks", "paths of the QCL units, one task each"}, scenario::path_form(tasks));
  archive.value({"cycle", "a round of all tasks begins this often"},
                scenario::form(cycle, scenario::Sign::positive));
  archive.value({"statement_time",
                 "what a statement of a task takes, and each look at a WAIT; 0: statements take no time"},
                scenario::form(statement_time, scenario::Sign::not_negative));
  visit_compute_time(archive, *this);
  visit_memory(archive, *this);
}

std::vector<scenario::Text> QmoveSection::files() const {
  auto files = tasks;
  files.push_back(configuration);
  return files;
}

std::string_view QmoveSection::settable() const {
  return "name a program variable or a device parameter (drycut devices)";
}

std::unique_ptr<devices::Controller> QmoveSection::load(const scenario::Scenario& scenario,
                                                        Problems& problems,
                                                        std::vector<Finding>* notes) const {
  const auto before = problems.size();
  const auto folder = scenario.file.parent_path();
  const auto text = read_program("qmove.configuration", configuration, scenario, problems);
  if (!text) return nullptr;
  auto parsed = qmove::parse_configuration(*text, (folder / configuration.text).string(),
                                           devices::catalogue(), problems);
  // Modules are not judged by a configuration that is not sound.
  if (problems.size() != before) return nullptr;
  std::vector<qmove::QclProgram> programs;
  for (const auto& task : tasks) {
    const auto module = read_program("qmove.tasks", task, scenario, problems);
    if (!module) continue;
    programs.push_back(qmove::compile_module(*module, (folder / task.text).string(), parsed,
                                             devices::catalogue(), problems));
  }
  if (problems.size() != before) return nullptr;
  if (notes != nullptr) {
    notes->insert(notes->end(), parsed.notes.begin(), parsed.notes.end());
    for (const auto& program : programs)
      notes->insert(notes->end(), program.notes.begin(), program.notes.end());
  }
  // A run says the same wherever it is started.
  for (std::size_t i = 0; i < programs.size(); ++i) programs[i].file = tasks[i].text;
  parsed.file = configuration.text;
  return std::make_unique<qmove::QmoveController>(std::move(parsed), std::move(programs),
                                                  devices::catalogue(), cycle, statement_time);
}

}  // namespace drycut::sim::controllers
