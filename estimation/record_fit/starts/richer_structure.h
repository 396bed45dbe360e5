// A loop of one structure as the start of a richer one, which contains it: the same modes, and such
// noise as there was. Further modes begin as those of `further`, a source that the poorer structure
// had not at a level that hardly shows, but for a background, which begins as the record shows it.
// A second path has no share yet (second_path_starts.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_RICHER_STRUCTURE_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_RICHER_STRUCTURE_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

// `rich` has at least as many modes, and of each source at least as many coefficients.
bool Contains(const PointStructure& rich, const PointStructure& poor);

// rich.modes - poor.modes modes, one after the other where each leaves least of cut A.
std::vector<LoopMode> FurtherModes(const RecordSpectra& record, const PointStructure& poor,
                                   const Eigen::VectorXd& parameters, const PointStructure& rich);

Eigen::VectorXd InRicherStructure(const RecordSpectra& record, const PointStructure& poor,
                                  const Eigen::VectorXd& parameters, const PointStructure& rich,
                                  const std::vector<LoopMode>& further);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_RICHER_STRUCTURE_H_
