// The config's choices for the family of unfalsified models: how many members are listed, and which
// test they have to pass.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_FAMILY_SPEC_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_FAMILY_SPEC_H_

#include <string>
#include <vector>

#include "estimation/family/problem/membership.h"

namespace howl {

// A quantity to be bounded over the family: an expression of estimation/family/bounds/expression.h.
struct PredictionSpec {
  std::string name;
  std::string expression;
  int line = 0;  // of the expression in the config
};

// kSpread: over the whole set, light damping as well as heavy. kUniform: with the density of the
// natural parameters' Lebesgue measure, most of which lies at heavy damping.
enum class MemberDraw { kSpread, kUniform };

struct FamilySpec {
  int members = 1000;   // listed, spread over the whole set
  double width = 0.01;  // relative precision at which the search for guaranteed bounds stops
  MemberDraw draw = MemberDraw::kSpread;
  MembershipTest test;
  std::vector<PredictionSpec> predictions;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_FAMILY_SPEC_H_
