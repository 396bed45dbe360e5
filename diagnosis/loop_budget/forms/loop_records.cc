#include "diagnosis/loop_budget/forms/loop_records.h"

#include <glog/logging.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "diagnosis/held_out/band_errors.h"
#include "diagnosis/held_out/record_signals.h"
#include "estimation/analysis/spectra/half_of_record.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/spectra/curve_exponents.h"

namespace howl {
namespace {

void SetCurveExponents(const Eigen::VectorXd& exponents, RecordSpectra* record) {
  record->curve_exponents = exponents;
  if (!record->middle) return;
  RecordSpectra middle = *record->middle;
  middle.curve_exponents = exponents;
  record->middle = std::make_shared<const RecordSpectra>(std::move(middle));
}

}  // namespace

LoopRecords::LoopRecords(const std::vector<LoopRecord>& records, int threads) {
  CHECK(!records.empty());
  for (const LoopRecord& each : records) {
    names_.push_back(each.name);
    cycle_hz_.push_back(each.cycle_hz);
    length_s_.push_back(static_cast<double>(each.record.pressure.size()) / each.record.sampling_hz);
  }
  for (Spectra& spectra : spectra_) {
    spectra.points.resize(records.size());
    spectra.halves.resize(records.size());
  }
  foretold_errors_.resize(records.size());
  RunUnits(spectra_.size() * records.size(), threads, [&](std::size_t i) {
    const std::size_t input = i / records.size();
    const std::size_t e = i % records.size();
    const LoopRecord& of = records[e];
    Spectra& spectra = spectra_[input];
    spectra.points[e] = {of.operating_parameter,
                         MakeRecordSpectra(of.record, of.cycle_hz, static_cast<FlameInput>(input))};
    for (std::size_t half = 0; half < 2; ++half) {
      const Record record = HalfOf(of.record, half == 1);
      RecordSpectra& there = spectra.halves[e][half];
      there = MakeRecordSpectra(record, spectra.points[e].record);
      if (input > 0 || record.pressure_errors.empty()) continue;
      foretold_errors_[e][half] = ForetoldPower(PressureErrors(record, there), SignalsOf(there));
    }
  });
}

void LoopRecords::DriveWithout(const LoopForm& form, const std::vector<Eigen::VectorXd>& noise,
                               std::vector<LoopPoint> fitted, int threads) {
  CHECK_EQ(fitted.size(), size());
  fitted_ = std::move(fitted);
  fitted_input_ = form.flame_input;
  std::vector<Eigen::VectorXd> recorded;
  for (std::size_t e = 0; e < size(); ++e) {
    recorded.push_back(
        PressureAsRecorded(Of(form.flame_input).points[e].record, form.effects, noise[e]));
  }
  RunUnits(spectra_.size() * size(), threads, [&](std::size_t i) {
    const std::size_t e = i % size();
    Spectra& spectra = spectra_[i / size()];
    const auto drive = [&](RecordSpectra* record, Eigen::Index first) {
      *record = DrivenWithout(std::move(*record), recorded[e].segment(first, record->Samples()));
    };
    drive(&spectra.points[e].record, 0);
    drive(&spectra.halves[e][0], 0);
    drive(&spectra.halves[e][1], spectra.halves[e][0].Samples());
  });
  curve_exponents_.assign(size(), {});
  RunUnits(size(), threads, [&](std::size_t e) {
    curve_exponents_[e] = CurveExponents(WholeAlone(form, e), fitted_[e].flame);
  });
}

RecordSpectra LoopRecords::Prepared(RecordSpectra record, const LoopForm& form, std::size_t e,
                                    const DriftRange& drift) const {
  record = RecordBeside(std::move(record), form.effects);
  // A curve of another input is not known.
  if (!fitted_.empty() && form.flame_input == fitted_input_ &&
      std::ranges::any_of(form.structure.noise, &NoiseTerm::before_curve)) {
    SetCurveExponents(curve_exponents_[e], &record);
  }
  if (!form.structure.HasChanges()) return record;
  if (fitted_.empty()) {
    SetSlowSignals(form.structure, nullptr, drift, &record);
  } else {
    LoopPoint fitted = fitted_[e];
    if (form.flame_input != fitted_input_) fitted.flame.resize(0);
    SetSlowSignals(form.structure, &fitted, drift, &record);
  }
  return record;
}

std::vector<OperatingPoint> LoopRecords::Points(const LoopForm& form) const {
  std::vector<OperatingPoint> out = Of(form.flame_input).points;
  for (std::size_t e = 0; e < out.size(); ++e) {
    out[e].record = Prepared(std::move(out[e].record), form, e);
  }
  return out;
}

RecordSpectra LoopRecords::Whole(const LoopForm& form, std::size_t e) const {
  return Prepared(Of(form.flame_input).points[e].record, form, e);
}

RecordSpectra LoopRecords::WholeAlone(const LoopForm& form, std::size_t e) const {
  RecordSpectra record = Of(form.flame_input).points[e].record;
  record.middle = nullptr;
  return Prepared(std::move(record), form, e);
}

RecordSpectra LoopRecords::Half(const LoopForm& form, std::size_t e, std::size_t half) const {
  const DriftRange drift = half == 0 ? DriftRange{-0.5, 0.0} : DriftRange{0.0, 0.5};
  return Prepared(Of(form.flame_input).halves[e][half], form, e, drift);
}

double LoopRecords::LogJacobianOfWhole(const LoopForm& form, std::size_t e) const {
  return LogJacobian(Of(form.flame_input).points[e].record, form.effects);
}

double LoopRecords::LogJacobianOfHalf(const LoopForm& form, std::size_t e, std::size_t half) const {
  return LogJacobian(Of(form.flame_input).halves[e][half], form.effects);
}

}  // namespace howl
