#include "diagnosis/verdict/calibration.h"

#include <algorithm>

namespace howl {
namespace {

// The share of wrong verdicts among all of their kind, on the rigs of the third and the fourth
// trial. Most effects that `none` misses are too small for the records.
constexpr double kDoubtOfNone = 0.18;
constexpr double kDoubtOfEffect = 0.08;
constexpr double kDoubtOfModelFree = 0.02;
constexpr double kDoubtOfUnknown = 0.07;
// The shares of the doubt that go to the other two kinds; the rest goes to all effects alike.
constexpr double kToNone = 0.1;
constexpr double kToUnknown = 0.35;

double Doubt(const Diagnosis& diagnosis, bool model_free) {
  switch (diagnosis.kind) {
    case VerdictKind::kNone:
      return kDoubtOfNone;
    case VerdictKind::kUnknown:
      return kDoubtOfUnknown;
    case VerdictKind::kEffect:
      break;
  }
  return model_free ? kDoubtOfModelFree : kDoubtOfEffect;
}

}  // namespace

void Calibrate(bool model_free, Diagnosis* diagnosis) {
  const double doubt = Doubt(*diagnosis, model_free);
  const double to_none = diagnosis->kind == VerdictKind::kNone ? 0.0 : kToNone;
  const double to_unknown = diagnosis->kind == VerdictKind::kUnknown ? 0.0 : kToUnknown;
  diagnosis->probability_none = (1.0 - doubt) * diagnosis->probability_none + doubt * to_none;
  diagnosis->probability_unknown =
      (1.0 - doubt) * diagnosis->probability_unknown + doubt * to_unknown;
  const auto count = static_cast<double>(std::max<std::size_t>(diagnosis->candidates.size(), 1));
  for (Candidate& candidate : diagnosis->candidates) {
    candidate.probability =
        (1.0 - doubt) * candidate.probability + doubt * (1.0 - to_none - to_unknown) / count;
  }
}

}  // namespace howl
