// An attempt to explain the records by a candidate of the catalogue: how much log-likelihood it
// gains, and what the gap is computed from. Each kind of effect has a file of its own here; a new
// kind is one more file.
#ifndef HOWL_DIAGNOSIS_CANDIDATES_ATTEMPT_H_
#define HOWL_DIAGNOSIS_CANDIDATES_ATTEMPT_H_

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/fit/fit_memory.h"
#include "diagnosis/reference/reference.h"
#include "diagnosis/samples/coherent_lines.h"
#include "diagnosis/samples/gain_fluctuation.h"
#include "diagnosis/verdict/diagnosis_result.h"
#include "model/effects/declared_effect.h"
#include "model/loop/instrument.h"

namespace howl {

struct Attempt {
  Candidate candidate;
  EffectKind kind = EffectKind::kTransfer;
  // Where the attempt joins another effect to a line: that one's block and gain.
  std::optional<LoopBlock> also;
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
};

// What all attempts share: the records, the fit of the loop with no effect, and what goes with
// them.
struct AttemptContext {
  const std::vector<CutRecord>* records = nullptr;
  const EffectFit* base = nullptr;
  const std::vector<DiagnosisExperiment>* experiments = nullptr;
  std::vector<ExperimentFit> base_held_out;
  FitUnits* memory = nullptr;
  const ReferenceModel* reference = nullptr;  // in the model's place; null: there is none
};

// An effect with several forms (orders of a filter, say): the best of them. unit: the name under
// which the memory keeps the fits (fit_memory.h).
Attempt TryTransfer(const AttemptContext& at, const std::string& unit,
                    const std::vector<EffectPointer>& forms);
Attempt FromFit(const AttemptContext& at, EffectFit fit);
Attempt TryGain(const AttemptContext& at, const Effect& effect, const GainFluctuation& fluctuation);
Attempt TryLines(const AttemptContext& at, const Effect& effect,
                 const std::vector<CoherentLine>& lines, const LineOrigin& origin);
Attempt TryClipping(const AttemptContext& at, const Effect& effect);
Attempt TryQuantisation(const AttemptContext& at, const Effect& effect);
Attempt TryDeclaredMap(const AttemptContext& at, const DeclaredEffect& effect);
Attempt TryDeclaredLine(const AttemptContext& at, const DeclaredEffect& effect,
                        const std::vector<CoherentLine>& lines);

// An attempt with the effect's name, and with the base's residuals until it is fitted.
Attempt Named(const AttemptContext& at, const Effect& effect);

// True for a transfer function whose evidence comes from cut B alone, and for one that changes cut
// B at all.
bool ShowsInFlameAlone(const Attempt& attempt);
bool ShowsInFlame(const Attempt& attempt);

// The gain that noise may give where a reference takes the model's place: no replicate of a
// reference can be simulated to measure it. Zero without a reference.
double NoiseGivenReference(const AttemptContext& at);

// True where the channel's samples have a sharp edge in their density, or p's samples few levels,
// and the reference's have not.
bool ShowsLimits(const AttemptContext& at, Channel channel);

// Half the logarithm of the data's size for each parameter, as in the BIC.
double PriceOfParameters(double parameters);

// Subtracts that price from the gain.
void PayForParameters(Attempt* attempt);

// The p-value of the largest gain among a catalogue of so many effects that were tried.
double PValue(double gain, double parameters, std::size_t catalogue);

// A value without an interval, for a parameter whose error is not estimated.
EstimatedParameter WithoutError(const std::string& name, double value, const std::string& unit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CANDIDATES_ATTEMPT_H_
