// A record made ready for the two cuts of the loop. Both signals being measured, each block is
// driven by what was measured before it:
//
//   cut A   acoustics   E_A = P - R Q                  R from G and the instruments
//   cut B   flame       E_B = Q - leak P - H Phi(v)    v from P: derivative, delay, filters
//
// Spectra are those of the whole record under the window sin^4(pi n / N): in the frequency domain
// five taps, applied to the residual, so that the wrap-around of a filter's transient at the ends
// is suppressed by its fourth-order zeros, and a line's leakage by its side lobes.
//
// Bins of width 1 / duration; units of p and q times samples.
#ifndef HOWL_DIAGNOSIS_RECORDS_CUT_RECORD_H_
#define HOWL_DIAGNOSIS_RECORDS_CUT_RECORD_H_

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "diagnosis/records/base_model.h"
#include "estimation/analysis/spectra/record.h"
#include "model/effects/effect.h"

namespace howl {

inline constexpr std::array<double, 3> kWindowTaps = {6.0 / 16.0, -4.0 / 16.0, 1.0 / 16.0};
inline constexpr Eigen::Index kTapReach = 2;

// Neighbouring bins are correlated by the window: the sum of K of them counts for
// K / kBinCorrelation independent ones (sum of the taps' squared autocorrelation).
inline constexpr double kBinCorrelation = 2.6265306122448979;

struct DiagnosisExperiment {
  std::string name;
  double phi = 0.0;
  Record record;
};

// What another record of the same loop, the reference, already has in addition to the base
// (reference.h). An empty vector stands for ones.
struct CutReference {
  Eigen::VectorXcd acoustic;  // factor on K (extended band)
  Eigen::VectorXcd flame;     // factor on delay and flame (cut B's extended band)
  Eigen::Vector4d acoustics = Eigen::Vector4d::Zero();  // where fits start: cut A's locals, and tau
  double tau_s = 0.0;
  Eigen::VectorXd acoustic_shape;  // of V_A on the band
  Eigen::VectorXd flame_shape;
  Eigen::VectorXd acoustic_share;  // what a bin counts for, at most 1
};

struct CutRecord {
  std::string name;
  BaseModel model;
  EffectContext at;
  Eigen::Index samples = 0;
  double sampling_hz = 0.0;
  double bin_hz = 0.0;
  double lowest_cycle_hz = 0.0;     // of all records of the rig
  Eigen::Index first = 0;           // bin of the band's first entry
  Eigen::Index acoustic_count = 0;  // bins in cut A
  Eigen::Index flame_count = 0;     // bins in cut B: the first of cut A's

  Eigen::VectorXd pressure;  // without mean
  Eigen::VectorXd heat_release;
  Eigen::VectorXcd pressure_spectrum;  // half spectra
  Eigen::VectorXcd heat_release_spectrum;
  Eigen::VectorXcd windowed_pressure;  // acoustic_count bins
  Eigen::VectorXcd windowed_heat_release;
  // Cut A's input: Q times the shrinkage of sensor_noise.h, on the extended band.
  Eigen::VectorXcd driving_heat_release;
  Eigen::VectorXd frequency_hz;  // of the extended band: acoustic_count + 2 kTapReach bins
  // s times a low-pass, times the shrinkage of sensor_noise.h: over the half spectrum.
  Eigen::VectorXcd derivative_filter;
  Eigen::VectorXd sensor_noise;  // model-free V_A (sensor_noise.h)
  // Twice the squares of p and of p' (low-passed), over those of the mean amplitude of all records:
  // half spectra.
  Eigen::VectorXcd square_spectrum;
  Eigen::VectorXcd rate_square_spectrum;
  std::vector<char> masked;  // bins with a coherent line: not used (acoustic_count)
  // What a bin counts for in cut B (flame_count). It falls to nothing towards the band's upper
  // edge: an edge is a filter that looks ahead, and ahead p knows the combustion noise.
  Eigen::VectorXd flame_share;
  CutReference reference;

  Eigen::Index extended() const { return acoustic_count + 2 * kTapReach; }
  double frequency(Eigen::Index bin) const { return frequency_hz[bin + kTapReach]; }
};

// The window's taps over `count` bins; extended has count + 4.
Eigen::VectorXcd ApplyWindow(const Eigen::Ref<const Eigen::VectorXcd>& extended,
                             Eigen::Index count);

// The slow amplitude that an effect feels, squared, relative to the mean of all records
// or to its own; delay_s: as it was that long before.
Eigen::ArrayXd SquaredAmplitude(const CutRecord& record, const AmplitudeSense& sense,
                                double delay_s = 0.0);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_RECORDS_CUT_RECORD_H_
