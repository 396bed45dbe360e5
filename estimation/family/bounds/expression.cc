#include "estimation/family/bounds/expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace howl {

namespace {

double Sine(double x) { return std::sin(x); }
double Cosine(double x) { return std::cos(x); }
double ExponentialOf(double x) { return std::exp(x); }
double LogarithmOf(double x) { return std::log(x); }
double Root(double x) { return std::sqrt(x); }
double Absolute(double x) { return std::abs(x); }
double Divide(double a, double b) { return a / b; }
double Power(double a, double b) { return std::pow(a, b); }

const Interval kWholeLine(-kUnbounded, kUnbounded);

// |f(x) - f(middle)| <= |x - middle| for sine and cosine.
Interval Wave(double (*f)(double), const Interval& x) {
  Interval range(-1.0, 1.0);
  const double half = 0.5 * Width(x);
  if (!(half < 2.0)) return range;
  const double middle = 0.5 * (x.lower() + x.upper());
  const double reach = Above(half) + 1e-15 * (1.0 + std::abs(middle));
  Narrow(range, Interval(f(middle)) + Interval(-reach, reach));
  return range;
}

Interval Sine(const Interval& x) { return Wave(std::sin, x); }
Interval Cosine(const Interval& x) { return Wave(std::cos, x); }
Interval ExponentialOf(const Interval& x) { return Exponential(x); }
Interval LogarithmOf(const Interval& x) { return Logarithm(x); }
Interval Root(const Interval& x) {
  if (!(x.upper() >= 0.0)) return kWholeLine;
  return sqrt(Interval(std::max(0.0, x.lower()), x.upper()));
}
Interval Absolute(const Interval& x) { return boost::numeric::abs(x); }
Interval Divide(const Interval& a, const Interval& b) { return Quotient(a, b); }
Interval Power(const Interval& a, const Interval& b) {
  if (b.lower() == b.upper() && b.lower() == std::round(b.lower()) && std::abs(b.lower()) <= 64) {
    const int n = static_cast<int>(b.lower());
    const Interval positive = boost::numeric::pow(a, std::abs(n));
    return n >= 0 ? positive : Quotient(Interval(1.0), positive);
  }
  return Exponential(b * Logarithm(a));
}

// Both kinds of number by one name.
struct Arithmetic {
  template <typename T>
  static T Multiply(const T& a, const T& b) {
    return a * b;
  }
  template <typename T>
  static T Divide(const T& a, const T& b) {
    return howl::Divide(a, b);
  }
  template <typename T>
  static T Power(const T& a, const T& b) {
    return howl::Power(a, b);
  }
  template <typename T>
  static T Root(const T& a) {
    return howl::Root(a);
  }
  template <typename T>
  static T Exponential(const T& a) {
    return ExponentialOf(a);
  }
  template <typename T>
  static T Logarithm(const T& a) {
    return LogarithmOf(a);
  }
  template <typename T>
  static T Sine(const T& a) {
    return howl::Sine(a);
  }
  template <typename T>
  static T Cosine(const T& a) {
    return howl::Cosine(a);
  }
  template <typename T>
  static T Absolute(const T& a) {
    return howl::Absolute(a);
  }
};

constexpr std::array<std::string_view, 11> kNames = {
    "omega_hz", "xi",           "N",         "M",    "tau_s",      "harmonic_ratio",
    "phi",      "frequency_hz", "phase_deg", "gain", "flame_slope"};

}  // namespace

