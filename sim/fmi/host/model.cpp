#include "sim/fmi/host/model.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace drycut::sim::fmi::host {

namespace {

using Reference = std::uint32_t;
enum Status { ok, warning, discard, error, fatal, pending };

/// What it has logged last of an error or a warning.
std::string last_words;

void keep_words(int status, const char* text) {
  constexpr std::size_t most = 500;
  if (status == ok || text == nullptr) return;
  last_words.assign(text, std::min(most, std::char_traits<char>::length(text)));
}

void log2(void* /*environment*/, const char* /*instance*/, int status, const char* /*category*/,
          const char* text, ...) {
  if (text == nullptr) return;
  std::array<char, 512> made{};
  va_list arguments;
  va_start(arguments, text);
  static_cast<void>(std::vsnprintf(made.data(), made.size(), text, arguments));
  va_end(arguments);
  keep_words(status, made.data());
}

void log3(void* /*environment*/, int status, const char* /*category*/, const char* text) {
  keep_words(status, text);
}

// As the standard lays it out.
struct Callbacks2 {
  void (*log)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(std::size_t, std::size_t);
  void (*free)(void*);
  void (*finished)(void*, int);
  void* environment;
};

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error(last_words.empty() ? what : what + ": " + last_words);
}

const char* name_of(int status) {
  constexpr std::array<const char*, 6> names = {"ok", "warning", "discard", "error", "fatal", "pending"};
  return status >= 0 && status < 6 ? names[static_cast<std::size_t>(status)] : "a status that there is not";
}

/// As the names of functions have it: fmi3GetFloat64, fmi2GetReal.
std::string name_of(NumberKind kind, int version) {
  if (kind == NumberKind::text) return "String";
  if (kind == NumberKind::boolean) return "Boolean";
  if (version == 2) return kind == NumberKind::float64 ? "Real" : "Integer";
  constexpr std::array<const char*, 10> names = {"Float32", "Float64", "Int8",   "UInt8", "Int16",
                                                 "UInt16",  "Int32",   "UInt32", "Int64", "UInt64"};
  return names[static_cast<std::size_t>(kind)];
}

/// The nearest that the type holds.
template <class T>
T narrowed(double number) {
  if constexpr (std::is_same_v<T, bool>) {
    return number != 0;
  } else if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(number);
  } else {
    const double rounded = std::round(number);
    if (!(rounded > static_cast<double>(std::numeric_limits<T>::min()))) return std::numeric_limits<T>::min();
    if (rounded >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    return static_cast<T>(rounded);
  }
}

template <class T>
class GroupOf : public VariableGroup {
 public:
  GroupOf(int version, std::string name, void* setter, void* getter)
      : version_(version), name_(std::move(name)), set_(setter), get_(getter) {}

  void add(const SharedVariable& variable, std::size_t place) override {
    references_.push_back(variable.reference);
    for (std::uint32_t n = 0; n < variable.elements; ++n) places_.push_back(place + n);
    values_ = std::make_unique<T[]>(places_.size());  // NOLINT(modernize-avoid-c-arrays): no vector of bool
  }
  void set(void* instance, const double* numbers) override {
    for (std::size_t n = 0; n < places_.size(); ++n) values_[n] = narrowed<T>(numbers[places_[n]]);
    exchange(set_, "Set", instance);
  }
  void get(void* instance, double* numbers) override {
    exchange(get_, "Get", instance);
    for (std::size_t n = 0; n < places_.size(); ++n) numbers[places_[n]] = static_cast<double>(values_[n]);
  }

 private:
  void exchange(void* function, const char* verb, void* instance) {
    int status = ok;
    if (version_ == 2)
      status = reinterpret_cast<int (*)(void*, const Reference*, std::size_t, T*)>(function)(
          instance, references_.data(), references_.size(), values_.get());
    else
      status = reinterpret_cast<int (*)(void*, const Reference*, std::size_t, T*, std::size_t)>(function)(
          instance, references_.data(), references_.size(), values_.get(), places_.size());
    if (status > warning)
      refuse("fmi" + std::to_string(version_) + verb + name_ + " answers " + name_of(status));
  }
  int version_;
  std::string name_;
  void* set_;
  void* get_;
  std::vector<Reference> references_;
  std::vector<std::size_t> places_;
  std::unique_ptr<T[]> values_;  // NOLINT(modernize-avoid-c-arrays)
};

}  // namespace

void* LoadedModel::function(const std::string& name) {
  const auto full = "fmi" + std::to_string(version_) + name;
  void* const found = dlsym(library_, full.c_str());
  if (found == nullptr) throw std::runtime_error("its library lacks the function " + full);
  return found;
}

