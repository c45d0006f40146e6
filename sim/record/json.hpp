#pragma once
#include <cmath>
#include <filesystem>
#include <string>
#include <type_traits>

#include "base/json.hpp"
#include "sim/record/visit.hpp"

namespace drycut::sim::record {

template <typename T>
inline constexpr bool is_path = std::is_same_v<T, std::filesystem::path>;

template <typename T>
Json json_of(const T& value);

/// Writes the members of a visited value.
struct JsonWriter {
  Json json = Json::object();
  template <typename T>
  void operator()(const char* key, const T& member) {
    if constexpr (is_cloud<T>) return;
    if constexpr (is_optional<T>)
      if constexpr (Visited<typename T::value_type>)
        if (!member) return;
    json[key] = json_of(member);
  }
};

/// A visited value as JSON: keys in the order of its visit. What is not there, and a number that is not
/// finite, is null; a part of its own that is not there has no key.
template <typename T>
Json json_of(const T& value) {
  if constexpr (Visited<T>) {
    JsonWriter writer;
    T::visit(writer, value);
    return std::move(writer.json);
  } else if constexpr (is_optional<T>) {
    return value ? json_of(*value) : Json();
  } else if constexpr (is_list<T>) {
    auto list = Json::array();
    for (const auto& item : value) list.push_back(json_of(item));
    return list;
  } else if constexpr (is_map<T>) {
    auto object = Json::object();
    for (const auto& [key, item] : value) object[key] = json_of(item);
    return object;
  } else if constexpr (is_path<T>) {
    return value.string();
  } else if constexpr (is_time<T>) {
    return seconds(value);
  } else if constexpr (std::is_enum_v<T>) {
    return word_of(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(value) ? Json(value) : Json();
  } else {
    return value;
  }
}

template <typename T>
void take_json(const Json& json, T& value);

/// Fills the members of a visited value; one that is not there stays as it is: an older file has no key for
/// it.
struct JsonReader {
  const Json& json;
  template <typename T>
  void operator()(const char* key, T&& member) {
    if (const auto found = json.find(key); found != json.end()) take_json(*found, member);
  }
};

/// Back again. Throws Json::exception where the JSON is of another kind.
template <typename T>
void take_json(const Json& json, T& value) {
  if constexpr (Visited<T>) {
    static_cast<void>(json.get_ref<const Json::object_t&>());  // or throws
    JsonReader reader{json};
    T::visit(reader, value);
  } else if constexpr (is_optional<T>) {
    value.reset();
    if (!json.is_null()) take_json(json, value.emplace());
  } else if constexpr (is_list<T>) {
    value.clear();
    for (const auto& item : json.get_ref<const Json::array_t&>()) take_json(item, value.emplace_back());
  } else if constexpr (is_map<T>) {
    value.clear();
    for (const auto& [key, item] : json.get_ref<const Json::object_t&>()) take_json(item, value[key]);
  } else if constexpr (is_path<T>) {
    value = json.get<std::string>();
  } else if constexpr (is_time<T>) {
    value = std::llround(json.get<double>() * static_cast<double>(second));
  } else if constexpr (std::is_enum_v<T>) {
    take_word(json.get<std::string>(), value);
  } else if constexpr (std::is_floating_point_v<T>) {
    if (!json.is_null()) value = json.get<T>();
  } else {
    value = json.get<T>();
  }
}

}  // namespace drycut::sim::record
