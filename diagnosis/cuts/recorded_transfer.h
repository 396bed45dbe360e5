// From recorded q to recorded p (the paper, (5a), and the places of model/effects/effect.h):
//
//   R = K / (1 + leak K),    K = G PressureInstrument / HeatReleaseInstrument
//
// G may have modes beside the base's, each with its own damping and a complex residue:
//
//   sum over k of (a_k s + b_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
#ifndef HOWL_DIAGNOSIS_CUTS_RECORDED_TRANSFER_H_
#define HOWL_DIAGNOSIS_CUTS_RECORDED_TRANSFER_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/cuts/acoustic_locals.h"
#include "diagnosis/records/cut_record.h"

namespace howl {

struct FurtherMode {
  double omega_hz = 0.0;
  double xi = 0.0;
  double a = 0.0;  // both in the unit of N
  double b = 0.0;
};
Response FurtherResponse(const std::vector<FurtherMode>& modes, double frequency_hz);

// R on the extended band.
Eigen::VectorXcd RecordedTransfer(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals,
                                  const std::vector<FurtherMode>& further = {});

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_RECORDED_TRANSFER_H_
