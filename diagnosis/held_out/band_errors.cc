#include "diagnosis/held_out/band_errors.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace howl {
namespace {

// The reach of the neighbourhood and the width of a band: those of a mode of damping 0.05 at the
// cycle.
constexpr double kReach = 0.1;  // of the cycle's frequency
constexpr double kWidth = 0.2;
constexpr Eigen::Index kLeastReach = 6;  // bins
constexpr Eigen::Index kLeftOut = 1;     // neighbours that the taper correlates with a bin

Eigen::Index Bins(const PredictedSignals& signals, double share_of_cycle) {
  return std::max(static_cast<Eigen::Index>(share_of_cycle * signals.cycle_hz / signals.bin_hz),
                  kLeastReach);
}

// |e - T x|^2 with T from the neighbours. Each has the weight 1 / power, so that a line does not
// speak for the noise beside it. T's own error adds the leverage of the bin, which is divided out.
Eigen::VectorXd FreeRemainder(const Eigen::VectorXcd& error, const Eigen::VectorXcd& signal,
                              const Eigen::VectorXd& power, const Eigen::VectorXd& share,
                              Eigen::Index reach) {
  const Eigen::Index n = error.size();
  Eigen::VectorXd out(n);
  out.setZero();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (share[i] == 0.0) continue;
    std::complex<double> cross = 0.0;
    double square = 0.0;
    for (Eigen::Index k = std::max<Eigen::Index>(i - reach, 0); k < std::min(i + reach + 1, n);
         ++k) {
      if (std::abs(k - i) <= kLeftOut || share[k] == 0.0) continue;
      cross += std::conj(signal[k]) * error[k] / power[k];
      square += std::norm(signal[k]) / power[k];
    }
    const double leverage = std::norm(signal[i]) / power[i] / square;
    out[i] = std::norm(error[i] - cross / square * signal[i]) / (1.0 + leverage);
  }
  return out;
}

void AddBands(const PredictedSignals& signals, const Eigen::VectorXcd& error,
              const Eigen::VectorXd& own_power, const Eigen::VectorXcd& other,
              const Eigen::VectorXd& other_power, std::vector<BandErrors>* out) {
  const Eigen::VectorXd square =
      (signals.share.array() > 0.0).select(error.cwiseAbs2().cwiseQuotient(own_power), 0.0);
  const Eigen::VectorXd free =
      FreeRemainder(error, other, other_power, signals.share, Bins(signals, kReach))
          .cwiseQuotient(own_power);
  const Eigen::Index width = Bins(signals, kWidth);
  for (Eigen::Index from = 0; from + width <= signals.share.size(); from += width) {
    out->push_back({signals.frequency_hz[from], signals.frequency_hz[from + width - 1],
                    square.segment(from, width).sum(), free.segment(from, width).sum()});
  }
}

void AddSpreadOf(const Eigen::VectorXcd& change, const Eigen::VectorXd& own_power,
                 const PredictedSignals& signals, double weight,
                 std::vector<BandErrors>::iterator band) {
  const Eigen::VectorXd square =
      (signals.share.array() > 0.0).select(change.cwiseAbs2().cwiseQuotient(own_power), 0.0);
  const Eigen::Index width = Bins(signals, kWidth);
  for (Eigen::Index from = 0; from + width <= signals.share.size(); from += width) {
    (band++)->spread += weight * square.segment(from, width).sum();
  }
}

}  // namespace

void AddSpread(const PredictedSignals& signals, const PredictedSignals& moved, double weight,
               std::vector<BandErrors>* bands) {
  AddSpreadOf(moved.pressure_error - signals.pressure_error, signals.pressure_power, signals,
              weight, bands->begin());
  AddSpreadOf(moved.heat_release_error - signals.heat_release_error, signals.heat_release_power,
              signals, weight, bands->begin() + static_cast<std::ptrdiff_t>(bands->size() / 2));
}

Eigen::VectorXd ForetoldPower(const Eigen::MatrixXcd& errors, const PredictedSignals& signals) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(errors.rows());
  for (const auto& error : errors.colwise()) {
    sum +=
        error.cwiseAbs2() - FreeRemainder(error, signals.heat_release, signals.heat_release_power,
                                          signals.share, Bins(signals, kReach));
  }
  // Of errors that no transfer foretells it is as often negative.
  return sum.cwiseMax(0.0) / static_cast<double>(errors.cols());
}

void SetPredictionErrors(const Eigen::Vector2cd& residuals, const Eigen::Matrix2cd& w,
                         const Eigen::Vector2cd& by_pressure,
                         const Eigen::Vector2cd& by_heat_release, Eigen::Index bin,
                         PredictedSignals* signals) {
  const Eigen::Vector2cd we = w * residuals;
  const auto error = [&](const Eigen::Vector2cd& u) { return u.dot(we) / u.dot(w * u).real(); };
  signals->pressure_error[bin] = error(by_pressure);
  signals->heat_release_error[bin] = error(by_heat_release);
}

std::vector<BandErrors> ErrorsOverBands(const PredictedSignals& signals) {
  std::vector<BandErrors> out;
  AddBands(signals, signals.pressure_error, signals.pressure_power, signals.heat_release,
           signals.heat_release_power, &out);
  AddBands(signals, signals.heat_release_error, signals.heat_release_power, signals.pressure,
           signals.pressure_power, &out);
  return out;
}

}  // namespace howl
