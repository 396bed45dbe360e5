// From the simulator's internal rate to the record's, by an anti-alias filter of linear phase
// whose delay is taken out: a Kaiser-windowed sinc (Oppenheim & Schafer, section 7.5).
//
//   pass band   0 .. 0.4 f_s, flat within 0.001 dB
//   stop band   from 0.6 f_s, at least 80 dB down: nothing folds into the pass band
//
// f_s: the record's rate. Ratio 1 passes samples through untouched.
#ifndef HOWL_MODEL_SIMULATION_DECIMATE_H_
#define HOWL_MODEL_SIMULATION_DECIMATE_H_

#include <cstddef>
#include <span>
#include <vector>

namespace howl {

class Decimator {
 public:
  explicit Decimator(int ratio);

  int ratio() const { return ratio_; }
  // Input samples on each side of an output sample.
  int half_length() const { return half_length_; }
  const std::vector<double>& taps() const { return taps_; }

  // The first output is centred on input sample half_length(); then one every `ratio` samples.
  void Push(std::span<const double> input, std::vector<double>* output);

 private:
  int ratio_;
  int half_length_;
  std::vector<double> taps_;
  std::vector<double> pending_;
};

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_DECIMATE_H_