template <class... Arguments>
int LoadedModel::call(const char* name, Arguments... arguments) {
  return reinterpret_cast<int (*)(void*, Arguments...)>(function(name))(instance_, arguments...);
}

template <class... Arguments>
void LoadedModel::require(const char* name, Arguments... arguments) {
  const int status = call(name, arguments...);
  if (status > warning)
    refuse("fmi" + std::to_string(version_) + name + " answers " + std::string(name_of(status)));
}

template <class T>
std::unique_ptr<VariableGroup> LoadedModel::make_group(NumberKind kind) {
  const auto name = name_of(kind, version_);
  return std::make_unique<GroupOf<T>>(version_, name, function("Set" + name), function("Get" + name));
}

VariableGroup& LoadedModel::group_of(Groups& groups, NumberKind kind) {
  for (auto& [known, group] : groups)
    if (known == kind) return *group;
  const auto make = [&]() -> std::unique_ptr<VariableGroup> {
    switch (kind) {
      case NumberKind::float32:
        return make_group<float>(kind);
      case NumberKind::int8:
        return make_group<std::int8_t>(kind);
      case NumberKind::uint8:
        return make_group<std::uint8_t>(kind);
      case NumberKind::int16:
        return make_group<std::int16_t>(kind);
      case NumberKind::uint16:
        return make_group<std::uint16_t>(kind);
      case NumberKind::int32:
        return make_group<std::int32_t>(kind);
      case NumberKind::uint32:
        return make_group<std::uint32_t>(kind);
      case NumberKind::int64:
        return make_group<std::int64_t>(kind);
      case NumberKind::uint64:
        return make_group<std::uint64_t>(kind);
      case NumberKind::boolean:
        return version_ == 2 ? make_group<int>(kind) : make_group<bool>(kind);
      default:
        return make_group<double>(kind);
    }
  };
  groups.emplace_back(kind, make());
  return *groups.back().second;
}

std::size_t LoadedModel::add(Groups& groups, const std::vector<SharedVariable>& variables) {
  std::size_t place = 0;
  for (const auto& variable : variables) {
    if (variable.kind == NumberKind::text) continue;
    group_of(groups, variable.kind).add(variable, place);
    place += variable.elements;
  }
  return place;
}

LoadedModel::LoadedModel(const LoadRequest& load) : version_(load.version), keeps_state_(load.keeps_state) {
  library_ = dlopen(load.library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr)
    throw std::runtime_error(std::string("its library cannot be loaded: ") + dlerror());
  const std::string says = reinterpret_cast<const char* (*)()>(function("GetVersion"))();
  if (!says.starts_with(std::to_string(version_) + "."))
    throw std::runtime_error("its description is of FMI " + std::to_string(version_) + ".0, its library of " +
                             says);
  step_ = function("DoStep");
  for (const auto* name : {"FreeInstance", "Terminate"}) function(name);
  if (keeps_state_)
    for (const auto* name : {"GetFMUState", "SetFMUState", "FreeFMUState", "SerializedFMUStateSize",
                             "SerializeFMUState", "DeserializeFMUState"})
      function(state_name(name));
  add(inputs_, load.inputs);
  values_.resize(add(outputs_, load.outputs));
  make_instance(load);
  set_parameters(load);
  initialise();
  begun_ = true;
  try {
    static_cast<void>(outputs());
  } catch (const std::exception&) {
    find_unknown(load.outputs);
    throw;
  }
}

// They are spelt otherwise in 2.0.
std::string LoadedModel::state_name(std::string name) const {
  if (version_ != 2) return name;
  if (const auto at = name.find("FMUState"); at != std::string::npos) name[at + 3] = 's';
  if (name.starts_with("Deserialize")) name[2] = 'S';
  return name;
}

void LoadedModel::make_instance(const LoadRequest& load) {
  if (version_ == 2) {
    static const Callbacks2 callbacks = {log2, std::calloc, std::free, nullptr, nullptr};
    constexpr int co_simulation = 1;
    instance_ =
        reinterpret_cast<void* (*)(const char*, int, const char*, const char*, const Callbacks2*, int, int)>(
            function("Instantiate"))(load.name.c_str(), co_simulation, load.token.c_str(),
                                     load.resources.c_str(), &callbacks, 0, 0);
  } else {
    instance_ = reinterpret_cast<void* (*)(const char*, const char*, const char*, bool, bool, bool, bool,
                                           const Reference*, std::size_t, void*,
                                           void (*)(void*, int, const char*, const char*), void*)>(
        function("InstantiateCoSimulation"))(load.name.c_str(), load.token.c_str(), load.resources.c_str(),
                                             false, false, false, false, nullptr, 0, nullptr, log3, nullptr);
  }
  if (instance_ == nullptr) refuse("it makes no instance");
}

