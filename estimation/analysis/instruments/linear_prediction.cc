#include "estimation/analysis/instruments/linear_prediction.h"

#include <algorithm>

namespace howl {
namespace {

constexpr std::size_t kLearntFrom = 4000;  // samples at the end
constexpr std::size_t kMostOrder = 64;
constexpr std::size_t kSamplesPerOrder = 4;

}  // namespace

std::vector<double> BurgCoefficients(std::span<const double> signal, std::size_t order) {
  const std::size_t n = signal.size();
  std::vector<double> forward(signal.begin(), signal.end());
  std::vector<double> backward = forward;
  std::vector<double> a;
  for (std::size_t stage = 1; stage <= order && stage < n; ++stage) {
    double product = 0.0;
    double power = 0.0;
    for (std::size_t i = stage; i < n; ++i) {
      product += forward[i] * backward[i - 1];
      power += forward[i] * forward[i] + backward[i - 1] * backward[i - 1];
    }
    if (!(power > 0.0)) break;  // predicted without an error
    const double reflection = -2.0 * product / power;
    for (std::size_t i = n - 1; i >= stage; --i) {
      const double error = forward[i];
      forward[i] += reflection * backward[i - 1];
      backward[i] = backward[i - 1] + reflection * error;
    }
    const std::vector<double> before = a;
    for (std::size_t k = 0; k < before.size(); ++k) {
      a[k] += reflection * before[before.size() - 1 - k];
    }
    a.push_back(reflection);
  }
  return a;
}

std::vector<double> PredictOnward(std::span<const double> signal, std::size_t count) {
  const std::span<const double> end = signal.last(std::min(signal.size(), kLearntFrom));
  const std::vector<double> a =
      BurgCoefficients(end, std::min(kMostOrder, end.size() / kSamplesPerOrder));
  std::vector<double> known(end.end() - static_cast<std::ptrdiff_t>(a.size()), end.end());
  for (std::size_t i = 0; i < count; ++i) {
    double next = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) next -= a[k] * known[known.size() - 1 - k];
    known.push_back(next);
  }
  known.erase(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(a.size()));
  return known;
}

}  // namespace howl
