// The fits of single points of which a fit of records is made (records_fit.h), each a unit of work
// with a key of its own. What is kept of one is bit for bit what it would be anew, so that a fit
// that was interrupted goes on where it stopped, to the same answer.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_FIT_UNITS_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_FIT_UNITS_H_

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "estimation/record_fit/point_fit.h"

namespace howl {

// Where finished units are. Called from several threads at once. What is kept belongs to one set of
// records and options; a key has no blanks, and is that of one unit: it is asked for once a run,
// and kept once at most. Recall may throw, to end the work.
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

// A part of the work keeps its units among those of the whole, its keys after a prefix of its own.
// Where there is no memory of the whole, none of the part's units are found or kept.
class UnitsOfPart : public FitUnits {
 public:
  UnitsOfPart(FitUnits* whole, std::string prefix) : whole_(whole), prefix_(std::move(prefix)) {}

  std::optional<std::string> Recall(const std::string& key) override {
    return whole_ == nullptr ? std::nullopt : whole_->Recall(prefix_ + key);
  }
  void Keep(const std::string& key, const std::string& bytes) override {
    if (whole_ != nullptr) whole_->Keep(prefix_ + key, bytes);
  }

 private:
  FitUnits* whole_;
  std::string prefix_;
};

std::string PointFitBytes(const PointFit& fit);
// None where the bytes are no fit.
std::optional<PointFit> PointFitOf(const std::string& bytes);

// That of `units` under the key, else `fit`'s, which is then kept. Without units: `fit`'s.
PointFit KeptFit(FitUnits* units, const std::string& key, const std::function<PointFit()>& fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_FIT_UNITS_H_
