#include "estimation/family/local/transfer_centre.h"

#include <algorithm>
#include <cmath>

namespace howl {

namespace {

// A start where the transfer does not determine the second mode: its fit may end anywhere, even at
// the smallest size, from which no search comes back. The mode is then minor by (5b).
constexpr double kUnknownMOverN = 0.1;
constexpr double kUnknownRelativeStd = 10.0;
// The covariance holds near the centre alone.
constexpr double kMostLogOmega = 0.1;
constexpr double kMostLogXi = 1.0;

struct SecondMode {
  double value = 0.0;
  double relative_variance = 0.0;
  double with_omega = 0.0;  // covariance of ln omega, and of ln xi, with value / value_0 - 1
  double with_xi = 0.0;
};

SecondMode SecondModeOf(const TransferEllipsoid& ellipsoid, bool relative) {
  const TransferVector& centre = ellipsoid.Centre();
  const TransferMatrix& c = ellipsoid.Covariance();
  if (!ellipsoid.IsDetermined(3)) {
    return {relative ? kUnknownMOverN : kUnknownMOverN * centre(2),
            kUnknownRelativeStd * kUnknownRelativeStd, 0.0, 0.0};
  }
  if (!relative) return {centre(3), c(3, 3), c(0, 3), c(1, 3)};
  return {centre(3) / centre(2), c(3, 3) + c(2, 2) - 2.0 * c(2, 3), c(0, 3) - c(0, 2),
          c(1, 3) - c(1, 2)};
}

}  // namespace

std::vector<TransferCentre> TransferCentres(const std::vector<Experiment>& experiments,
                                            bool shared_second, bool relative) {
  std::vector<TransferCentre> centres;
  std::vector<SecondMode> seconds;
  double sum = 0.0, weights = 0.0;
  for (const Experiment& experiment : experiments) {
    if (!experiment.transfer_ellipsoid) return {};
    const TransferVector& centre = experiment.transfer_ellipsoid->Centre();
    const SecondMode& second =
        seconds.emplace_back(SecondModeOf(*experiment.transfer_ellipsoid, relative));
    centres.push_back({centre(0), centre(1), second.value});
    const double weight = 1.0 / (second.relative_variance * second.value * second.value);
    sum += weight * second.value;
    weights += weight;
  }
  if (!shared_second) return centres;
  const double shared = sum / weights;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const SecondMode& second = seconds[i];
    const double m = (shared / second.value - 1.0) / second.relative_variance;
    centres[i].omega_hz *=
        std::exp(std::clamp(second.with_omega * m, -kMostLogOmega, kMostLogOmega));
    centres[i].xi *= std::exp(std::clamp(second.with_xi * m, -kMostLogXi, kMostLogXi));
    centres[i].second = shared;
  }
  return centres;
}

}  // namespace howl
