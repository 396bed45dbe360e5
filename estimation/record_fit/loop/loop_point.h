// One operating point's loop, as the likelihood of its record has it (whittle.h):
//
//   R = sum_k (a_k s + b_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
//   F = D(s) V(s) sum_k c_k slope_k,   E_B = Q - D(s) sum_k c_k b_k      record_spectra.h
//   D = e^(-tau s), or that of spread delays or of two paths                    flame_path.h
//   ln S_j = sum_k n_jk T_k                                                       noise_sources.h
//   E_A = P - R Q - sum_k (g_k s + h_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
//
// with s over the cycle's angular frequency. The paper's acoustics (5a) have b = 0, one damping and
// frequencies at 1, r, 2 r - 1, ...: those of a half-open duct for r = 3. g and h are what each
// mode held at the record's ends (Pintelon & Schoukens 2012, section 6.3.2): near a sharp resonance
// the taper does not hide it.
//
// The cycle's own lines hold thousands of times the power of the noise beside them: what a loop
// misses of them by a few per cent would outweigh all else that the record tells. So what a cut
// foretells at the cycle's multiples h may have relative errors d_h and e_h, complex, normal about
// zero (point_prior.h):
//
//   E_A: R Q becomes (1 + sum_h W_h) R Q,   E_B: the flame's answer becomes (1 + sum_h W_h) of it
//   W_h = 2 r (s Re d_h - h Im d_h) / (s^2 + 2 r s + h^2),   which is d_h at s = j h
//
// r, kLineReach, is half its width. W_h is a filter that looks back only, as the loop itself does.
// It is an error of the mean alone: R and F, which small signals see, and with them the noise's
// directions, are without it; the Jacobian is of the residuals, and has it (return_difference.h).
//
// Damping, frequencies, delay and the flame's gain may change within the record (slow_changes.h):
// k and r.
//
// All parameters are one vector: of the modes ln omega, ln xi, a, where residues are complex b, g
// and h (omega_1 alone where the ratio is given, xi_1 alone where damping is shared, and those of
// further modes, which are tied to none), real and imaginary parts of d, k; the path's
// (flame_path.h); c; those of e, r; n; where there is a background its ratio.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_POINT_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_POINT_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <complex>
#include <optional>
#include <vector>

#include "estimation/record_fit/loop/flame_path.h"
#include "estimation/record_fit/spectra/record_spectra.h"
#include "estimation/record_fit/whittle/whittle.h"

namespace howl {

// Relative to the cycle's frequency.
inline constexpr double kLineReach = 0.06;
// The cycle's multiples that the band of a record holds.
inline constexpr int kCycleLines = 6;

struct PointStructure {
  int modes = 1;
  std::optional<double> ratio;  // of the second mode's frequency to the first's; none: all are free
  bool own_damping = true;
  int further_modes = 0;  // of the modes, the last ones, with frequencies and dampings of their own
  bool complex_residues = true;
  DelaySpread delay_spread = DelaySpread::kNone;
  bool second_path = false;  // of the flame's answer
  std::vector<NoiseTerm> noise;
  // Multiples of the cycle's frequency at which acoustics and flame may err.
  int acoustic_lines = 0;
  int flame_lines = 0;
  // Slow changes (slow_changes.h).
  bool damping_follows_amplitude = false;
  bool frequency_drifts = false;
  bool delay_follows_amplitude = false;
  bool gain_follows_amplitude = false;

