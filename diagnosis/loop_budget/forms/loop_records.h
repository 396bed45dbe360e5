// The records of a rig's operating points, whole and in halves, made ready for the likelihood
// (record_spectra.h) with each of the flame's inputs.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_RECORDS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_RECORDS_H_

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/forms/loop_form.h"
#include "estimation/joint_records/loop_record.h"
#include "estimation/joint_records/records_fit.h"
#include "estimation/record_fit/slow/slow_signals.h"

namespace howl {

class LoopRecords {
 public:
  LoopRecords() = default;
  LoopRecords(const std::vector<LoopRecord>& records, int threads);

  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<double>& cycle_hz() const { return cycle_hz_; }
  const std::vector<double>& length_s() const { return length_s_; }
  // As `form` has them, without its shared effects, and with what its slow changes need.
  std::vector<OperatingPoint> Points(const LoopForm& form) const;
  RecordSpectra Whole(const LoopForm& form, std::size_t e) const;
  // Without its middle, which costs as much as the rest.
  RecordSpectra WholeAlone(const LoopForm& form, std::size_t e) const;
  // The units of a point's whole record.
  const RecordScale& Scale(std::size_t e) const { return spectra_.front().points[e].record.scale; }
  // How many coefficients the flame has.
  Eigen::Index FlameTerms(FlameInput input, std::size_t e) const {
    return Of(input).points[e].record.flame.cols();
  }
  // In the units of the whole.
  RecordSpectra Half(const LoopForm& form, std::size_t e, std::size_t half) const;
  // Of the change from what was recorded to what `form` is fitted to.
  double LogJacobianOfWhole(const LoopForm& form, std::size_t e) const;
  double LogJacobianOfHalf(const LoopForm& form, std::size_t e, std::size_t half) const;

  // Power of p's errors where samples stand in the place of lost ones (draw_clipped.h), by bin of a
  // half, as far as a free transfer from q foretells it (band_errors.h); empty where none was lost.
  const Eigen::VectorXd& ForetoldErrors(std::size_t e, std::size_t half) const {
    return foretold_errors_[e][half];
  }

  // From now on the flames are driven by p without this noise of each point, which the points tell
  // as `form` has them (PressureNoiseOf), and these loops of that form say what slow changes there
  // may be (slow_signals.h), and what a gain before the flame's curve makes of the cycle's
  // harmonics (curve_exponents.h).
  void DriveWithout(const LoopForm& form, const std::vector<Eigen::VectorXd>& noise,
                    std::vector<LoopPoint> fitted, int threads);

 private:
  // As `form` is fitted to it.
  RecordSpectra Prepared(RecordSpectra record, const LoopForm& form, std::size_t e,
                         const DriftRange& drift = {}) const;
  struct Spectra {
    std::vector<OperatingPoint> points;
    std::vector<std::array<RecordSpectra, 2>> halves;
  };
  const Spectra& Of(FlameInput input) const { return spectra_[static_cast<std::size_t>(input)]; }

  std::vector<std::string> names_;
  std::vector<double> cycle_hz_;
  std::vector<double> length_s_;
  std::array<Spectra, 3> spectra_;
  std::vector<std::array<Eigen::VectorXd, 2>> foretold_errors_;
  // None before a loop was fitted.
  std::vector<LoopPoint> fitted_;
  std::vector<Eigen::VectorXd> curve_exponents_;
  FlameInput fitted_input_ = FlameInput::kPressureRate;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_RECORDS_H_
