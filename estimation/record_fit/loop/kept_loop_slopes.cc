// From the weights of a record's bins to the slopes by a loop's parameters.
#include <complex>

#include "estimation/record_fit/loop/kept_loop.h"
#include "estimation/record_fit/loop/loop_lanes.h"
#include "estimation/record_fit/loop/slow_parts.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// What the answers before the taper weigh, of which the residuals lose the differences.
void BeforeTaper(const Eigen::VectorXcd& of_residuals, Eigen::VectorXcd* out) {
  const Eigen::Index bins = of_residuals.size();
  out->resize(bins + 1);
  (*out)[0] = -of_residuals[0];
  out->segment(1, bins - 1) = of_residuals.head(bins - 1) - of_residuals.tail(bins - 1);
  (*out)[bins] = of_residuals[bins - 1];
}

double Sum(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, const Eigen::VectorXcd& c) {
  return SumOfProducts(a.data(), b.data(), c.data(), a.size());
}

// `by` may be null, for ones.
void MultiplyBy(const C* by, Eigen::VectorXcd* out) {
  if (by != nullptr) SetProducts(out->data(), by, out->size(), out->data());
}

}  // namespace

Eigen::VectorXd KeptLoop::Slope(const WhittleWeights& weights, Eigen::Index first) {
  const Eigen::Index flame = record_.flame.cols();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(structure_.Parameters(flame));
  if (first < structure_.AcousticChange()) SlopeByAcoustics(weights, &out);
  if (first < structure_.FlameChange(flame)) SlopeByFlame(weights, &out);
  if (structure_.HasChanges() && first < structure_.Noise(flame)) SlopeByChanges(weights, &out);
  Eigen::Index next = structure_.Noise(flame);
  for (std::size_t j = 0; j < noise_columns_.size(); ++j) {
    const Eigen::MatrixXd& columns = noise_columns_[j];
    const auto source = static_cast<Eigen::Index>(j);
    const auto by_log_spectrum = weights.log_spectra.col(source);
    if (lost_power_[j].size() > 0) {
      const auto spectrum = residuals_.spectra.col(source).array();
      out.segment(next, columns.cols()) =
          columns.transpose() *
          (by_log_spectrum.array() * (1.0 - lost_power_[j].array() / spectrum)).matrix();
    } else {
      out.segment(next, columns.cols()) = columns.transpose() * by_log_spectrum;
    }
    next += columns.cols();
  }
  if (HasBackground(structure_.noise)) out[next] = weights.ratio;
  return out;
}

Eigen::VectorXd KeptLoop::SlopeByBandLines(const WhittleWeights& weights,
                                           const Eigen::VectorXcd& other_factors,
                                           Eigen::Index lines) {
  band_weighted_.resize(record_.bins());
  SetProducts(weights.line_factors.data(), other_factors.data(), record_.bins(),
              band_weighted_.data());
  return band_lines_.Slope(band_weighted_, lines);
}

void KeptLoop::SlopeByAcoustics(const WhittleWeights& weights, Eigen::VectorXd* out) {
  BeforeTaper(weights.acoustic, &edge_weights_);
  weighted_.resize(edge_weights_.size());
  if (structure_.acoustic_lines > 0) {
    SetProducts(edge_weights_.data(), answer_.data(), weighted_.size(), weighted_.data());
    out->segment(structure_.AcousticLine(), structure_.AcousticLines()) =
        lines_.Slope(weighted_, structure_.acoustic_lines) +
        SlopeByBandLines(weights, band_flame_factors_, structure_.acoustic_lines);
  }
  MultiplyBy(AcousticFactors(), &edge_weights_);
  driven_.resize(edge_weights_.size());
  SetProducts(edge_weights_.data(), acoustic_heat_release_.data(), driven_.size(), driven_.data());
  const Eigen::Index dampings = structure_.Frequencies();
  const Eigen::Index residues = dampings + structure_.Dampings();
  const Eigen::Index transients = structure_.Transfer();
  for (Eigen::Index k = 0; k < structure_.modes; ++k) {
    const ModeGrids& grids = modes_[static_cast<std::size_t>(k)];
    const LoopMode& mode = point_.modes[static_cast<std::size_t>(k)];
    const auto at_edges = [&](const Eigen::VectorXcd& of) {
      return SumsOfMode(of.data(), edge_x_.data(), grids.edge_over.data(), of.size());
    };
    const ModeSums transfer =
        SumsOfMode(weights.r.data(), x_.data(), grids.over.data(), record_.bins()) +
        at_edges(driven_);
    const ModeSums transient = at_edges(edge_weights_);
    (*out)[structure_.Frequency(k)] +=
        transfer.ByLogOmega(mode, mode.a, mode.b) + transient.ByLogOmega(mode, mode.g, mode.h);
    (*out)[dampings + structure_.Damping(k)] +=
        transfer.ByLogDamping(mode, mode.a, mode.b) + transient.ByLogDamping(mode, mode.g, mode.h);
    (*out)[residues + k] = transfer.ByRate();
    if (structure_.complex_residues) {
      (*out)[residues + structure_.modes + k] = transfer.ByLevel(mode);
    }
    (*out)[transients + k] = transient.ByRate();
    (*out)[transients + structure_.modes + k] = transient.ByLevel(mode);
  }
}

