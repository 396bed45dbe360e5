// Describes a fault of a file that the report reads, for the report's reader.
#ifndef HOWL_IO_REPORT_FAULT_WORDS_H_
#define HOWL_IO_REPORT_FAULT_WORDS_H_

#include <exception>
#include <nlohmann/json.hpp>
#include <string>

namespace howl {

// The library's own words for a field of another type name neither file nor field.
inline std::string FaultWords(const std::exception& error) {
  const bool of_json = dynamic_cast<const nlohmann::json::exception*>(&error) != nullptr;
  return of_json ? "a field is missing or of another type than howl writes" : error.what();
}

}  // namespace howl

#endif  // HOWL_IO_REPORT_FAULT_WORDS_H_
