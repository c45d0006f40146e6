// FMI 2.0.4: the functions of its co-simulation, and those of its model exchange, which this FMU has none of.
#include <charconv>
#include <string_view>

#include "sim/fmi/binary/instance.hpp"

using namespace drycut::sim::fmi;  // functions of C are in no namespace

namespace {

using Type = FmiVariable::Type;

// As the standard has it.
struct CallbackFunctions {
  void (*logger)(void* environment, const char* instance, FmiStatus status, const char* category,
                 const char* message, ...);
  void* (*allocate)(std::size_t count, std::size_t size);
  void (*free)(void* memory);
  void (*step_finished)(void* environment, FmiStatus status);
  void* environment;
};
enum Fmi2Type { model_exchange, co_simulation };
enum Fmi2StatusKind { do_step_status, pending_status, last_successful_time, terminated };

// "file:///opt/a%20b/resources", "file://localhost/opt"; what some importers give is one, too: a plain path,
// or one that begins in their folder, "file:resources", "file://resources".
std::filesystem::path folder_of(std::string_view location) {
  constexpr std::string_view scheme = "file:";
  if (!location.starts_with(scheme)) return location;
  location.remove_prefix(scheme.size());
  constexpr std::string_view host = "//localhost/";
  if (location.starts_with(host))
    location.remove_prefix(host.size() - 1);
  else if (location.starts_with("//"))
    location.remove_prefix(2);
  std::string path;
  for (std::size_t n = 0; n < location.size(); ++n) {
    unsigned char byte = 0;
    const char* const digits = location.data() + n + 1;
    if (location[n] == '%' && n + 2 < location.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      path += static_cast<char>(byte);
      n += 2;
    } else {
      path += location[n];
    }
  }
  return path;
}

}  // namespace

DRYCUT_FMI const char* fmi2GetTypesPlatform() { return "default"; }
DRYCUT_FMI const char* fmi2GetVersion() { return "2.0"; }

DRYCUT_FMI void* fmi2Instantiate(const char* name, Fmi2Type type, const char* guid, const char* resources,
                                 const CallbackFunctions* callbacks, int /*visible*/, int /*logging*/) {
  if (callbacks == nullptr) return nullptr;
  const Log log = [callbacks = *callbacks, name = std::string(name == nullptr ? "" : name)](
                      FmiStatus status, const std::string& message) {
    if (callbacks.logger != nullptr)
      callbacks.logger(callbacks.environment, name.c_str(), status, log_category, "%s", message.c_str());
  };
  if (type != co_simulation) {
    log(fmi_error, "this FMU is for co-simulation");
    return nullptr;
  }
  return instance_of(folder_of(resources == nullptr ? "" : resources), guid, log);
}
DRYCUT_FMI void fmi2FreeInstance(void* handle) { delete static_cast<Instance*>(handle); }
// Errors are told whether debugging is on or not, and there is nothing else.
DRYCUT_FMI FmiStatus fmi2SetDebugLogging(void* handle, int, std::size_t, const char* const*) {
  return guarded(handle, [](Component&) {});
}

DRYCUT_FMI FmiStatus fmi2SetupExperiment(void* handle, int, double, double start, int, double) {
  return guarded(handle, [&](Component& component) { component.begin_at(start); });
}
DRYCUT_FMI FmiStatus fmi2EnterInitializationMode(void* handle) {
  return guarded(handle, [](Component& component) { component.enter_initialisation(); });
}
DRYCUT_FMI FmiStatus fmi2ExitInitializationMode(void* handle) {
  return guarded(handle, [](Component& component) { component.exit_initialisation(); });
}
DRYCUT_FMI FmiStatus fmi2Terminate(void* handle) {
  return guarded(handle, [](Component& component) { component.terminate(); });
}
DRYCUT_FMI FmiStatus fmi2Reset(void* handle) {
  return guarded(handle, [](Component& component) { component.reset(); });
}

