// Characteristics of a limit cycle (the paper, section 2 and table 2): its frequency f, and the
// phase and gain from q to p at f.
//
// Method `paper`, the published one: f = argmax |FFT p|; phase and gain are the means of those of
// FFT p / FFT q over 11 bins around f, weighted by |FFT p|.
//
// Method `local`, the default. A limit cycle's phase diffuses and its amplitude breathes, so that
// no sinusoid fits a whole record; but p = H q holds in every short block. With the blocks' complex
// amplitudes P_b, Q_b at f (spectrum.h) and e_b = P_b - H Q_b, least squares gives
//
//   H = sum conj(Q_b) P_b / sum |Q_b|^2,     H - true = sum conj(Q_b) e_b / sum |Q_b|^2
//
// which is the least-squares fit of sinusoids where the phase does not diffuse. The error is that
// of the mean of the scores conj(Q_b) e_b, whose long-run variance is estimated from the scores
// themselves (statistics.h): it holds under coloured noise and under fluctuations of gain or phase
// alike. Noise of q's own biases |H| down by at most the incoherent share of the blocks: the value
// given is the geometric mean of both regressions, and half their distance enters the standard
// deviation. f is the slope of the blocks' phase, fundamental and harmonics of p and q together,
// under white noise plus a random walk of unknown strengths (statistics.h: FitTrend).
#ifndef HOWL_ESTIMATION_ANALYSIS_CYCLE_CHARACTERISTICS_H_
#define HOWL_ESTIMATION_ANALYSIS_CYCLE_CHARACTERISTICS_H_

#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/spectra/slow_modulation.h"
#include "estimation/analysis/spectra/spectral_peak.h"
#include "estimation/analysis/spectra/spectrum.h"
#include "estimation/analysis/spectra/statistics.h"

namespace howl {

enum class CharacteristicsMethod { kLocal, kPaper };

struct CharacteristicsOptions {
  CharacteristicsMethod method = CharacteristicsMethod::kLocal;
  double min_frequency_hz = 0.0;  // where the limit cycle is looked for; 0: LowestSearched
  double max_frequency_hz = 0.0;  // 0: four tenths of the sampling rate
  // The variance of A^2 over its squared mean, A the cycle's envelope: 0 for a steady cycle, 1 for
  // a resonance that noise excites, and pi/2 - 1 where a Van der Pol loop in noise is neutral.
  double intermittent_fluctuation = 0.25;
  double no_cycle_fluctuation = 0.5707963267948966;
  int block_passes = 3;  // in which the blocks' length comes to the phase's coherence
  // Blocks for phase and gain are at least this long, so that no neighbour lies in their main lobe.
  double least_ratio_block_s = 0.0;
};

enum class CycleState { kLimitCycle, kIntermittent, kNoLimitCycle };
std::string_view CycleStateName(CycleState state);  // as in files

inline constexpr double kFewestPeriods = 8.0;  // of the cycle, in a record
// Relative drifts of amplitude and frequency over a record, beyond which it is not stationary.
inline constexpr double kMostAmplitudeDrift = 0.2;
inline constexpr double kMostFrequencyDrift = 0.005;

// Drift counts when it is significant (three standard deviations: four tests a record) and large
// enough to matter.
inline bool Drifts(const Estimate& rate, double enough) {
  return std::abs(rate.value) > 3.0 * rate.std && std::abs(rate.value) > enough;
}

struct Characteristics {
  PeakTest peak;
  CycleState state = CycleState::kNoLimitCycle;
  Estimate frequency_hz;
  Estimate phase_deg;  // from q to p: negative when p lags q; absent (NaN) without q
  Estimate gain;       // |p| / |q|
  double p_amplitude = 0.0, q_amplitude = 0.0;  // of the fundamental, root mean square envelope
  double line_width_hz = 0.0;    // full width at half maximum by phase diffusion: D / (2 pi)
  double coherence = 0.0;        // of p and q over the blocks at f
  double gain_bias_bound = 0.0;  // relative: how far q's own noise can have moved the gain
  // The variance of A^2 over its squared mean, free of the noise floor and of slow_modulation,
  // which is the part that goes with another, slow oscillation of the record.
  Estimate power_fluctuation;
  double slow_modulation = 0.0;

  // Stationarity over the record.
  Estimate frequency_drift_hz_per_s;
  Estimate amplitude_drift_per_s;    // relative
  double low_amplitude_share = 0.0;  // of the time, envelope below half its root mean square
  bool stationary = false;

  int block_samples = 0;
  double block_noise_power = 0.0;  // of the noise floor in |P_b|^2
  // The share of that floor that is not coherent with q, and so may be noise of the p sensor; the
  // rest is pressure that acts on the flame. One where there is no q.
  double floor_incoherent_share = 1.0;
  std::vector<double> envelope;  // of p, one a block
};

// The lowest frequency at which a cycle is searched: 20 Hz, below which rigs rumble and drift; for
// slow records a 250th of the sampling rate, which is what 20 Hz is of the paper's rate; and never
// one with less than eight periods in the record.
double LowestSearched(double sampling_hz, double duration_s);

// Needs at least eight periods of the cycle; a record without a significant peak gives
// kNoLimitCycle with the fields it could estimate. `spectrum` is the record's WelchSpectrum.
Characteristics EstimateCharacteristics(const Record& record, const CrossSpectrum& spectrum,
                                        const CharacteristicsOptions& options = {});

// The same at a peak that is known. `slow`: an oscillation beside the cycle that may modulate it.
Characteristics CharacteristicsAt(const Record& record, const CrossSpectrum& spectrum,
                                  const SpectralPeak& peak, const CharacteristicsOptions& options,
                                  const SlowOscillation* slow = nullptr);

// The paper's procedure on mean-free samples; standard deviations are not part of it.
Characteristics PaperCharacteristics(std::span<const double> p, std::span<const double> q,
                                     double sampling_hz, double min_frequency_hz,
                                     double max_frequency_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_CYCLE_CHARACTERISTICS_H_
