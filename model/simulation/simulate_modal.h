// A loop of K modes with complex residues in time, with a flame of any curve and noise of any
// spectra:
//
//   p = R (q + d),   q(t) = Phi(v(t - tau)) + n(t),   v = p', p or the integral of p (modal_step.h)
//   recorded  p + m_p + beta b,   q + m_q + b
//
// n is combustion's noise and d the duct's, which q does not show; m_p, m_q are the sensors' and b
// is a background that both channels show. The scheme is of order six where Phi and the noise are
// smooth: the acoustics are exact for a q that is a polynomial through its six nearest samples, and
// v is read tau earlier by interpolation of order six. A corner of Phi lowers the order as the
// solution passes it.
//
// Noise repeats after a period that is longer than the run (model/noise/periodic_noise.h). n and d
// are sampled at the internal rate, the recorded channels' at the record's, past the anti-alias
// filter (decimate.h). Seconds, Hz, units of p and q as in the rig.
#ifndef HOWL_MODEL_SIMULATION_SIMULATE_MODAL_H_
#define HOWL_MODEL_SIMULATION_SIMULATE_MODAL_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "model/noise/periodic_noise.h"
#include "model/simulation/modal_step.h"
#include "model/simulation/simulate.h"

namespace howl {

struct ModalRig {
  std::vector<ResidueMode> modes;
  ModalDrive drive = ModalDrive::kPressureRate;
  double leak_hz = 0.0;  // of the integral of p
  double tau_s = 0.0;
  std::function<double(double v)> flame;  // Phi
  // One-sided, of q squared a Hz, but for the sensor of p. None: no noise.
  PowerDensity combustion;
  PowerDensity duct;
  PowerDensity pressure_sensor;
  PowerDensity heat_release_sensor;
  PowerDensity background;          // as q shows it
  double background_ratio = 0.0;    // beta
  std::optional<InitialWave> past;  // of q; none: at rest
};

// What comes into the loop at its steps, repeated where it is shorter than the run; empty: nothing.
struct ModalDrives {
  std::vector<double> combustion;
  std::vector<double> duct;
};

// p and q at the steps, the first at the end of the past.
struct ModalPath {
  std::vector<double> pressure;
  std::vector<double> heat_release;
};

// The delay is six steps long or more.
ModalPath RunModal(const ModalRig& rig, double step_s, std::size_t steps,
                   const ModalDrives& drives);

// The smallest multiple of sampling_hz that gives the delay twelve steps, the lowest mode eighty a
// period and the highest twenty, and is four times sampling_hz or more.
double ModalInternalRate(const ModalRig& rig, double sampling_hz);

SimulatedRecord SimulateModal(const ModalRig& rig, const SimulationOptions& options,
                              std::uint64_t seed);

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_SIMULATE_MODAL_H_