void LoadedModel::set_parameters(const LoadRequest& load) {
  std::size_t number = 0;
  std::size_t text = 0;
  for (const auto& variable : load.parameters) {
    if (variable.kind == NumberKind::text) {
      const char* const word = load.texts.at(text++).c_str();
      if (version_ == 2)
        require("SetString", &variable.reference, std::size_t{1}, &word);
      else
        require("SetString", &variable.reference, std::size_t{1}, &word, std::size_t{1});
      continue;
    }
    Groups one;
    auto& group = group_of(one, variable.kind);
    group.add(variable, 0);
    group.set(instance_, &load.numbers.at(number));
    number += variable.elements;
  }
}

void LoadedModel::initialise() {
  if (version_ == 2) {
    require("SetupExperiment", 0, 0.0, 0.0, 0, 0.0);
    require("EnterInitializationMode");
  } else {
    require("EnterInitializationMode", false, 0.0, 0.0, false, 0.0);
  }
  require("ExitInitializationMode");
}

// One at a time, to say which.
void LoadedModel::find_unknown(const std::vector<SharedVariable>& variables) {
  for (const auto& variable : variables) {
    Groups one;
    auto& group = group_of(one, variable.kind);
    group.add(variable, 0);
    std::vector<double> numbers(variable.elements);
    try {
      group.get(instance_, numbers.data());
    } catch (const std::exception& error) {
      throw std::runtime_error("it does not know its own output of value reference " +
                               std::to_string(variable.reference) + ": " + error.what());
    }
  }
}

// What 2.0 has for it, if the library has that.
bool LoadedModel::asks_to_end() const {
  void* const ask = dlsym(library_, "fmi2GetBooleanStatus");
  constexpr int terminated = 3;
  int answer = 0;
  if (ask != nullptr) reinterpret_cast<int (*)(void*, int, int*)>(ask)(instance_, terminated, &answer);
  return answer != 0;
}

void LoadedModel::step(double at, double size, std::span<const double> inputs) {
  if (ended_at_) refuse("it asked to end the run at " + std::to_string(*ended_at_) + " s");
  for (auto& [kind, group] : inputs_) group->set(instance_, inputs.data());
  int status = ok;
  bool terminated = false;
  if (version_ == 2) {
    status = reinterpret_cast<int (*)(void*, double, double, int)>(step_)(instance_, at, size,
                                                                          keeps_state_ ? 0 : 1);
  } else {
    bool event = false;
    bool early = false;
    double reached = at + size;
    status = reinterpret_cast<int (*)(void*, double, double, bool, bool*, bool*, bool*, double*)>(step_)(
        instance_, at, size, !keeps_state_, &event, &terminated, &early, &reached);
    if (status <= warning && early) refuse("fmi3DoStep returns early, which was not allowed");
  }
  if (status == discard && version_ == 2) terminated = asks_to_end();
  if (terminated) ended_at_ = at + size;
  if (status > warning && !terminated)
    refuse("fmi" + std::to_string(version_) + "DoStep answers " + name_of(status));
}

const std::vector<double>& LoadedModel::outputs() {
  for (auto& [kind, group] : outputs_) group->get(instance_, values_.data());
  return values_;
}

std::vector<std::byte> LoadedModel::save() {
  void* state = nullptr;
  require(state_name("GetFMUState").c_str(), &state);
  std::size_t size = 0;
  require(state_name("SerializedFMUStateSize").c_str(), state, &size);
  if (size > (std::size_t{1} << 30U)) throw std::runtime_error("its state is larger than 1 GB");
  std::vector<std::byte> bytes(size);
  require(state_name("SerializeFMUState").c_str(), state, bytes.data(), size);
  require(state_name("FreeFMUState").c_str(), &state);
  return bytes;
}

void LoadedModel::restore(std::span<const std::byte> bytes) {
  ended_at_.reset();
  void* state = nullptr;
  require(state_name("DeserializeFMUState").c_str(), bytes.data(), bytes.size(), &state);
  require(state_name("SetFMUState").c_str(), state);
  require(state_name("FreeFMUState").c_str(), &state);
}

LoadedModel::~LoadedModel() {
  if (instance_ == nullptr) return;
  if (begun_) static_cast<void>(call("Terminate"));
  reinterpret_cast<void (*)(void*)>(function("FreeInstance"))(instance_);
}

}  // namespace drycut::sim::fmi::host
