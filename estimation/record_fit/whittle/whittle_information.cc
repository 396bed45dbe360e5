// The information of whittle.h.
#include <array>
#include <complex>

#include "estimation/record_fit/whittle/noise_covariance.h"
#include "estimation/record_fit/whittle/whittle.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// Sums over bins of Re(x_k alpha y_l + x_k beta conj(y_l)).
Eigen::MatrixXd Form(const Eigen::MatrixXcd& x, const Eigen::VectorXcd& alpha,
                     const Eigen::VectorXcd& beta, const Eigen::MatrixXcd& y) {
  const Eigen::MatrixXcd weighted = alpha.asDiagonal() * y + beta.asDiagonal() * y.conjugate();
  return x.real().transpose() * weighted.real() - x.imag().transpose() * weighted.imag();
}

// What two parameters that move R or F have in common at each bin: the coefficients of dx dy and of
// dx conj(dy).
struct Coupling {
  explicit Coupling(Eigen::Index bins) : alpha(bins), beta(bins) {}
  Eigen::VectorXcd alpha;
  Eigen::VectorXcd beta;
};

// All that the information needs of a bin, with its weight in it.
struct Bins {
  Bins(Eigen::Index bins, Eigen::Index sources)
      : rr(bins),
        rf(bins),
        ff(bins),
        aa(bins),
        ab(bins),
        bb(bins),
        r_spectra(bins, sources),
        f_spectra(bins, sources),
        spectra_spectra(bins, sources * sources),
        r_ratio(bins),
        f_ratio(bins),
        spectra_ratio(bins, sources) {}

  Coupling rr, rf, ff;
  Eigen::VectorXcd aa, ab, bb;            // of dE_A conj(dE_A), dE_A conj(dE_B), dE_B conj(dE_B)
  Eigen::MatrixXcd r_spectra, f_spectra;  // of dR d ln S_j
  Eigen::MatrixXd spectra_spectra;
  // Of the background's ratio, which is the same at all bins: sums where no other parameter's
  // slope depends on the bin.
  double ratio_ratio = 0.0;
  Eigen::VectorXcd r_ratio, f_ratio;
  Eigen::MatrixXd spectra_ratio;
};

// M of a parameter that moves R is dR e_A x^T and its conjugate transpose, that of one that moves F
// dF e_B y^T: x and y are the rows. Without the noise's part they are -B Sigma.
struct Movement {
  ComplexPair row;     // x
  ComplexPair b;       // B = dR e_A b^T
  ComplexPair turned;  // x^T Sigma^-1
};

void Fill(const std::vector<NoiseTerm>& noise, const LoopResiduals& at, double share,
          Eigen::Index i, Bins* out) {
  const C r = at.r[i];
  const C f = at.f[i];
  const NoiseDirections direction = DirectionsOf(noise, at, i);
  const HermitianPair sigma = CovarianceOf(direction, at, i);
  const HermitianPair w = sigma.Inverse();
  const C closed = Reciprocal(1.0 - Times(r, f));
  Movement by_r{{}, {-Times(closed, f), -closed}, {}};
  Movement by_f{{}, {-closed, -Times(closed, r)}, {}};
  for (Movement* m : {&by_r, &by_f}) {
    const ComplexPair moved = sigma.Before(m->b);
    m->row = {-moved.a, -moved.b};
  }
  std::array<ComplexPair, kMostNoiseTerms> wu;
  const auto sources = static_cast<Eigen::Index>(noise.size());
  const ComplexPair ratio_turn{1.0, -f};  // du of the background, by its ratio
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto at_j = static_cast<std::size_t>(j);
    const LoopNoise source = noise[at_j].source;
    const double s = at.spectra(i, j);
    const ComplexPair& u = direction[at_j];
    wu[at_j] = w.Apply(u);
    const NoiseTurn turn = TurnOf(source, at.background_ratio);
    by_r.row.a += s * turn.by_r * std::conj(u.a);
    by_r.row.b += s * turn.by_r * std::conj(u.b);
    by_f.row.a += s * turn.by_f * std::conj(u.a);
    by_f.row.b += s * turn.by_f * std::conj(u.b);
  }
  by_r.turned = w.Before(by_r.row);
  by_f.turned = w.Before(by_f.row);
  // tr(W X W Y) and tr(W X W Y^H), of which the second loses what the means would tell.
  const auto beta = [&](const Movement& x, const Movement& y, C w_yx) {
    return Times(w_yx, Dot(x.turned, Conjugate(y.row)) - Dot(sigma.Before(x.b), Conjugate(y.b)));
  };
  const double two = 2.0 * share;
  out->rr.alpha[i] = two * Times(by_r.turned.a, by_r.turned.a);
  out->rr.beta[i] = two * beta(by_r, by_r, w.aa);
  out->rf.alpha[i] = two * Times(by_f.turned.a, by_r.turned.b);
  out->rf.beta[i] = two * beta(by_r, by_f, std::conj(w.ab));
  out->ff.alpha[i] = two * Times(by_f.turned.b, by_f.turned.b);
  out->ff.beta[i] = two * beta(by_f, by_f, w.bb);
  out->aa[i] = two * w.aa;
  out->ab[i] = two * std::conj(w.ab);
  out->bb[i] = two * w.bb;
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto at_j = static_cast<std::size_t>(j);
    const double s = two * at.spectra(i, j);
    out->r_spectra(i, j) = s * ConjugateTimes(wu[at_j].a, Dot(by_r.turned, direction[at_j]));
    out->f_spectra(i, j) = s * ConjugateTimes(wu[at_j].b, Dot(by_f.turned, direction[at_j]));
    for (Eigen::Index k = 0; k < sources; ++k) {
      const ComplexPair& u = direction[static_cast<std::size_t>(k)];
      out->spectra_spectra(i, j * sources + k) =
          share * at.spectra(i, j) * at.spectra(i, k) * std::norm(Inner(u, wu[at_j]));
    }
  }
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto at_j = static_cast<std::size_t>(j);
    if (noise[at_j].source != LoopNoise::kBackground) continue;
    // M of the ratio is d (S u)^H and its conjugate transpose, d the background's turn.
    const double s = at.spectra(i, j);
    const ComplexPair& u = direction[at_j];
    const ComplexPair wd = w.Apply(ratio_turn);
    const auto with = [&](const ComplexPair& turned, C wd_left, C wu_left) {
      return two * s *
             (ConjugateTimes(wu_left, Dot(turned, ratio_turn)) +
              ConjugateTimes(wd_left, Dot(turned, u)));
    };
    out->r_ratio[i] = with(by_r.turned, wd.a, wu[at_j].a);
    out->f_ratio[i] = with(by_f.turned, wd.b, wu[at_j].b);
    const C mixed = Inner(u, wd);
    out->ratio_ratio +=
        two * s * s *
        (Times(mixed, mixed).real() + Inner(u, wu[at_j]).real() * Inner(ratio_turn, wd).real());
    for (Eigen::Index k = 0; k < sources; ++k) {
      const auto at_k = static_cast<std::size_t>(k);
      const ComplexPair& of_k = direction[at_k];
      out->spectra_ratio(i, k) =
          two * at.spectra(i, k) * s * Times(Inner(of_k, wd), Inner(u, wu[at_k])).real();
    }
  }
}

