// The section opcua of a scenario.
#include "sim/scenario/archive.hpp"

namespace drycut::sim::scenario {

namespace {

Key shown_if_given(std::string_view name, std::string_view meaning, const Text& value) {
  return {name, meaning, !value.text.empty()};
}

void visit_machine(Archive& archive, OpcuaSection::Machine& machine) {
  archive.in_line();
  archive.value({"manufacturer", "who made it", !machine.manufacturer.empty()}, form(machine.manufacturer));
  archive.value({"model", "what it is called", !machine.model.empty()}, form(machine.model));
  archive.value({"serial_number", "which one it is", !machine.serial_number.empty()},
                form(machine.serial_number));
}

void visit_packml(Archive& archive, OpcuaSection::Packml& packml) {
  archive.in_line();
  archive.value(
      shown_if_given("state", "value with the number of the state: 1 Clearing ... 17 Complete", packml.state),
      form(packml.state));
  archive.value(
      shown_if_given("mode", "value with the number of the mode: 1 Production, 2 Maintenance, 3 Manual",
                     packml.mode),
      form(packml.mode));
  archive.require("state", "name the value that holds the number of the PackML state");
}

void visit_machinery(Archive& archive, OpcuaSection::Machinery& machinery) {
  archive.in_line();
  archive.value(shown_if_given("executing",
                               "value that is not 0 while the machine does its work; without it "
                               "the PackML state says so",
                               machinery.executing),
                form(machinery.executing));
  archive.value(
      shown_if_given("out_of_service", "value that is not 0 while it cannot work", machinery.out_of_service),
      form(machinery.out_of_service));
  archive.value(shown_if_given("mode",
                               "value with the number of the mode: 0 None, 1 Maintenance, 2 Setup, "
                               "3 Processing",
                               machinery.mode),
                form(machinery.mode));
  archive.require_one({"executing", "out_of_service", "mode"}, "says nothing",
                      "name the value that is not 0 while the machine works: executing: AxisX.st_sync");
}

}  // namespace

bool OpcuaSection::given() const {
  return !machine.manufacturer.empty() || !machine.model.empty() || !machine.serial_number.empty() ||
         !packml.state.text.empty() || !machinery.executing.text.empty() ||
         !machinery.out_of_service.text.empty() || !machinery.mode.text.empty() || !cutters.empty();
}

void visit(Archive& archive, OpcuaSection::Cutter& cutter) {
  archive.in_line();
  archive.value({"length", "value with the length that is to be cut"}, form(cutter.length));
  archive.require("length", "name the value with the length that is to be cut");
}

void visit(Archive& archive, OpcuaSection& opcua) {
  const auto& [machine, packml, machinery, cutters] = opcua;
  const bool named =
      !machine.manufacturer.empty() || !machine.model.empty() || !machine.serial_number.empty();
  const bool has_machinery = !machinery.executing.text.empty() || !machinery.out_of_service.text.empty() ||
                             !machinery.mode.text.empty();
  archive.section({"machine", "its name plate (OPC 40001-1)", named},
                  [&](Archive& inner) { visit_machine(inner, opcua.machine); });
  archive.section({"packml", "its state where the program has it (OPC 30050)", !packml.state.text.empty()},
                  [&](Archive& inner) { visit_packml(inner, opcua.packml); });
  archive.section({"machinery", "its state and mode (OPC 40001-1)", has_machinery},
                  [&](Archive& inner) { visit_machinery(inner, opcua.machinery); });
  archive.names({"cutters", "knives and saws, by their plants' names (OPC 40084-9)", !cutters.empty()},
                opcua.cutters, &OpcuaSection::Cutter::plant);
}

}  // namespace drycut::sim::scenario
