// The information of whittle.h.
#include <algorithm>

#include "estimation/record_fit/whittle/information_weights.h"
#include "estimation/record_fit/whittle/weigh_columns.h"
#include "estimation/record_fit/whittle/whittle.h"
#include "model/numerics/transposed_product.h"

namespace howl {
namespace {

// The slopes of R and E_A, or of F and E_B, over a chunk of bins: four rows a bin, real and
// imaginary parts of both, one column a parameter.
class Panel {
 public:
  Panel(const Eigen::MatrixXcd& transfer, const Eigen::MatrixXcd& residual)
      : transfer_(transfer), residual_(residual), rows_(4 * kChunk, transfer.cols()) {}

  void MoveTo(Eigen::Index first, Eigen::Index bins) {
    Set(transfer_, first, bins, 0);
    Set(residual_, first, bins, 2);
  }
  // Those of two parts, from `part` on.
  SlopeColumns Columns(Eigen::Index part) const {
    return {rows_.data() + part * kChunk, rows_.outerStride(), rows_.cols()};
  }
  Eigen::Index cols() const { return rows_.cols(); }
  const Eigen::MatrixXd& rows() const { return rows_; }

 private:
  // Rows of a last chunk that has fewer bins stay zero.
  void Set(const Eigen::MatrixXcd& of, Eigen::Index first, Eigen::Index bins, Eigen::Index part) {
    if (bins < kChunk) rows_.middleRows(part * kChunk, 2 * kChunk).setZero();
    rows_.middleRows(part * kChunk, bins) = of.middleRows(first, bins).real();
    rows_.middleRows((part + 1) * kChunk, bins) = of.middleRows(first, bins).imag();
  }

  const Eigen::MatrixXcd& transfer_;
  const Eigen::MatrixXcd& residual_;
  Eigen::MatrixXd rows_;
};

// What the slopes of R, or of F, share with the noise: the real part of the product.
void WeighNoise(const Eigen::Ref<const Eigen::VectorXcd>& by,
                const Eigen::Ref<const Eigen::MatrixXd>& basis, Eigen::Index column,
                Eigen::MatrixXd* out) {
  const Eigen::Index bins = basis.rows();
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    const auto of = basis.col(k).array();
    out->col(column + k).head(bins).array() = of * by.head(bins).array().real();
    out->col(column + k).segment(kChunk, bins).array() = -of * by.head(bins).array().imag();
  }
}

class Gathering {
 public:
  Gathering(const std::vector<NoiseTerm>& noise, const LoopDerivatives& derivatives)
      : noise_(noise),
        d_(derivatives),
        size_(WhittleParameters(noise, derivatives)),
        acoustic_(d_.r, d_.acoustic),
        flame_(d_.f, d_.flame),
        weighted_(Eigen::MatrixXd::Zero(4 * kChunk, size_)),
        upper_(Eigen::MatrixXd::Zero(size_, size_)) {}

  void Add(const InformationWeights& weights, Eigen::Index first, Eigen::Index bins);
  // Of all chunks, with the background's ratio by itself.
  Eigen::MatrixXd Sum(double ratio_ratio);

 private:
  void Weigh(const Coupling& transfers, const Eigen::VectorXcd& residuals, const Panel& y,
             Eigen::Index column, Eigen::Index bins);
  void AddLoop(const Panel& x, Eigen::Index row, const Eigen::MatrixXcd& with_noise,
               const Eigen::VectorXcd& with_ratio, Eigen::Index first, Eigen::Index bins);
  void AddNoise(const InformationWeights& weights, Eigen::Index first, Eigen::Index bins);

