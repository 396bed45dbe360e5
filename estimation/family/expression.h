// Arithmetic expressions of a member's parameters, as a config may ask for:
//
//   + - * / ^ ( ), unary -, sqrt exp log sin cos abs, numbers, pi, and the names
//   omega_hz xi N M tau_s harmonic_ratio (of the model), phi frequency_hz phase_deg gain
//   flame_slope (of the experiment).
//
// A name alone is that of the experiment the expression is evaluated for; exp1.xi is that of exp1.
// ^ binds to the right, and tighter than the unary minus on its left: -x^2 = -(x^2).
#ifndef HOWL_ESTIMATION_FAMILY_EXPRESSION_H_
#define HOWL_ESTIMATION_FAMILY_EXPRESSION_H_

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/experiment.h"
#include "estimation/family/cell.h"
#include "estimation/family/problem.h"

namespace howl {

struct ExpressionError {
  std::size_t position = 0;  // in the text, from 0
  std::string message;       // what is wrong, what was expected
};

class Expression {
 public:
  // Nothing on an error, which is then told.
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
  friend class ExpressionParser;
  enum class Operation {
    kNumber,
    kName,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kNegate,
    kSqrt,
    kExp,
    kLog,
    kSin,
    kCos,
    kAbs
  };
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
  struct Token {  // in reverse Polish order
    Operation operation;
    double number = 0.0;
    Name name = Name::kOmega;
    std::optional<std::size_t> experiment;
  };

  template <typename T, typename Lookup>
  T Run(const Lookup& lookup) const;

  std::string text_;
  std::vector<Token> tokens_;
  bool per_experiment_ = false;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_EXPRESSION_H_
