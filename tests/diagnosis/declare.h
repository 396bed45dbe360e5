// Effects as a user declares them.
#ifndef HOWL_TESTS_DIAGNOSIS_DECLARE_H_
#define HOWL_TESTS_DIAGNOSIS_DECLARE_H_

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "model/effects/declared_effect.h"

namespace howl {

inline EffectDeclaration Declare(const std::string& name, LoopPlace place, DeclaredForm form,
                                 const std::string& formula, EffectParameter parameter) {
  EffectDeclaration out;
  out.name = name;
  out.place = place;
  out.form = form;
  out.parameters = {std::move(parameter)};
  FormulaError error;
  const auto parsed = DeclaredFormula::Parse(formula, place, form, out.parameters, error);
  EXPECT_TRUE(parsed.has_value()) << error.message;
  if (parsed) out.numerator = {*parsed};
  return out;
}

}  // namespace howl

#endif  // HOWL_TESTS_DIAGNOSIS_DECLARE_H_
