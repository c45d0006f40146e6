#include "plants/guest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

using Role = GuestVariable::Role;
using Type = GuestVariable::Type;

namespace {

/// What a double holds exactly.
constexpr double largest_count = 9007199254740992.0;

std::int64_t count_of(double number) {
  return static_cast<std::int64_t>(std::clamp(std::round(number), -largest_count, largest_count));
}

bool is_pure_number(const GuestVariable& variable) {
  return variable.unit.empty() && (variable.type == Type::real || variable.type == Type::whole);
}

std::string meaning_of(const GuestVariable& variable) {
  return variable.meaning.empty() ? "of the FMU" : variable.meaning;
}

}  // namespace

bool Guest::Input::is_reference() const {
  return variable->type == Type::real && (variable->is_voltage || variable->unit.empty());
}

void Guest::Input::set(double si) {
  if (variable->type == Type::flag)
    command.level = si != 0;
  else if (variable->type == Type::whole)
    pulses.pulses = count_of(si);
  else if (is_reference())
    reference.volts = si;
  else
    value = variable->from_si(si);
}

double Guest::Input::si() const {
  if (variable->type == Type::flag) return command.level ? 1 : 0;
  if (variable->type == Type::whole) return static_cast<double>(pulses.pulses);
  return is_reference() ? reference.volts : variable->in_si(value);
}

double Guest::Input::own() const {
  if (variable->type != Type::real) return si();
  return is_reference() ? variable->from_si(reference.volts) : value;
}

void Guest::Input::visit(StateArchive& archive) { STATE(archive, value, reference, command, pulses); }

bool Guest::Output::is_encoder() const { return is_pure_number(*variable); }

void Guest::Output::visit(StateArchive& archive) { STATE(archive, value, encoder, signal, rises_before); }

Guest::Guest(World& world, std::string name, std::shared_ptr<const GuestType> type,
             const GuestType::Start& start, double every)
    : world_(&world), name_(std::move(name)), type_(std::move(type)), every_(every) {
  if (!type_) return;
  for (const auto& variable : type_->variables()) {
    if (variable.role == Role::input) {
      inputs_.push_back({&variable});
      inputs_.back().set(variable.in_si(variable.start));
    } else if (variable.role == Role::output) {
      outputs_.push_back({&variable});
    }
  }
  sent_.resize(inputs_.size());
  answer_.resize(outputs_.size());
  try {
    model_ = type_->start(start, answer_);
  } catch (const std::exception& error) {
    world_->fail(error.what());
  }
  for (std::size_t n = 0; n < outputs_.size(); ++n) {
    auto& output = outputs_[n];
    output.value = answer_[n];
    output.signal.level = output.value != 0;
    if (!output.is_encoder()) continue;
    output.encoder.count = count_of(output.value);
    output.encoder.before = output.encoder.now = static_cast<double>(output.encoder.count);
  }
  find_edges();
}

// What lies beside a switch and tells more of it.
void Guest::find_edges() {
  const auto beside = [&](const std::string& name) -> Output* {
    const auto found =
        std::ranges::find_if(outputs_, [&](const auto& o) { return o.variable->name == name; });
    return found == outputs_.end() ? nullptr : &*found;
  };
  for (auto& output : outputs_) {
    if (output.variable->type != Type::flag) continue;
    const auto& name = output.variable->name;
    auto* const rises = beside(name + ".rises");
    auto* const rise_time = beside(name + ".rise_time");
    if (rises == nullptr || rise_time == nullptr || !is_pure_number(*rises->variable) ||
        rise_time->variable->type != Type::real)
      continue;
    output.rises = rises;
    output.rise_time = rise_time;
    output.rises_before = rises->value;
    auto* const encoder = beside(name.substr(0, name.rfind('.')));
    output.latch = beside(name + ".latch");
    if (output.latch != nullptr && encoder != nullptr && encoder->is_encoder()) output.latched = encoder;
  }
}

// An exception of the model is the end of the run, with what was recorded kept.
template <class Act>
void Guest::guarded(double at, const Act& act) {
  now_ = at;
  if (!world_->failure().empty()) return;
  try {
    act();
  } catch (const std::exception& error) {
    world_->fail(fmt::format("{} at {:.9g} s: {}", name_, at, error.what()));
    failed_ = true;
    happened({"failed", 1, {}});
  }
}

std::int64_t Guest::steps_of(double h) const {
  return every_ > 0 ? std::max<std::int64_t>(1, std::llround(every_ / h)) : 1;
}

