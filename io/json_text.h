// JSON of a file that a user, or a fault, may have changed. A value of 100000 lists within one
// another is 200 kB of text, and what copies, compares or prints it calls itself for each of them
// and runs out of its stack: it is refused while it is parsed.
#ifndef HOWL_IO_JSON_TEXT_H_
#define HOWL_IO_JSON_TEXT_H_

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace howl {

inline constexpr int kDeepestJson = 100;  // files of howl's own have less than 10

struct JsonTooDeep : std::runtime_error {
  JsonTooDeep() : std::runtime_error("values within one another, expected fewer") {}
};

// Throws Json::exception, or JsonTooDeep.
template <typename Json, typename Input>
Json ParseJson(Input&& input) {
  const auto check = [](int depth, typename Json::parse_event_t, Json&) {
    if (depth > kDeepestJson) throw JsonTooDeep();
    return true;
  };
  return Json::parse(std::forward<Input>(input), check);
}

// Discarded (is_discarded()) where it is no JSON, or JsonTooDeep.
template <typename Json, typename Input>
Json ParseJsonOrNone(Input&& input) {
  try {
    return ParseJson<Json>(std::forward<Input>(input));
  } catch (const typename Json::exception&) {
  } catch (const JsonTooDeep&) {
  }
  return Json(Json::value_t::discarded);
}

// A path, or what another program said, may have bytes that are no UTF-8, of which JSON has none:
// they become U+FFFD.
template <typename Json>
std::string JsonText(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace howl

#endif  // HOWL_IO_JSON_TEXT_H_
