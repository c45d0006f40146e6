#include "sim/fmi/model_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::fmi {

namespace {

using Role = FmiVariable::Role;
using Type = FmiVariable::Type;

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string attribute(std::string_view name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, escaped(value));
}

// The unit of the numbers themselves.
std::string unit_of(const FmiVariable& variable) {
  if (variable.unit.empty() || !scenario::is_unit(variable.unit)) return "";
  if (!variable.in_si) return variable.unit;
  const auto si = scenario::readable_si(variable.unit);
  return si.empty() ? "" : si;
}

double to_own(const FmiVariable& variable, double number) {
  return variable.in_si && !variable.unit.empty() ? scenario::to_si(number, variable.unit) : number;
}

// "m2.kg.s-2" as attributes: m="2" kg="1" s="-2".
std::string exponents(const std::string& dimension) {
  std::string all;
  std::size_t begin = 0;
  while (begin < dimension.size()) {
    const auto end = std::min(dimension.find('.', begin), dimension.size());
    const auto factor = dimension.substr(begin, end - begin);
    const auto digits = factor.find_first_of("-0123456789");
    all += attribute(factor.substr(0, digits), digits == std::string::npos ? "1" : factor.substr(digits));
    begin = end + 1;
  }
  return all;
}

std::string scale(double factor, double offset) {
  std::string text;
  if (factor != 1) text += attribute("factor", fmt::format("{}", factor));
  if (offset != 0) text += attribute("offset", fmt::format("{}", offset));
  return text;
}

std::string unit_definitions(const std::vector<FmiVariable>& variables) {
  std::map<std::string, std::map<std::string, std::string>> shown;  // of each unit the display units
  for (const auto& variable : variables) {
    const auto unit = unit_of(variable);
    if (unit.empty()) continue;
    auto& displays = shown[unit];
    if (variable.unit == unit) continue;
    const double offset = scenario::to_si(0, variable.unit);
    const double factor = scenario::to_si(1, variable.unit) - offset;
    displays[variable.unit] = scale(1 / factor, -offset / factor);
  }
  std::string text = "  <UnitDefinitions>\n";
  for (const auto& [unit, displays] : shown) {
    const double offset = scenario::to_si(0, unit);
    text += fmt::format("    <Unit{}>\n      <BaseUnit{}{}/>\n", attribute("name", unit),
                        exponents(scenario::si_unit(unit)), scale(scenario::to_si(1, unit) - offset, offset));
    for (const auto& [display, conversion] : displays)
      text += fmt::format("      <DisplayUnit{}{}/>\n", attribute("name", display), conversion);
    text += "    </Unit>\n";
  }
  return text + "  </UnitDefinitions>\n";
}

// The type of numbers in a unit, as it is named.
std::string type_name(const FmiVariable& variable) {
  const auto unit = unit_of(variable);
  if (unit.empty() || variable.type != Type::real) return "";
  return variable.unit == unit ? "number in " + unit
                               : fmt::format("number in {}, shown in {}", unit, variable.unit);
}

std::string type_definitions(Standard standard, const std::vector<FmiVariable>& variables) {
  std::map<std::string, std::string> types;
  for (const auto& variable : variables) {
    const auto name = type_name(variable);
    if (name.empty()) continue;
    auto units = attribute("unit", unit_of(variable));
    if (variable.unit != unit_of(variable)) units += attribute("displayUnit", variable.unit);
    types[name] = units;
  }
  if (types.empty()) return "";
  std::string text = "  <TypeDefinitions>\n";
  for (const auto& [name, units] : types)
    text += standard == Standard::fmi2
                ? fmt::format("    <SimpleType{}><Real{}/></SimpleType>\n", attribute("name", name), units)
                : fmt::format("    <Float64Type{}{}/>\n", attribute("name", name), units);
  return text + "  </TypeDefinitions>\n";
}

