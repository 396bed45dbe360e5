// Operating points of a duct whose loop is known, for diagnoses of records.
#ifndef HOWL_TESTS_DIAGNOSIS_LOOP_BUDGET_DUCT_RIG_H_
#define HOWL_TESTS_DIAGNOSIS_LOOP_BUDGET_DUCT_RIG_H_

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"
#include "model/numerics/fft.h"
#include "tests/estimation/record_fit/modal_loop.h"

namespace howl {

// Its operating parameter is the loop's gain, with which the delay grows a little.
inline LoopRecord DuctAt(double gain, double duration_s, std::uint64_t seed,
                         const ModalInstruments& instruments = {},
                         const std::function<void(ModalLoop*)>& change = {}) {
  ModalLoop loop = DuctOfModes(2);
  if (change) change(&loop);
  loop.tau_s *= 1.0 + 0.03 * (gain - 1.3);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  loop.slope = gain / loop.Open(cycle_hz).real();
  return {"gain " + std::to_string(gain), gain, cycle_hz,
          SimulateModalLoop(loop, duration_s, seed, instruments)};
}

inline std::vector<LoopRecord> DuctsAt(const std::vector<double>& gains,
                                       const ModalInstruments& instruments = {}) {
  std::vector<LoopRecord> out;
  for (const double gain : gains) {
    out.push_back(DuctAt(gain, 0.8, static_cast<std::uint64_t>(100.0 * gain), instruments));
  }
  return out;
}

// A signal through a filter, exact at each frequency of the record, whose end meets its beginning
// within a sample.
inline void Filter(const std::function<std::complex<double>(double frequency_hz)>& response,
                   double sampling_hz, std::vector<double>* signal) {
  std::vector<std::complex<double>> spectrum(signal->size() / 2 + 1);
  Fft fft;
  fft.Forward(*signal, spectrum);
  const double bin_hz = sampling_hz / static_cast<double>(signal->size());
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    spectrum[k] *= response(static_cast<double>(k) * bin_hz);
  }
  fft.Inverse(spectrum, *signal);
}

// q through a low-pass of first order.
inline void LowPass(double cutoff_hz, Record* record) {
  const auto response = [&](double hz) { return 1.0 / std::complex<double>(1.0, hz / cutoff_hz); };
  Filter(response, record->sampling_hz, &record->heat_release);
}

// A share of p in q, relative to what the signals are.
inline void Leak(double share, Record* record) {
  const double leak =
      share * RootMeanSquare(record->heat_release) / RootMeanSquare(record->pressure);
  for (std::size_t i = 0; i < record->pressure.size(); ++i) {
    record->heat_release[i] += leak * record->pressure[i];
  }
}

// A search that is offered these items alone.
inline LoopBudgetOptions Among(const std::vector<std::string>& kept) {
  LoopBudgetOptions out;
  out.starts = 4;
  out.withheld = LoopItemIds();
  std::erase_if(out.withheld,
                [&](const std::string& id) { return std::ranges::find(kept, id) != kept.end(); });
  return out;
}

// The duct's own: two free modes with complex residues, driven by dp/dt.
inline LoopForm DuctsForm() {
  LoopForm out;
  out.structure.modes = 2;
  out.structure.noise = LeastNoise();
  return out;
}

// That form, fitted to all points together.
inline LoopFit DuctsFit(const LoopRecords& records, const LoopBudgetOptions& options) {
  const LoopForm form = DuctsForm();
  const RecordsFitOptions of_fit = FitOptionsOf(options, "base/");
  return Scored(records, form, FitRecords(records.Points(form), form.structure, of_fit), of_fit);
}

}  // namespace howl

#endif  // HOWL_TESTS_DIAGNOSIS_LOOP_BUDGET_DUCT_RIG_H_
