// The library of a line: the machine and its controller.
#include "sim/fmi/binary/component.hpp"
#include "sim/fmi/line/carried_line.hpp"
#include "sim/scenario/unit_table.hpp"

namespace drycut::sim::fmi {

std::string_view resource_name() { return "line.cbor"; }

std::unique_ptr<FmiSource> source_of(const std::string& bytes, const std::filesystem::path& resources) {
  scenario::read_units_from(resources / "udunits" / "udunits2.xml");
  return std::make_unique<LineSource>(read_line(bytes));
}

}  // namespace drycut::sim::fmi
