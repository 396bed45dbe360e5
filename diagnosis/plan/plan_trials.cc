#include "diagnosis/plan/plan_trials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <utility>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/fitted_rig.h"
#include "diagnosis/fit/fitter.h"
#include "estimation/analysis/spectra/simulated_record.h"

namespace howl {
namespace {

constexpr double kWeaker = 0.5;        // of the recorded amplitude of p
constexpr double kStable = 0.1;        // below this there is no cycle
constexpr double kOften = 1.0 / 1.15;  // between two gains of the flame that are tried
constexpr int kMostGains = 24;
constexpr double kBeyond = 0.5;   // of the operating range
constexpr double kQuieter = 0.5;  // of the sensors' noise
constexpr std::uint64_t kSeed = 22;

double Rms(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

DiagnosisExperiment Simulated(const PlanRecords& at, const EffectFit& fit, std::size_t e,
                              const std::string& name, double phi) {
  const CutRecord& record = (*at.records)[e];
  return {name, phi,
          ToRecord(Simulate(FittedRig(record, fit, e, kSeed), FittedRigOptions(record)))};
}

// Cut with the present records, but with amplitudes and operating parameter on their scales, so
// that an effect's size means the same.
std::vector<CutRecord> CutAlike(const PlanRecords& at, const DiagnosisExperiment& further) {
  std::vector<DiagnosisExperiment> all = *at.experiments;
  all.push_back(further);
  const CutRecord& known = (*at.records)[0];
  const std::vector<CutRecord> cut = MakeCutRecords(all, known.model);
  CutRecord out = cut.back();
  const double amplitude = known.at.relative_amplitude / cut[0].at.relative_amplitude;
  const double rate = known.at.relative_rate_amplitude / cut[0].at.relative_rate_amplitude;
  out.at.relative_amplitude *= amplitude;
  out.square_spectrum *= amplitude * amplitude;
  out.at.relative_rate_amplitude *= rate;
  out.rate_square_spectrum *= rate * rate;
  out.at.heat_release_over_pressure = known.at.heat_release_over_pressure;
  const auto [low, high] = std::minmax_element(
      at.experiments->begin(), at.experiments->end(),
      [](const DiagnosisExperiment& a, const DiagnosisExperiment& b) { return a.phi < b.phi; });
  if (high->phi > low->phi) {
    out.at.phi_position = (further.phi - 0.5 * (low->phi + high->phi)) / (high->phi - low->phi);
  }
  return {out};
}

// The base at the further experiment: its own parameters are those that it was simulated with, and
// its noise is what they leave over.
std::shared_ptr<EffectFit> FitOf(const std::vector<CutRecord>& further, const EffectFit& fit,
                                 std::size_t e) {
  auto out = std::make_shared<EffectFit>(fit);
  out->experiments = {fit.experiments[e]};
  ExperimentFit& at = out->experiments[0];
  at.acoustic_noise = Eigen::VectorXd::Ones(further[0].acoustic_count);
  at.flame_noise = Eigen::VectorXd::Ones(further[0].flame_count);
  Fitter fitter(further, *fit.effect, nullptr);
  for (int round = 0; round < 3; ++round) {
    fitter.SetNoise(*out);
    fitter.Evaluate(out.get());
    fitter.RefitNoise(out.get());
  }
  return out;
}

TrialMeasurement Further(const PlanRecords& at, const EffectFit& fit, std::size_t e,
                         const DiagnosisExperiment& experiment, std::string what) {
  TrialMeasurement out;
  out.what = std::move(what);
  out.further = CutAlike(at, experiment);
  out.further_fit = FitOf(out.further, fit, e);
  return out;
}

// The first gain of the flame, from the present one down, with which the cycle is weak enough.
std::optional<TrialMeasurement> Weaker(const PlanRecords& at, std::size_t e, double amplitude,
                                       const std::string& what) {
  const double recorded = Rms((*at.experiments)[e].record.pressure);
  EffectFit fit = *at.base;
  for (int i = 0; i < kMostGains; ++i) {
    fit.experiments[e].flame *= kOften;
    const DiagnosisExperiment found = Simulated(at, fit, e, "weaker", (*at.experiments)[e].phi);
    if (Rms(found.record.pressure) <= amplitude * recorded) return Further(at, fit, e, found, what);
  }
  return std::nullopt;
}

std::string Number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

// Beyond the range, with the acoustics that the two outermost experiments lead to.
TrialMeasurement Beyond(const PlanRecords& at, std::size_t from, std::size_t neighbour,
                        double phi) {
  const double share = (phi - (*at.experiments)[from].phi) /
                       ((*at.experiments)[from].phi - (*at.experiments)[neighbour].phi);
  EffectFit fit = *at.base;
  AcousticLocals& locals = fit.experiments[from].acoustics;
  const AcousticLocals change = locals - at.base->experiments[neighbour].acoustics;
  // The damping is taken as it is, since extrapolation may lead to none.
  locals[0] += share * std::clamp(change[0], -0.2, 0.2);
  return Further(at, fit, from, Simulated(at, fit, from, "beyond", phi),
                 "a record at the operating parameter " + Number(phi));
}

// The noise of both cuts with sensors that are quieter by so much; what combustion adds stays.
TrialMeasurement Quieter(const PlanRecords& at) {
  TrialMeasurement out;
  out.what = "sensors with half the noise";
  out.fit = std::make_shared<EffectFit>(*at.base);
  const double less = kQuieter * kQuieter;
  for (std::size_t e = 0; e < at.records->size(); ++e) {
    const CutRecord& record = (*at.records)[e];
    ExperimentFit& fit = out.fit->experiments[e];
    const double q_sensor = HeatReleaseSensorPower(record, fit);
    fit.acoustic_noise *= less;
    fit.flame_noise =
        (fit.flame_noise.array() - (1.0 - less) * q_sensor).max(less * fit.flame_noise.array());
  }
  return out;
}

}  // namespace

std::vector<TrialMeasurement> TrialMeasurements(const PlanRecords& at) {
  std::vector<TrialMeasurement> out(1);
  out[0].what = "records twice as long";
  out[0].record_scale = 2.0;
  out.push_back(Quieter(at));
  std::vector<std::size_t> order(at.experiments->size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (*at.experiments)[a].phi < (*at.experiments)[b].phi;
  });
  const std::size_t middle = order[order.size() / 2];
  const std::string name = (*at.experiments)[middle].name;
  for (const auto& [amplitude, what] :
       {std::pair<double, std::string>(kWeaker, "a cycle of half the amplitude near " + name),
        std::pair<double, std::string>(kStable,
                                       "a stable point near " + name + ", driven by its noise")}) {
    if (auto found = Weaker(at, middle, amplitude, what)) out.push_back(std::move(*found));
  }
  if (order.size() < 2) return out;
  const std::size_t low = order.front();
  const std::size_t high = order.back();
  const double low_phi = (*at.experiments)[low].phi;
  const double high_phi = (*at.experiments)[high].phi;
  const double beyond = kBeyond * (high_phi - low_phi);
  if (!(beyond > 0.0)) return out;
  out.push_back(Beyond(at, low, order[1], low_phi - beyond));
  out.push_back(Beyond(at, high, order[order.size() - 2], high_phi + beyond));
  return out;
}

}  // namespace howl
