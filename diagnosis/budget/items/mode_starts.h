// Where one more mode of the acoustics would gain most: on a grid of frequencies and dampings over
// the band, to second order in its residue, all other parameters free, summed over the operating
// points:
//
//   gain = g^T (H_aa - H_ao H_oo^-1 H_oa)^-1 g / 2,    a: the two parts of the residue, o: the rest
#ifndef HOWL_DIAGNOSIS_BUDGET_ITEMS_MODE_STARTS_H_
#define HOWL_DIAGNOSIS_BUDGET_ITEMS_MODE_STARTS_H_

#include <vector>

#include "diagnosis/structure/structure_fit.h"

namespace howl {

// The best places, no two of them neighbours, each with residues to first order.
std::vector<StructureFit> ModeStarts(const std::vector<JointBand>& bands, const StructureFit& from);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_ITEMS_MODE_STARTS_H_
