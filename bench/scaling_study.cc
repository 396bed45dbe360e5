// CPU seconds of `howl fit` and `howl family` against the number of experiments E, one thread, and
// the local exponent ln(t / t before) / ln(E / E before): one where the work is linear.
//
//   scaling_study HOWL FOLDER [fit|family|both] [MODES] [E ...]
//
// Each table has E loops of known parameters in the range of the paper's test R228: phi from 0.45
// to 0.56, xi rising with it from 0.04 to 0.15, omega within 1 % of 215 Hz, delays near 0.72
// periods, loop gains of 1.15 to 1.6. Its characteristics are exact: the frequency where (1a)
// holds, found by bisection, gain and phase of G there, and the slope from the loop gain.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "model/loop.h"
#include "model/units.h"

namespace {

using howl::AcousticResponse;
using howl::LoopParameters;

constexpr double kOmegaHz = 215.0;
constexpr double kRatio = 3.0;

// Where arg L passes 180 degrees above omega.
double CycleFrequency(const LoopParameters<double>& loop) {
  double lo = loop.acoustics.omega_hz, hi = 1.3 * lo;
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = 0.5 * (lo + hi);
    (howl::LoopPhaseError(loop, middle) > 0.0 ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

void WriteConfig(const std::filesystem::path& path, int experiments, int modes) {
  std::mt19937_64 random(20011);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * uniform(random); };
  std::ofstream out(path);
  out.precision(17);
  out << "experiments:\n";
  for (int k = 0; k < experiments; ++k) {
    const double x = (k + 0.5) / experiments;
    const double omega_hz = kOmegaHz * between(0.99, 1.01);
    const double xi = 0.04 * std::pow(0.15 / 0.04, x);
    const double N = 15.0 * 2.0 * xi * howl::kRadPerSPerHz * omega_hz * between(0.8, 1.25);
    const double M = modes == 2 ? 300.0 : 0.0;
    const LoopParameters<double> loop{{omega_hz, xi, N, M, kRatio},
                                      between(0.715, 0.725) / omega_hz};
    const double f = CycleFrequency(loop);
    const howl::Complex<double> z = AcousticResponse(loop.acoustics, f);
    const double gain = howl::Magnitude(z);
    out << "  - {name: exp" << k + 1 << ", phi: " << 0.45 + 0.11 * x << ", frequency_hz: " << f
        << ", phase_deg: " << howl::Angle(z) * howl::kDegPerRad << ", gain: " << gain
        << ", flame_slope: " << -between(1.15, 1.6) / (howl::kRadPerSPerHz * f * gain) << "}\n";
  }
  out << "model: {modes: " << modes << "}\n";
}

// CPU seconds of the child, or nothing where it failed.
double Run(const std::string& howl, const std::string& command, const std::filesystem::path& config,
           const std::filesystem::path& out) {
  std::vector<std::string> words = {howl,        command, config.string(), "--out", out.string(),
                                    "--threads", "1",     "--quiet"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, howl.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) {
    return std::nan("");
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child) return std::nan("");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    std::fprintf(stderr, "%s %s: status %d\n", command.c_str(), config.c_str(),
                 WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    return std::nan("");
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "scaling_study HOWL FOLDER [fit|family|both] [MODES] [E ...]\n");
    return 2;
  }
  const std::string howl = argv[1];
  const std::filesystem::path folder = argv[2];
  const std::string which = argc > 3 ? argv[3] : "both";
  const int modes = argc > 4 ? std::atoi(argv[4]) : 1;
  std::vector<int> counts;
  for (int k = 5; k < argc; ++k) counts.push_back(std::atoi(argv[k]));
  if (counts.empty()) counts = {6, 12, 24, 48, 96, 960};
  std::filesystem::create_directories(folder);
  for (const std::string command : {"fit", "family"}) {
    if (which != "both" && which != command) continue;
    std::printf("%-8s %6s %12s %9s\n", command.c_str(), "E", "CPU s", "exponent");
    double before = 0.0, count_before = 0.0;
    for (const int count : counts) {
      const std::filesystem::path config =
          folder / ("experiments" + std::to_string(count) + ".yaml");
      WriteConfig(config, count, modes);
      const double seconds = Run(howl, command, config, folder / (command + std::to_string(count)));
      const double exponent = std::log(seconds / before) / std::log(count / count_before);
      std::printf("%-8s %6d %12.3f ", "", count, seconds);
      if (before > 0.0) std::printf("%9.2f", exponent);
      std::printf("\n");
      std::fflush(stdout);
      before = seconds;
      count_before = count;
    }
  }
}