std::string start_of(const FmiVariable& variable) {
  switch (variable.type) {
    case Type::word:
      return *variable.word;
    case Type::flag:
      return variable.get() != 0 ? "true" : "false";
    case Type::whole:
    case Type::count:
      return fmt::format("{}", static_cast<std::int64_t>(variable.get()));
    case Type::real:
      break;
  }
  return fmt::format("{}", variable.get());
}

bool has_start(const FmiVariable& variable) {
  return variable.role != Role::output && variable.role != Role::time;
}

std::string causality(const FmiVariable& variable) {
  constexpr std::string_view names[] = {"independent", "parameter", "parameter", "input", "output"};
  return std::string(names[static_cast<int>(variable.role)]);
}

std::string variability(const FmiVariable& variable) {
  if (variable.role == Role::parameter) return "fixed";
  if (variable.role == Role::live_parameter) return "tunable";
  return variable.type == Type::real ? "continuous" : "discrete";
}

std::string meaning(const FmiVariable& variable) {
  if (variable.choices.empty()) return variable.meaning;
  return fmt::format("{}: {}", variable.meaning, fmt::join(variable.choices, ", "));
}

// What stands in the element of its type, in both standards.
std::string typed(const FmiVariable& variable, bool real) {
  std::string text;
  if (const auto type = type_name(variable); !type.empty()) text += attribute("declaredType", type);
  if (real) {
    const auto unit = unit_of(variable);
    if (!unit.empty()) text += attribute("unit", unit);
    if (!unit.empty() && variable.unit != unit) text += attribute("displayUnit", variable.unit);
  }
  if (variable.ranged) {
    text += attribute("min", fmt::format("{}", to_own(variable, variable.min)));
    text += attribute("max", fmt::format("{}", to_own(variable, variable.max)));
  }
  return text;
}

std::string head_text(const FmuHead& head, std::string_view version, std::string_view token) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{}\" "
      "generationTool=\"Drycut {}\"{}{}{} variableNamingConvention=\"structured\"",
      version, DRYCUT_VERSION, attribute("modelName", head.identifier), attribute(token, head.token),
      attribute("description", head.title));
}

std::string experiment(const FmuHead& head) {
  return fmt::format("  <DefaultExperiment startTime=\"0\" stopTime=\"{}\" stepSize=\"{}\"/>\n", head.stop,
                     head.step);
}

std::string variable2(const FmiVariable& variable, std::size_t reference) {
  constexpr std::string_view types[] = {"Real", "Integer", "Real", "Boolean", "String"};
  const std::string_view type = types[static_cast<int>(variable.type)];
  const auto start = has_start(variable) ? attribute("start", start_of(variable)) : "";
  return fmt::format("    <ScalarVariable{} valueReference=\"{}\"{}{}{}><{}{}{}/></ScalarVariable>\n",
                     attribute("name", variable.name), reference, attribute("description", meaning(variable)),
                     attribute("causality", causality(variable)),
                     attribute("variability", variability(variable)), type, start,
                     typed(variable, type == "Real"));
}

std::string variable3(const FmiVariable& variable, std::size_t reference) {
  constexpr std::string_view types[] = {"Float64", "Int32", "Int64", "Boolean", "String"};
  const std::string_view type = types[static_cast<int>(variable.type)];
  const auto begin = fmt::format(
      "    <{}{} valueReference=\"{}\"{}{}{}{}", type, attribute("name", variable.name), reference,
      attribute("description", meaning(variable)), attribute("causality", causality(variable)),
      attribute("variability", variability(variable)), typed(variable, variable.type == Type::real));
  if (!has_start(variable)) return begin + "/>\n";
  if (variable.type == Type::word)
    return fmt::format("{}><Start{}/></{}>\n", begin, attribute("value", start_of(variable)), type);
  return fmt::format("{}{}/>\n", begin, attribute("start", start_of(variable)));
}

