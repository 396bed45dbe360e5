#include "estimation/family/expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace howl {

namespace {

constexpr int kDeepest = 200;  // of nested parentheses, signs and powers

double Sine(double x) { return std::sin(x); }
double Cosine(double x) { return std::cos(x); }
double Exponential(double x) { return std::exp(x); }
double Logarithm(double x) { return std::log(x); }
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
Interval Exponential(const Interval& x) {
  return {std::max(0.0, Below(std::exp(x.lower()))), Above(std::exp(x.upper()))};
}
// The part of the argument outside the domain has no value: the enclosure is of the rest.
Interval Logarithm(const Interval& x) {
  if (!(x.upper() > 0.0)) return kWholeLine;
  return {x.lower() > 0.0 ? Below(std::log(x.lower())) : -Unbounded(), Above(std::log(x.upper()))};
}
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

}  // namespace

class ExpressionParser {
 public:
  using Operation = Expression::Operation;
  using Name = Expression::Name;

  ExpressionParser(std::string_view text, std::span<const Experiment> experiments,
                   Expression& expression, ExpressionError& error)
      : text_(text), experiments_(experiments), expression_(expression), error_(error) {}

  bool Parse() {
    if (!Sum()) return false;
    Skip();
    return position_ == text_.size() || Fail("unexpected '" + std::string(1, text_[position_]) +
                                             "', expected an operator or the end");
  }

