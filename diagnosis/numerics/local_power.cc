#include "diagnosis/numerics/local_power.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace howl {

double LocalPower(const Eigen::VectorXd& power, Eigen::Index bin, Eigen::Index reach,
                  Eigen::Index gap) {
  std::vector<double> around;
  around.reserve(static_cast<std::size_t>(2 * reach + 1));
  const Eigen::Index to = std::min(power.size(), bin + reach + 1);
  for (Eigen::Index i = std::max<Eigen::Index>(0, bin - reach); i < to; ++i) {
    if (std::abs(i - bin) > gap) around.push_back(power[i]);
  }
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return *middle / std::numbers::ln2;
}

}  // namespace howl
