// Spectra of p and q by Welch's averages, and the narrow-band blocks that every line estimate uses.
//
//   S_xy(f) = 2 / (fs sum w^2) * mean over segments of conj(X_k) Y_k        (one-sided, units^2/Hz)
//   z_b = 2 / sum w * sum_t w(t) x(t0_b + t) e^(-j 2 pi f (t0_b + t) / fs)  (complex amplitude)
//
// Segments overlap by three quarters under the four-term Blackman-Harris window, whose side lobes
// lie 92 dB below its peak: a limit cycle's line does not leak into the broadband noise beside it.
// Blocks overlap by one half under Hann's window: their sum weighs all samples equally, so that a
// mean over blocks of a pure tone is the tone's least-squares fit.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_SPECTRUM_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_SPECTRUM_H_

#include <complex>
#include <span>
#include <vector>

namespace howl {

std::vector<double> HannWindow(int length);            // periodic
std::vector<double> BlackmanHarrisWindow(int length);  // periodic

inline constexpr double kBlackmanHarrisHalfPowerBins = 1.90;   // full width at half power
inline constexpr double kBlackmanHarrisVarianceBins2 = 0.619;  // of its power over frequency
inline constexpr int kBlackmanHarrisMainLobeBins = 4;          // half width to the first null
inline constexpr double kHannOverlapCorrelation = 1.0 / 6.0;   // of half-overlapping blocks

struct CrossSpectrum {
  double bin_hz = 0.0;
  int segment = 0;   // samples
  int segments = 0;  // averaged
  std::vector<double> pp, qq;
  std::vector<std::complex<double>> qp;  // mean of conj(Q) P; empty, as qq, without q
  // Number of independent complex averages of one bin, and of a mean over `bins` adjacent ones.
  double degrees_of_freedom = 0.0;
  double DegreesOfFreedom(int bins) const;

  bool HasHeatRelease() const { return !qq.empty(); }
  double Frequency(int bin) const { return bin * bin_hz; }
};

// segment = 0: the power of two next below samples / 3.5.
CrossSpectrum WelchSpectrum(std::span<const double> p, std::span<const double> q,
                            double sampling_hz, int segment = 0);

struct Blocks {
  std::vector<std::complex<double>> amplitude;
  double hop_s = 0.0;
  double length_s = 0.0;
  double first_center_s = 0.0;
};

// Half-overlapping Hann blocks of `length` samples (made even) at frequency_hz.
Blocks Demodulate(std::span<const double> x, double sampling_hz, double frequency_hz, int length);
Blocks Demodulate(std::span<const std::complex<double>> x, double sampling_hz, double frequency_hz,
                  int length);

// The whole record's discrete Fourier transform, bins 0 .. n/2.
std::vector<std::complex<double>> RealFft(std::span<const double> x);

std::vector<double> RemoveMean(std::span<const double> x);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_SPECTRUM_H_
