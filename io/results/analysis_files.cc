#include "io/results/analysis_files.h"

#include <cmath>
#include <limits>

#include "io/results/csv_writer.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

bool HasCycle(const Analysis& analysis) {
  return analysis.characteristics.state != CycleState::kNoLimitCycle;
}

Estimate OrUnknown(const std::optional<Estimate>& estimate) {
  return estimate.value_or(Estimate{});
}

Json EstimateJson(const Estimate& estimate, const char* unit) {
  return {
      {"value", NumberOrNull(estimate.value)}, {"std", NumberOrNull(estimate.std)}, {"unit", unit}};
}

Json LineJson(const SpectralLine& line) {
  return {{"frequency_hz", NumberOrNull(line.frequency_hz.value)},
          {"frequency_std_hz", NumberOrNull(line.frequency_hz.std)},
          {"harmonic", line.harmonic == 0 ? Json(nullptr) : Json(line.harmonic)},
          {"p_amplitude", NumberOrNull(line.p_amplitude)},
          {"q_amplitude", NumberOrNull(line.q_amplitude)},
          {"width_hz", NumberOrNull(line.width_hz)},
          {"resolution_hz", NumberOrNull(line.resolution_hz)},
          {"coherence", NumberOrNull(line.coherence)},
          {"phase_deg", NumberOrNull(line.phase_deg.value)},
          {"phase_std_deg", NumberOrNull(line.phase_deg.std)},
          {"narrow", line.narrow}};
}

Json TransferFitJson(const TransferFit& fit) {
  return {{"omega_hz", EstimateJson(fit.omega_hz, "Hz")},
          {"xi", EstimateJson(fit.xi, "1")},
          {"N", EstimateJson(fit.N, "p/q rad/s")},
          {"M", EstimateJson(fit.M, "p/q rad/s")},
          {"chi_square_per_dof", NumberOrNull(fit.chi_square_per_dof)},
          {"explained_power", NumberOrNull(fit.explained_power)},
          {"noise_power", NumberOrNull(fit.noise_power)},
          {"points", fit.points.size()},
          {"points_within_95", NumberOrNull(fit.points_within_95)}};
}

Json FlameJson(const FlameCurve& curve) {
  Json mean_cycle = Json::array();  // [re, im] of q's harmonics relative to the first
  for (const std::complex<double>& r : curve.mean_cycle) mean_cycle.push_back({r.real(), r.imag()});
  return {{"slope", EstimateJson(curve.slope, "q per p/s")},
          {"offset", EstimateJson(curve.offset, "q")},
          {"saturation_low", NumberOrNull(curve.saturation_low)},
          {"saturation_high", NumberOrNull(curve.saturation_high)},
          {"hysteresis", NumberOrNull(curve.hysteresis)},
          {"harmonics_of_p", curve.harmonics},
          {"degree", curve.degree},
          {"mean_cycle", std::move(mean_cycle)},
          {"regressor_noise", NumberOrNull(curve.regressor_noise)},
          {"dither", NumberOrNull(curve.dither)}};
}

Json LowLoopGainJson(const LowLoopGain& low) {
  return {{"reason", LoopGainReasonName(low.reason)},
          {"third_harmonic", NumberOrNull(low.third_harmonic)},
          {"turn_deg", NumberOrNull(low.turn_deg)},
          {"shape_gain", NumberOrNull(low.shape_gain)},
          {"stiffening", NumberOrNull(low.stiffening)}};
}

Json CycleJson(const Characteristics& cycle) {
  return {{"state", CycleStateName(cycle.state)},
          {"frequency", EstimateJson(cycle.frequency_hz, "Hz")},
          {"phase", EstimateJson(cycle.phase_deg, "deg")},
          {"gain", EstimateJson(cycle.gain, "p/q")},
          {"p_amplitude", NumberOrNull(cycle.p_amplitude)},
          {"q_amplitude", NumberOrNull(cycle.q_amplitude)},
          {"line_width_hz", NumberOrNull(cycle.line_width_hz)},
          {"coherence", NumberOrNull(cycle.coherence)},
          {"power_fluctuation", EstimateJson(cycle.power_fluctuation, "1")},
          {"frequency_drift", EstimateJson(cycle.frequency_drift_hz_per_s, "Hz/s")},
          {"amplitude_drift", EstimateJson(cycle.amplitude_drift_per_s, "1/s")},
          {"low_amplitude_share", NumberOrNull(cycle.low_amplitude_share)},
          {"stationary", cycle.stationary}};
}

