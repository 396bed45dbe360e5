// Cut A: acoustics and instruments driven by measured q (the paper, (5a), and the places of
// model/effects/effect.h):
//
//   E_A = P - R Q,    R = K / (1 + leak K),    K = G PressureInstrument / HeatReleaseInstrument
//
// Where the acoustics move (acoustic_modulation.h), R is that of their mean, and what the movement
// adds to p is subtracted too. recorded_transfer.h has R.
#ifndef HOWL_DIAGNOSIS_CUTS_ACOUSTIC_CUT_H_
#define HOWL_DIAGNOSIS_CUTS_ACOUSTIC_CUT_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/cuts/acoustic_locals.h"
#include "diagnosis/cuts/recorded_transfer.h"
#include "diagnosis/records/cut_record.h"

namespace howl {

// E_A on the band.
Eigen::VectorXcd AcousticResidual(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals);

// Derivatives of E_A: four columns for the locals (zero where a local is not free), then one column
// for each entry of `steps`, by which the effect's parameters are moved.
Eigen::MatrixXcd AcousticJacobian(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals, const Eigen::VectorXcd& residual,
                                  const Eigen::VectorXd& steps);

// Starts for a fit, the best first, from a grid over omega and xi with N and M by least squares: at
// most `count`, no two of them neighbours on the grid.
std::vector<AcousticLocals> AcousticStarts(const CutRecord& record, const Effect& effect,
                                           EffectValues x, std::size_t count);

// The same on the grid of loops whose second mode carries the cycle; empty with one mode or with a
// reference. Where the first mode carries the cycle these starts are no better, for they have a
// mode of no weight below the cycle.
std::vector<AcousticLocals> SecondModeStarts(const CutRecord& record, const Effect& effect,
                                             EffectValues x, std::size_t count);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_ACOUSTIC_CUT_H_