// No output follows an input before the next step; at the beginning each may follow the parameters.
std::string structure(Standard standard, const std::vector<FmiVariable>& variables) {
  std::string outputs;
  std::string unknowns;
  for (std::size_t n = 0; n < variables.size(); ++n) {
    if (variables[n].role != Role::output) continue;
    if (standard == Standard::fmi2) {
      outputs += fmt::format("      <Unknown index=\"{}\" dependencies=\"\"/>\n", n + 1);
      unknowns += fmt::format("      <Unknown index=\"{}\"/>\n", n + 1);
    } else {
      outputs += fmt::format("    <Output valueReference=\"{}\" dependencies=\"\"/>\n", n);
      unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\"/>\n", n);
    }
  }
  if (standard == Standard::fmi3) return outputs + unknowns;
  return fmt::format("    <Outputs>\n{}    </Outputs>\n    <InitialUnknowns>\n{}    </InitialUnknowns>\n",
                     outputs, unknowns);
}

}  // namespace

std::string model_description(Standard standard, const FmuHead& head,
                              const std::vector<FmiVariable>& variables) {
  const bool two = standard == Standard::fmi2;
  auto text = head_text(head, two ? "2.0" : "3.0", two ? "guid" : "instantiationToken") + ">\n";
  const auto identifier = attribute("modelIdentifier", head.identifier);
  if (two)
    text += fmt::format(
        "  <CoSimulation{} canHandleVariableCommunicationStepSize=\"true\" "
        "canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\" "
        "canSerializeFMUstate=\"true\"/>\n",
        identifier);
  else
    text += fmt::format(
        "  <CoSimulation{} canHandleVariableCommunicationStepSize=\"true\" fixedInternalStepSize=\"{}\" "
        "canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" mightReturnEarlyFromDoStep=\"true\"/>\n",
        identifier, head.step);
  text += unit_definitions(variables) + type_definitions(standard, variables);
  text +=
      "  <LogCategories>\n    <Category name=\"logStatusError\" description=\"what is refused, and why\"/>\n"
      "  </LogCategories>\n";
  text += experiment(head) + "  <ModelVariables>\n";
  for (std::size_t n = 0; n < variables.size(); ++n)
    text += two ? variable2(variables[n], n) : variable3(variables[n], n);
  return text + "  </ModelVariables>\n  <ModelStructure>\n" + structure(standard, variables) +
         "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string documentation(Standard standard, const FmuHead& head, const std::vector<FmiVariable>& variables,
                          const FmuContents& contents) {
  auto text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body {{font: 15px sans-serif; max-width: 70em; margin: 2em auto}} td, th {{text-align: left; "
      "padding: 0.1em 1em 0.1em 0; vertical-align: top}}</style></head>\n<body>\n<h1>{0}</h1>\n<p>{1}</p>\n"
      "<p>{4}, for co-simulation by FMI {2}. It steps by {3} s; a communication step is any whole multiple "
      "of "
      "that. {5}</p>\n<table>\n"
      "<tr><th>variable</th><th>is</th><th>unit</th><th>start</th><th>meaning</th></tr>\n",
      escaped(head.identifier), escaped(head.title), standard == Standard::fmi2 ? "2.0" : "3.0", head.step,
      head.what, escaped(head.use));
  for (const auto& variable : variables)
    text += fmt::format("<tr><td>{}</td><td>{}{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escaped(variable.name), variable.role == Role::live_parameter ? "tunable " : "",
                        causality(variable), escaped(unit_of(variable)),
                        has_start(variable) ? escaped(start_of(variable)) : "", escaped(meaning(variable)));
  text += "</table>\n<h2>What it carries</h2>\n";
  if (contents.files.empty()) {
    text += "<p>None of the files that it was made of: only the values of the machine.</p>\n";
  } else {
    text += "<p>These files that it was made of, whole; whoever has the FMU has them:</p>\n<ul>\n";
    for (const auto& file : contents.files) text += fmt::format("<li>{}</li>\n", escaped(file));
    text += "</ul>\n";
  }
  text += fmt::format("<p>{}</p>\n<p>It carries libraries of others under licences of their own:",
                      escaped(contents.own_licence));
  for (const auto& licence : contents.licences)
    text += fmt::format(" <a href=\"{0}\">{0}</a>", escaped(licence));
  return text + "</p>\n</body>\n</html>\n";
}

}  // namespace drycut::sim::fmi
