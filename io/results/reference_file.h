// results/NAME/reference.json, schema howl.reference/2: the figures that a config gave when they
// were stored, and how fresh ones compare with them.
#ifndef HOWL_IO_RESULTS_REFERENCE_FILE_H_
#define HOWL_IO_RESULTS_REFERENCE_FILE_H_

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace howl {

inline constexpr const char* kReferenceSchema = "howl.reference/2";
// Without a family; still read, for what it has.
inline constexpr const char* kReferenceSchemaBefore = "howl.reference/1";

struct MovedFigure {
  std::string name;  // family.bounds.exp1.omega_hz.outer[0]
  std::string stored;
  std::string fresh;
};

// Throws UserError, with the line where there is one, for a file that is missing, no JSON, or of
// another schema.
nlohmann::ordered_json ReadReference(const std::filesystem::path& path);

// Figures that differ by more than `tolerance` relative, or that only one of the two has. Throws
// UserError for a stored figure of the wrong kind: a text where a number belongs.
std::vector<MovedFigure> CompareReference(const std::filesystem::path& path,
                                          const nlohmann::ordered_json& stored,
                                          const nlohmann::ordered_json& fresh, double tolerance);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_REFERENCE_FILE_H_