Json OscillationJson(const Oscillation& one) {
  const Characteristics& c = one.characteristics;
  return {{"state", CycleStateName(c.state)},
          {"is_cycle", one.is_cycle},
          {"frequency", EstimateJson(c.frequency_hz, "Hz")},
          {"phase", EstimateJson(c.phase_deg, "deg")},
          {"gain", EstimateJson(c.gain, "p/q")},
          {"p_amplitude", NumberOrNull(c.p_amplitude)},
          {"q_amplitude", NumberOrNull(c.q_amplitude)},
          {"p_share", NumberOrNull(one.p_share)},
          {"q_share", NumberOrNull(one.q_share)},
          {"power_fluctuation", EstimateJson(c.power_fluctuation, "1")},
          {"slow_modulation", NumberOrNull(c.slow_modulation)}};
}

Json OneJson(const Analysis& analysis) {
  Json lines = Json::array();
  for (const SpectralLine& line : analysis.lines) lines.push_back(LineJson(line));
  Json json = {{"name", analysis.name},
               {"phi", analysis.phi},
               {"sampling_hz", analysis.sampling_hz},
               {"duration_s", analysis.duration_s},
               {"has_heat_release", analysis.has_heat_release},
               {"cycle", CycleJson(analysis.characteristics)},
               {"lines", lines}};
  json["tau"] = analysis.tau_s ? EstimateJson(*analysis.tau_s, "s") : Json(nullptr);
  json["flame"] = analysis.flame_curve ? FlameJson(*analysis.flame_curve) : Json(nullptr);
  json["low_loop_gain"] =
      analysis.low_loop_gain ? LowLoopGainJson(*analysis.low_loop_gain) : Json(nullptr);
  json["loop_gain"] = analysis.loop_gain ? EstimateJson(*analysis.loop_gain, "1") : Json(nullptr);
  json["transfer"] =
      analysis.transfer_fit ? TransferFitJson(*analysis.transfer_fit) : Json(nullptr);
  json["growth"] = nullptr;
  if (analysis.growth) {
    json["growth"] = {{"rate", EstimateJson(analysis.growth->rate_per_s, "1/s")},
                      {"frequency", EstimateJson(analysis.growth->frequency_hz, "Hz")},
                      {"start_s", analysis.growth->start_s},
                      {"end_s", analysis.growth->end_s}};
  }
  return json;
}

}  // namespace

Json OscillationsJson(const AnalysisSet& set) {
  Json json = Json::array();
  for (const Analysis& analysis : set.analyses) {
    Json each = Json::array();
    for (const Oscillation& one : analysis.oscillations) each.push_back(OscillationJson(one));
    json.push_back({{"name", analysis.name}, {"oscillations", std::move(each)}});
  }
  return json;
}

std::string CharacteristicsCsv(const AnalysisSet& set, std::string_view operating_parameter) {
  const OwnNameColumn own(operating_parameter);
  CsvWriter csv(
      "name,phi,frequency_hz,frequency_std_hz,phase_deg,phase_std_deg,gain,gain_std,tau_s,"
      "flame_slope,flame_slope_std,loop_gain,stationary" +
      own.Header());
  for (const Analysis& analysis : set.analyses) {
    // Without a limit cycle there is a largest peak, but no cycle to characterise.
    const Characteristics cycle = HasCycle(analysis) ? analysis.characteristics : Characteristics{};
    const Estimate slope = analysis.flame_curve ? analysis.flame_curve->slope : Estimate{};
    csv.Cell(analysis.name).Cell(analysis.phi);
    for (const Estimate& estimate : {cycle.frequency_hz, cycle.phase_deg, cycle.gain}) {
      csv.Cell(estimate.value).Cell(estimate.std);
    }
    csv.Cell(OrUnknown(analysis.tau_s).value).Cell(slope.value).Cell(slope.std);
    csv.Cell(OrUnknown(analysis.loop_gain).value).Cell(cycle.stationary ? "true" : "false");
    own.Add(csv, analysis.phi).EndRow();
  }
  return csv.Text();
}

std::string OscillationsCsv(const AnalysisSet& set, std::string_view operating_parameter) {
  const OwnNameColumn own(operating_parameter);
  CsvWriter csv(
      "name,phi,is_cycle,state,frequency_hz,frequency_std_hz,phase_deg,phase_std_deg,gain,gain_std,"
      "p_amplitude,q_amplitude,p_share,q_share,power_fluctuation,power_fluctuation_std,"
      "slow_modulation" +
      own.Header());
  for (const Analysis& analysis : set.analyses) {
    for (const Oscillation& one : analysis.oscillations) {
      const Characteristics& c = one.characteristics;
      csv.Cell(analysis.name).Cell(analysis.phi).Cell(one.is_cycle ? "true" : "false");
      csv.Cell(CycleStateName(c.state));
      for (const Estimate& estimate : {c.frequency_hz, c.phase_deg, c.gain}) {
        csv.Cell(estimate.value).Cell(estimate.std);
      }
      csv.Cell(c.p_amplitude).Cell(c.q_amplitude).Cell(one.p_share).Cell(one.q_share);
      csv.Cell(c.power_fluctuation.value).Cell(c.power_fluctuation.std).Cell(c.slow_modulation);
      own.Add(csv, analysis.phi).EndRow();
    }
  }
  return csv.Text();
}

