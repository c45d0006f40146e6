// FMI 3.0.2: the functions of its co-simulation, and all others, which this FMU has none of.
#include "sim/fmi/binary/instance.hpp"

using namespace drycut::sim::fmi;  // functions of C are in no namespace

namespace {

using Type = FmiVariable::Type;
using LogMessage = void (*)(void* environment, FmiStatus status, const char* category, const char* message);

void* refused(LogMessage log, void* environment) {
  if (log != nullptr) log(environment, fmi_error, log_category, "this FMU is for co-simulation");
  return nullptr;
}

}  // namespace

DRYCUT_FMI const char* fmi3GetVersion() { return "3.0"; }

DRYCUT_FMI void* fmi3InstantiateCoSimulation(const char* /*name*/, const char* token, const char* resources,
                                             bool /*visible*/, bool /*logging*/, bool /*event mode*/,
                                             bool early, const FmiReference* /*intermediate*/, std::size_t,
                                             void* environment, LogMessage message,
                                             void (* /*intermediate update*/)()) {
  auto* const instance = instance_of(resources == nullptr ? "" : resources, token,
                                     [=](FmiStatus status, const std::string& text) {
                                       if (message != nullptr)
                                         message(environment, status, log_category, text.c_str());
                                     });
  if (instance != nullptr) instance->early = early;
  return instance;
}
DRYCUT_FMI void* fmi3InstantiateModelExchange(const char*, const char*, const char*, bool, bool,
                                              void* environment, LogMessage message) {
  return refused(message, environment);
}
DRYCUT_FMI void* fmi3InstantiateScheduledExecution(const char*, const char*, const char*, bool, bool,
                                                   void* environment, LogMessage message, void (*)(),
                                                   void (*)(), void (*)()) {
  return refused(message, environment);
}
DRYCUT_FMI void fmi3FreeInstance(void* handle) { delete static_cast<Instance*>(handle); }
// Errors are told whether debugging is on or not, and there is nothing else.
DRYCUT_FMI FmiStatus fmi3SetDebugLogging(void* handle, bool, std::size_t, const char* const*) {
  return guarded(handle, [](Component&) {});
}

DRYCUT_FMI FmiStatus fmi3EnterInitializationMode(void* handle, bool, double, double start, bool, double) {
  return guarded(handle, [&](Component& component) {
    component.begin_at(start);
    component.enter_initialisation();
  });
}
DRYCUT_FMI FmiStatus fmi3ExitInitializationMode(void* handle) {
  return guarded(handle, [](Component& component) { component.exit_initialisation(); });
}
DRYCUT_FMI FmiStatus fmi3Terminate(void* handle) {
  return guarded(handle, [](Component& component) { component.terminate(); });
}
DRYCUT_FMI FmiStatus fmi3Reset(void* handle) {
  return guarded(handle, [](Component& component) { component.reset(); });
}

// Scalars only: of each as many values as references.
DRYCUT_FMI FmiStatus fmi3GetFloat64(void* handle, const FmiReference* vr, std::size_t size, double* values,
                                    std::size_t) {
  return get_numbers(handle, vr, size, values, Type::real, Type::real);
}
DRYCUT_FMI FmiStatus fmi3SetFloat64(void* handle, const FmiReference* vr, std::size_t size,
                                    const double* values, std::size_t) {
  return set_numbers(handle, vr, size, values, Type::real, Type::real);
}
DRYCUT_FMI FmiStatus fmi3GetInt32(void* handle, const FmiReference* vr, std::size_t size,
                                  std::int32_t* values, std::size_t) {
  return get_numbers(handle, vr, size, values, Type::whole, Type::whole);
}
DRYCUT_FMI FmiStatus fmi3SetInt32(void* handle, const FmiReference* vr, std::size_t size,
                                  const std::int32_t* values, std::size_t) {
  return set_numbers(handle, vr, size, values, Type::whole, Type::whole);
}
DRYCUT_FMI FmiStatus fmi3GetInt64(void* handle, const FmiReference* vr, std::size_t size,
                                  std::int64_t* values, std::size_t) {
  return get_numbers(handle, vr, size, values, Type::count, Type::count);
}
DRYCUT_FMI FmiStatus fmi3SetInt64(void* handle, const FmiReference* vr, std::size_t size,
                                  const std::int64_t* values, std::size_t) {
  return set_numbers(handle, vr, size, values, Type::count, Type::count);
}
DRYCUT_FMI FmiStatus fmi3GetBoolean(void* handle, const FmiReference* vr, std::size_t size, bool* values,
                                    std::size_t) {
  return get_numbers(handle, vr, size, values, Type::flag, Type::flag);
}
DRYCUT_FMI FmiStatus fmi3SetBoolean(void* handle, const FmiReference* vr, std::size_t size,
                                    const bool* values, std::size_t) {
  return set_numbers(handle, vr, size, values, Type::flag, Type::flag);
}
DRYCUT_FMI FmiStatus fmi3GetString(void* handle, const FmiReference* vr, std::size_t size,
                                   const char** values, std::size_t) {
  return get_words(handle, vr, size, values);
}
DRYCUT_FMI FmiStatus fmi3SetString(void* handle, const FmiReference* vr, std::size_t size,
                                   const char* const* values, std::size_t) {
  return set_words(handle, vr, size, values);
}

