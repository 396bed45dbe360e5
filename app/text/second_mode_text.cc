#include "app/text/second_mode_text.h"

#include <algorithm>
#include <limits>

#include "app/text/text_table.h"
#include "estimation/fit/loop_crossings.h"

namespace howl {
namespace {

std::string Between(double lo, double hi, int digits) {
  const std::string from = Significant(lo, digits);
  const std::string to = Significant(hi, digits);
  return from == to ? from : from + " .. " + to;
}

// "omega 160.1 .. 163.0 Hz, M/N 7.2 .. 9.1, second mode's share at the cycle 0.92"
std::string Where(const ModeBranch& branch) {
  double omega_lo = std::numeric_limits<double>::infinity(), omega_hi = 0.0;
  double ratio_lo = omega_lo, ratio_hi = 0.0;
  for (const LoopModel& model : branch.models) {
    omega_lo = std::min(omega_lo, model.omega_hz);
    omega_hi = std::max(omega_hi, model.omega_hz);
    ratio_lo = std::min(ratio_lo, model.M / model.N);
    ratio_hi = std::max(ratio_hi, model.M / model.N);
  }
  return "omega " + Between(omega_lo, omega_hi, 4) + " Hz, M/N " + Between(ratio_lo, ratio_hi, 3) +
         ", the second mode's share at the cycle up to " + Significant(branch.share, 2);
}

}  // namespace

std::string CrossingsText(const JointProblem& problem, const JointFit& fit) {
  TextTable table({"experiment", "crossing Hz", "loop gain", "observed Hz", "loop gain there",
                   "phase error deg"});
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    const Experiment& experiment = problem.experiments()[i];
    std::string name = experiment.name;
    for (const ObservedCrossing& one : LoopCrossings(experiment, fit.models[i], problem.model())) {
      const bool seen = one.observed_hz.has_value();
      table.AddRow({name, Fixed(one.crossing.frequency_hz, 1), Fixed(one.crossing.gain, 3),
                    seen ? Fixed(*one.observed_hz, 1) : "-",
                    seen ? Fixed(one.observed_gain, 3) : "-",
                    seen ? Fixed(one.phase_error_deg, 2) : "-"});
      name.clear();
    }
  }
  return "where the fitted loop's phase is 180 degrees (it oscillates where the gain exceeds "
         "one):\n" +
         table.Text();
}

std::string BranchText(const BranchComparison& comparison) {
  const bool on_papers = comparison.fit.IsPapers(comparison.share_max);
  const std::string here = Significant(comparison.fit.cost, 4);
  std::string text;
  if (!on_papers) {
    text = "the second mode carries the cycle (" + Where(comparison.fit) +
           "): not the paper's branch, (5b)";
    if (comparison.other) {
      text += "; that one, with second_mode_minor, costs " +
              Significant(comparison.other->cost, 4) + ", this one " + here;
    }
  } else if (comparison.DataPreferOther()) {
    text = "the data prefer the other branch, which second_mode_minor keeps the fit from: cost " +
           Significant(comparison.other->cost, 4) + " there (" + Where(*comparison.other) + "), " +
           here + " here (" + Where(comparison.fit) + ")";
  }
  return text.empty() ? text : Wrapped(text, 2) + "\n";
}

}  // namespace howl
