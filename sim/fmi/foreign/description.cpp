#include "sim/fmi/foreign/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "sim/scenario/guests.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::fmi {

namespace {

using host::NumberKind;
using plants::GuestVariable;
using Node = pugi::xml_node;

[[noreturn]] void refuse_description(const std::string& what) {
  throw scenario::GuestRefused("fmu.description"_code, "modelDescription.xml: " + what,
                               "it is the exporting tool's: export the FMU again");
}

constexpr std::size_t most_variables = 100000;  // elements of arrays among them
constexpr double largest_whole = 2147483647.0;

template <class T>
T number_in(const std::string& text, const std::string& of) {
  T number{};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end)
    refuse_description(fmt::format("{}: '{}' is no number", of, text));
  return number;
}

/// A unit as scenarios know it, and how to come to it.
struct KnownUnit {
  std::string text = {};
  double factor = 1;  // a number of the model is in `text` after * factor + offset
  double offset = 0;
};

/// Of one element of UnitDefinitions, or of a name alone.
KnownUnit unit_called(const std::string& name, const Node& definition) {
  if (name.empty() || name == "1" || name == "-") return {};
  const bool known = scenario::is_unit(name);
  const auto base = definition.child("BaseUnit");
  if (!base) return known ? KnownUnit{name} : KnownUnit{};
  std::string text;
  for (const auto* of : {"kg", "m", "s", "A", "K", "mol", "cd", "rad"}) {
    const int power = base.attribute(of).as_int(0);
    if (power == 0) continue;
    if (!text.empty()) text += '.';
    text += power == 1 ? of : fmt::format("{}{}", of, power);
  }
  const double factor = base.attribute("factor").as_double(1);
  const double offset = base.attribute("offset").as_double(0);
  if (!text.empty() && !scenario::is_unit(text))
    refuse_description(fmt::format("the unit {} has the exponents {}, which no unit has", name, text));
  if (!std::isfinite(factor) || factor == 0 || !std::isfinite(offset) || !std::isfinite(1 / factor))
    refuse_description(fmt::format("the unit {} has a factor or offset that is no number", name));
  // Angles may be left out of its base, as the standard allows.
  const auto same = [&](const std::string& other) {
    constexpr double slack = 1e-6;
    if (!known || !scenario::is_unit(other) || !scenario::same_dimension(name, other)) return false;
    const double zero = scenario::to_si(0, name);
    return std::abs(scenario::to_si(1, name) - zero - factor) <= slack * std::abs(factor) &&
           std::abs(zero - offset) <= slack * std::max(1.0, std::abs(offset));
  };
  const auto with = [&](const char* angle) { return text.empty() ? angle : text + "." + angle; };
  if (same(text) || same(with("rad")) || same(with("rad-1"))) return {name};
  return {text, factor, offset};
}

class Description {
 public:
  explicit Description(const Node& root) : root_(root) {}

  ForeignDescription read() {
    const std::string version = root_.attribute("fmiVersion").value();
    if (std::string_view(root_.name()) != "fmiModelDescription")
      refuse_description("it is of something else than an FMU");
    if (!version.starts_with("2.") && !version.starts_with("3."))
      refuse_description(fmt::format("it is of FMI '{}'; 2.0 and 3.0 are taken", version));
    made_.version = version.front() - '0';
    made_.model = root_.attribute("modelName").value();
    made_.tool = root_.attribute("generationTool").value();
    made_.token = root_.attribute(two() ? "guid" : "instantiationToken").value();
    const auto kind = root_.child("CoSimulation");
    if (!kind) refuse_description("it is for model exchange or scheduled execution; co-simulation is taken");
    made_.identifier = kind.attribute("modelIdentifier").value();
    if (made_.identifier.empty() || made_.identifier.find('/') != std::string::npos)
      refuse_description(fmt::format("modelIdentifier '{}' is no name of a library", made_.identifier));
    const auto says = [&](const char* in2, const char* in3) {
      return kind.attribute(two() ? in2 : in3).as_bool();
    };
    made_.keeps_state = says("canGetAndSetFMUstate", "canGetAndSetFMUState") &&
                        says("canSerializeFMUstate", "canSerializeFMUState");
    made_.fixed_step = kind.attribute("fixedInternalStepSize").as_double(0);
    if (kind.attribute("needsExecutionTool").as_bool())
      refuse_description("it needs the tool that wrote it (needsExecutionTool); it is to run on its own");
    read_units();
    for (const auto& variable : root_.child("ModelVariables").children())
      if (variable.type() == pugi::node_element) read_variable(variable);
    check_structure();
    return std::move(made_);
  }

