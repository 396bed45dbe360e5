// Arithmetic formulas as a config may ask for, over any kind of number:
//
//   + - * / ^ ( ), unary -, sqrt exp log sin cos abs, numbers, pi, and names
//
// ^ binds to the right, and tighter than the unary minus on its left: -x^2 = -(x^2). What a name
// means is the caller's: each is a slot, looked up when the formula is evaluated.
#ifndef HOWL_MODEL_NUMERICS_FORMULA_H_
#define HOWL_MODEL_NUMERICS_FORMULA_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

struct FormulaError {
  std::size_t position = 0;  // in the text, from 0
  std::string message;       // what is wrong, what was expected
};

enum class FormulaOperation : std::uint8_t {
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

struct FormulaToken {  // in reverse Polish order
  FormulaOperation operation = FormulaOperation::kNumber;
  double number = 0.0;
  std::size_t slot = 0;  // of a name
};

// A name, or owner.member: its slot, or the message of what is wrong with it.
struct FormulaName {
  std::optional<std::size_t> slot;
  std::string message;
};
using FormulaNames = std::function<FormulaName(const std::string& owner, const std::string& name)>;

// No value on an error, which is then told.
std::optional<std::vector<FormulaToken>> ParseFormula(std::string_view text,
                                                      const FormulaNames& names,
                                                      FormulaError& error);

// Room that the evaluation needs.
std::size_t FormulaDepth(std::span<const FormulaToken> tokens);

// Math has static Multiply, Divide, Power, Root, Exponential, Logarithm, Sine, Cosine and Absolute
// of T; lookup(slot) gives a name's value; `stack` has room for FormulaDepth(tokens).
template <typename Math, typename T, typename Lookup>
T EvaluateFormula(std::span<const FormulaToken> tokens, const Lookup& lookup, T* stack) {
  std::size_t size = 0;
  for (const FormulaToken& token : tokens) {
    if (token.operation == FormulaOperation::kNumber) {
      stack[size++] = T(token.number);
      continue;
    }
    if (token.operation == FormulaOperation::kName) {
      stack[size++] = lookup(token.slot);
      continue;
    }
    const T right = stack[--size];
    T& left = stack[size > 0 ? size - 1 : 0];
    switch (token.operation) {
      case FormulaOperation::kAdd:
        left = left + right;
        break;
      case FormulaOperation::kSubtract:
        left = left - right;
        break;
      case FormulaOperation::kMultiply:
        left = Math::Multiply(left, right);
        break;
      case FormulaOperation::kDivide:
        left = Math::Divide(left, right);
        break;
      case FormulaOperation::kPower:
        left = Math::Power(left, right);
        break;
      case FormulaOperation::kNegate:
        stack[size++] = -right;
        break;
      case FormulaOperation::kSqrt:
        stack[size++] = Math::Root(right);
        break;
      case FormulaOperation::kExp:
        stack[size++] = Math::Exponential(right);
        break;
      case FormulaOperation::kLog:
        stack[size++] = Math::Logarithm(right);
        break;
      case FormulaOperation::kSin:
        stack[size++] = Math::Sine(right);
        break;
      case FormulaOperation::kCos:
        stack[size++] = Math::Cosine(right);
        break;
      case FormulaOperation::kAbs:
        stack[size++] = Math::Absolute(right);
        break;
      case FormulaOperation::kNumber:
      case FormulaOperation::kName:
        break;
    }
  }
  return stack[0];
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_FORMULA_H_
