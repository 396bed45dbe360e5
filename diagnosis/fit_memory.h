// Finished fits kept for a run that was interrupted: the same bits as fitting again.
#ifndef HOWL_DIAGNOSIS_FIT_MEMORY_H_
#define HOWL_DIAGNOSIS_FIT_MEMORY_H_

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/effect_fit.h"

namespace howl {

// Where fits are kept. Called from several threads at once. What is kept belongs to one set of
// records: the keys are unique among its fits alone.
class FitMemory {
 public:
  virtual ~FitMemory() = default;
  virtual std::optional<std::string> Recall(const std::string& key) = 0;
  virtual void Keep(const std::string& key, const std::string& bytes) = 0;

 protected:
  FitMemory() = default;
  FitMemory(const FitMemory&) = default;
  FitMemory& operator=(const FitMemory&) = default;
};

// Every number of the fit, but not its effect.
std::string ToBytes(const EffectFit& fit);
// Nothing where the bytes are no fit of this effect to these records.
std::optional<EffectFit> FromBytes(const std::string& bytes, const std::vector<CutRecord>& records,
                                   const EffectPointer& effect);

// The best of an effect's forms (orders of a filter, say), each by FitEffect unless the memory has
// it. Without a memory: by FitEffect.
EffectFit FitBestForm(FitMemory* memory, const std::vector<CutRecord>& records,
                      const std::vector<EffectPointer>& forms, const EffectFit& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_MEMORY_H_
