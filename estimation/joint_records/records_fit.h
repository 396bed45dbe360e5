// The loops of several operating points of one rig, from their records together.
//
// Each point's loop has parameters of its own (point_fit.h), whose prior is the law by which they
// vary over the points (parameter_law.h), which is estimated with them: points that say little of a
// parameter lean on those that say more. Alternately the law is estimated from what each record
// tells, and each point's loop under the law.
//
// A mode of one point must be the same mode at the others. The loop found at each point (at up to
// four) in turn is where all points begin, and the one from which all together become most likely
// gives the modes their order; each point then looks for other maxima under what the others say of
// it (law_rounds.h). Where a poorer structure was fitted before, all points begin as well with what
// it found there.
//
// The work grows as the number of points does, and points run in parallel. One point by itself is
// fitted under its own prior, but for the size of its errors, which is estimated.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_RECORDS_FIT_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_RECORDS_FIT_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "estimation/joint_records/fit_units.h"
#include "estimation/joint_records/parameter_law.h"
#include "estimation/joint_records/shared_units.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

struct OperatingPoint {
  double operating_parameter = 0.0;
  RecordSpectra record;
};

struct RecordsFitOptions {
  std::size_t starts = 12;  // of each point by itself
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores
  // Whether each point looks for other maxima once the law stands: most of a fit's work.
  bool other_maxima = true;
  // Where finished fits of single points are; none: nowhere. Keys begin with `key`.
  FitUnits* units = nullptr;
  std::string key = {};
};

struct RecordsFit {
  PointStructure structure;
  ReferenceUnits reference;
  std::vector<double> z;          // parameter_law.h
  std::vector<PointFit> points;   // under the law
  ParameterLaw law;               // in common units (shared_units.h)
  std::vector<PointPrior> prior;  // of each point, by the law
};

// Where all points begin, one row a candidate.
using StartRows = std::vector<std::vector<Eigen::VectorXd>>;

// `poorer`: a fit of these points by a structure that this one contains (richer_structure.h).
RecordsFit FitRecords(const std::vector<OperatingPoint>& points, const PointStructure& structure,
                      const RecordsFitOptions& options = {}, const RecordsFit* poorer = nullptr);

// The same from these starts alone, without a search of each point by itself.
RecordsFit FitRecordsFrom(const std::vector<OperatingPoint>& points,
                          const PointStructure& structure, const StartRows& starts,
                          const RecordsFitOptions& options = {});

// What of each record of p is noise, as `fit` has it (pressure_noise.h).
std::vector<Eigen::VectorXd> PressureNoiseOf(const std::vector<OperatingPoint>& points,
                                             const RecordsFit& fit, int threads);

// `fit` taken further, with the flames driven by p without the noise that it finds there
// (record_spectra.h), as `points` have it from then on.
RecordsFit FitDriven(const RecordsFit& fit, const RecordsFitOptions& options,
                     std::vector<OperatingPoint>* points);

// Where fits of a structure that contains that of `poorer` may begin: a row for each point whose
// further modes all may have (richer_structure.h), one row where there are none.
StartRows StartsInRicher(const std::vector<OperatingPoint>& points, const RecordsFit& poorer,
                         const PointStructure& structure, int threads);

// Of each point by the law that all other points give; at least two.
std::vector<PointPrior> PriorsOfOthers(const std::vector<OperatingPoint>& points,
                                       const RecordsFit& fit, int threads);

// ln of the predictive density of each point's record, by the law that all other points give. Of
// one point alone: the evidence of its record.
// Of `options` threads, units and key hold.
std::vector<double> LeftOutDensities(const std::vector<OperatingPoint>& points,
                                     const RecordsFit& fit, const RecordsFitOptions& options = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_RECORDS_FIT_H_
