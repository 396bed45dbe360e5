// Delays that differ a little between experiments, which the paper finds within some per cent of
// one value (section 3.1): log tau_e = log tau + d_e, where d_e is normal with a standard deviation
// s that all experiments share. When d_e is integrated out (Laplace; I_e: its information), the
// cost, minus the logarithm of the likelihood, has in addition to the residuals' terms
//
//   sum over experiments of  d_e^2 / (2 s^2) + ln(1 + s^2 I_e) / 2
//
// s is the value of least cost. Own delays therefore cost next to nothing where one delay serves
// all. An effect that explains why delays differ saves what their scatter costs: the logarithms of
// all experiments, less one for tau, which only replaces one of the n delays, and less one for each
// parameter of the effect, which replaces another. With two experiments any law of the delays is as
// good as none. log_delay is d_e.
#ifndef HOWL_DIAGNOSIS_FIT_DELAY_SCATTER_H_
#define HOWL_DIAGNOSIS_FIT_DELAY_SCATTER_H_

#include <cstddef>
#include <vector>

namespace howl {

struct OwnDelay {
  double log_delay = 0.0;    // where the fit has it
  double optimum = 0.0;      // where its record alone would put it
  double information = 0.0;  // of the record: inverse variance of the optimum
};

struct DelayScatter {
  double mean = 0.0;                // of log_delay: what the shared delay should move by
  double standard_deviation = 0.0;  // 0: one delay serves all
};

// d^2 / (2 s^2); 0 where s is 0 (then d is 0 too).
double DelayPrice(double log_delay, double standard_deviation);

// The logarithms of the sum above: what the delays' freedom costs.
double FreedomCost(const std::vector<OwnDelay>& delays, double standard_deviation);

// How much less the delays' freedom costs with an effect than without, as far as the effect has not
// earned that.
double UnearnedFreedom(double cost_without, double cost_with, std::size_t experiments,
                       std::size_t parameters);

// The sum above, at the fit's own delays.
double ScatterCost(const std::vector<OwnDelay>& delays, double standard_deviation);

// The scatter of least cost, with every d_e at its own best.
DelayScatter FitScatter(const std::vector<OwnDelay>& delays);

// The d_e of least cost: the optimum, shrunk towards the mean.
double ShrunkenDelay(const OwnDelay& delay, const DelayScatter& scatter);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_DELAY_SCATTER_H_
