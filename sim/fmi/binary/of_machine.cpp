// The library of the machine alone.
#include "sim/fmi/binary/component.hpp"
#include "sim/fmi/machine/built_machine.hpp"

namespace drycut::sim::fmi {

std::string_view resource_name() { return "machine.json"; }

std::unique_ptr<FmiSource> source_of(const std::string& bytes, const std::filesystem::path& /*resources*/) {
  return std::make_unique<MachineSource>(read_machine(bytes));
}

}  // namespace drycut::sim::fmi
