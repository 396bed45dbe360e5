#include "model/numerics/formula.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "model/numerics/formula_products.h"

namespace howl {
namespace {

constexpr int kDeepest = 200;  // of nested parentheses, signs and powers

class FormulaParser {
 public:
  using Operation = FormulaOperation;

  FormulaParser(std::string_view text, const FormulaNames& names, bool unsigned_products,
                std::vector<FormulaToken>& tokens, FormulaError& error)
      : text_(text),
        names_(names),
        unsigned_products_(unsigned_products),
        tokens_(tokens),
        error_(error) {}

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
    tokens_.push_back({.operation = operation});
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
    bool divided = false;
    for (;;) {
      if (Take('*')) {
        if (!Signed() || !Emit(Operation::kMultiply)) return false;
        divided = false;
      } else if (Take('/')) {
        if (!Signed() || !Emit(Operation::kDivide)) return false;
        divided = true;
      } else if (unsigned_products_ && AtFactor()) {
        if (divided) {
          return Fail("a product without * after / can be read in two ways, expected * or ( )");
        }
        if (!Factor() || !Emit(Operation::kMultiply)) return false;
      } else {
        return true;
      }
    }
  }

  // What stands next can only be one more factor.
  bool AtFactor() {
    Skip();
    if (position_ >= text_.size()) return false;
    const bool number = std::isdigit(Byte(position_)) || text_[position_] == '.';
    if (number) return !after_number_;
    return std::isalpha(Byte(position_)) || text_[position_] == '_' || text_[position_] == '(';
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
      if (!Sum() || !(Take(')') || Fail("expected ')'"))) return false;
      after_number_ = false;
      return true;
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
    tokens_.push_back({.operation = Operation::kNumber, .number = value});
    after_number_ = true;
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
      if (!Sum() || !(Take(')') || Fail("expected ')'"))) return false;
      after_number_ = false;
      return Emit(operation);
    }
    after_number_ = false;
    if (word == "pi") {
      tokens_.push_back({.operation = Operation::kNumber, .number = std::numbers::pi});
      return true;
    }
    std::string owner;
    std::string name = word;
    if (position_ < text_.size() && text_[position_] == '.') {
      ++position_;
      owner = word;
      name = Identifier();
    }
    const FormulaName found = names_(owner, name);
    if (!found.slot) {
      position_ = start;
      return Fail(found.message);
    }
    tokens_.push_back({.operation = Operation::kName, .slot = *found.slot});
    return true;
  }

  std::string_view text_;
  const FormulaNames& names_;
  bool unsigned_products_;
  std::vector<FormulaToken>& tokens_;
  FormulaError& error_;
  std::size_t position_ = 0;
  int depth_ = 0;
  bool after_number_ = false;  // what was read last ends in digits
};

}  // namespace

std::optional<std::vector<FormulaToken>> ParseFormula(std::string_view text,
                                                      const FormulaNames& names,
                                                      FormulaError& error) {
  std::vector<FormulaToken> tokens;
  FormulaParser parser(text, names, false, tokens, error);
  if (!parser.Parse()) return std::nullopt;
  return tokens;
}

std::optional<std::vector<FormulaToken>> ParseFormulaWithProducts(std::string_view text,
                                                                  const FormulaNames& names,
                                                                  FormulaError& error) {
  std::vector<FormulaToken> tokens;
  FormulaParser parser(text, names, true, tokens, error);
  if (!parser.Parse()) return std::nullopt;
  return tokens;
}

std::size_t FormulaDepth(std::span<const FormulaToken> tokens) {
  std::size_t size = 0;
  std::size_t deepest = 0;
  for (const FormulaToken& token : tokens) {
    if (token.operation <= FormulaOperation::kName) {
      deepest = std::max(deepest, ++size);
    } else if (token.operation <= FormulaOperation::kPower) {
      --size;
    }
  }
  return deepest;
}

}  // namespace howl