 private:
  bool Fail(std::string message) {
    error_ = {position_, std::move(message)};
    return false;
  }
  void Skip() {
    while (position_ < text_.size() && std::isspace(Byte(position_))) ++position_;
  }
  int Byte(std::size_t at) const { return static_cast<unsigned char>(text_[at]); }
  bool Take(char c) {
    Skip();
    if (position_ >= text_.size() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  bool Emit(Operation operation) {
    expression_.tokens_.push_back({.operation = operation, .experiment = std::nullopt});
    return true;
  }

  bool Sum() {
    if (!Product()) return false;
    for (;;) {
      if (Take('+')) {
        if (!Product() || !Emit(Operation::kAdd)) return false;
      } else if (Take('-')) {
        if (!Product() || !Emit(Operation::kSubtract)) return false;
      } else {
        return true;
      }
    }
  }

  bool Product() {
    if (!Signed()) return false;
    for (;;) {
      if (Take('*')) {
        if (!Signed() || !Emit(Operation::kMultiply)) return false;
      } else if (Take('/')) {
        if (!Signed() || !Emit(Operation::kDivide)) return false;
      } else {
        return true;
      }
    }
  }

  bool Signed() {
    if (++depth_ > kDeepest) return Fail("nested too deeply");
    bool good = false;
    if (Take('-')) {
      good = Signed() && Emit(Operation::kNegate);
    } else {
      Take('+');
      good = Factor();
    }
    --depth_;
    return good;
  }

  bool Factor() {
    if (!Primary()) return false;
    return !Take('^') || (Signed() && Emit(Operation::kPower));
  }

  bool Primary() {
    Skip();
    if (position_ >= text_.size()) return Fail("ends too early, expected a number, a name or '('");
    if (Take('(')) {
      return Sum() && (Take(')') || Fail("expected ')'"));
    }
    if (std::isdigit(Byte(position_)) || text_[position_] == '.') return Number();
    if (std::isalpha(Byte(position_)) || text_[position_] == '_') return Word();
    return Fail("unexpected '" + std::string(1, text_[position_]) +
                "', expected a number, a name or '('");
  }

  bool Number() {
    const std::string rest(text_.substr(position_, 64));
    char* end = nullptr;
    const double value = std::strtod(rest.c_str(), &end);
    if (end == rest.c_str() || !std::isfinite(value)) return Fail("expected a number");
    position_ += static_cast<std::size_t>(end - rest.c_str());
    expression_.tokens_.push_back(
        {.operation = Operation::kNumber, .number = value, .experiment = std::nullopt});
    return true;
  }

  std::string Identifier() {
    const std::size_t start = position_;
    while (position_ < text_.size() && (std::isalnum(Byte(position_)) || text_[position_] == '_')) {
      ++position_;
    }
    return std::string(text_.substr(start, position_ - start));
  }

  bool Word() {
    const std::size_t start = position_;
    const std::string word = Identifier();
    constexpr std::array<std::pair<std::string_view, Operation>, 6> kFunctions = {
        {{"sqrt", Operation::kSqrt},
         {"exp", Operation::kExp},
         {"log", Operation::kLog},
         {"sin", Operation::kSin},
         {"cos", Operation::kCos},
         {"abs", Operation::kAbs}}};
    for (const auto& [name, operation] : kFunctions) {
      if (word != name) continue;
      if (!Take('(')) return Fail("expected '(' after " + word);
      return Sum() && (Take(')') || Fail("expected ')'")) && Emit(operation);
    }
    if (word == "pi") {
      expression_.tokens_.push_back({.operation = Operation::kNumber,
                                     .number = std::numbers::pi,
                                     .experiment = std::nullopt});
      return true;
    }
    if (position_ < text_.size() && text_[position_] == '.') {
      const auto found = std::find_if(experiments_.begin(), experiments_.end(),
                                      [&](const Experiment& e) { return e.name == word; });
      if (found == experiments_.end()) {
        position_ = start;
        return Fail("no experiment is called " + word);
      }
      ++position_;
      return Named(Identifier(), static_cast<std::size_t>(found - experiments_.begin()), start);
    }
    return Named(word, std::nullopt, start);
  }

  bool Named(const std::string& word, std::optional<std::size_t> experiment, std::size_t start) {
    constexpr std::array<std::pair<std::string_view, Name>, 11> kNames = {
        {{"omega_hz", Name::kOmega},
         {"xi", Name::kXi},
         {"N", Name::kN},
         {"M", Name::kM},
         {"tau_s", Name::kTau},
         {"harmonic_ratio", Name::kHarmonicRatio},
         {"phi", Name::kPhi},
         {"frequency_hz", Name::kFrequency},
         {"phase_deg", Name::kPhase},
         {"gain", Name::kGain},
         {"flame_slope", Name::kFlameSlope}}};
    for (const auto& [name, value] : kNames) {
      if (word != name) continue;
      expression_.tokens_.push_back(
          {.operation = Operation::kName, .name = value, .experiment = experiment});
      if (!experiment) expression_.per_experiment_ = true;
      return true;
    }
    position_ = start;
    return Fail("unknown name " + word +
                ", expected omega_hz, xi, N, M, tau_s, harmonic_ratio, phi, frequency_hz, "
                "phase_deg, gain, flame_slope, pi or a function");
  }

  std::string_view text_;
  std::span<const Experiment> experiments_;
  Expression& expression_;
  ExpressionError& error_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

std::optional<Expression> Expression::Parse(std::string_view text,
                                            std::span<const Experiment> experiments,
                                            ExpressionError& error) {
  Expression expression;
  expression.text_ = std::string(text);
  ExpressionParser parser(text, experiments, expression, error);
  if (!parser.Parse()) return std::nullopt;
  return expression;
}

template <typename T, typename Lookup>
T Expression::Run(const Lookup& lookup) const {
  std::vector<T> stack(tokens_.size(), T(0.0));
  std::size_t size = 0;
  for (const Token& token : tokens_) {
    if (token.operation == Operation::kNumber) {
      stack[size++] = T(token.number);
      continue;
    }
    if (token.operation == Operation::kName) {
      stack[size++] = lookup(token.name, token.experiment);
      continue;
    }
    const T right = stack[--size];
    T& left = stack[size > 0 ? size - 1 : 0];
    switch (token.operation) {
      case Operation::kAdd:
        left = left + right;
        break;
      case Operation::kSubtract:
        left = left - right;
        break;
      case Operation::kMultiply:
        left = left * right;
        break;
      case Operation::kDivide:
        left = Divide(left, right);
        break;
      case Operation::kPower:
        left = Power(left, right);
        break;
      case Operation::kNegate:
        stack[size++] = -right;
        break;
      case Operation::kSqrt:
        stack[size++] = Root(right);
        break;
      case Operation::kExp:
        stack[size++] = Exponential(right);
        break;
      case Operation::kLog:
        stack[size++] = Logarithm(right);
        break;
      case Operation::kSin:
        stack[size++] = Sine(right);
        break;
      case Operation::kCos:
        stack[size++] = Cosine(right);
        break;
      case Operation::kAbs:
        stack[size++] = Absolute(right);
        break;
      case Operation::kNumber:
      case Operation::kName:
        break;
    }
  }
  return stack[0];
}

bool Expression::DependsOn(std::size_t experiment, std::size_t index) const {
  return std::any_of(tokens_.begin(), tokens_.end(), [&](const Token& token) {
    return token.operation == Operation::kName && token.experiment.value_or(index) == experiment;
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
