// Diagnosis against a reference: records of another simulator, or of the rig itself at another
// time, take the model's place, and the question is which effect turns them into the rig's.
//
// What the reference has in addition to the base enters the rig's cuts as fixed factors, smooth in
// frequency u = f / f_cycle (Gaussian kernel w of width kKernelWidth):
//
//   C_A(u) = sum w conj(R Q) P / V_A  /  sum w |R Q|^2 / V_A        K = C_A G Instruments
//   C_B(u) = sum w conj(X) Q / V_B  /  sum w |X|^2 / V_B            X: what the base predicts of q
//
// with the shape of the noise that is left over. An experiment takes them from the reference's
// point with the same name or operating parameter; between operating points they are interpolated.
//
// How well a reference predicts at all is measured on itself: each half of every record from the
// other half (or each operating point from its neighbours, where the rig's points are not among the
// reference's). Noise alone would give 1 in log-likelihood a band; where such a prediction gives
// kappa instead, a bin counts for 1 / kappa. What already differs from one time to another, or from
// one operating point to the next, is therefore no evidence.
#ifndef HOWL_DIAGNOSIS_REFERENCE_REFERENCE_H_
#define HOWL_DIAGNOSIS_REFERENCE_REFERENCE_H_

#include <cmath>
#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/samples/coherent_lines.h"

namespace howl {

// Operating parameters that two files state alike, digit by digit.
inline bool IsSamePhi(double a, double b) { return std::abs(a - b) <= 1e-9 * (1.0 + std::abs(b)); }

// Of one operating point, on the even grid u = i kReferenceStep.
inline constexpr double kReferenceStep = 0.01;
struct ReferencePoint {
  std::string name;
  double phi = 0.0;
  Eigen::VectorXcd acoustic;
  Eigen::VectorXcd flame;
  Eigen::VectorXd acoustic_shape;
  Eigen::VectorXd flame_shape;
  AcousticLocals locals = AcousticLocals::Zero();  // of the base, to which the factors are relative
  double tau_s = 0.0;
};

struct ReferenceModel {
  std::vector<ReferencePoint> points;
  Eigen::VectorXd acoustic_kappa;  // on the grid
  Eigen::VectorXd flame_kappa;
  double gap_floor = 0.0;  // of the reference against itself
  std::vector<CoherentLine> lines;
  double fluctuation_gain = 0.0;  // what the reference alone would show, at the rig's length
  double pressure_clipping_gain = 0.0;
  double heat_release_clipping_gain = 0.0;
  bool pressure_sharp_edge = false;
  bool heat_release_sharp_edge = false;
  double quantisation_levels = 0.0;  // 0: not quantised
};

// What the records have in addition to the base that is fitted to them.
std::vector<ReferencePoint> DescribeReference(const std::vector<DiagnosisExperiment>& experiments,
                                              const std::vector<CutRecord>& records,
                                              const EffectFit& base);

// The point of that name or operating parameter, or the interpolation between its neighbours.
ReferencePoint PointAt(const std::vector<ReferencePoint>& points, const std::string& name,
                       double phi);

void PutReference(const ReferencePoint& point, CutRecord* record);

// Describes the reference and puts it into the rig's records.
ReferenceModel AbsorbReference(const std::vector<DiagnosisExperiment>& reference,
                               const std::vector<DiagnosisExperiment>& rig,
                               std::vector<CutRecord>* records);

// The same records made anew from changed signals keep what the reference says of them.
void KeepReference(const std::vector<CutRecord>& from, std::vector<CutRecord>* to);

// The lines that the reference does not have, or has four times weaker.
std::vector<CoherentLine> NewLines(const std::vector<CoherentLine>& lines,
                                   const std::vector<CoherentLine>& known);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_REFERENCE_REFERENCE_H_