void KeptLoop::SlopeByChanges(const WhittleWeights& weights, Eigen::VectorXd* out) {
  const auto of_feedback = [&](Eigen::Index column) {
    return (weights.slow.transpose() * record_.slow.of_pressure.col(column)).value().real();
  };
  BeforeTaper(weights.acoustic, &edge_weights_);
  weighted_.resize(edge_weights_.size());
  if (structure_.AcousticChanges() > 0) {
    driven_.setZero(edge_x_.size());  // R before the taper
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      AddTransfer(point_.modes[k], edge_x_.data(), modes_[k].edge_over.data(), driven_.size(),
                  driven_.data());
    }
    SetProducts(edge_weights_.data(), driven_.data(), weighted_.size(), weighted_.data());
    MultiplyBy(AcousticFactors(), &weighted_);
  }
  Eigen::Index next = structure_.AcousticChange();
  ForEachColumn(structure_, kAcousticChanges, [&](Eigen::Index column) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < weighted_.size(); ++i) {
      sum -= Times(weighted_[i], record_.slow.signals(i, column)).real();
    }
    (*out)[next++] = sum + of_feedback(column);
  });
  // What is added to q weighs as an answer does, with the other sign.
  BeforeTaper(weights.flame, &edge_weights_);
  next = structure_.FlameChange(record_.flame.cols());
  ForEachColumn(structure_, kFlameChanges, [&](Eigen::Index column) {
    const double sum =
        (edge_weights_.transpose() * record_.slow.signals.col(column)).value().real();
    (*out)[next++] = of_feedback(column) - sum;
  });
}

void KeptLoop::SlopeByFlame(const WhittleWeights& weights, Eigen::VectorXd* out) {
  BeforeTaper(weights.flame, &edge_weights_);
  const Eigen::Index flame = record_.flame.cols();
  weighted_.resize(edge_weights_.size());
  if (structure_.flame_lines > 0) {
    SetProducts(edge_weights_.data(), arriving_.data(), weighted_.size(), weighted_.data());
    out->segment(structure_.FlameLine(flame), structure_.FlameLines()) =
        lines_.Slope(weighted_, structure_.flame_lines) +
        SlopeByBandLines(weights, band_acoustic_factors_, structure_.flame_lines);
  }
  MultiplyBy(FlameFactors(), &edge_weights_);
  SetProducts(edge_weights_.data(), path_.edge_at.data(), weighted_.size(), weighted_.data());
  out->segment(structure_.Flame(), flame) =
      flame_real_.transpose() * weighted_.real() - flame_imag_.transpose() * weighted_.imag();
  C of_slope = 0.0;
  for (Eigen::Index i = 0; i < record_.bins(); ++i) of_slope += Times(weights.f[i], path_.at[i]);
  out->segment(structure_.Flame(), flame) += of_slope.real() * record_.slopes;
  for (Eigen::Index i = 0; i < structure_.Delays(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    (*out)[structure_.Delay() + i] =
        Sum(weights.f, residuals_.f, path_.by[k]) + Sum(edge_weights_, arriving_, path_.edge_by[k]);
  }
}

}  // namespace howl
