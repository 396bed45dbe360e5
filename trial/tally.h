// Counts with Wilson's 95 % interval (Wilson 1927): for a share p of n,
//   (p + z^2 / 2n -+ z sqrt(p (1 - p) / n + z^2 / 4 n^2)) / (1 + z^2 / n),   z = 1.96
#ifndef HOWL_TRIAL_TALLY_H_
#define HOWL_TRIAL_TALLY_H_

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct Tally {
  int right = 0;
  int total = 0;

  void Count(bool is_right) {
    right += is_right ? 1 : 0;
    ++total;
  }
  // NaN where nothing was counted.
  double Share() const {
    return total > 0 ? static_cast<double>(right) / total
                     : std::numeric_limits<double>::quiet_NaN();
  }
  double Low() const { return Bound(-1.0); }
  double High() const { return Bound(1.0); }

 private:
  double Bound(double side) const {
    constexpr double kZ = kNormal95;
    if (total == 0) return side < 0.0 ? 0.0 : 1.0;
    const double n = total;
    const double p = right / n;
    const double half = kZ * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
    return std::clamp((p + kZ * kZ / (2.0 * n) + side * half) / (1.0 + kZ * kZ / n), 0.0, 1.0);
  }
};

}  // namespace howl

#endif  // HOWL_TRIAL_TALLY_H_