 private:
  [[nodiscard]] bool two() const { return made_.version == 2; }

  void read_units() {
    for (const auto& unit : root_.child("UnitDefinitions").children("Unit"))
      definitions_[unit.attribute("name").value()] = unit;
    for (const auto& type : root_.child("TypeDefinitions").children())
      types_[type.attribute("name").value()] = two() ? type.first_child() : type;
  }

  /// Of the variable, else of the type that it names.
  [[nodiscard]] std::string said(const Node& typed, const char* attribute) const {
    if (const auto own = typed.attribute(attribute)) return own.value();
    const auto type = types_.find(typed.attribute("declaredType").value());
    return type == types_.end() ? "" : type->second.attribute(attribute).value();
  }

  static std::optional<NumberKind> kind_of(std::string_view type, bool two) {
    static const std::map<std::string_view, NumberKind> in2 = {{"Real", NumberKind::float64},
                                                               {"Integer", NumberKind::int32},
                                                               {"Enumeration", NumberKind::int32},
                                                               {"Boolean", NumberKind::boolean},
                                                               {"String", NumberKind::text}};
    static const std::map<std::string_view, NumberKind> in3 = {
        {"Float32", NumberKind::float32},  {"Float64", NumberKind::float64}, {"Int8", NumberKind::int8},
        {"UInt8", NumberKind::uint8},      {"Int16", NumberKind::int16},     {"UInt16", NumberKind::uint16},
        {"Int32", NumberKind::int32},      {"UInt32", NumberKind::uint32},   {"Int64", NumberKind::int64},
        {"UInt64", NumberKind::uint64},    {"Boolean", NumberKind::boolean}, {"String", NumberKind::text},
        {"Enumeration", NumberKind::int64}};
    const auto& known = two ? in2 : in3;
    const auto found = known.find(type);
    return found == known.end() ? std::nullopt : std::optional(found->second);
  }

  // What a type holds; of 64 bits what a double holds exactly.
  static std::pair<double, double> whole_range(NumberKind kind) {
    constexpr double exact = 9007199254740992;  // 2^53
    switch (kind) {
      case NumberKind::int8:
        return {-0x80, 0x7F};
      case NumberKind::uint8:
        return {0, 0xFF};
      case NumberKind::int16:
        return {-0x8000, 0x7FFF};
      case NumberKind::uint16:
        return {0, 0xFFFF};
      case NumberKind::int32:
        return {-largest_whole - 1, largest_whole};
      case NumberKind::uint32:
        return {0, 2 * largest_whole + 1};
      case NumberKind::uint64:
        return {0, exact};
      default:
        return {-exact, exact};
    }
  }

  static GuestVariable::Type type_of(NumberKind kind, GuestVariable::Role role) {
    using Type = GuestVariable::Type;
    switch (kind) {
      case NumberKind::float32:
      case NumberKind::float64:
        return Type::real;
      case NumberKind::boolean:
        return Type::flag;
      case NumberKind::text:
        return Type::word;
      case NumberKind::uint32:
      case NumberKind::int64:
      case NumberKind::uint64:  // more than a whole number of a table holds
        return role == GuestVariable::Role::parameter ? Type::real : Type::whole;
      default:
        return Type::whole;
    }
  }

