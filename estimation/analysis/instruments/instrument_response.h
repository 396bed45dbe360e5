// The response of an instrument, such as a probe or a camera:
//
//   recorded(s) = H(s) true(s),   s = 2 pi j f in rad/s
//
// H is a formula, such as "1 / (1 + s / (2 pi 400))", with the names s, f_hz and j in addition to
// those of formula.h, or a table. Between the rows of a table log |H| and the unwrapped phase are
// linear in the frequency; beyond its ends magnitude and phase are held.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_INSTRUMENT_RESPONSE_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_INSTRUMENT_RESPONSE_H_

#include <complex>
#include <optional>
#include <string_view>
#include <vector>

#include "model/numerics/formula.h"

namespace howl {

class InstrumentResponse {
 public:
  // No value on a mistake, whose description is then written to the argument.
  static std::optional<InstrumentResponse> Parse(std::string_view text, FormulaError& error);

  // At least two rows: frequencies that increase, magnitudes above zero, all finite. From row to
  // row the phase turns by less than half a turn.
  static InstrumentResponse OfTable(std::vector<double> frequency_hz,
                                    const std::vector<double>& magnitude,
                                    const std::vector<double>& phase_deg);

  // Not finite where a formula has no value.
  std::complex<double> At(double frequency_hz) const;

  // The ends of a table in Hz; no value for a formula.
  struct Band {
    double low_hz = 0.0;
    double high_hz = 0.0;
  };
  std::optional<Band> TableBand() const;

 private:
  std::vector<FormulaToken> tokens_;  // empty for a table
  std::vector<double> frequency_hz_;
  std::vector<double> log_magnitude_;
  std::vector<double> phase_rad_;  // unwrapped
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_INSTRUMENT_RESPONSE_H_
