#pragma once
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "sim/fmi/binary/component.hpp"

namespace drycut::sim::fmi {

// What the two faces have in common. The standards' types are declared here as they state them; their status
// codes and value references have the same numbers.

/// A function of the standards: all that this library shows.
#define DRYCUT_FMI extern "C" __attribute__((visibility("default")))

/// The only category of messages.
inline constexpr const char* log_category = "logStatusError";

enum FmiStatus { fmi_ok, fmi_warning, fmi_discard, fmi_error, fmi_fatal };
using FmiReference = std::uint32_t;

using Log = std::function<void(FmiStatus status, const std::string& message)>;

/// What an importer's handle points to.
struct Instance {
  Log log;
  std::unique_ptr<Component> component = {};
  bool early = false;  ///< events may end a communication step
};

/// Does `act` with the component behind a handle. What it throws becomes a message of the importer's log and
/// a status: nothing leaves the library otherwise.
template <class Act>
FmiStatus guarded(void* handle, const Act& act) noexcept {
  if (handle == nullptr) return fmi_error;
  auto& instance = *static_cast<Instance*>(handle);
  try {
    act(*instance.component);
    return fmi_ok;
  } catch (const std::exception& error) {
    try {
      instance.log(fmi_error, error.what());
    } catch (...) {  // it has no room for a message
    }
  } catch (...) {
  }
  return fmi_error;
}

/// Why a function that the standard has and this FMU cannot do is refused, its flags having said so.
inline FmiStatus cannot(void* handle, const char* function) noexcept {
  return guarded(handle, [&](Component&) {
    throw Refusal(std::string(function) + ": this FMU cannot do that, as its description says");
  });
}
/// Such a function. Its other arguments stay unread, for which the call of C on Linux allows.
#define DRYCUT_FMI_CANNOT(function) \
  DRYCUT_FMI FmiStatus function(void* handle) { return cannot(handle, #function); }

/// A new instance, or nullptr and a message: of the folder of resources, `token` that of the description.
Instance* instance_of(const std::filesystem::path& resources, const char* token, const Log& log) noexcept;

/// Gets numbers of variables into an array of the standard's type.
template <class T>
FmiStatus get_numbers(void* handle, const FmiReference* references, std::size_t size, T* values,
                      FmiVariable::Type type, FmiVariable::Type or_type) noexcept {
  return guarded(handle, [&](Component& component) {
    for (std::size_t n = 0; n < size; ++n)
      values[n] = static_cast<T>(component.number(references[n], type, or_type));
  });
}
template <class T>
FmiStatus set_numbers(void* handle, const FmiReference* references, std::size_t size, const T* values,
                      FmiVariable::Type type, FmiVariable::Type or_type) noexcept {
  return guarded(handle, [&](Component& component) {
    for (std::size_t n = 0; n < size; ++n)
      component.set(references[n], static_cast<double>(values[n]), type, or_type);
  });
}
FmiStatus get_words(void* handle, const FmiReference* references, std::size_t size, const char** values);
FmiStatus set_words(void* handle, const FmiReference* references, std::size_t size,
                    const char* const* values);

// The states of both standards: bytes that may be put away as they are.
FmiStatus get_state(void* handle, void** state);
FmiStatus set_state(void* handle, void* state);
FmiStatus free_state(void* handle, void** state);
FmiStatus size_of_state(void* handle, void* state, std::size_t* size);
FmiStatus write_state(void* handle, void* state, void* bytes, std::size_t size);
FmiStatus read_state(void* handle, const void* bytes, std::size_t size, void** state);

}  // namespace drycut::sim::fmi
