#include "estimation/family/answers/predict/advise.h"

#include <algorithm>
#include <cmath>

#include "model/loop/loop.h"

namespace howl {

namespace {

double NormalBelow(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

std::string WithNumber(const std::string& text, double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", number);
  return text + digits;
}

}  // namespace

SurvivalResult TestFurther(const FamilyProblem& problem, std::span<const Member> members,
                           std::span<const Experiment> further) {
  SurvivalResult result;
  for (const Member& member : members) {
    ConditionSet failed;
    bool tested = false;
    for (const Experiment& experiment : further) {
      const std::optional<LoopModel> model =
          InterpolateModel(problem.experiments, member, experiment.phi);
      if (!model) continue;
      tested = true;
      // Experiments are tested one at a time, because conditions that couple experiments were
      // tested when the member was made.
      const ConditionSet one =
          Falsify(std::span(&experiment, 1), std::span(&*model, 1), problem.test);
      for (const Condition condition : kConditions) {
        if (one.Contains(condition)) failed.Insert(condition);
      }
    }
    Survival survival = Survival::kUntested;
    if (tested) survival = failed.IsEmpty() ? Survival::kSurvives : Survival::kRejected;
    result.of_member.push_back(survival);
    result.counts.untested += survival == Survival::kUntested;
    result.counts.survive += survival == Survival::kSurvives;
    result.counts.rejected += survival == Survival::kRejected;
    for (std::size_t k = 0; k < kNumConditions; ++k) {
      result.counts.rejected_by[k] += failed.Contains(kConditions[k]);
    }
  }
  return result;
}

std::vector<Advice> Advise(std::span<const Member> members,
                           std::span<const Measurement> measurements, double kept_within) {
  constexpr std::size_t kMostTruths = 1000;
  std::vector<Advice> advice;
  for (const Measurement& measurement : measurements) {
    std::vector<double> values;
    for (const Member& member : members) {
      const std::optional<double> value = measurement.predictor(member);
      if (value && std::isfinite(*value)) values.push_back(*value);
    }
    Advice one{measurement.name, measurement.std, 1.0, {1.0, -1.0}};
    if (!values.empty()) {
      const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
      one.predicted = {*lo, *hi};
      const std::size_t step = std::max<std::size_t>(1, values.size() / kMostTruths);
      double sum = 0.0;
      std::size_t truths = 0;
      for (std::size_t truth = 0; truth < values.size(); truth += step, ++truths) {
        double kept = static_cast<double>(members.size() - values.size());
        for (const double value : values) {
          // The probability that the measurement of the truth falls within reach of this member's
          // value.
          const double distance = (value - values[truth]) / measurement.std;
          kept += NormalBelow(kept_within - distance) - NormalBelow(-kept_within - distance);
        }
        sum += kept / static_cast<double>(members.size());
      }
      one.expected_remaining = sum / static_cast<double>(truths);
    }
    advice.push_back(std::move(one));
  }
  std::stable_sort(advice.begin(), advice.end(), [](const Advice& a, const Advice& b) {
    return a.expected_remaining < b.expected_remaining;
  });
  return advice;
}

Range LineBand(double frequency_hz, double harmonic_ratio) {
  constexpr double kBelow = 0.91;  // 600 Hz at the paper's 220 Hz and ratio of three
  constexpr double kAbove = 1.36;  // 900 Hz
  const double second_hz = harmonic_ratio * frequency_hz;
  return {kBelow * second_hz, kAbove * second_hz};
}

std::vector<Measurement> DefaultMeasurements(const std::vector<Experiment>& experiments,
                                             double harmonic_ratio, const MeasurementStds& stds) {
  std::vector<Measurement> measurements;
  const auto phase_of = [](const LoopModel& model, double frequency_hz) {
    return Angle(AcousticResponse(model.Loop().acoustics, frequency_hz)) * kDegPerRad;
  };
  std::vector<double> phis;
  phis.reserve(experiments.size());
  double mean_hz = 0.0;
  for (const Experiment& experiment : experiments) {
    phis.push_back(experiment.phi);
    mean_hz += experiment.frequency_hz / static_cast<double>(experiments.size());
  }
  std::sort(phis.begin(), phis.end());
  for (std::size_t k = 1; k < phis.size(); ++k) {
    if (!(phis[k] > phis[k - 1])) continue;
    const double phi = 0.5 * (phis[k] + phis[k - 1]);
    measurements.push_back({WithNumber("limit-cycle frequency at phi ", phi), "Hz",
                            stds.frequency_relative * mean_hz,
                            [experiments, phi](std::span<const LoopModel> m) {
                              return InterpolatedFrequency(experiments, m, phi);
                            }});
    measurements.push_back(
        {WithNumber("q-to-p phase of the limit cycle at phi ", phi), "deg", stds.phase_deg,
         [experiments, phi, phase_of](std::span<const LoopModel> m) -> std::optional<double> {
           const std::optional<double> f = InterpolatedFrequency(experiments, m, phi);
           if (!f) return std::nullopt;
           return phase_of(*InterpolateModel(experiments, m, phi), *f);
         }});
  }
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const std::string of = " of " + experiments[i].name;
    for (const double multiple : {0.5, 1.5, 2.0}) {
      const double f = multiple * experiments[i].frequency_hz;
      measurements.push_back(
          {WithNumber("q-to-p phase" + of + " at ", f) + " Hz", "deg", stds.phase_deg,
           [i, f, phase_of](std::span<const LoopModel> m) -> std::optional<double> {
             return phase_of(m[i], f);
           }});
      measurements.push_back(
          {WithNumber("log of the q-to-p gain" + of + " at ", f) + " Hz", "relative",
           stds.gain_relative, [i, f](std::span<const LoopModel> m) -> std::optional<double> {
             return std::log(Magnitude(AcousticResponse(m[i].Loop().acoustics, f)));
           }});
    }
    const Range band_hz = LineBand(experiments[i].frequency_hz, harmonic_ratio);
    measurements.push_back(
        {"non-harmonic line" + of, "Hz", stds.line_relative * 0.5 * (band_hz.lo + band_hz.hi),
         [i, band_hz](std::span<const LoopModel> m) { return CrossingNear(m[i], band_hz); }});
  }
  return measurements;
}

}  // namespace howl