std::optional<Expression> Expression::Parse(std::string_view text,
                                            std::span<const Experiment> experiments,
                                            ExpressionError& error) {
  Expression expression;
  expression.text_ = std::string(text);
  const FormulaNames names = [&](const std::string& owner, const std::string& word) -> FormulaName {
    Quantity quantity;
    if (!owner.empty()) {
      const auto found = std::find_if(experiments.begin(), experiments.end(),
                                      [&](const Experiment& e) { return e.name == owner; });
      if (found == experiments.end()) return {std::nullopt, "no experiment is called " + owner};
      quantity.experiment = static_cast<std::size_t>(found - experiments.begin());
    }
    const auto name = std::find(kNames.begin(), kNames.end(), word);
    if (name == kNames.end()) {
      return {std::nullopt,
              "unknown name " + word +
                  ", expected omega_hz, xi, N, M, tau_s, harmonic_ratio, phi, frequency_hz, "
                  "phase_deg, gain, flame_slope, pi or a function"};
    }
    quantity.name = static_cast<Name>(name - kNames.begin());
    if (!quantity.experiment) expression.per_experiment_ = true;
    expression.quantities_.push_back(quantity);
    return {expression.quantities_.size() - 1, ""};
  };
  auto tokens = ParseFormula(text, names, error);
  if (!tokens) return std::nullopt;
  expression.tokens_ = std::move(*tokens);
  return expression;
}

template <typename T, typename Lookup>
T Expression::Run(const Lookup& lookup) const {
  std::vector<T> stack(FormulaDepth(tokens_), T(0.0));
  return EvaluateFormula<Arithmetic>(
      std::span<const FormulaToken>(tokens_),
      [&](std::size_t slot) {
        return lookup(quantities_[slot].name, quantities_[slot].experiment);
      },
      stack.data());
}

bool Expression::DependsOn(std::size_t experiment, std::size_t index) const {
  return std::any_of(quantities_.begin(), quantities_.end(), [&](const Quantity& quantity) {
    return quantity.experiment.value_or(index) == experiment;
  });
}

double Expression::Evaluate(std::span<const Experiment> experiments,
                            std::span<const LoopModel> models, std::size_t index) const {
  return Run<double>([&](Name name, const std::optional<std::size_t>& of) {
    const std::size_t i = of.value_or(index);
    const Experiment& experiment = experiments[i];
    const LoopModel& model = models[i];
    switch (name) {
      case Name::kOmega:
        return model.omega_hz;
      case Name::kXi:
        return model.xi;
      case Name::kN:
        return model.N;
      case Name::kM:
        return model.M;
      case Name::kTau:
        return model.tau_s;
      case Name::kHarmonicRatio:
        return model.harmonic_ratio;
      case Name::kPhi:
        return experiment.phi;
      case Name::kFrequency:
        return experiment.frequency_hz;
      case Name::kPhase:
        return experiment.phase_deg;
      case Name::kGain:
        return experiment.gain;
      case Name::kFlameSlope:
        return experiment.flame_slope.value_or(std::numeric_limits<double>::quiet_NaN());
    }
    return 0.0;
  });
}

Interval Expression::Evaluate(std::span<const Experiment> experiments, const Cell& cell,
                              double harmonic_ratio, std::size_t index) const {
  return Run<Interval>([&](Name name, const std::optional<std::size_t>& of) {
    const std::size_t i = of.value_or(index);
    const Experiment& experiment = experiments[i];
    const ExperimentBox& box = cell.boxes[i];
    switch (name) {
      case Name::kOmega:
        return box[kCellOmega];
      case Name::kXi:
        return box[kCellXi];
      case Name::kN:
        return box[kCellN];
      case Name::kM:
        return box[kCellM];
      case Name::kTau:
        return box[kCellTau];
      case Name::kHarmonicRatio:
        return Interval(harmonic_ratio);
      case Name::kPhi:
        return Interval(experiment.phi);
      case Name::kFrequency:
        return Interval(experiment.frequency_hz);
      case Name::kPhase:
        return Interval(experiment.phase_deg);
      case Name::kGain:
        return Interval(experiment.gain);
      case Name::kFlameSlope:
        return experiment.flame_slope ? Interval(*experiment.flame_slope) : kWholeLine;
    }
    return kWholeLine;
  });
}

}  // namespace howl
