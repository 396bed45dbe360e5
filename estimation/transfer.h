// The complex q-to-p transfer at every frequency where the two are coherent. In the loop p = G q
// holds whatever drives it, so that noise entering in the flame identifies G, in closed loop as in
// open:
//
//   H(f) = S_qp(f) / (S_qq(f) - S_n),     var Re H = var Im H = |H|^2 (1 - c) / (2 nu c)
//
// c: coherence, nu: independent complex averages in the point, S_n: the floor of q's own noise,
// white, read off the top of the spectrum where q is not coherent with p. Noise of p's own only
// scatters H. What is left of q's noise bounds |H| from below; |H| / c is the bound from above.
//
// Bins under the main lobe of a strong line are left out (the window keeps the line's leakage 92 dB
// down elsewhere). Points are means over `bins_per_point` adjacent bins, at the mean frequency that
// q's power gives them; neighbours overlap a little: neighbour_inflation is the factor by which
// that raises the variance of what is fitted to many of them.
#ifndef HOWL_ESTIMATION_TRANSFER_H_
#define HOWL_ESTIMATION_TRANSFER_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "estimation/lines.h"
#include "estimation/spectrum.h"
#include "estimation/statistics.h"
#include "estimation/transfer_point.h"
#include "model/acoustics.h"

namespace howl {

struct TransferOptions {
  int bins_per_point = 4;
  double min_frequency_hz = 20.0;
  double max_frequency_hz = 0.0;  // 0: 0.45 of the sampling rate
  double min_coherence = 0.1;
  double false_alarm = 1e-3;   // of calling an incoherent point coherent
  double strong_line = 100.0;  // a narrow line this far over its floor is left out
};

struct Transfer {
  std::vector<TransferPoint> points;
  double neighbour_inflation = 1.0;
  double q_noise_psd = 0.0;  // S_n
};

Transfer EstimateTransfer(const CrossSpectrum& spectrum, std::span<const SpectralLine> lines,
                          const TransferOptions& options = {});

struct TransferFitOptions {
  double harmonic_ratio = kSeedHarmonicRatio;
  bool second_mode = true;  // else M is held at a negligible share of N
};

struct TransferFitPoint {
  double frequency_hz = 0.0;
  double model_re = 0.0, model_im = 0.0;
  double misfit = 0.0;  // whitened length of G - H: its square is chi-square with two degrees
  double relative_error = 0.0;  // |G - H| / |H|
};

// Two-mode acoustics fitted to the transfer.
struct TransferFit {
  bool available = false;  // at least four points, and the solver converged
  Acoustics<double> acoustics{0, 0, 0, 0, kSeedHarmonicRatio};
  Estimate omega_hz, xi, N, M;  // std widened by sqrt(chi_square_per_dof) where above one
  // Of log omega_hz, log xi, log N, log M: as the points' variances have it, not widened.
  Eigen::Matrix4d log_covariance = Eigen::Matrix4d::Zero();
  double chi_square_per_dof = 0.0;
  double explained_power = 0.0;   // 1 - sum S_qq |G - H|^2 / sum S_qq |H|^2 over the points
  double noise_power = 0.0;       // the share that the points' own variance leaves unexplained
  double points_within_95 = 0.0;  // share of points whose misfit the noise explains
  std::vector<TransferFitPoint> points;
};

TransferFit FitTransfer(const Transfer& transfer, const TransferFitOptions& options = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_TRANSFER_H_
