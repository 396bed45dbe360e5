// What each mode of a loop that was fitted holds of recorded p:
//
//   P_i = R_i / R P,   X_i = P_i / (a_i s + b_i omega_i)
//
// and near zeros of R no more than the modes' sizes allow.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SLOW_MODAL_PARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_SLOW_MODAL_PARTS_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// On the edges of the record's bins.
struct ModalPart {
  double omega = 1.0;      // over that of the cycle's mode
  double lean = 0.0;       // xi_i over the omega_i of loop_point.h
  Eigen::VectorXcd share;  // R_i / R
  Eigen::VectorXcd x;      // X_i times the size of a and b of the cycle's mode
};

// The mode that is nearest to the cycle.
const LoopMode& ModeOfCycle(const std::vector<LoopMode>& modes);

// Of no modes one that holds all of p, with b = 0 and little damping.
std::vector<ModalPart> PartsOf(const RecordSpectra& record, const std::vector<LoopMode>& modes);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SLOW_MODAL_PARTS_H_
