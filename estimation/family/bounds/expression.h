// Formulas (model/numerics/formula.h) of a member's parameters, as a config may ask for, in the
// names
//
//   omega_hz xi N M tau_s harmonic_ratio (of the model), phi frequency_hz phase_deg gain
//   flame_slope (of the experiment).
//
// A name alone is that of the experiment the expression is evaluated for; exp1.xi is that of exp1.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_EXPRESSION_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_EXPRESSION_H_

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/problem/problem.h"
#include "model/numerics/formula.h"

namespace howl {

using ExpressionError = FormulaError;

class Expression {
 public:
  // No value on an error, which is then told.
  static std::optional<Expression> Parse(std::string_view text,
                                         std::span<const Experiment> experiments,
                                         ExpressionError& error);

  // For the model of experiment `index`.
  double Evaluate(std::span<const Experiment> experiments, std::span<const LoopModel> models,
                  std::size_t index) const;
  // A guaranteed enclosure over a cell. Needs a RoundingGuard.
  Interval Evaluate(std::span<const Experiment> experiments, const Cell& cell,
                    double harmonic_ratio, std::size_t index) const;

  // Whether its value for experiment `index` depends on the model of `experiment`.
  bool DependsOn(std::size_t experiment, std::size_t index) const;

  const std::string& Text() const { return text_; }
  // Names without an experiment: the value differs from experiment to experiment.
  bool IsPerExperiment() const { return per_experiment_; }

 private:
  enum class Name {
    kOmega,
    kXi,
    kN,
    kM,
    kTau,
    kHarmonicRatio,
    kPhi,
    kFrequency,
    kPhase,
    kGain,
    kFlameSlope
  };
  struct Quantity {
    Name name = Name::kOmega;
    std::optional<std::size_t> experiment;
  };

  template <typename T, typename Lookup>
  T Run(const Lookup& lookup) const;

  std::string text_;
  std::vector<FormulaToken> tokens_;
  std::vector<Quantity> quantities_;  // by the tokens' slots
  bool per_experiment_ = false;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_EXPRESSION_H_
