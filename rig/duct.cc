#include "rig/duct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rig/constants.h"
#include "rig/dense.h"

namespace rig {
namespace {

constexpr double kRoundTrips = 1.6;      // length of the distribution
constexpr double kMatchedBand = 10.5;    // over the first mode's frequency
constexpr double kOutsideWeight = 0.01;  // keeps the distribution smooth above the band
constexpr double kRidge = 1e-4;

Complex Sum(const std::vector<double>& taps, Complex z) {
  Complex sum = 0.0;
  for (std::size_t k = taps.size(); k-- > 0;) sum = sum * z + taps[k];
  return sum;
}

Complex Pole(double omega_hz, double xi) {
  return kTwoPi * omega_hz * Complex(-xi, std::sqrt(1.0 - xi * xi));
}

// Of all reflections with the two poles, the one with least sum of R_k^2 / envelope_k.
std::vector<double> Reflection(const Modes& modes, double spacing_s, double widening) {
  const double round_trip_s = 0.5 / modes.omega_hz;
  const double width_s = round_trip_s * widening * 0.22 * (0.3 + 2.0 * modes.xi);
  const double reach_s = std::min(0.9 * round_trip_s, 2.6 * width_s + 0.2 * round_trip_s);
  const auto first = static_cast<std::size_t>(std::ceil((round_trip_s - reach_s) / spacing_s));
  const auto last = static_cast<std::size_t>((round_trip_s + reach_s) / spacing_s);
  const std::array<Complex, 2> poles = {
      Pole(modes.omega_hz, modes.xi),
      Pole(modes.ratio * modes.omega_hz, modes.xi * modes.second_xi_factor)};
  const std::size_t count = last - first + 1;
  std::vector<std::array<double, 4>> conditions(count);
  std::vector<double> envelope(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = static_cast<double>(first + i) * spacing_s;
    for (std::size_t j = 0; j < 2; ++j) {
      const Complex wave = std::exp(-poles[j] * time_s);
      conditions[i][2 * j] = wave.real();
      conditions[i][2 * j + 1] = wave.imag();
    }
    const double distance = (time_s - round_trip_s) / width_s;
    envelope[i] = std::exp(-distance * distance);
  }
  Square gram(4);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        gram(a, b) += envelope[i] * conditions[i][a] * conditions[i][b];
      }
    }
  }
  const std::vector<double> multipliers = SolveSymmetric(gram, {1.0, 0.0, 1.0, 0.0});
  std::vector<double> reflection(last + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t a = 0; a < 4; ++a) {
      reflection[first + i] += envelope[i] * conditions[i][a] * multipliers[a];
    }
  }
  return reflection;
}

// The open end gives back less than it gets, at all frequencies but the lowest. Then the duct alone
// is stable.
bool IsPassive(const std::vector<double>& reflection) {
  constexpr int kPoints = 512;
  for (int i = 0; i <= kPoints; ++i) {
    const Complex z = std::polar(1.0, -std::numbers::pi * i / kPoints);
    if (std::abs(Sum(reflection, z)) >= 1.0) return false;
  }
  return true;
}

std::vector<double> Distribution(const Modes& modes, const Duct& duct) {
  const double step_hz = modes.omega_hz / 35.0;
  const double top_hz = std::min(kMatchedBand * modes.omega_hz, 0.45 / duct.spacing_s);
  const auto count = static_cast<std::size_t>(kRoundTrips * 0.5 / modes.omega_hz / duct.spacing_s);
  Square normal(count);
  std::vector<double> right(count, 0.0);
  std::vector<double> real(count);
  std::vector<double> imaginary(count);
  const auto add = [&](double frequency_hz, double weight, Complex wanted) {
    const Complex turn = std::polar(1.0, -kTwoPi * frequency_hz * duct.spacing_s);
    Complex z = weight;
    for (std::size_t k = 0; k < count; ++k, z *= turn) {
      real[k] = z.real();
      imaginary[k] = z.imag();
    }
    wanted *= weight;
    for (std::size_t i = 0; i < count; ++i) {
      double* row = normal.row(i);
      for (std::size_t j = 0; j <= i; ++j) {
        row[j] += real[i] * real[j] + imaginary[i] * imaginary[j];
      }
      right[i] += real[i] * wanted.real() + imaginary[i] * wanted.imag();
    }
  };
  const int inside = static_cast<int>(top_hz / step_hz);
  for (int i = 0; i < inside; ++i) {
    const double f = (i + 0.3) * step_hz;
    const Complex s(0.0, kTwoPi * f);
    const Complex open = 1.0 - Sum(duct.reflection, std::exp(-s * duct.spacing_s));
    // In units of N / omega, so that the ridge means the same for all ducts.
    const Complex wanted = ModalResponse(modes, s) * (kTwoPi * modes.omega_hz / modes.N);
    const double weight = std::min(30.0, 1.0 / (std::abs(wanted) * std::abs(open)));
    add(f, weight, wanted * open);
  }
  const int outside = static_cast<int>((0.5 / duct.spacing_s - top_hz) / (4.0 * step_hz));
  for (int i = 0; i <= outside; ++i) add(top_hz + 4.0 * i * step_hz, kOutsideWeight, 0.0);
  for (std::size_t i = 0; i < count; ++i) normal(i, i) += kRidge * kRidge;
  std::vector<double> taps = SolveSymmetric(normal, right);
  for (double& tap : taps) tap *= modes.N / (kTwoPi * modes.omega_hz);
  return taps;
}

}  // namespace

Complex ModalResponse(const Modes& modes, Complex s) {
  const auto mode = [&](double strength, double omega_hz, double xi) {
    const double w = kTwoPi * omega_hz;
    return strength * s / (s * s + 2.0 * xi * w * s + w * w);
  };
  return mode(modes.N, modes.omega_hz, modes.xi) +
         mode(modes.M, modes.ratio * modes.omega_hz, modes.xi * modes.second_xi_factor);
}

Complex Duct::Response(Complex s) const {
  const Complex z = std::exp(-s * spacing_s);
  return Sum(distribution, z) / (1.0 - Sum(reflection, z));
}

Duct DesignDuct(const Modes& modes, double spacing_s) {
  Duct duct;
  duct.spacing_s = spacing_s;
  for (const double widening : {1.0, 1.5, 2.2, 3.2, 4.5, 6.0, 8.0}) {
    duct.reflection = Reflection(modes, spacing_s, widening);
    if (!IsPassive(duct.reflection)) continue;
    duct.distribution = Distribution(modes, duct);
    return duct;
  }
  throw std::runtime_error("no passive end gives a duct these modes");
}

double LargestMismatch(const Duct& duct, const Modes& modes, double low_hz, double high_hz) {
  double largest = 0.0;
  constexpr int kPoints = 400;
  for (int i = 0; i <= kPoints; ++i) {
    const Complex s(0.0, kTwoPi * (low_hz + (high_hz - low_hz) * i / kPoints));
    largest = std::max(largest, std::abs(duct.Response(s) / ModalResponse(modes, s) - 1.0));
  }
  return largest;
}

}  // namespace rig
