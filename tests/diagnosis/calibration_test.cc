#include "diagnosis/verdict/calibration.h"

#include <gtest/gtest.h>

namespace howl::calibration_test {
namespace {

Diagnosis Sure(VerdictKind kind, double none, double unknown,
               const std::vector<double>& candidates) {
  Diagnosis out;
  out.kind = kind;
  out.probability_none = none;
  out.probability_unknown = unknown;
  for (const double each : candidates) {
    Candidate candidate;
    candidate.probability = each;
    out.candidates.push_back(candidate);
  }
  return out;
}

double Total(const Diagnosis& diagnosis) {
  double sum = diagnosis.probability_none + diagnosis.probability_unknown;
  for (const Candidate& candidate : diagnosis.candidates) sum += candidate.probability;
  return sum;
}

TEST(Calibration, ProbabilitiesStayProbabilitiesAndTheOrderStays) {
  for (const VerdictKind kind : {VerdictKind::kNone, VerdictKind::kEffect, VerdictKind::kUnknown}) {
    for (const double doubt :
         {DoubtOfOneCause(kind, false), DoubtOfOneCause(kind, true), DoubtOfBudget(kind)}) {
      Diagnosis diagnosis = Sure(kind, 0.2, 0.1, {0.4, 0.25, 0.05});
      Calibrate(doubt, &diagnosis);
      EXPECT_NEAR(Total(diagnosis), 1.0, 1e-12);
      EXPECT_GT(diagnosis.candidates[0].probability, diagnosis.candidates[1].probability);
      EXPECT_GT(diagnosis.candidates[1].probability, diagnosis.candidates[2].probability);
    }
  }
}

TEST(Calibration, NoVerdictIsCertain) {
  Diagnosis none = Sure(VerdictKind::kNone, 1.0, 0.0, {0.0, 0.0});
  Calibrate(DoubtOfOneCause(VerdictKind::kNone, false), &none);
  EXPECT_LT(none.probability_none, 0.9);
  EXPECT_GT(none.candidates[0].probability, 0.0);
  Diagnosis effect = Sure(VerdictKind::kEffect, 0.0, 0.0, {1.0, 0.0});
  Calibrate(DoubtOfOneCause(VerdictKind::kEffect, false), &effect);
  EXPECT_LT(effect.candidates[0].probability, 0.97);
  // What is detected in the samples without a model is surer than what is fitted.
  Diagnosis direct = Sure(VerdictKind::kEffect, 0.0, 0.0, {1.0, 0.0});
  Calibrate(DoubtOfOneCause(VerdictKind::kEffect, true), &direct);
  EXPECT_GT(direct.candidates[0].probability, effect.candidates[0].probability);
}

}  // namespace
}  // namespace howl::calibration_test
