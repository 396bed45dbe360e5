// What a config calls a loop's flame input and the spread of its delays.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_LOOP_NAMES_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_LOOP_NAMES_H_

#include <string>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

const char* FlameInputName(FlameInput input);
const char* DelaySpreadName(DelaySpread spread);

// The least that a config can state with this loop in it: a config has no modes that are tied
// beside others that are not, and a single mode's damping is its own.
PointStructure AsStated(PointStructure structure);

// The config's `model` that states this loop, in one line.
std::string ModelLine(const PointStructure& structure, FlameInput input);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_LOOP_NAMES_H_
