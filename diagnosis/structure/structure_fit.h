// The most likely parameters of a structure, all records together (joint_likelihood.h), and its
// evidence.
//
//   maximise  sum over records of ln L  +  ln prior
//   ln Z = ln L + ln prior - ln det(H) / 2 + k ln(2 pi) / 2          (Laplace; k parameters)
//
// Fisher scoring: an operating point's own parameters and its noise are eliminated (Schur
// complement); tau, the effects' parameters and the model's relative errors are shared
// (point_scoring.h). An operating point whose step made it worse is damped alone.
#ifndef HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_FIT_H_
#define HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_FIT_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/likelihood/joint_likelihood.h"
#include "diagnosis/structure/structure.h"

namespace howl {

struct StructureFit {
  LoopStructure structure;
  SharedLoop shared;
  std::vector<PointLoop> points;
  std::vector<PointLoop> centres;    // of the priors of an operating point's own parameters
  std::vector<double> point_values;  // ln L and the priors of its own parameters
  double log_posterior = 0.0;        // their sum, and the shared parameters' priors
  double log_evidence = 0.0;
  // Of ln tau, the effects' parameters as they are searched, ln eps_A, ln eps_B; the rest free.
  Eigen::MatrixXd shared_information;
  int iterations = 0;
};

struct StructureOptions {
  int iterations = 40;
  double converged = 0.05;    // nats of an iteration
  bool shared_fixed = false;  // an operating point's own parameters alone are fitted
};

// White sensor noise and coloured combustion noise, which every structure has.
std::vector<NoiseTerm> BaseNoise();

// The start of a first fit: the base as the two cuts give it each by itself, with the noise of
// their residuals. It becomes that to which the model's errors are relative.
StructureFit StartOf(std::vector<JointBand>* bands, const EffectFit& base,
                     const std::vector<NoiseTerm>& noise);

// The model's errors become relative to what this fit predicts of other records of the same points.
void SetErrorScale(const StructureFit& fit, std::vector<JointBand>* bands);

// Fits from `start`, which must have the structure's parameters and sources.
StructureFit FitStructure(const std::vector<JointBand>& bands, StructureFit start,
                          const StructureOptions& options = {});

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_FIT_H_
