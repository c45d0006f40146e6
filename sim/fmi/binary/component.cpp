#include "sim/fmi/binary/component.hpp"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <typeinfo>

namespace drycut::sim::fmi {

using Role = FmiVariable::Role;

namespace {

constexpr std::string_view mark = "drycutF1";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Refusal(fmt::format("{} cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string_view name_of(FmiVariable::Type type) {
  constexpr std::string_view names[] = {"a real number", "a whole number", "a count", "a Boolean", "a text"};
  return names[static_cast<int>(type)];
}

// Bullet in single precision has the same names in C++, and where an importer has made them global, the
// loader takes those: results would be others, and nobody would be told.
void refuse_other_bullet() {
  for (const auto* type : {&typeid(btRigidBody), &typeid(btBoxShape)}) {
    Dl_info found{};
    if (dladdr(type, &found) == 0 || found.dli_fname == nullptr) continue;
    const auto name = std::filesystem::path(found.dli_fname).filename().string();
    if (name.starts_with("libBullet") && name.find("float64") == std::string::npos)
      throw Refusal(fmt::format(
          "{} is loaded in this process for all, in single precision, and hides the Bullet of this "
          "FMU; load it without RTLD_GLOBAL",
          found.dli_fname));
  }
}

}  // namespace

Component::Component(const std::filesystem::path& resources, std::string_view token) {
  refuse_other_bullet();
  const auto text = text_of(resources / resource_name());
  token_ = token_of(text);
  if (token != token_)
    throw Refusal(
        fmt::format("the description has the token {}, what its resources have {}: they are of "
                    "two FMUs",
                    token, token_));
  source_ = source_of(text, resources);
  h_ = seconds(source_->step());
  machine_ = source_->build({});
}

const FmiVariable& Component::variable(std::uint32_t reference, Type type, Type or_type) const {
  const auto& all = machine_->variables();
  if (reference >= all.size())
    throw Refusal(fmt::format("there is no variable of value reference {}", reference));
  const auto& variable = all[reference];
  if (variable.type != type && variable.type != or_type)
    throw Refusal(fmt::format("{} is {}, not {}", variable.name, name_of(variable.type), name_of(type)));
  return variable;
}

double Component::number(std::uint32_t reference, Type type, Type or_type) {
  if (stale_) rebuild();
  const auto& row = variable(reference, type, or_type);
  return row.role == Role::time ? time() : row.get();
}

const char* Component::word(std::uint32_t reference) {
  if (stale_) rebuild();
  return variable(reference, Type::word, Type::word).word->c_str();
}

void Component::set(std::uint32_t reference, const FmiValue& value, Type type, Type or_type) {
  static_cast<void>(variable(reference, type, or_type));
  const auto& row = machine_->checked(reference, value);
  const bool before_steps = phase_ == Phase::instantiated || phase_ == Phase::initialising;
  if (row.role == Role::input) {
    if (stale_) rebuild();
    apply(reference, value);
    if (before_steps) inputs_[reference] = value;
  } else if (before_steps) {
    parameters_[reference] = value;
    stale_ = true;
  } else if (row.role == Role::live_parameter) {
    apply(reference, value);
  } else {
    throw Refusal(fmt::format("{} is fixed once the initialisation is over", row.name));
  }
}

// An input acts when it changes: importers set all of them before every step.
void Component::apply(std::uint32_t reference, const FmiValue& value) {
  const auto& row = machine_->variables()[reference];
  const double number = std::get<double>(value);
  if (row.get() != number) row.set(number);
}

// What has the values of its parameters now; the old one stays where they do not go together.
void Component::rebuild() {
  auto built = source_->build(parameters_);
  const auto& now = built->variables();
  const auto& before = machine_->variables();
  bool same = now.size() == before.size();
  for (std::size_t n = 0; same && n < now.size(); ++n)
    same = now[n].name == before[n].name && now[n].unit == before[n].unit;
  if (!same)
    throw Refusal(
        "with these parameters the machine has other variables than the description says: give them in the "
        "scenario and write another FMU");
  machine_ = std::move(built);
  stale_ = false;
  for (const auto& [reference, value] : inputs_) apply(reference, value);
}

void Component::require(Phase phase, std::string_view what) const {
  if (phase_ != phase) throw Refusal(fmt::format("it cannot {} now: calls are out of their order", what));
}

void Component::begin_at(double start) {
  require(Phase::instantiated, "take a start time");
  if (!std::isfinite(start)) throw Refusal("the start time is no finite number");
  start_ = start;
}

void Component::enter_initialisation() {
  require(Phase::instantiated, "be initialised");
  if (stale_) rebuild();
  phase_ = Phase::initialising;
}

void Component::exit_initialisation() {
  require(Phase::initialising, "end its initialisation");
  if (stale_) rebuild();
  phase_ = Phase::stepping;
}

void Component::terminate() {
  require(Phase::stepping, "be terminated");
  phase_ = Phase::terminated;
}

void Component::reset() {
  machine_ = source_->build({});
  parameters_.clear();
  inputs_.clear();
  stale_ = false;
  start_ = 0;
  phase_ = Phase::instantiated;
}

std::int64_t Component::steps_in(double size) const {
  if (size == h_) return 1;  // most importers go by one
  const double steps = std::round(size / h_);
  // The difference of two times has lost digits.
  if (!(std::abs(size / h_ - steps) < 1e-6 * std::max(1.0, steps)) || steps < 1 || steps > 1e15)
    throw Refusal(fmt::format(
        "a communication step of {:.12g} s is no whole multiple of the machine's step of {:g} s", size, h_));
  return static_cast<std::int64_t>(steps);
}

bool Component::step(double at, double size, bool early) {
  require(Phase::stepping, "step");
  if (!(std::abs(at - time()) < h_ / 2))
    throw Refusal(fmt::format("a step from {:.9g} s is asked for, and it is {:.9g} s", at, time()));
  auto left = steps_in(size);
  if (!machine_->failure().empty()) throw Refusal(machine_->failure());
  for (; left > 0; --left) {
    machine_->step();
    if (!machine_->failure().empty()) throw std::runtime_error(machine_->failure());
    if (early && left > 1 && machine_->had_event()) return true;
  }
  return false;
}

StateArchive::Bytes Component::save() {
  if (stale_) rebuild();
  StateArchive::Bytes bytes(mark.size() + sizeof(std::uint64_t));
  StateArchive::save(bytes, [&](StateArchive& archive) {
    STATE(archive, token_, phase_, start_, parameters_, inputs_, *machine_);
  });
  std::memcpy(bytes.data(), mark.data(), mark.size());
  const auto begin = mark.size() + sizeof(std::uint64_t);
  const auto sum = StateArchive::sum_of(std::span(bytes).subspan(begin));
  std::memcpy(bytes.data() + mark.size(), &sum, sizeof sum);
  return bytes;
}

void Component::restore(std::span<const std::byte> state) {
  std::uint64_t sum = 0;
  const auto begin = mark.size() + sizeof sum;
  if (state.size() < begin || std::memcmp(state.data(), mark.data(), mark.size()) != 0)
    throw BadState("these bytes are no state of a Drycut FMU");
  std::memcpy(&sum, state.data() + mark.size(), sizeof sum);
  state = state.subspan(begin);
  if (sum != StateArchive::sum_of(state)) throw BadState("the state was changed, or is cut short");
  auto archive = StateArchive::restoring(state.data(), state.size());
  std::string token;
  Phase phase{};
  double start = 0;
  FmiModel::Given parameters;
  FmiModel::Given inputs;
  STATE(archive, token);
  if (token != token_) throw BadState("the state is of another FMU");
  STATE(archive, phase, start, parameters, inputs);
  if (stale_ || parameters != parameters_) {
    machine_ = source_->build(parameters);
    stale_ = false;
  }
  STATE(archive, *machine_);
  phase_ = phase;
  start_ = start;
  parameters_ = std::move(parameters);
  inputs_ = std::move(inputs);
}

}  // namespace drycut::sim::fmi