// No variable is of these types; of none there is nothing to do.
#define DRYCUT_FMI3_NONE(function)                                                            \
  DRYCUT_FMI FmiStatus function(void* handle, const FmiReference* /*vr*/, std::size_t size) { \
    return size == 0 ? fmi_ok : cannot(handle, #function);                                    \
  }
DRYCUT_FMI3_NONE(fmi3GetFloat32)
DRYCUT_FMI3_NONE(fmi3GetInt8)
DRYCUT_FMI3_NONE(fmi3GetUInt8)
DRYCUT_FMI3_NONE(fmi3GetInt16)
DRYCUT_FMI3_NONE(fmi3GetUInt16)
DRYCUT_FMI3_NONE(fmi3GetUInt32)
DRYCUT_FMI3_NONE(fmi3GetUInt64)
DRYCUT_FMI3_NONE(fmi3GetBinary)
DRYCUT_FMI3_NONE(fmi3GetClock)
DRYCUT_FMI3_NONE(fmi3SetFloat32)
DRYCUT_FMI3_NONE(fmi3SetInt8)
DRYCUT_FMI3_NONE(fmi3SetUInt8)
DRYCUT_FMI3_NONE(fmi3SetInt16)
DRYCUT_FMI3_NONE(fmi3SetUInt16)
DRYCUT_FMI3_NONE(fmi3SetUInt32)
DRYCUT_FMI3_NONE(fmi3SetUInt64)
DRYCUT_FMI3_NONE(fmi3SetBinary)
DRYCUT_FMI3_NONE(fmi3SetClock)

DRYCUT_FMI FmiStatus fmi3GetFMUState(void* handle, void** state) { return get_state(handle, state); }
DRYCUT_FMI FmiStatus fmi3SetFMUState(void* handle, void* state) { return set_state(handle, state); }
DRYCUT_FMI FmiStatus fmi3FreeFMUState(void* handle, void** state) { return free_state(handle, state); }
DRYCUT_FMI FmiStatus fmi3SerializedFMUStateSize(void* handle, void* state, std::size_t* size) {
  return size_of_state(handle, state, size);
}
DRYCUT_FMI FmiStatus fmi3SerializeFMUState(void* handle, void* state, std::uint8_t* bytes, std::size_t size) {
  return write_state(handle, state, bytes, size);
}
DRYCUT_FMI FmiStatus fmi3DeserializeFMUState(void* handle, const std::uint8_t* bytes, std::size_t size,
                                             void** state) {
  return read_state(handle, bytes, size, state);
}

DRYCUT_FMI FmiStatus fmi3DoStep(void* handle, double at, double size, bool /*no set state before it*/,
                                bool* event_handling, bool* terminate, bool* early, double* reached) {
  return guarded(handle, [&](Component& component) {
    *event_handling = *terminate = *early = false;
    *reached = component.time();
    *early = component.step(at, size, static_cast<Instance*>(handle)->early);
    *reached = component.time();
  });
}

DRYCUT_FMI_CANNOT(fmi3EnterEventMode)
DRYCUT_FMI_CANNOT(fmi3EnterStepMode)
DRYCUT_FMI_CANNOT(fmi3EvaluateDiscreteStates)
DRYCUT_FMI_CANNOT(fmi3UpdateDiscreteStates)
DRYCUT_FMI_CANNOT(fmi3EnterConfigurationMode)
DRYCUT_FMI_CANNOT(fmi3ExitConfigurationMode)
DRYCUT_FMI_CANNOT(fmi3GetNumberOfVariableDependencies)
DRYCUT_FMI_CANNOT(fmi3GetVariableDependencies)
DRYCUT_FMI_CANNOT(fmi3GetDirectionalDerivative)
DRYCUT_FMI_CANNOT(fmi3GetAdjointDerivative)
DRYCUT_FMI_CANNOT(fmi3GetOutputDerivatives)
DRYCUT_FMI_CANNOT(fmi3GetIntervalDecimal)
DRYCUT_FMI_CANNOT(fmi3GetIntervalFraction)
DRYCUT_FMI_CANNOT(fmi3GetShiftDecimal)
DRYCUT_FMI_CANNOT(fmi3GetShiftFraction)
DRYCUT_FMI_CANNOT(fmi3SetIntervalDecimal)
DRYCUT_FMI_CANNOT(fmi3SetIntervalFraction)
DRYCUT_FMI_CANNOT(fmi3SetShiftDecimal)
DRYCUT_FMI_CANNOT(fmi3SetShiftFraction)
DRYCUT_FMI_CANNOT(fmi3ActivateModelPartition)
DRYCUT_FMI_CANNOT(fmi3EnterContinuousTimeMode)
DRYCUT_FMI_CANNOT(fmi3CompletedIntegratorStep)
DRYCUT_FMI_CANNOT(fmi3SetTime)
DRYCUT_FMI_CANNOT(fmi3SetContinuousStates)
DRYCUT_FMI_CANNOT(fmi3GetContinuousStates)
DRYCUT_FMI_CANNOT(fmi3GetContinuousStateDerivatives)
DRYCUT_FMI_CANNOT(fmi3GetNominalsOfContinuousStates)
DRYCUT_FMI_CANNOT(fmi3GetEventIndicators)
DRYCUT_FMI_CANNOT(fmi3GetNumberOfEventIndicators)
DRYCUT_FMI_CANNOT(fmi3GetNumberOfContinuousStates)
