#include "diagnosis/loop_budget/loop_records.h"

#include <glog/logging.h>

#include <span>

#include "estimation/parallel.h"

namespace howl {
namespace {

Record HalfOf(const Record& record, std::size_t half) {
  const std::size_t count = record.pressure.size() / 2;
  const auto part = [&](const std::vector<double>& signal) {
    const auto samples = std::span(signal).subspan(half * count, count);
    return std::vector<double>(samples.begin(), samples.end());
  };
  Record out = record;
  out.pressure = part(record.pressure);
  out.heat_release = part(record.heat_release);
  return out;
}

}  // namespace

LoopRecords::LoopRecords(const std::vector<LoopRecord>& records, int threads) {
  CHECK(!records.empty());
  for (const LoopRecord& each : records) names_.push_back(each.name);
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
          MakeRecordSpectra(HalfOf(of.record, half), spectra.points[e].record);
    }
  });
}

}  // namespace howl
