// A candidate of the catalogue, tried: what it takes off the likelihood, and what its gap needs.
// One file for each kind of effect; a kind that is new is one more of them.
#ifndef HOWL_DIAGNOSIS_CANDIDATES_ATTEMPT_H_
#define HOWL_DIAGNOSIS_CANDIDATES_ATTEMPT_H_

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/coherent_lines.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/effect_fit.h"
#include "diagnosis/gain_fluctuation.h"
#include "diagnosis/reference.h"
#include "model/effects/declared_effect.h"

namespace howl {

struct Attempt {
  Candidate candidate;
  EffectKind kind = EffectKind::kTransfer;
  // Of two effects or three: the blocks of those after the first, and what the last brings.
  std::vector<LoopBlock> also;
  double second_gain = 0.0;
  std::vector<ExperimentFit> held_out;
  bool without_lines = false;
  std::optional<EffectFit> fit;
  bool leaks = false;  // p into recorded q: cut B's evidence, though both cuts' likelihood has it
  double parameters = 1.0;
  // There is evidence other than the likelihood, so that slack that is left over may come from the
  // crude form that the catalogue gives the effect.
  bool confirmed = false;
  bool model_free = false;  // detected in the samples themselves, without a model
  // The second of two effects brings no more than the errors of the first's rough repair may bring.
  bool may_be_spurious = false;
  // Where the effect was taken out of the samples: the records without it.
  std::vector<DiagnosisExperiment> repaired;
  // Where p's plateaus were filled in under this fit (search_repair.cc): the records it is a fit
  // to.
  std::shared_ptr<const std::vector<CutRecord>> refilled;
};

// What all attempts share: the records, and the fit of the loop with no effect.
struct Setting {
  const std::vector<CutRecord>* records = nullptr;
  const EffectFit* base = nullptr;
  const std::vector<DiagnosisExperiment>* experiments = nullptr;
  std::vector<ExperimentFit> base_held_out;
  FitMemory* memory = nullptr;
  const ReferenceModel* reference = nullptr;  // what stands in the model's place, if anything does
  const std::vector<CutRecord>* recorded = nullptr;  // before a repair; null: records
  // After one: a fit to what the base filled in, made a fit to what it fills in itself.
  std::function<EffectFit(const EffectFit&)> refit = {};
};

// A fit to the records that the base declipped is fitted anew to records declipped under itself if
// it has at least this share of the best candidate's gain. The new fit raises the gain, and in
// trials never doubled it.
inline constexpr double kWorthRefilling = 0.3;

// An effect with several forms (orders of a filter, say): the best of them. unit: the name under
// which the memory keeps the fits (fit_memory.h).
Attempt TryTransfer(const Setting& at, const std::string& unit,
                    const std::vector<EffectPointer>& forms);
Attempt FromFit(const Setting& at, EffectFit fit);
Attempt TryGain(const Setting& at, const Effect& effect, const GainFluctuation& fluctuation);
Attempt TryLines(const Setting& at, const Effect& effect, const std::vector<CoherentLine>& lines,
                 const LineOrigin& origin);
Attempt TryClipping(const Setting& at, const Effect& effect);
Attempt TryQuantisation(const Setting& at, const Effect& effect);
Attempt TryDeclaredMap(const Setting& at, const DeclaredEffect& effect);
Attempt TryDeclaredLine(const Setting& at, const DeclaredEffect& effect,
                        const std::vector<CoherentLine>& lines);

// The start of an attempt whose residuals are the base's.
Attempt Named(const Setting& at, const Effect& effect);

// A transfer function whose evidence is cut B's alone; one that changes cut B at all.
bool ShowsInFlameAlone(const Attempt& attempt);
bool ShowsInFlame(const Attempt& attempt);

// Levels are those of the samples as they were recorded.
const std::vector<CutRecord>& AsRecorded(const Setting& at);

// What a gain may be that is no evidence, where a reference stands in the model's place: no
// replicate of it can be simulated. Zero without one.
double NoiseBesideReference(const Setting& at);

// In the channel's samples an edge of the density, or in p's few levels, that a reference has not.
bool ShowsLimits(const Setting& at, bool pressure);

// Half the logarithm of the data's size for each parameter.
double PriceOfParameters(double parameters);

// That, off the gain.
void PayForParameters(Attempt* attempt);

// Of several effects that together were tried: the p-value of the largest.
double PValue(double gain, double parameters, std::size_t catalogue);

// True within a millionth of the search's range from either of its ends; the range of logarithms
// where the parameter's scale is logarithmic.
bool StandsAtBound(const EffectParameter& parameter, double value);

// A value whose error nothing here estimates: it has no interval.
EstimatedParameter WithoutError(const std::string& name, double value, const std::string& unit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CANDIDATES_ATTEMPT_H_
