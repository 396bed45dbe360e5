// What howl_rig writes: records and a config that show nothing of what was withheld, and the key.
#ifndef HOWL_RIG_OUTPUT_H_
#define HOWL_RIG_OUTPUT_H_

#include <string>

#include "rig/plan.h"
#include "rig/recording.h"

namespace rig {

std::string RecordCsv(const Record& record);  // p,q
std::string ConfigYaml(const Spec& spec);     // records are data/NAME.csv
std::string KeyJson(const Spec& spec, const Plan& plan, const Grid& grid);
std::string EffectsTable();  // id, block, catalogue, sizes
// Whole or not at all. Throws std::runtime_error.
void WriteFile(const std::string& path, const std::string& content);

}  // namespace rig

#endif  // HOWL_RIG_OUTPUT_H_
