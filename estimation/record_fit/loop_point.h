// One operating point's loop, as the likelihood of its record has it (whittle.h):
//
//   R = sum_k (a_k s + b_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
//   F = e^(-tau s) V(s) sum_k c_k slope_k,   E_B = Q - e^(-tau s) sum_k c_k b_k record_spectra.h
//   ln S_j = sum_k n_jk T_k                                                       noise_sources.h
//   E_A = P - R Q - sum_k (g_k s + h_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
//
// with s over the cycle's angular frequency. The paper's acoustics (5a) have b = 0, one damping and
// frequencies at 1, r, 2 r - 1, ...: those of a half-open duct for r = 3. g and h are what each
// mode held at the record's ends (Pintelon & Schoukens 2012, section 6.3.2): near a sharp resonance
// the taper does not hide it.
//
// All parameters are one vector: of the modes ln omega, ln xi, a, where residues are complex b, g
// and h (omega_1 alone where the ratio is given, xi_1 alone where damping is shared); ln tau; c; n;
// where there is a background its ratio.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_H_

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "estimation/record_fit/record_spectra.h"
#include "estimation/record_fit/whittle.h"

namespace howl {

struct PointStructure {
  int modes = 1;
  std::optional<double> ratio;  // of the second mode's frequency to the first's; none: all are free
  bool own_damping = true;
  bool complex_residues = true;
  std::vector<NoiseTerm> noise;

  Eigen::Index Frequencies() const { return ratio ? 1 : modes; }
  Eigen::Index Dampings() const { return own_damping ? modes : 1; }
  Eigen::Index Residues() const { return complex_residues ? Eigen::Index{2} * modes : modes; }
  // Of R alone; then those of what the record's ends leave follow.
  Eigen::Index Transfer() const { return Frequencies() + Dampings() + Residues(); }
  Eigen::Index Transients() const { return Eigen::Index{2} * modes; }
  Eigen::Index Acoustics() const { return Transfer() + Transients(); }
  // With the background's ratio.
  Eigen::Index NoiseParameters() const;
  // The index of ln tau; the flame's coefficients follow.
  Eigen::Index Delay() const { return Acoustics(); }
};

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
  double tau = 0.0;
  Eigen::VectorXd flame;               // c
  std::vector<Eigen::VectorXd> noise;  // one a source
  double background_ratio = 0.0;       // noise_sources.h
};

LoopPoint ToPoint(const PointStructure& structure, Eigen::Index flame,
                  const Eigen::VectorXd& parameters);
// The tied frequencies and dampings are those of the first mode.
Eigen::VectorXd ToParameters(const PointStructure& structure, const LoopPoint& point);

// R at s.
std::complex<double> AcousticTransfer(const LoopPoint& point, std::complex<double> s);
// Adds the real part of `by` times dR at s, for each of the acoustics' parameters.
void AddAcousticSlopes(const PointStructure& structure, const LoopPoint& point,
                       std::complex<double> s, std::complex<double> by, Eigen::VectorXd* out);

LoopResiduals ResidualsOf(const RecordSpectra& record, const PointStructure& structure,
                          const LoopPoint& point);
// The noise of `point` in the place of what the residuals have.
void SetNoise(const RecordSpectra& record, const PointStructure& structure, const LoopPoint& point,
              LoopResiduals* residuals);
LoopDerivatives DerivativesOf(const RecordSpectra& record, const PointStructure& structure,
                              const LoopPoint& point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_POINT_H_
