// Notes on the instruments that were removed from the records: a table that ends within the
// record's band, and a cycle at which the division is limited (remove_instruments.h).
#ifndef HOWL_APP_TEXT_INSTRUMENT_TEXT_H_
#define HOWL_APP_TEXT_INSTRUMENT_TEXT_H_

#include <string>

#include "estimation/analysis/analyse.h"
#include "io/config/config.h"

namespace howl {

// One paragraph for each; empty without any. `set` is of the config's records, in order.
std::string InstrumentText(const Config& config, const AnalysisSet& set);

}  // namespace howl

#endif  // HOWL_APP_TEXT_INSTRUMENT_TEXT_H_