Eigen::MatrixXd GatherInformation(const std::vector<NoiseTerm>& noise, const Bins& bins,
                                  const LoopDerivatives& d) {
  const bool background = HasBackground(noise);
  const Eigen::Index acoustic = d.r.cols();
  const Eigen::Index flame = d.f.cols();
  const Eigen::Index size = WhittleParameters(noise, d);
  Eigen::MatrixXd out(size, size);
  const auto put = [&](Eigen::Index row, Eigen::Index column, const Eigen::MatrixXd& block) {
    out.block(row, column, block.rows(), block.cols()) = block;
    if (row == column) return;
    out.block(column, row, block.cols(), block.rows()) = block.transpose();
  };
  const Eigen::VectorXcd none = Eigen::VectorXcd::Zero(bins.aa.size());
  put(0, 0,
      Form(d.r, bins.rr.alpha, bins.rr.beta, d.r) + Form(d.acoustic, none, bins.aa, d.acoustic));
  put(0, acoustic,
      Form(d.r, bins.rf.alpha, bins.rf.beta, d.f) + Form(d.acoustic, none, bins.ab, d.flame));
  put(acoustic, acoustic,
      Form(d.f, bins.ff.alpha, bins.ff.beta, d.f) + Form(d.flame, none, bins.bb, d.flame));
  Eigen::Index row = acoustic + flame;
  const auto sources = static_cast<Eigen::Index>(d.log_spectra.size());
  for (Eigen::Index j = 0; j < sources; ++j) {
    const Eigen::MatrixXd& basis = d.log_spectra[static_cast<std::size_t>(j)];
    put(0, row, (d.r.transpose() * bins.r_spectra.col(j).asDiagonal()).real() * basis);
    put(acoustic, row, (d.f.transpose() * bins.f_spectra.col(j).asDiagonal()).real() * basis);
    Eigen::Index column = row;
    for (Eigen::Index k = j; k < sources; ++k) {
      const Eigen::MatrixXd& other = d.log_spectra[static_cast<std::size_t>(k)];
      put(row, column,
          basis.transpose() * bins.spectra_spectra.col(j * sources + k).asDiagonal() * other);
      column += other.cols();
    }
    if (background) put(row, column, basis.transpose() * bins.spectra_ratio.col(j));
    row += basis.cols();
  }
  if (background) {
    put(0, row, (d.r.transpose() * bins.r_ratio).real());
    put(acoustic, row, (d.f.transpose() * bins.f_ratio).real());
    out(row, row) = bins.ratio_ratio;
  }
  return out;
}

}  // namespace

Eigen::MatrixXd WhittleInformation(const std::vector<NoiseTerm>& noise,
                                   const Eigen::VectorXd& share, const LoopResiduals& at,
                                   const LoopDerivatives& derivatives) {
  const Eigen::Index bins = share.size();
  Bins all(bins, static_cast<Eigen::Index>(noise.size()));
  for (Eigen::Index i = 0; i < bins; ++i) Fill(noise, at, share[i], i, &all);
  return GatherInformation(noise, all, derivatives);
}

}  // namespace howl