  void read_variable(const Node& element) {
    const std::string name = element.attribute("name").value();
    if (name.empty() || !names_.insert(name).second)
      refuse_description(fmt::format("a variable has no name, or that of another one: '{}'", name));
    auto typed = two() ? element.first_child() : element;
    while (typed && typed.type() != pugi::node_element) typed = typed.next_sibling();
    const auto reference =
        number_in<std::uint32_t>(element.attribute("valueReference").value(), name + ".valueReference");
    const std::string causality = element.attribute("causality").value();
    order_.push_back(causality);
    causalities_[reference] = causality;
    const auto kind = kind_of(typed.name(), two());
    if (causality == "structuralParameter" && kind &&
        type_of(*kind, GuestVariable::Role::input) == GuestVariable::Type::whole)
      sizes_[reference] = number_in<std::uint64_t>(element.attribute("start").value(), name + ".start");
    const bool parameter = causality == "parameter";
    if (!parameter && causality != "input" && causality != "output") return;
    if (!kind) {
      if (std::string_view(typed.name()) == "Clock" || std::string_view(typed.name()) == "Binary") return;
      refuse_description(
          fmt::format("{} is of the type '{}', which FMI {}.0 has not", name, typed.name(), made_.version));
    }
    if (*kind == NumberKind::text && !parameter) return;
    GuestVariable made;
    made.name = name;
    made.meaning = element.attribute("description").value();
    made.role = parameter              ? GuestVariable::Role::parameter
                : causality == "input" ? GuestVariable::Role::input
                                       : GuestVariable::Role::output;
    made.type = type_of(*kind, made.role);
    if (made.type == GuestVariable::Type::real) take_unit(made, said(typed, "unit"));
    if (made.type == GuestVariable::Type::flag) made.max = 1;
    if (made.type == GuestVariable::Type::flag) made.min = 0;
    if (made.type == GuestVariable::Type::whole && made.role != GuestVariable::Role::output) {
      std::tie(made.min, made.max) = whole_range(*kind);
      if (made.role == GuestVariable::Role::parameter) {
        made.min = std::max(made.min, -largest_whole - 1);
        made.max = std::min(made.max, largest_whole);
      }
    }
    take_range(made, typed);
    add_elements(std::move(made), element, typed, {reference, *kind, 1});
  }

  void take_unit(GuestVariable& made, const std::string& name) {
    const auto definition = definitions_.find(name);
    const auto unit = unit_called(name, definition == definitions_.end() ? Node() : definition->second);
    made.unit = unit.text;
    made.factor = unit.factor;
    made.offset = unit.offset;
    if (unit.text.empty()) return;
    const double zero = scenario::to_si(0, unit.text);
    const double one = scenario::to_si(1, unit.text) - zero;
    made.si_factor = unit.factor * one;
    made.si_offset = unit.offset * one + zero;
    if (!std::isfinite(made.si_factor) || !std::isfinite(1 / made.si_factor) ||
        !std::isfinite(made.si_offset))
      refuse_description(fmt::format("the unit {} has a factor or offset beyond all measure", name));
    made.is_voltage = scenario::same_dimension(unit.text, "V");
  }

  void take_range(GuestVariable& made, const Node& typed) const {
    if (made.type == GuestVariable::Type::flag || made.type == GuestVariable::Type::word) return;
    for (const auto* which : {"min", "max"}) {
      const auto text = said(typed, which);
      if (text.empty()) continue;
      const double limit = made.in_unit(number_in<double>(text, made.name + "." + which));
      (std::string_view(which) == "min" ? made.min : made.max) = limit;
    }
    if (!(made.min < made.max))
      refuse_description(fmt::format("{} has nothing between its least and its largest value", made.name));
  }

  [[nodiscard]] std::vector<std::size_t> dimensions_of(const Node& element, const std::string& name) const {
    constexpr std::uint64_t most = 10000;
    std::vector<std::size_t> sizes;
    std::uint64_t all = 1;
    for (const auto& dimension : element.children("Dimension")) {
      std::uint64_t size = 0;
      if (const auto fixed = dimension.attribute("start")) {
        size = number_in<std::uint64_t>(fixed.value(), name);
      } else {
        const auto by =
            sizes_.find(number_in<std::uint32_t>(dimension.attribute("valueReference").value(), name));
        if (by == sizes_.end()) refuse_description(fmt::format("the size of {} is not known", name));
        size = by->second;
      }
      if (size > most || (all *= size) > most)
        refuse_description(fmt::format("{} has more than {} elements", name, most));
      sizes.push_back(static_cast<std::size_t>(size));
    }
    return sizes;
  }

