#include "diagnosis/numerics/local_power.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

double LocalPower(const Eigen::VectorXd& power, Eigen::Index bin, Eigen::Index reach,
                  Eigen::Index gap) {
  std::vector<double> around;
  around.reserve(static_cast<std::size_t>(2 * reach + 1));
  const Eigen::Index to = std::min(power.size(), bin + reach + 1);
  for (Eigen::Index i = std::max<Eigen::Index>(0, bin - reach); i < to; ++i) {
    if (std::abs(i - bin) > gap) around.push_back(power[i]);
  }
  return MedianInPlace(around) / std::numbers::ln2;
}

}  // namespace howl
