// CPU seconds of `howl fit` and `howl family` against the number of experiments E, one thread, and
// the local exponent ln(t / t before) / ln(E / E before): one where the work is linear. The tables
// are those of tests/known_loops.h.
//
//   scaling_study HOWL FOLDER [joint|fit|family|all] [MODES] [GAIN_NOISE] [E ...]
//
// joint: the joint fit alone, eight starts, without the search for mistakes in the data that `fit`
// makes where a fit misses by more than 10 nats. GAIN_NOISE: relative, and as much of a radian for
// the phase.
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "estimation/fit/joint_fit.h"
#include "tests/known_loops.h"

namespace {

void WriteConfig(const std::filesystem::path& path, int count, int modes, double noise) {
  const howl::KnownLoops known =
      howl::DrawKnownLoops(count, modes, noise, noise * howl::kDegPerRad);
  std::ofstream out(path);
  out.precision(17);
  out << "experiments:\n";
  for (const howl::Experiment& e : known.experiments) {
    out << "  - {name: " << e.name << ", phi: " << e.phi << ", frequency_hz: " << e.frequency_hz
        << ", phase_deg: " << e.phase_deg << ", gain: " << e.gain
        << ", flame_slope: " << *e.flame_slope << "}\n";
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

double JointFitSeconds(int count, int modes, double noise) {
  using howl::JointProblem;
  howl::ModelSpec model = howl::DefaultModelSpec();
  model.modes = modes;
  const howl::KnownLoops known =
      howl::DrawKnownLoops(count, modes, noise, noise * howl::kDegPerRad);
  const std::clock_t before = std::clock();
  const JointProblem problem(known.experiments, model, howl::DefaultResidualSet());
  const howl::JointFit fit = howl::SolveJoint(problem, {}, 1, 1);
  if (!fit.converged) return std::nan("");
  return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr,
                 "scaling_study HOWL FOLDER [joint|fit|family|all] [MODES] [GAIN_NOISE] [E ...]\n");
    return 2;
  }
  const std::string howl = argv[1];
  const std::filesystem::path folder = argv[2];
  const std::string which = argc > 3 ? argv[3] : "all";
  const int modes = argc > 4 ? std::atoi(argv[4]) : 1;
  std::vector<int> counts;
  const double noise = argc > 5 ? std::atof(argv[5]) : 0.0;
  for (int k = 6; k < argc; ++k) counts.push_back(std::atoi(argv[k]));
  if (counts.empty()) counts = {6, 12, 24, 48, 96, 960};
  std::filesystem::create_directories(folder);
  for (const std::string command : {"joint", "fit", "family"}) {
    if (which != "all" && which != command) continue;
    std::printf("%-8s %6s %12s %9s\n", command.c_str(), "E", "CPU s", "exponent");
    double before = 0.0, count_before = 0.0;
    for (const int count : counts) {
      const std::filesystem::path config =
          folder / ("experiments" + std::to_string(count) + ".yaml");
      WriteConfig(config, count, modes, noise);
      const double seconds = command == "joint" ? JointFitSeconds(count, modes, noise)
                                                : Run(howl, command, config,
                                                      folder / (command + std::to_string(count)));
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