void Guest::drive(double h) {
  const auto whole = steps_of(h);
  if (!model_ || steps_ % whole != 0) return;
  constexpr double nanoseconds = 1e9;
  const auto nanoseconds_of_step = std::llround(h * nanoseconds);
  const auto at = static_cast<double>(steps_ * nanoseconds_of_step) / nanoseconds;
  const auto size = static_cast<double>(whole * nanoseconds_of_step) / nanoseconds;
  for (std::size_t n = 0; n < inputs_.size(); ++n) sent_[n] = inputs_[n].own();
  guarded(at, [&] {
    model_->begin_step(at, size, sent_);
    waits_ = true;
  });
}

void Guest::settle(double at) {
  if (!waits_) return;
  waits_ = false;
  guarded(at, [&] {
    model_->end_step(answer_);
    for (std::size_t n = 0; n < outputs_.size(); ++n)
      if (!std::isfinite(answer_[n]))
        throw std::runtime_error(
            fmt::format("the FMU's output {} is no finite number any more", outputs_[n].variable->name));
  });
}

void Guest::sense(double h) {
  ++steps_;
  for (auto& output : outputs_) {
    output.signal.edges.clear();
    output.encoder.before = output.encoder.now;
  }
  if (!model_ || steps_ % steps_of(h) != 0) return;
  const double end = static_cast<double>(steps_) * h;
  settle(end);
  if (!world_->failure().empty()) return;
  for (std::size_t n = 0; n < outputs_.size(); ++n) {
    auto& output = outputs_[n];
    output.value = answer_[n];
    if (!output.is_encoder()) continue;
    output.encoder.count = count_of(output.value);
    output.encoder.now = output.value;
  }
  const double begin = static_cast<double>(steps_ - 1) * h;
  for (auto& output : outputs_)
    if (output.variable->type == Type::flag) show_signal(output, begin, h);
}

void Guest::show_signal(Output& output, double begin, double h) {
  const bool now = output.value != 0;
  if (output.rises != nullptr && output.rises->value > output.rises_before) {
    const double fraction = std::clamp((output.rise_time->value - begin) / h, 0.0, 1.0);
    if (output.signal.level) output.signal.add_edge(false, fraction);
    output.signal.add_edge(true, fraction);
    output.signal.level = true;
    output.rises_before = output.rises->value;
    // The line through what was latched and what is counted now.
    if (output.latched != nullptr && fraction < 1) {
      auto& encoder = output.latched->encoder;
      encoder.before = (output.latch->value - encoder.now * fraction) / (1 - fraction);
    }
  }
  output.signal.show(now);
}

void Guest::visit(StateArchive& archive) {
  if (!model_) return;
  if (!type_->keeps_state())
    throw std::runtime_error("an FMU of this line cannot keep its state: no moment of it can be kept");
  settle(now_);
  std::vector<std::byte> state;
  if (!archive.restores()) guarded(now_, [&] { state = model_->save(); });
  STATE(archive, steps_, waits_, sent_, answer_, state);
  archive.each("inputs", inputs_, [&](Input& input) { input.visit(archive); });
  archive.each("outputs", outputs_, [&](Output& output) { output.visit(archive); });
  if (archive.restores()) guarded(now_, [&] { model_->restore(state); });
}

std::vector<Port> Guest::ports() {
  std::vector<Port> ports;
  for (auto& input : inputs_) {
    const auto& variable = *input.variable;
    if (variable.type == Type::flag)
      ports.push_back({variable.name, &input.command, meaning_of(variable)});
    else if (variable.type == Type::whole)
      ports.push_back({variable.name, &input.pulses, meaning_of(variable)});
    else if (input.is_reference())
      ports.push_back({variable.name, &input.reference, meaning_of(variable)});
  }
  for (auto& output : outputs_) {
    const auto& variable = *output.variable;
    if (variable.type == Type::flag)
      ports.push_back({variable.name, &output.signal, meaning_of(variable)});
    else if (output.is_encoder())
      ports.push_back({variable.name, &output.encoder, meaning_of(variable)});
  }
  return ports;
}

std::vector<Channel> Guest::channels() {
  std::vector<Channel> channels;
  for (auto& output : outputs_)
    channels.push_back({output.variable->name, output.variable->unit,
                        [&output] { return output.variable->in_unit(output.value); },
                        meaning_of(*output.variable)});
  for (auto& input : inputs_)
    channels.push_back({input.variable->name, input.variable->unit,
                        [&input] { return input.variable->in_unit(input.own()); },
                        meaning_of(*input.variable)});
  return channels;
}

