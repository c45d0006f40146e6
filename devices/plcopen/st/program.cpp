#include "devices/plcopen/st/program.hpp"

#include <algorithm>

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

Program compile(std::string_view text, const std::string& file, Problems& problems) {
  return Program(Compiler(text, file, problems).run());
}

}  // namespace drycut::devices::plcopen::st
