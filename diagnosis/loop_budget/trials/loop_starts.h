// Where fits of a loop with one item more, or one less, begin (loop_item.h).
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_STARTS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_STARTS_H_

#include <vector>

#include "diagnosis/loop_budget/forms/loop_item.h"
#include "diagnosis/loop_budget/forms/loop_records.h"

namespace howl {

// A model fitted to all records, and how well each point's record is foretold by the others'.
struct LoopFit {
  LoopForm model;
  RecordsFit fit;
  std::vector<double> log_density;  // LeftOutDensities

  double Density() const;
};

std::vector<Eigen::VectorXd> ParametersOf(const std::vector<PointFit>& fits);
std::vector<Eigen::VectorXd> ParametersOf(const LoopFit& fit);

std::vector<LoopPoint> PointsOf(const LoopRecords& records, const LoopFit& fit);

struct LoopStarts {
  StartRows rows;
  // Whether each point may begin at another row, as where rows have each point's own paths: rows of
  // a further mode have that of one point for all, as it must be the same mode.
  bool apart = false;
};

// Where `fit` may begin again, besides where it stands. Modes that are tied to one another went, as
// one, to what the loop lacked when they were found, and none can leave alone, as free ones do
// (mode_maxima.h): they begin anew, each point where its cut A is met best (pole_starts.h).
StartRows Again(const LoopRecords& records, const LoopFit& fit, int threads);

LoopStarts StartsWith(const LoopRecords& records, const LoopFit& from, const LoopForm& with,
                      int threads);

// `mode`: of those that `without` has not, the first; of other items the number of modes.
LoopStarts StartsWithout(const LoopRecords& records, const LoopFit& from, const LoopForm& without,
                         std::size_t mode);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_LOOP_STARTS_H_