std::vector<Setting> Guest::settings() {
  std::vector<Setting> settings;
  for (auto& input : inputs_) {
    const auto& variable = *input.variable;
    Range range;
    if (variable.type != Type::flag) range = {variable.min, variable.max, variable.type == Type::whole};
    settings.push_back({variable.name, variable.unit, [&input](double si) { input.set(si); },
                        [&input] { return input.si(); }, meaning_of(variable), range});
  }
  return settings;
}

std::vector<EventType> Guest::event_types() {
  return {
      {"failed",
       {},
       "it crashed, hung, took too much memory, refused to go on, or gave what is no number: the run ends",
       Severity::error}};
}

void GuestDefinition::open(std::shared_ptr<const GuestType> type, std::string name) {
  type_ = std::move(type);
  name_ = std::move(name);
  given_.clear();
  if (!type_) return;
  const auto& variables = type_->variables();
  for (std::size_t n = 0; n < variables.size(); ++n) {
    const auto& variable = variables[n];
    if (variable.role != Role::parameter) continue;
    Given given{n, variable.in_si(variable.start), {}};
    if (variable.type == Type::whole) given.value = static_cast<int>(variable.start);
    if (variable.type == Type::flag) given.value = variable.start != 0;
    if (variable.type == Type::word) given.value = variable.start_word;
    given.start = given.value;
    given_.push_back(std::move(given));
  }
}

Parameters GuestDefinition::parameters() {
  constexpr std::string_view own = "own choice";
  Parameters rows = {
      row("file", "the FMU, for co-simulation by FMI 2.0 or 3.0, seen from the scenario", file_, {}, own),
      row("every", "ms",
          "its communication step, a whole multiple of the scene's; 0 = the scene's. Its inputs hold over it",
          every_, 0, 1e6, own),
      row("limits.time", "s", "how long it may take for one answer; the run fails then", time_limit_, 0.001,
          1e6, own),
      row("limits.memory", "how many MB its process may have", memory_limit_, 16, 1e6, own),
  };
  for (auto& given : given_) {
    const auto& variable = type_->variables()[given.variable];
    rows.push_back({fmt::format("parameters.{}", variable.name),
                    variable.unit,
                    variable.meaning.empty() ? std::string_view("of the FMU") : variable.meaning,
                    {},
                    variable.min,
                    variable.max,
                    {},
                    {},
                    "the FMU"});
    std::visit([&](auto& value) { rows.back().value = &value; }, given.value);
  }
  return rows;
}

std::vector<PlantDefinition::Objection> GuestDefinition::objections(double h) {
  const double steps = step(h) / h;
  if (std::abs(steps - std::round(steps)) > 1e-6 || steps < 0.5)
    return {
        {"scenario.time-grid"_code, "every",
         fmt::format("{:g} ms is no whole multiple of the scene's step of {:g} ms", every_ * 1e3, h * 1e3),
         "choose a multiple"}};
  if (!type_ || type_->fixed_step() <= 0) return {};
  const double own = step(h) / type_->fixed_step();
  if (std::abs(own - std::round(own)) <= 1e-6 * own && own > 0.5) return {};
  return {{"scenario.time-grid"_code, "every",
           fmt::format("the FMU steps by {:g} ms, of which {:g} ms is no whole multiple",
                       type_->fixed_step() * 1e3, step(h) * 1e3),
           fmt::format("every: {:g} ms, or a multiple", type_->fixed_step() * 1e3)}};
}

std::unique_ptr<Plant> GuestDefinition::build(World& world,
                                              const std::function<Plant*(std::string_view)>& find) {
  (void)find;
  GuestType::Start start{{}, time_limit_, memory_limit_};
  for (const auto& given : given_) {
    if (given.value == given.start) continue;
    const auto& variable = type_->variables()[given.variable];
    if (const auto* number = std::get_if<double>(&given.value))
      start.parameters.emplace_back(given.variable, variable.from_si(*number));
    else if (const auto* whole = std::get_if<int>(&given.value))
      start.parameters.emplace_back(given.variable, static_cast<double>(*whole));
    else if (const auto* flag = std::get_if<bool>(&given.value))
      start.parameters.emplace_back(given.variable, *flag ? 1.0 : 0.0);
    else
      start.parameters.emplace_back(given.variable, std::get<std::string>(given.value));
  }
  return std::make_unique<Guest>(world, name_, type_, start, every_);
}

}  // namespace drycut::plants
