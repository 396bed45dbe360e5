// Finished fits are kept, so that an interrupted run can go on: a kept fit is bit for bit what a
// new fit would be.
#ifndef HOWL_DIAGNOSIS_FIT_FIT_MEMORY_H_
#define HOWL_DIAGNOSIS_FIT_FIT_MEMORY_H_

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "estimation/joint_records/fit_units.h"

namespace howl {

// The keys that a run has asked for, or kept, with a CHECK that none comes twice. It is not safe to
// use from several threads at once.
class UniqueKeys {
 public:
  explicit UniqueKeys(const char* verb) : verb_(verb) {}
  void Take(const std::string& key);

 private:
  const char* verb_;
  std::set<std::string> taken_;
};

// The bytes of every number of the fit, but not of its effect.
std::string ToBytes(const EffectFit& fit);
// No value where the bytes are no fit of this effect to these records.
std::optional<EffectFit> FromBytes(const std::string& bytes, const std::vector<CutRecord>& records,
                                   const EffectPointer& effect);

// The best of an effect's forms (orders of a filter, say), each by FitEffect unless the memory has
// it under the unit's name and the form's number. Without a memory: by FitEffect.
EffectFit FitBestForm(FitUnits* memory, const std::string& unit,
                      const std::vector<CutRecord>& records,
                      const std::vector<EffectPointer>& forms, const EffectFit& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_FIT_MEMORY_H_
