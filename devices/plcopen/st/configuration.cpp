#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// CONFIGURATION: which PROGRAMs run, in which tasks, with what at their pins.
namespace drycut::devices::plcopen::st {

/// Its VAR_GLOBAL sections are as those outside of it; the rest is read when all types are known.
void Compiler::find_configuration() {
  const StToken opening = take();
  const std::size_t first = at_;
  if (configuration_first_ != 0)
    complain("st.declared-twice"_code, opening.place, "a second CONFIGURATION",
             "one CONFIGURATION says what runs on the controller");
  while (at_ < stop_ && !peek().word("END_CONFIGURATION")) {
    if (peek().word("VAR_GLOBAL"))
      add_globals();
    else
      take();
  }
  configuration_first_ = first;
  configuration_end_ = at_;
  if (accept_word("END_CONFIGURATION")) return;
  complain("st.configuration"_code, opening.place, "CONFIGURATION has no END_CONFIGURATION",
           "write END_CONFIGURATION at the end");
}

void Compiler::read_configuration() {
  if (configuration_first_ == 0) {
    for (const auto& unit : units_)
      if (unit->kind == Unit::Kind::program) add_instance(unit->name, -1, *unit, 0);
    return;
  }
  code_->configured = true;
  at_ = configuration_first_;
  stop_ = configuration_end_;
  unit_ = &outside_;
  int resources = 0;
  try {
    expect_name("the name of the CONFIGURATION");
  } catch (const GiveUp&) {
  }
  // A PROGRAM may stand before its TASK.
  const std::size_t begin = at_;
  for (const bool tasks : {true, false}) {
    for (at_ = begin; at_ < stop_;) {
      const std::size_t before = at_;
      try {
        configuration_part(tasks, resources);
      } catch (const GiveUp&) {
        skip_past("");
        if (at_ == before) ++at_;
      }
    }
  }
  check_instances();
}

void Compiler::configuration_part(bool tasks, int& resources) {
  const StToken opening = peek();
  const auto skip_to = [&](std::string_view end) {
    while (at_ < stop_ && !take().word(end)) {
    }
  };
  if (opening.word("VAR_GLOBAL")) {
    skip_to("END_VAR");
  } else if (opening.word("VAR_ACCESS") || opening.word("VAR_CONFIG")) {
    if (tasks)
      complain("st.unknown-name"_code, opening.place, upper(opening.text) + " is not known here",
               "give variables their places and values where they are declared");
    skip_to("END_VAR");
  } else if (accept_word("RESOURCE")) {
    expect_name("the name of the RESOURCE");
    expect_word("ON", "RESOURCE name ON type");
    expect_name("the type of the RESOURCE");
    if (tasks && ++resources > 1)
      complain("st.declared-twice"_code, opening.place, "a second RESOURCE",
               "the controller has one processor: put its tasks into one");
  } else if (accept_word("END_RESOURCE") || accept(";")) {
    return;
  } else if (accept_word("TASK")) {
    if (tasks)
      declare_task();
    else
      skip_statement();
  } else if (accept_word("PROGRAM")) {
    if (tasks)
      skip_statement();
    else
      declare_instance();
  } else if (tasks) {
    give_up("st.configuration"_code, opening.place,
            fmt::format("{} stands in the CONFIGURATION", in_quotes(opening.text)),
            "VAR_GLOBAL, RESOURCE, TASK and PROGRAM do");
  } else {
    take();
  }
}

void Compiler::declare_task() {
  const StToken name = expect_name("the name of the task");
  Program::Task task{std::string(name.text), name.place.line, name.place.column, 0, 0, {}};
  bool runs = false;
  int single = -1;
  expect("(", "TASK name(INTERVAL := T#10ms, PRIORITY := 1);");
  do {
    const StToken property = expect_name("INTERVAL, PRIORITY or SINGLE");
    expect(":=", "stands between a property and its value");
    const Place place = peek().place;
    if (property.word("INTERVAL")) {
      task.interval_ns = constant_value(*time_type()) * 1'000'000;
      runs = runs || task.interval_ns > 0;
    } else if (property.word("PRIORITY")) {
      task.priority = static_cast<int>(constant_value(*type_of(Basic::uint)));
    } else if (property.word("SINGLE")) {
      const TypedExpression signal = expression();
      const bool plain = signal.address && signal.type->basic == Basic::boolean && !signal.bits &&
                         node(signal.node).op == StOp::address;
      if (!plain && !signal.unknown())
        give_up("st.unknown-name"_code, place, "SINGLE is no BOOL of VAR_GLOBAL",
                "a task runs at the rising edge of one");
      if (plain) single = static_cast<int>(node(signal.node).imm);
      runs = true;
    } else {
      give_up("st.configuration"_code, property.place,
              fmt::format("a task has no {}", in_quotes(property.text)), "INTERVAL, PRIORITY or SINGLE");
    }
  } while (accept(","));
  expect(")", "ends the properties of a task");
  expect(";", "ends a TASK");
  if (!runs)
    complain("st.configuration"_code, name.place, fmt::format("the task {} never runs", in_quotes(name.text)),
             "INTERVAL := T#10ms, or SINGLE := a BOOL of VAR_GLOBAL");
  for (const Program::Task& other : code_->tasks)
    if (name.word(other.name))
      complain("st.declared-twice"_code, name.place, in_quotes(name.text) + " is declared twice",
               "the first one is in " + line_of({other.line, 1}, name.place));
  code_->tasks.push_back(std::move(task));
  code_->singles.push_back(single);
}

void Compiler::declare_instance() {
  if (peek().word("RETAIN"))
    give_up("st.configuration"_code, peek().place, "RETAIN of a whole program",
            "VAR RETAIN ... END_VAR in the PROGRAM names what is kept");
  accept_word("NON_RETAIN");
  const StToken name = expect_name("the name of the program");
  int task = -1;
  if (accept_word("WITH")) {
    const StToken with = expect_name("the name of its task");
    for (std::size_t i = 0; i < code_->tasks.size(); ++i)
      if (with.word(code_->tasks[i].name)) task = static_cast<int>(i);
    if (task < 0)
      complain("st.unknown-name"_code, with.place, fmt::format("there is no task {}", in_quotes(with.text)),
               suggestion(with.text, names_of(code_->tasks),
                          "TASK " + std::string(with.text) + "(INTERVAL := T#10ms);"));
  }
  expect(":", "PROGRAM name WITH task : type;");
  const StToken type = expect_name("the PROGRAM that it is");
  Unit* const unit = find_unit(type.text);
  if (unit == nullptr || unit->kind != Unit::Kind::program) {
    const auto known = [&] {
      std::vector<std::string> names;
      for (const auto& other : units_)
        if (other->kind == Unit::Kind::program) names.emplace_back(other->name.text);
      return names;
    };
    give_up("st.unknown-name"_code, type.place, fmt::format("there is no PROGRAM {}", in_quotes(type.text)),
            suggested(type.text, known, "PROGRAM " + std::string(type.text) + " ... END_PROGRAM"));
  }
  const std::size_t connections = peek().is("(") ? at_ : 0;
  skip_to([&] { return peek().is(";"); });
  expect(";", "ends a PROGRAM in the CONFIGURATION");
  add_instance(name, task, *unit, connections);
}

void Compiler::add_instance(const StToken& name, int task, Unit& unit, std::size_t connections) {
  if (unit.pou < 0) return;
  code_->instances.push_back({.pou = unit.pou});
  code_->instance_names.push_back({std::string(name.text), name.place.line, name.place.column, task});
  connections_.push_back({&unit, name, connections});
}

void Compiler::check_instances() {
  std::set<std::string> names;
  for (const Connections& instance : connections_) {
    const StToken& name = instance.name;
    if (!names.insert(lower(name.text)).second || find_member(*globals_, name.text) != nullptr)
      complain("st.declared-twice"_code, name.place, in_quotes(name.text) + " is declared twice",
               "each program of a CONFIGURATION has a name of its own");
  }
  for (std::size_t i = 0; i < code_->located.size(); ++i) {
    const int pou = located_in_[i];
    const auto count = std::count_if(code_->instances.begin(), code_->instances.end(),
                                     [&](const Compiled::Instance& instance) { return instance.pou == pou; });
    const Program::Located& located = code_->located[i];
    if (pou >= 0 && count > 1 && located.bit <= 0)
      complain("st.declared-twice"_code, {located.line, located.column},
               fmt::format("{} is in {} programs at one terminal", in_quotes(located.name), count),
               "declare it in VAR_GLOBAL");
  }
  for (std::size_t i = 0; i < code_->in_memory.size(); ++i) {
    const int pou = memory_in_[i];
    const auto count = std::count_if(code_->instances.begin(), code_->instances.end(),
                                     [&](const Compiled::Instance& instance) { return instance.pou == pou; });
    const Program::InMemory& variable = code_->in_memory[i];
    if (pou >= 0 && count > 1)
      complain("st.declared-twice"_code, {variable.line, variable.column},
               fmt::format("{} is in {} programs at one place in memory", in_quotes(variable.name), count),
               "declare it in VAR_GLOBAL");
  }
}

/// What a CONFIGURATION gives the programs: P(in := g, out => h).
void Compiler::connect_instances() {
  unit_ = &outside_;
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    const Connections& of = connections_[i];
    Compiled::Instance& instance = code_->instances[i];
    if (of.unit->state != Unit::State::done || of.unit->type == nullptr) continue;
    const int node = leaf_node(StOp::address, Basic::block, of.name.place, instance.cell);
    const TypedExpression whole = variable_at(of.unit->type, node, std::string(of.name.text), of.name.place);
    at_ = of.connections;
    stop_ = of.connections == 0 ? 0 : configuration_end_;
    try {
      Tree call;
      call.parts.resize(1);
      if (of.connections != 0) call = call_tree(Tree{Tree::Kind::name, &of.name, false, {}, {}, {}});
      const BlockCall given = block_arguments(whole, arguments(call));
      instance.before = sequence_node(given.before, of.name.place);
      instance.after = sequence_node(given.after, of.name.place);
    } catch (const GiveUp&) {
    }
  }
}

}  // namespace drycut::devices::plcopen::st
