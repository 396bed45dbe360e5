// Priors of the joint fit (structure_fit.h), as standard deviations about the base's first fit.
// They are wide enough that a record decides, and the same for every structure. An effect's
// parameters have a uniform prior between the bounds of their search, the model's errors between
// theirs.
#ifndef HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_PRIORS_H_
#define HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_PRIORS_H_

#include <cmath>

#include "model/effects/effect.h"

namespace howl {

inline constexpr double kPriorLogOmega = 0.3;
inline constexpr double kPriorLogXi = 1.5;
inline constexpr double kPriorCoefficient = 3.0;  // N and M, of N
// A further mode may lie anywhere in the band, whose logarithm is about four wide about the
// cycle's, and is as damped as those of ducts.
inline constexpr double kPriorModeLogOmega = 1.1;
inline constexpr double kPriorModeMeanLogXi = -3.0;  // xi 0.05
inline constexpr double kPriorModeResidue = 1.0;     // a and b, of N
inline constexpr double kPriorLevel = 3.0;           // of a noise's logarithm
inline constexpr double kPriorShape = 1.5;           // of its higher coefficients
inline constexpr double kLargestError = 1.0;         // eps: with a larger one there is no model
inline constexpr double kLeastError = 1e-4;
inline constexpr double kLeastScatter = 1e-4;  // of log delay
inline constexpr double kMostScatter = 0.5;

inline double ToSearch(const EffectParameter& p, double x) {
  return p.scale == ParameterScale::kLogarithmic ? std::log(x) : x;
}

inline double FromSearch(const EffectParameter& p, double u) {
  return p.scale == ParameterScale::kLogarithmic ? std::exp(u) : u;
}

inline double SearchSpan(const EffectParameter& p) {
  return ToSearch(p, p.high) - ToSearch(p, p.low);
}

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STRUCTURE_STRUCTURE_PRIORS_H_
