// The identified flame and acoustics of an experiment as other programs read them.
//
// OSCILOS (Open Source Combustion Instability Low Order Simulator, Imperial College London,
// https://github.com/MorgansLab) describes a flame by its transfer or describing function from
// velocity to heat release, both over their means, in the convention e^(s t):
//
//   F(s, a) = (q' / mean q) / (u' / mean u),   a = |u'| / mean u
//
// The flame here is q = Phi(v), v = p'(t - tau). Its input counts as a velocity, u' / mean u = -v /
// V (the sign makes the gain positive: Phi'(0) < 0), V being the rate of change of pressure that
// modulates the velocity by 100 %, so that with the describing function D of model/flame.h
//
//   F(s, a) = -D(a V) V / (mean q) e^(-s tau)
//
// OSCILOS_lite reads F from Flame.txt (SubFunctions/Flame_subfc.m): a line of three words, then
// type 1, the gain n and tau in milliseconds: F = n exp(-s tau). OSCILOS_long reads one MATLAB file
// for each a (GUI_INI_FM_IMPORT.m): matrices Gain and Phase, of rows (frequency in Hz, gain) and
// (frequency in Hz, phase in rad, without jumps), which it interpolates linearly.
#ifndef HOWL_IO_RESULTS_FLAME_EXPORT_H_
#define HOWL_IO_RESULTS_FLAME_EXPORT_H_

#include <filesystem>
#include <string>
#include <vector>

#include "estimation/parameters.h"
#include "model/loop/flame.h"

namespace howl {

// What u' and q' are relative to.
struct FlameScale {
  double mean_heat_release = 1.0;        // units of q
  double rate_at_full_modulation = 1.0;  // V, (units of p) / s
};

// |F| at the velocity ratio a; the slope of the flame is negative.
double FlameGain(const Flame<double>& flame, const FlameScale& scale, double velocity_ratio);

// Flame.txt of OSCILOS_lite.
std::string OscilosLiteFlame(double gain, double tau_s);

// The MATLAB file (version 5) of OSCILOS_long for one velocity ratio. Throws UserError where the
// disk refuses.
void WriteOscilosLongFlame(const std::filesystem::path& path, double gain, double tau_s,
                           const std::vector<double>& frequencies_hz);

// frequency_hz,amplitude,gain,phase_deg: q over v in natural units, of amplitudes of v in (units of
// p) / s. The phase has the slope's sign: 180 degrees at rest.
std::string FlameTableCsv(const Flame<double>& flame, double tau_s,
                          const std::vector<double>& frequencies_hz,
                          const std::vector<double>& amplitudes);

// frequency_hz,gain,phase_deg: G(j 2 pi f), p over q in natural units.
std::string AcousticsTableCsv(const LoopModel& model, const std::vector<double>& frequencies_hz);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FLAME_EXPORT_H_
