// The fits of single points of which a fit of records is made (records_fit.h), each a unit of work
// with a key of its own. What is kept of one is bit for bit what it would be anew, so that a fit
// that was interrupted goes on where it stopped, to the same answer.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_FIT_UNITS_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_FIT_UNITS_H_

#include <functional>
#include <optional>
#include <string>

#include "estimation/record_fit/point_fit.h"

namespace howl {

// Where finished units are. Called from several threads at once. What is kept belongs to one set of
// records and options; a key has no blanks, and is that of one unit. Recall may throw, to end the
// work.
class FitUnits {
 public:
  virtual ~FitUnits() = default;
  virtual std::optional<std::string> Recall(const std::string& key) = 0;
  virtual void Keep(const std::string& key, const std::string& bytes) = 0;

 protected:
  FitUnits() = default;
  FitUnits(const FitUnits&) = default;
  FitUnits& operator=(const FitUnits&) = default;
};

std::string PointFitBytes(const PointFit& fit);
// None where the bytes are no fit.
std::optional<PointFit> PointFitOf(const std::string& bytes);

// That of `units` under the key, else `fit`'s, which is then kept. Without units: `fit`'s.
PointFit KeptFit(FitUnits* units, const std::string& key, const std::function<PointFit()>& fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_FIT_UNITS_H_