DRYCUT_FMI FmiStatus fmi2GetReal(void* handle, const FmiReference* vr, std::size_t size, double* values) {
  return get_numbers(handle, vr, size, values, Type::real, Type::count);
}
DRYCUT_FMI FmiStatus fmi2GetInteger(void* handle, const FmiReference* vr, std::size_t size, int* values) {
  return get_numbers(handle, vr, size, values, Type::whole, Type::whole);
}
DRYCUT_FMI FmiStatus fmi2GetBoolean(void* handle, const FmiReference* vr, std::size_t size, int* values) {
  return get_numbers(handle, vr, size, values, Type::flag, Type::flag);
}
DRYCUT_FMI FmiStatus fmi2GetString(void* handle, const FmiReference* vr, std::size_t size,
                                   const char** values) {
  return get_words(handle, vr, size, values);
}
DRYCUT_FMI FmiStatus fmi2SetReal(void* handle, const FmiReference* vr, std::size_t size,
                                 const double* values) {
  return set_numbers(handle, vr, size, values, Type::real, Type::count);
}
DRYCUT_FMI FmiStatus fmi2SetInteger(void* handle, const FmiReference* vr, std::size_t size,
                                    const int* values) {
  return set_numbers(handle, vr, size, values, Type::whole, Type::whole);
}
DRYCUT_FMI FmiStatus fmi2SetBoolean(void* handle, const FmiReference* vr, std::size_t size,
                                    const int* values) {
  return set_numbers(handle, vr, size, values, Type::flag, Type::flag);
}
DRYCUT_FMI FmiStatus fmi2SetString(void* handle, const FmiReference* vr, std::size_t size,
                                   const char* const* values) {
  return set_words(handle, vr, size, values);
}

DRYCUT_FMI FmiStatus fmi2GetFMUstate(void* handle, void** state) { return get_state(handle, state); }
DRYCUT_FMI FmiStatus fmi2SetFMUstate(void* handle, void* state) { return set_state(handle, state); }
DRYCUT_FMI FmiStatus fmi2FreeFMUstate(void* handle, void** state) { return free_state(handle, state); }
DRYCUT_FMI FmiStatus fmi2SerializedFMUstateSize(void* handle, void* state, std::size_t* size) {
  return size_of_state(handle, state, size);
}
DRYCUT_FMI FmiStatus fmi2SerializeFMUstate(void* handle, void* state, char* bytes, std::size_t size) {
  return write_state(handle, state, bytes, size);
}
DRYCUT_FMI FmiStatus fmi2DeSerializeFMUstate(void* handle, const char* bytes, std::size_t size,
                                             void** state) {
  return read_state(handle, bytes, size, state);
}

DRYCUT_FMI FmiStatus fmi2DoStep(void* handle, double at, double size, int /*no set state before it*/) {
  return guarded(handle, [&](Component& component) { component.step(at, size, false); });
}
DRYCUT_FMI FmiStatus fmi2GetRealStatus(void* handle, Fmi2StatusKind kind, double* value) {
  if (kind != last_successful_time) return cannot(handle, "fmi2GetRealStatus");
  return guarded(handle, [&](Component& component) { *value = component.time(); });
}
DRYCUT_FMI FmiStatus fmi2GetBooleanStatus(void* handle, Fmi2StatusKind kind, int* value) {
  if (kind != terminated) return cannot(handle, "fmi2GetBooleanStatus");
  return guarded(handle, [&](Component&) { *value = 0; });
}
// Each step is done when doStep comes back: nothing is pending.
DRYCUT_FMI FmiStatus fmi2GetStatus(void* /*handle*/, Fmi2StatusKind, FmiStatus*) { return fmi_discard; }
DRYCUT_FMI FmiStatus fmi2GetIntegerStatus(void* /*handle*/, Fmi2StatusKind, int*) { return fmi_discard; }
DRYCUT_FMI FmiStatus fmi2GetStringStatus(void* /*handle*/, Fmi2StatusKind, const char**) {
  return fmi_discard;
}

DRYCUT_FMI_CANNOT(fmi2CancelStep)
DRYCUT_FMI_CANNOT(fmi2SetRealInputDerivatives)
DRYCUT_FMI_CANNOT(fmi2GetRealOutputDerivatives)
DRYCUT_FMI_CANNOT(fmi2GetDirectionalDerivative)
DRYCUT_FMI_CANNOT(fmi2EnterEventMode)
DRYCUT_FMI_CANNOT(fmi2NewDiscreteStates)
DRYCUT_FMI_CANNOT(fmi2EnterContinuousTimeMode)
DRYCUT_FMI_CANNOT(fmi2CompletedIntegratorStep)
DRYCUT_FMI_CANNOT(fmi2SetTime)
DRYCUT_FMI_CANNOT(fmi2SetContinuousStates)
DRYCUT_FMI_CANNOT(fmi2GetDerivatives)
DRYCUT_FMI_CANNOT(fmi2GetEventIndicators)
DRYCUT_FMI_CANNOT(fmi2GetContinuousStates)
DRYCUT_FMI_CANNOT(fmi2GetNominalsOfContinuousStates)
