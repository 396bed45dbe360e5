#include "diagnosis/loop_budget/forms/loop_records.h"

#include <glog/logging.h>

#include <utility>

#include "estimation/analysis/spectra/half_of_record.h"
#include "estimation/parallel.h"

namespace howl {
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
  RunUnits(spectra_.size() * records.size(), threads, [&](std::size_t i) {
    const std::size_t input = i / records.size();
    const std::size_t e = i % records.size();
    const LoopRecord& of = records[e];
    Spectra& spectra = spectra_[input];
    spectra.points[e] = {of.operating_parameter,
                         MakeRecordSpectra(of.record, of.cycle_hz, static_cast<FlameInput>(input))};
    for (std::size_t half = 0; half < 2; ++half) {
      spectra.halves[e][half] =
          MakeRecordSpectra(HalfOf(of.record, half == 1), spectra.points[e].record);
    }
  });
}

void LoopRecords::DriveWithout(const LoopForm& form, const std::vector<Eigen::VectorXd>& noise,
                               int threads) {
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
}

std::vector<OperatingPoint> LoopRecords::Points(const LoopForm& form) const {
  std::vector<OperatingPoint> out = Of(form.flame_input).points;
  for (OperatingPoint& point : out)
    point.record = RecordBeside(std::move(point.record), form.effects);
  return out;
}

RecordSpectra LoopRecords::Whole(const LoopForm& form, std::size_t e) const {
  return RecordBeside(Of(form.flame_input).points[e].record, form.effects);
}

RecordSpectra LoopRecords::WholeAlone(const LoopForm& form, std::size_t e) const {
  RecordSpectra record = Of(form.flame_input).points[e].record;
  record.middle = nullptr;
  return RecordBeside(std::move(record), form.effects);
}

RecordSpectra LoopRecords::Half(const LoopForm& form, std::size_t e, std::size_t half) const {
  return RecordBeside(Of(form.flame_input).halves[e][half], form.effects);
}

double LoopRecords::LogJacobianOfWhole(const LoopForm& form, std::size_t e) const {
  return LogJacobian(Of(form.flame_input).points[e].record, form.effects);
}

double LoopRecords::LogJacobianOfHalf(const LoopForm& form, std::size_t e, std::size_t half) const {
  return LogJacobian(Of(form.flame_input).halves[e][half], form.effects);
}

}  // namespace howl
