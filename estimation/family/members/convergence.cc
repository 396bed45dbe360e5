#include "estimation/family/members/convergence.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace howl {

Convergence AssessConvergence(const std::vector<std::vector<double>>& chains) {
  CHECK(!chains.empty());
  const std::size_t half = chains[0].size() / 2;
  CHECK_GE(half, 2u);
  std::vector<const double*> parts;
  for (const std::vector<double>& chain : chains) {
    CHECK_EQ(chain.size(), chains[0].size());
    parts.push_back(chain.data());
    parts.push_back(chain.data() + half);
  }
  const double n = static_cast<double>(half);
  const double m = static_cast<double>(parts.size());
  std::vector<double> means;
  double within = 0.0;
  for (const double* part : parts) {
    const double mean = std::accumulate(part, part + half, 0.0) / n;
    double sum = 0.0;
    for (std::size_t k = 0; k < half; ++k) sum += (part[k] - mean) * (part[k] - mean);
    means.push_back(mean);
    within += sum / (n - 1.0) / m;
  }
  const double grand = std::accumulate(means.begin(), means.end(), 0.0) / m;
  double between = 0.0;
  for (const double mean : means) between += n * (mean - grand) * (mean - grand) / (m - 1.0);
  const double pooled = (n - 1.0) / n * within + between / n;
  Convergence result;
  if (!(within > 0.0)) {  // a constant
    result.effective_sample_size = n * m;
    return result;
  }
  result.split_r_hat = std::sqrt(pooled / within);
  // Geyer's initial monotone sequence of autocorrelations in pairs.
  const auto correlation = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      for (std::size_t k = 0; k + lag < half; ++k) {
        sum += (parts[part][k] - means[part]) * (parts[part][k + lag] - means[part]);
      }
    }
    return 1.0 - (within - sum / (m * n)) / pooled;
  };
  double time = -1.0;
  double previous = 2.0;
  for (std::size_t lag = 0; lag + 1 < half; lag += 2) {
    const double pair =
        std::min(previous, (lag == 0 ? 1.0 : correlation(lag)) + correlation(lag + 1));
    if (!(pair > 0.0)) break;
    time += 2.0 * pair;
    previous = pair;
  }
  result.effective_sample_size = std::min(n * m / std::max(time, 1e-3), n * m);
  return result;
}

}  // namespace howl
