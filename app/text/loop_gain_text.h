// The lines of analyse on loop gains below one where the loop is in a limit cycle.
#ifndef HOWL_APP_TEXT_LOOP_GAIN_TEXT_H_
#define HOWL_APP_TEXT_LOOP_GAIN_TEXT_H_

#include <string>

#include "estimation/analysis/analyse.h"

namespace howl {

// One wrapped line for each reason (estimation/analysis/loop/loop_gain_reason.h) with the
// experiments that it holds for; empty where there is none.
std::string LowLoopGainText(const AnalysisSet& set);

}  // namespace howl

#endif  // HOWL_APP_TEXT_LOOP_GAIN_TEXT_H_
