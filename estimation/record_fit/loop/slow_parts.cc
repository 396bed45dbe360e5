#include "estimation/record_fit/loop/slow_parts.h"

namespace howl {
namespace {

// The first columns belong to cut A, the others to cut B.
constexpr Eigen::Index kOfAcoustics = ColumnsOf(SlowChange::kDelay).first;
constexpr Eigen::Index kOfFlame = kSlowColumns - kOfAcoustics;

}  // namespace

Eigen::VectorXcd HeatReleaseOfAcoustics(const RecordSpectra& record, const LoopPoint& point) {
  const auto k = point.changes.head<kOfAcoustics>();
  if (k.isZero(0.0)) return record.heat_release;
  return record.heat_release - record.slow.signals.leftCols<kOfAcoustics>() * k;
}

Eigen::VectorXcd HeatReleaseOfFlame(const RecordSpectra& record, const LoopPoint& point) {
  const auto r = point.changes.tail<kOfFlame>();
  if (r.isZero(0.0)) return record.heat_release;
  return record.heat_release + record.slow.signals.rightCols<kOfFlame>() * r;
}

Eigen::VectorXcd SlowFeedback(const RecordSpectra& record, const LoopPoint& point) {
  return record.slow.of_pressure * point.changes;
}

}  // namespace howl
