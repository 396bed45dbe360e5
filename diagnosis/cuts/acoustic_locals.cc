#include "diagnosis/cuts/acoustic_locals.h"

#include <cmath>

namespace howl {

Acoustics<double> ToAcoustics(const BaseModel& model, const AcousticLocals& locals) {
  return {std::exp(locals[0]), std::exp(locals[1]), locals[2], locals[3], model.harmonic_ratio};
}

}  // namespace howl
