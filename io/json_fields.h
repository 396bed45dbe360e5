// Fields of JSON that a user, or a fault, may have changed: of another type they are absent.
#ifndef HOWL_IO_JSON_FIELDS_H_
#define HOWL_IO_JSON_FIELDS_H_

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace howl {

// The field where it is there and of this type; else null.
inline const nlohmann::json* FieldAt(const nlohmann::json& json, const char* key,
                                     bool (nlohmann::json::*is_type)() const noexcept) {
  if (!json.is_object()) return nullptr;
  const auto found = json.find(key);
  return found != json.end() && ((*found).*is_type)() ? &*found : nullptr;
}

// Of any type; null where there is none.
inline const nlohmann::json& JsonAt(const nlohmann::json& json, const char* key) {
  static const nlohmann::json null;
  if (!json.is_object()) return null;
  const auto found = json.find(key);
  return found != json.end() ? *found : null;
}

// "" where there is none.
inline std::string TextAt(const nlohmann::json& json, const char* key) {
  const nlohmann::json* const field = FieldAt(json, key, &nlohmann::json::is_string);
  return field != nullptr ? field->get<std::string>() : "";
}

// `otherwise` where there is none.
inline double NumberAt(const nlohmann::json& json, const char* key,
                       double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  const nlohmann::json* const field = FieldAt(json, key, &nlohmann::json::is_number);
  return field != nullptr ? field->get<double>() : otherwise;
}

// An empty object where there is none.
inline nlohmann::json ObjectAt(const nlohmann::json& json, const char* key) {
  const nlohmann::json* const field = FieldAt(json, key, &nlohmann::json::is_object);
  return field != nullptr ? *field : nlohmann::json::object();
}

// An empty list where there is none.
inline const nlohmann::json& ListAt(const nlohmann::json& json, const char* key) {
  static const nlohmann::json empty = nlohmann::json::array();
  const nlohmann::json* const field = FieldAt(json, key, &nlohmann::json::is_array);
  return field != nullptr ? *field : empty;
}

}  // namespace howl

#endif  // HOWL_IO_JSON_FIELDS_H_
