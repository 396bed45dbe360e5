#include "model/simulation/decimate.h"

#include <glog/logging.h>

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>

#include "model/numerics/constants.h"
#include "model/simulation/lane_loop.h"

namespace howl {
namespace {

constexpr double kAttenuationDb = 85.0;
constexpr double kPassBand = 0.4;  // of the record's rate
constexpr double kStopBand = 0.6;

}  // namespace

Decimator::Decimator(int ratio) : ratio_(ratio), half_length_(0), taps_{1.0} {
  CHECK_GE(ratio, 1);
  if (ratio == 1) return;
  const double transition = 2.0 * kPi * (kStopBand - kPassBand) / ratio;  // rad a sample
  const auto half =
      static_cast<std::size_t>(std::ceil(0.5 * (kAttenuationDb - 7.95) / (2.285 * transition)));
  half_length_ = static_cast<int>(half);
  const double beta = 0.1102 * (kAttenuationDb - 8.7);
  const double cutoff = 0.5 * (kPassBand + kStopBand) / ratio;  // cycles a sample
  taps_.resize(2 * half + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < taps_.size(); ++k) {
    const double i = static_cast<double>(k) - static_cast<double>(half);
    const double x = i / static_cast<double>(half);
    const double sinc = k == half ? 2.0 * cutoff : std::sin(2.0 * kPi * cutoff * i) / (kPi * i);
    taps_[k] = sinc * boost::math::cyl_bessel_i(0, beta * std::sqrt(1.0 - x * x));
    sum += taps_[k];
  }
  for (double& tap : taps_) tap /= sum;
}

void Decimator::Push(std::span<const double> input, std::vector<double>* output) {
  if (ratio_ == 1) {
    output->insert(output->end(), input.begin(), input.end());
    return;
  }
  pending_.insert(pending_.end(), input.begin(), input.end());
  const std::size_t length = taps_.size();
  std::size_t start = 0;
  while (start + length <= pending_.size()) {
    output->push_back(internal::DotProduct(taps_.data(), pending_.data() + start, length));
    start += static_cast<std::size_t>(ratio_);
  }
  pending_.erase(pending_.begin(),
                 pending_.begin() + static_cast<std::ptrdiff_t>(std::min(start, pending_.size())));
}

}  // namespace howl