  // As many as may be tied to one another.
  Eigen::Index FirstModes() const { return modes - further_modes; }
  // Of mode k's frequency to the first's, where they are tied.
  double RatioOf(Eigen::Index k) const { return 1.0 + (*ratio - 1.0) * static_cast<double>(k); }
  // The index of mode k's, of all frequencies and of all dampings.
  Eigen::Index Frequency(Eigen::Index k) const { return ratio ? AmongTied(k) : k; }
  Eigen::Index Damping(Eigen::Index k) const { return own_damping ? k : AmongTied(k); }
  Eigen::Index Frequencies() const { return Frequency(modes - 1) + 1; }
  Eigen::Index Dampings() const { return Damping(modes - 1) + 1; }
  Eigen::Index Residues() const { return complex_residues ? Eigen::Index{2} * modes : modes; }
  // Of R alone; then those of what the record's ends leave follow, and the lines' errors.
  Eigen::Index Transfer() const { return Frequencies() + Dampings() + Residues(); }
  Eigen::Index Transients() const { return Eigen::Index{2} * modes; }
  Eigen::Index AcousticLines() const { return Eigen::Index{2} * acoustic_lines; }
  Eigen::Index FlameLines() const { return Eigen::Index{2} * flame_lines; }
  // The index of the first of them.
  Eigen::Index AcousticLine() const { return Transfer() + Transients(); }
  Eigen::Index AcousticChange() const { return AcousticLine() + AcousticLines(); }
  Eigen::Index AcousticChanges() const;
  Eigen::Index FlameChanges() const;
  bool HasChanges() const { return AcousticChanges() + FlameChanges() > 0; }
  Eigen::Index Acoustics() const { return AcousticChange() + AcousticChanges(); }
  // With the background's ratio.
  Eigen::Index NoiseParameters() const;
  bool HasSpread() const { return delay_spread != DelaySpread::kNone; }
  // The index of ln tau, of how many parameters the path has, and of a second path's share.
  Eigen::Index Delay() const { return Acoustics(); }
  Eigen::Index Delays() const { return 1 + (HasSpread() ? 1 : 0) + (second_path ? 2 : 0); }
  Eigen::Index SecondPath() const { return Delay() + (HasSpread() ? 2 : 1); }
  // The index of the flame's first coefficient.
  Eigen::Index Flame() const { return Delay() + Delays(); }
  // Those of the flame's first line and of the first source of noise, and how many parameters there
  // are, given the number of the flame's coefficients.
  Eigen::Index FlameLine(Eigen::Index flame) const { return Flame() + flame; }
  Eigen::Index FlameChange(Eigen::Index flame) const { return FlameLine(flame) + FlameLines(); }
  Eigen::Index Noise(Eigen::Index flame) const { return FlameChange(flame) + FlameChanges(); }
  Eigen::Index Parameters(Eigen::Index flame) const { return Noise(flame) + NoiseParameters(); }

 private:
  Eigen::Index AmongTied(Eigen::Index k) const {
    return std::max<Eigen::Index>(k - FirstModes() + 1, 0);
  }
};

struct SlowChangeOfStructure {
  SlowChange change;
  bool PointStructure::*has;
};
// Of cut A and of cut B, in the order of their parameters.
inline constexpr std::array<SlowChangeOfStructure, 2> kAcousticChanges = {
    {{SlowChange::kDamping, &PointStructure::damping_follows_amplitude},
     {SlowChange::kFrequency, &PointStructure::frequency_drifts}}};
inline constexpr std::array<SlowChangeOfStructure, 2> kFlameChanges = {
    {{SlowChange::kDelay, &PointStructure::delay_follows_amplitude},
     {SlowChange::kGain, &PointStructure::gain_follows_amplitude}}};

// For each signal of the changes that the structure has, its column in SlowSignals.
template <typename Changes, typename Do>
void ForEachColumn(const PointStructure& structure, const Changes& changes, const Do& apply) {
  for (const SlowChangeOfStructure& each : changes) {
    if (!(structure.*each.has)) continue;
    const SlowColumns columns = ColumnsOf(each.change);
    for (Eigen::Index i = 0; i < columns.count; ++i) apply(columns.first + i);
  }
}

// One mode, without units.
struct LoopMode {
  double omega = 1.0;
  double xi = 0.1;
  double a = 0.0;
  double b = 0.0;
  double g = 0.0;
  double h = 0.0;
};

struct LoopPoint {
  std::vector<LoopMode> modes;
  FlamePath path;
  Eigen::VectorXd flame;               // c
  std::vector<Eigen::VectorXd> noise;  // one a source
  double background_ratio = 0.0;       // noise_sources.h
  Eigen::VectorXcd acoustic_lines;     // d_h, from h = 1 on
  Eigen::VectorXcd flame_lines;        // e_h
  // k and r, of all signals.
  Eigen::Vector<double, kSlowColumns> changes = Eigen::Vector<double, kSlowColumns>::Zero();

  auto Change(SlowChange change) {
    return changes.segment(ColumnsOf(change).first, ColumnsOf(change).count);
  }
  auto Change(SlowChange change) const {
    return changes.segment(ColumnsOf(change).first, ColumnsOf(change).count);
  }
};

LoopPoint ToPoint(const PointStructure& structure, Eigen::Index flame,
                  const Eigen::VectorXd& parameters);
// The tied frequencies and dampings are those of the first mode.
Eigen::VectorXd ToParameters(const PointStructure& structure, const LoopPoint& point);

// Where a fit of the record may begin after one of its middle, and the reverse: what modes held at
// the ends of the one is not what they held at those of the other.
Eigen::VectorXd BesideMiddle(const RecordSpectra& record, const PointStructure& structure,
                             Eigen::VectorXd parameters);

// R at s.
std::complex<double> AcousticTransfer(const LoopPoint& point, std::complex<double> s);
// Adds the real part of `by` times dR at s, for each of the acoustics' parameters.
void AddAcousticSlopes(const PointStructure& structure, const LoopPoint& point,
                       std::complex<double> s, std::complex<double> by, Eigen::VectorXd* out);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_POINT_H_
