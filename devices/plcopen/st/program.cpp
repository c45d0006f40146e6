#include "devices/plcopen/st/program.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "devices/plcopen/pins.hpp"
#include "devices/plcopen/st/compiler.hpp"

namespace drycut::devices::plcopen::st {

Program::Program() : compiled_(std::make_shared<const Compiled>()) {}
Program::Program(std::shared_ptr<const Compiled> compiled) : compiled_(std::move(compiled)) {}
const std::vector<Program::Name>& Program::externals() const { return compiled_->externals; }
const std::vector<Program::Located>& Program::located() const { return compiled_->located; }
const std::vector<Program::InMemory>& Program::in_memory() const { return compiled_->in_memory; }
const std::vector<Program::Name>& Program::tables() const { return compiled_->tables; }
const std::vector<Program::Task>& Program::tasks() const { return compiled_->tasks; }
const std::vector<Program::Instance>& Program::instances() const { return compiled_->instance_names; }
bool Program::has_configuration() const { return compiled_->configured; }

bool Program::has_motion_block(std::string_view name) const {
  return std::any_of(compiled_->motions.begin(), compiled_->motions.end(),
                     [&](const Compiled::Motion& motion) { return motion.type->motion->name == name; });
}

const std::vector<SourceFile>& Program::files() const { return compiled_->files; }
const SourceLines& Program::lines() const { return compiled_->lines; }

Problem Program::problem_at(Code code, int line, int column, std::string what, std::string remedy) const {
  const auto at = lines().at(line);
  return {code, files().at(at.file).name, at.line, column, std::move(what), std::move(remedy)};
}

std::vector<Finding> Program::notes() const {
  std::vector<Finding> notes;
  for (const auto& [code, line, column, text, value] : compiled_->doubts) {
    if (!value.empty()) continue;
    const auto at = lines().at(line);
    notes.emplace_back(code, fmt::format("{}:{}:{}: {}", files().at(at.file).name, at.line, column, text));
  }
  return notes;
}

Program compile(std::span<const SourceFile> files, const CompileOptions& options, Problems& problems) {
  return Program(Compiler(files, options, problems).run());
}

Program compile(std::string_view text, const std::string& file, Problems& problems,
                const CompileOptions& options) {
  const SourceFile one{file, std::string(text)};
  return compile(std::span(&one, 1), options, problems);
}

}  // namespace drycut::devices::plcopen::st
