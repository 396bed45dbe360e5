// The complex q-to-p transfer at every frequency where the two are coherent. In the loop p = G q
// holds whatever drives it, so that noise entering in the flame identifies G, in closed loop as in
// open:
//
//   H(f) = S_qp(f) / (S_qq(f) - S_n / 2),     var Re H = var Im H = S_pp (1 - c) / (2 nu S_qq)
//
// c: coherence, nu: independent complex averages in the point. Noise of p's own only scatters H;
// white noise of q's own biases it, and is at most S_n, the least level of what of q is not
// coherent with p: half of that is taken out, and what it truly is stays one unknown of the record
// (estimation/transfer_point.h) in whatever is fitted to the points. |H| / c bounds |H| from above.
//
// Neither the choice of points nor their weights may look at H itself, or chance that makes H large
// counts more than chance that makes it small: points are taken where their neighbours are
// coherent, and the variance is that of what of p is not coherent with q, about the point, which
// does not depend on the H that is found.
//
// Bins under the main lobe of a strong line are left out (the window keeps the line's leakage 92 dB
// down elsewhere). Points are means over `bins_per_point` adjacent bins, at the mean frequency that
// q's power gives them; neighbours overlap a little: neighbour_inflation is the factor by which
// that raises the variance of what is fitted to many of them.
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_H_

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "estimation/analysis/spectra/lines.h"
#include "estimation/analysis/spectra/spectrum.h"
#include "estimation/analysis/spectra/statistics.h"
#include "estimation/parameters.h"
#include "estimation/transfer_point.h"
#include "model/loop/acoustics.h"

namespace howl {

struct TransferOptions {
  int bins_per_point = 4;
  double min_frequency_hz = 0.0;  // 0: the lowest that the spectrum's window resolves
  double max_frequency_hz = 0.0;  // 0: 0.45 of the sampling rate
  double min_coherence = 0.1;
  double strong_line = 100.0;  // a narrow line this far over its floor is left out
};

struct Transfer {
  std::vector<TransferPoint> points;
  double neighbour_inflation = 1.0;
  double q_noise_psd = 0.0;  // S_n
};

Transfer EstimateTransfer(const CrossSpectrum& spectrum, std::span<const SpectralLine> lines,
                          const TransferOptions& options = {});

// The frequencies at which a model with these modes claims to be the acoustics, about a limit cycle
// at frequency_hz: one mode up to halfway to the next, two modes a little beyond the second. Fits
// to the transfer keep to it, wherever they are made.
struct TransferBand {
  double min_frequency_hz = 0.0;
  double max_frequency_hz = std::numeric_limits<double>::infinity();
  // The cycle's: of two modes the first is then the nearer to it, omega within f / sqrt(ratio) ..
  // f sqrt(ratio) (the paper's (5b): the second hardly matters there). Otherwise a first mode with
  // a vanishing N, at a third of the frequency, fits as well, the modes' names exchanged. Zero:
  // there is none.
  double cycle_frequency_hz = 0.0;

  bool Contains(double frequency_hz) const {
    return min_frequency_hz <= frequency_hz && frequency_hz <= max_frequency_hz;
  }
};

// The search with two modes starts where the second adds no more than a share at the limit cycle,
// (5b). Elsewhere the two may have changed places: a mode at omega is as well a second mode at r
// times omega / r.
struct FirstModeCarries {
  double frequency_hz = 0.0;  // of the limit cycle
  double second_mode_share_max = std::numeric_limits<double>::infinity();
};

TransferBand TransferBandOf(const ModelSpec& model, double frequency_hz);

struct TransferFitPoint {
  double frequency_hz = 0.0;
  double model_re = 0.0, model_im = 0.0;
  double misfit = 0.0;  // whitened length of G - H: its square is chi-square with two degrees
  double relative_error = 0.0;  // |G - H| / |H|
  bool fitted = true;           // within the fit's band
};

// The model's acoustics fitted to the transfer: one mode or two, with the model's ratio. Where the
// noise alone cannot explain what is left (chi_square_per_dof above one and a half), a relative
// model error common to all points is added to their variance until it does: then no few sharp
// points carry the fit, and the intervals are those of a model that is only so good. What a model
// misses is much the same at neighbouring frequencies, so that many points count as few: with rho_k
// the correlation of the misfits of points k apart,
//
//   points_per_error = 1 + 2 (rho_1 + rho_2 + ...), up to the first that is not positive,
//
// by which the covariance is larger than for errors that differ from point to point.
struct TransferFit {
  bool available = false;  // at least four points, and the solver converged
  Acoustics<double> acoustics{0, 0, 0, 0, kPaperHarmonicRatio};
  Estimate omega_hz, xi, N, M;  // one mode: M is zero
  // Of log omega_hz, log xi, log N, log M, model_error included; one mode: nothing of log M.
  Eigen::Matrix4d log_covariance = Eigen::Matrix4d::Zero();
  double chi_square_per_dof = 0.0;  // by the points' own variance, before model_error
  double model_error = 0.0;         // relative to |H|; zero where the noise explains the misfit
  double points_per_error = 1.0;    // one where model_error is zero
  double explained_power = 0.0;     // 1 - sum S_qq |G - H|^2 / sum S_qq |H|^2 over all points
  double noise_power = 0.0;         // the share that the points' own variance leaves unexplained
  double points_within_95 = 0.0;    // share of points whose misfit the noise explains
  std::vector<TransferFitPoint> points;
};

// The model has no default: a fit with other modes than those that its result is compared with
// rejects right models. `band`: the points that take part.
TransferFit FitTransfer(const Transfer& transfer, const ModelSpec& model,
                        const TransferBand& band = {},
                        const std::optional<FirstModeCarries>& first = std::nullopt);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_H_
