// Foreign FMUs: the archive, and what its description says. Nothing of them is run.
#include <cmath>
#include <string>

#include "sim/fmi/foreign/archive.hpp"
#include "sim/fmi/foreign/description.hpp"
#include "sim/scenario/guests.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

namespace {

void expect_usable(const std::vector<plants::GuestVariable>& variables) {
  for (const auto& variable : variables) {
    if (variable.name.empty()) fuzz::broken("a variable has a name");
    if (!(variable.min < variable.max)) fuzz::broken("a range has something in it");
    if (!std::isfinite(variable.in_si(variable.start)) || !std::isfinite(variable.in_unit(variable.start)))
      fuzz::broken("a variable starts with a finite number");
    if (!std::isfinite(variable.from_si(1))) fuzz::broken("a unit can be converted back");
  }
}

}  // namespace

DRYCUT_FUZZ(text) {
  try {
    if (!text.starts_with("PK")) {
      expect_usable(sim::fmi::read_description(text).variables);
      return;
    }
    const std::string bytes(text);
    const sim::fmi::FmuArchive archive(bytes);
    for (const auto& name : archive.names()) {
      if (name.starts_with("/") || name.find("..") == 0) fuzz::broken("a file stays in its folder");
      if (name == "modelDescription.xml") static_cast<void>(archive.bytes(name));
    }
    expect_usable(sim::scenario::open_guest(bytes, "f.fmu")->variables());
  } catch (const sim::scenario::GuestRefused& refused) {
    if (std::string_view(refused.what()).empty()) fuzz::broken("a problem says what is wrong");
    if (refused.remedy().empty()) fuzz::broken("a problem says what would be right");
  }
}

}  // namespace drycut