  void add_elements(GuestVariable made, const Node& element, const Node& typed,
                    host::SharedVariable exchanged) {
    const auto sizes = dimensions_of(element, made.name);
    std::size_t count = 1;
    for (const auto size : sizes) count *= size;
    if (count == 0) return;
    if (made_.variables.size() + count > most_variables)
      refuse_description(fmt::format("it has more than {} variables", most_variables));
    exchanged.elements = static_cast<std::uint32_t>(count);
    std::vector<std::string> starts;
    if (exchanged.kind == NumberKind::text && !two()) {
      for (const auto& start : element.children("Start"))
        starts.emplace_back(start.attribute("value").value());
      if (count > 1) return;  // lists of texts
      if (starts.empty()) starts.emplace_back();
    } else if (exchanged.kind == NumberKind::text) {
      starts.emplace_back(typed.attribute("start").value());
    } else {
      std::istringstream list(typed.attribute("start").value());
      for (std::string one; list >> one;) starts.push_back(one);
    }
    if (made.role != GuestVariable::Role::output && starts.size() != count && starts.size() != 1)
      refuse_description(
          fmt::format("{} has {} start values, and {} elements", made.name, starts.size(), count));
    made_.exchanged.push_back({exchanged, made_.variables.size()});
    for (std::size_t n = 0; n < count; ++n) {
      auto one = made;
      if (!sizes.empty()) one.name += index_of(n, sizes);
      if (!starts.empty()) take_start(one, starts[starts.size() == 1 ? 0 : n]);
      made_.variables.push_back(std::move(one));
    }
  }

  static std::string index_of(std::size_t n, const std::vector<std::size_t>& sizes) {
    std::string text;
    for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
      text = fmt::format("{}{}{}", n % *size + 1, text.empty() ? "" : ",", text);
      n /= *size;
    }
    return "[" + text + "]";
  }

  static void take_start(GuestVariable& made, const std::string& text) {
    if (made.type == GuestVariable::Type::word)
      made.start_word = text;
    else if (made.type == GuestVariable::Type::flag)
      made.start = text == "true" || text == "1" ? 1 : 0;
    else
      made.start = number_in<double>(text, made.name + ".start");
    if (!std::isfinite(made.start) || !std::isfinite(made.in_si(made.start)) ||
        !std::isfinite(made.in_unit(made.start)))
      refuse_description(fmt::format("{}.start is no finite number", made.name));
    const bool fits = made.start == std::round(made.start) && std::abs(made.start) <= largest_whole;
    if (made.type == GuestVariable::Type::whole && !fits)
      refuse_description(fmt::format("{}.start is no whole number of 32 bits", made.name));
  }

  // An output is one, in both places.
  void check_structure() const {
    const auto structure = root_.child("ModelStructure");
    if (two()) {
      for (const auto& unknown : structure.child("Outputs").children("Unknown")) {
        const auto index = unknown.attribute("index").as_ullong(0);
        if (index < 1 || index > order_.size() || order_[static_cast<std::size_t>(index) - 1] != "output")
          refuse_description(
              fmt::format("ModelStructure names variable {} as an output, which is none", index));
      }
      return;
    }
    for (const auto& output : structure.children("Output")) {
      const auto reference = output.attribute("valueReference").as_uint(0);
      const auto found = causalities_.find(reference);
      if (found == causalities_.end() || found->second != "output")
        refuse_description(fmt::format(
            "ModelStructure names the value reference {} as an output, which is none", reference));
    }
  }

  Node root_;
  ForeignDescription made_;
  std::map<std::string, Node> definitions_;
  std::map<std::string, Node> types_;
  std::set<std::string> names_;
  std::vector<std::string> order_;
  std::map<std::uint32_t, std::string> causalities_;
  std::map<std::uint32_t, std::uint64_t> sizes_;  ///< structural parameters
};

}  // namespace

ForeignDescription read_description(std::string_view xml) {
  pugi::xml_document document;
  const auto read = document.load_buffer(xml.data(), xml.size());
  if (!read) {
    const auto before = xml.substr(0, static_cast<std::size_t>(read.offset));
    refuse_description(fmt::format("line {}: {}", std::ranges::count(before, '\n') + 1, read.description()));
  }
  return Description(document.document_element()).read();
}

}  // namespace drycut::sim::fmi