  const std::vector<NoiseTerm>& noise_;
  const LoopDerivatives& d_;
  const Eigen::Index size_;
  Panel acoustic_, flame_;
  const Eigen::MatrixXd ones_ = Eigen::MatrixXd::Ones(kChunk, 1);
  // Of the last chunk's missing rows what stands here meets zeros of the panels.
  Eigen::MatrixXd weighted_;
  Eigen::MatrixXd upper_;  // of which the lower half is not filled
};

void Gathering::Add(const InformationWeights& weights, Eigen::Index first, Eigen::Index bins) {
  acoustic_.MoveTo(first, bins);
  flame_.MoveTo(first, bins);
  const Eigen::Index flame = acoustic_.cols();
  Weigh(weights.rr, weights.aa, acoustic_, 0, bins);
  Weigh(weights.rf, weights.ab, flame_, flame, bins);
  AddLoop(acoustic_, 0, weights.r_spectra, weights.r_ratio, first, bins);
  Weigh(weights.ff, weights.bb, flame_, flame, bins);
  AddLoop(flame_, flame, weights.f_spectra, weights.f_ratio, first, bins);
  AddNoise(weights, first, bins);
}

// Those of y by what they count for in products with slopes of the transfers, and of the residuals.
void Gathering::Weigh(const Coupling& transfers, const Eigen::VectorXcd& residuals, const Panel& y,
                      Eigen::Index column, Eigen::Index bins) {
  const Eigen::Index stride = weighted_.outerStride();
  double* const out = weighted_.data() + column * stride;
  WeighColumns(transfers.alpha.data(), transfers.beta.data(), bins, y.Columns(0), out, stride);
  WeighColumns(nullptr, residuals.data(), bins, y.Columns(2), out + 2 * kChunk, stride);
}

void Gathering::AddLoop(const Panel& x, Eigen::Index row, const Eigen::MatrixXcd& with_noise,
                        const Eigen::VectorXcd& with_ratio, Eigen::Index first, Eigen::Index bins) {
  Eigen::Index column = acoustic_.cols() + flame_.cols();
  for (std::size_t j = 0; j < d_.log_spectra.size(); ++j) {
    const Eigen::MatrixXd& basis = d_.log_spectra[j];
    WeighNoise(with_noise.col(static_cast<Eigen::Index>(j)), basis.middleRows(first, bins), column,
               &weighted_);
    column += basis.cols();
  }
  if (HasBackground(noise_)) {
    WeighNoise(with_ratio, ones_.topRows(bins), column, &weighted_);
  }
  const Eigen::Index beside = row + x.cols();
  const Eigen::Index noise = acoustic_.cols() + flame_.cols();
  AddUpperOfTransposedProduct(x.rows(), weighted_.middleCols(row, x.cols()),
                              upper_.block(row, row, x.cols(), x.cols()));
  AddTransposedProduct(x.rows(), weighted_.middleCols(beside, noise - beside),
                       upper_.block(row, beside, x.cols(), noise - beside));
  // The residuals' slopes share nothing with the noise.
  AddTransposedProduct(x.rows().topRows(2 * kChunk),
                       weighted_.topRightCorner(2 * kChunk, size_ - noise),
                       upper_.block(row, noise, x.cols(), size_ - noise));
}

void Gathering::AddNoise(const InformationWeights& weights, Eigen::Index first, Eigen::Index bins) {
  const auto sources = static_cast<Eigen::Index>(d_.log_spectra.size());
  Eigen::Index row = acoustic_.cols() + flame_.cols();
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto basis = d_.log_spectra[static_cast<std::size_t>(j)].middleRows(first, bins);
    Eigen::Index column = row;
    for (Eigen::Index k = j; k < sources; ++k) {
      const auto other = d_.log_spectra[static_cast<std::size_t>(k)].middleRows(first, bins);
      const auto by = weights.spectra_spectra.col(j * sources + k).head(bins);
      weighted_.block(0, column, bins, other.cols()) = by.asDiagonal() * other;
      column += other.cols();
    }
    if (HasBackground(noise_)) {
      weighted_.col(column++).head(bins) = weights.spectra_ratio.col(j).head(bins);
    }
    AddTransposedProduct(basis, weighted_.block(0, row, bins, column - row),
                         upper_.block(row, row, basis.cols(), column - row));
    row += basis.cols();
  }
}

Eigen::MatrixXd Gathering::Sum(double ratio_ratio) {
  if (HasBackground(noise_)) upper_(size_ - 1, size_ - 1) = ratio_ratio;
  Eigen::MatrixXd out = upper_.triangularView<Eigen::Upper>();
  out.triangularView<Eigen::StrictlyLower>() = upper_.transpose();
  return out;
}

}  // namespace

Eigen::MatrixXd WhittleInformation(const std::vector<NoiseTerm>& noise,
                                   const Eigen::VectorXd& share, const LoopResiduals& at,
                                   const LoopDerivatives& derivatives) {
  const NoiseOfBins of_bins(noise, at.background_ratio);
  InformationWeights weights(kChunk, static_cast<Eigen::Index>(noise.size()));
  Gathering gathering(noise, derivatives);
  for (Eigen::Index first = 0; first < share.size(); first += kChunk) {
    const Eigen::Index bins = std::min(kChunk, share.size() - first);
    WeighInformation(of_bins, at, share.data(), first, bins, &weights);
    gathering.Add(weights, first, bins);
  }
  return gathering.Sum(weights.ratio_ratio);
}

}  // namespace howl