std::string LinesCsv(const AnalysisSet& set, std::string_view operating_parameter) {
  const OwnNameColumn own(operating_parameter);
  CsvWriter csv(
      "name,phi,frequency_hz,frequency_std_hz,harmonic,p_amplitude,q_amplitude,p_over_floor,"
      "q_over_floor,p_log10_p_value,q_log10_p_value,width_hz,resolution_hz,coherence,phase_deg,"
      "phase_std_deg,narrow" +
      own.Header());
  for (const Analysis& analysis : set.analyses) {
    for (const SpectralLine& line : analysis.lines) {
      csv.Cell(analysis.name).Cell(analysis.phi);
      csv.Cell(line.frequency_hz.value).Cell(line.frequency_hz.std);
      csv.Cell(line.harmonic == 0 ? kUnknown : line.harmonic);
      for (const double value :
           {line.p_amplitude, line.q_amplitude, line.p_over_floor, line.q_over_floor,
            line.p_log10_p_value, line.q_log10_p_value, line.width_hz, line.resolution_hz,
            line.coherence, line.phase_deg.value, line.phase_deg.std}) {
        csv.Cell(value);
      }
      own.Add(csv.Cell(line.narrow ? "true" : "false"), analysis.phi).EndRow();
    }
  }
  return csv.Text();
}

std::string TransferCsv(const AnalysisSet& set, std::string_view operating_parameter) {
  const OwnNameColumn own(operating_parameter);
  CsvWriter csv(
      "name,phi,frequency_hz,re,im,variance_re,variance_im,covariance,coherence,model_re,model_im,"
      "misfit" +
      own.Header());
  for (const Analysis& analysis : set.analyses) {
    if (!analysis.transfer) continue;
    const bool fitted = analysis.transfer_fit &&
                        analysis.transfer_fit->points.size() == analysis.transfer->points.size();
    for (std::size_t k = 0; k < analysis.transfer->points.size(); ++k) {
      const TransferPoint& point = analysis.transfer->points[k];
      csv.Cell(analysis.name).Cell(analysis.phi);
      const Eigen::Matrix2d covariance = point.TotalCovariance();
      for (const double value : {point.frequency_hz, point.re, point.im, covariance(0, 0),
                                 covariance(1, 1), covariance(0, 1), point.coherence}) {
        csv.Cell(value);
      }
      const TransferFitPoint model =
          fitted ? analysis.transfer_fit->points[k]
                 : TransferFitPoint{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
      csv.Cell(model.model_re).Cell(model.model_im).Cell(model.misfit);
      own.Add(csv, analysis.phi).EndRow();
    }
  }
  return csv.Text();
}

std::string FlameCurveCsv(const AnalysisSet& set, std::string_view operating_parameter) {
  const OwnNameColumn own(operating_parameter);
  CsvWriter csv("name,phi,delayed_derivative,q,q_std,samples" + own.Header());
  for (const Analysis& analysis : set.analyses) {
    if (!analysis.flame_curve) continue;
    for (const FlameCurveBin& bin : analysis.flame_curve->bins) {
      csv.Cell(analysis.name).Cell(analysis.phi).Cell(bin.x).Cell(bin.q).Cell(bin.q_std);
      own.Add(csv.Cell(static_cast<double>(bin.samples)), analysis.phi).EndRow();
    }
  }
  return csv.Text();
}

Json AnalysisJson(const AnalysisSet& set) {
  Json experiments = Json::array();
  for (const Analysis& analysis : set.analyses) experiments.push_back(OneJson(analysis));
  Json branches = Json::array();
  for (const DelayBranch& branch : set.delay.branches) {
    branches.push_back({{"periods", branch.branch},
                        {"mean_tau_s", NumberOrNull(branch.mean_tau_s)},
                        {"spread", NumberOrNull(branch.spread)},
                        {"probability", branch.probability}});
  }
  return {{"schema", "howl.analysis/1"},
          {"experiments", experiments},
          {"delay",
           {{"periods", set.delay.branch},
            {"by_consistency", set.delay.by_consistency},
            {"compared", branches}}},
          {"vanishing_phi", VanishingJson(set.vanishing_phi)}};
}

}  // namespace howl
