#include "sim/fmi/binary/instance.hpp"

#include <cstring>

namespace drycut::sim::fmi {

using Bytes = StateArchive::Bytes;
using Type = FmiVariable::Type;

Instance* instance_of(const std::filesystem::path& resources, const char* token, const Log& log) noexcept {
  try {
    auto instance = std::make_unique<Instance>();
    instance->log = log;
    instance->component = std::make_unique<Component>(resources, token == nullptr ? "" : token);
    return instance.release();
  } catch (const std::exception& error) {
    try {
      log(fmi_error, error.what());
    } catch (...) {  // it has no room for a message
    }
  }
  return nullptr;
}

FmiStatus get_words(void* handle, const FmiReference* references, std::size_t size, const char** values) {
  return guarded(handle, [&](Component& component) {
    for (std::size_t n = 0; n < size; ++n) values[n] = component.word(references[n]);
  });
}

FmiStatus set_words(void* handle, const FmiReference* references, std::size_t size,
                    const char* const* values) {
  return guarded(handle, [&](Component& component) {
    for (std::size_t n = 0; n < size; ++n) {
      if (values[n] == nullptr) throw Refusal("a text is missing");
      component.set(references[n], std::string(values[n]), Type::word, Type::word);
    }
  });
}

FmiStatus get_state(void* handle, void** state) {
  return guarded(handle, [&](Component& component) {
    auto bytes = component.save();
    if (*state == nullptr) *state = new Bytes();
    *static_cast<Bytes*>(*state) = std::move(bytes);
  });
}

FmiStatus set_state(void* handle, void* state) {
  return guarded(handle, [&](Component& component) {
    if (state == nullptr) throw Refusal("there is no state to go back to");
    component.restore(*static_cast<Bytes*>(state));
  });
}

FmiStatus free_state(void* handle, void** state) {
  return guarded(handle, [&](Component&) {
    if (state == nullptr) return;
    delete static_cast<Bytes*>(*state);
    *state = nullptr;
  });
}

FmiStatus size_of_state(void* handle, void* state, std::size_t* size) {
  return guarded(handle, [&](Component&) {
    if (state == nullptr) throw Refusal("there is no state to be written");
    *size = static_cast<Bytes*>(state)->size();
  });
}

FmiStatus write_state(void* handle, void* state, void* bytes, std::size_t size) {
  return guarded(handle, [&](Component&) {
    if (state == nullptr) throw Refusal("there is no state to be written");
    const auto& kept = *static_cast<Bytes*>(state);
    if (size < kept.size()) throw Refusal("there is no room for the state");
    std::memcpy(bytes, kept.data(), kept.size());
  });
}

FmiStatus read_state(void* handle, const void* bytes, std::size_t size, void** state) {
  return guarded(handle, [&](Component&) {
    const auto* const begin = static_cast<const std::byte*>(bytes);
    Bytes kept(begin, begin + size);
    if (*state == nullptr) *state = new Bytes();
    *static_cast<Bytes*>(*state) = std::move(kept);
  });
}

}  // namespace drycut::sim::fmi
