// A value with half of its 95 % interval, for a reader: "219.664 ± 0.017".
#ifndef HOWL_IO_REPORT_SPELLED_INTERVAL_H_
#define HOWL_IO_REPORT_SPELLED_INTERVAL_H_

#include <string>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

// value and half width times `scale`. The half width has two digits where they begin below 35 and
// else one, the value ends at the same decimal, and both stand before one power of ten:
// "(−7.023 ± 0.011) · 10⁻⁵". Without an error the value alone with
// `digits` digits; a dash for NaN.
std::string SpelledInterval(const Estimate& estimate, double scale = 1.0, int digits = 5);

}  // namespace howl

#endif  // HOWL_IO_REPORT_SPELLED_INTERVAL_H_
