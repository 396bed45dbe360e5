#include "diagnosis/localise/localise.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "diagnosis/localise/free_additive.h"
#include "diagnosis/localise/free_map.h"
#include "diagnosis/localise/free_slack.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr double kBandOfCycle = 0.2;  // width, of the cycle's frequency
constexpr double kBandShare = 0.1;    // of the largest band's gain

// The decrease of the base's squares by the fit, in bands of both cuts.
void FindBand(const AttemptContext& at, const EffectFit& fit, BlockSlack* out) {
  const std::vector<CutRecord>& records = *at.records;
  const double width = kBandOfCycle * records[0].at.cycle_frequency_hz;
  const double low = records[0].frequency(0);
  std::vector<double> gains;
  const auto add = [&](const CutRecord& record, const Eigen::VectorXcd& before,
                       const Eigen::VectorXcd& after, const Eigen::VectorXd& noise) {
    for (Eigen::Index k = 0; k < after.size(); ++k) {
      if (record.masked[static_cast<std::size_t>(k)]) continue;
      const auto band = static_cast<std::size_t>((record.frequency(k) - low) / width);
      if (band >= gains.size()) gains.resize(band + 1, 0.0);
      gains[band] += (std::norm(before[k]) - std::norm(after[k])) / noise[k];
    }
  };
  for (std::size_t e = 0; e < records.size(); ++e) {
    const ExperimentFit& before = at.base->experiments[e];
    const ExperimentFit& after = fit.experiments[e];
    if (fit.effect->ChangesAcousticCut()) {
      add(records[e], before.acoustic_residual, after.acoustic_residual, after.acoustic_noise);
    }
    if (fit.effect->ChangesFlameCut()) {
      add(records[e], before.flame_residual, after.flame_residual, after.flame_noise);
    }
  }
  const double most = *std::max_element(gains.begin(), gains.end());
  for (std::size_t b = 0; b < gains.size(); ++b) {
    if (gains[b] < kBandShare * most) continue;
    const double from = low + static_cast<double>(b) * width;
    if (out->high_hz == 0.0) out->low_hz = from;
    out->high_hz = from + width;
  }
}

BlockSlack Paid(const AttemptContext& at, const EffectFit& fit, LoopBlock block, std::string form,
                double parameters) {
  const double gain = GainOver(*at.base, fit) - PriceOfParameters(parameters);
  BlockSlack out{block, std::move(form), gain, false, 0.0, 0.0};
  FindBand(at, fit, &out);
  return out;
}

BlockSlack OfForm(const AttemptContext& at, const EffectFit& fit) {
  return Paid(at, fit, fit.effect->block(), std::string(fit.effect->id()),
              static_cast<double>(fit.values.size()));
}

BlockSlack OfMap(const AttemptContext& at, Channel channel) {
  const bool pressure = channel == Channel::kPressure;
  const EffectFit fit = FitFreeMap(*at.records, channel, *at.base);
  BlockSlack out =
      Paid(at, fit, pressure ? LoopBlock::kPressureInstrument : LoopBlock::kHeatReleaseInstrument,
           pressure ? "slack_p_map" : "slack_q_map", static_cast<double>(kMapTerms));
  out.model_free = ShowsLimits(at, channel);
  return out;
}

// The experiment whose own delay would differ most from the shared one, to first order.
std::size_t OddOne(const EffectFit& base) {
  std::size_t odd = 0;
  double most = -1.0;
  for (std::size_t e = 0; e < base.experiments.size(); ++e) {
    const ExperimentFit& at = base.experiments[e];
    const double gain = at.gradient[0] * at.gradient[0] / std::max(at.curvature(0, 0), 1e-300);
    if (gain > most) {
      most = gain;
      odd = e;
    }
  }
  return odd;
}

}  // namespace

std::vector<BlockSlack> Localise(const AttemptContext& at, const std::vector<CoherentLine>& lines,
                                 const LineOrigin& origin, const GainFluctuation& fluctuation,
                                 int threads) {
  const CutRecord& first = (*at.records)[0];
  const SlackScale scale{first.at.cycle_frequency_hz,
                         std::sqrt(first.frequency(0) * first.frequency(first.acoustic_count - 1)),
                         at.base->tau_s};
  std::vector<EffectPointer> forms;
  const auto add = [&](std::vector<EffectPointer> more) {
    std::move(more.begin(), more.end(), std::back_inserter(forms));
  };
  add(FreePressureInstrument(scale));
  add(FreeAcoustics(scale));
  add(FreeHeatReleaseInstrument(scale));
  add(FreeDelay(scale));
  add(FreeFlame(scale));
  if (at.records->size() > 2) {
    add(FreePoint((*at.records)[OddOne(*at.base)].at.phi_position));
  }
  std::vector<BlockSlack> out(forms.size() + 2);
  RunUnits(out.size(), threads, [&](std::size_t i) {
    if (i >= forms.size()) {
      out[i] = OfMap(at, i == forms.size() ? Channel::kPressure : Channel::kHeatRelease);
      return;
    }
    out[i] = OfForm(at, FitEffect(*at.records, forms[i], *at.base));
  });
  const AdditiveGain additive = FitFreeAdditive(*at.records, *at.base);
  const auto paid = [&](LoopBlock block, const std::string& form, double gain) {
    out.push_back({block, form, gain - PriceOfParameters(additive.parameters), false,
                   additive.low_hz, additive.high_hz});
  };
  paid(LoopBlock::kSource, "slack_source_additive", additive.source);
  paid(LoopBlock::kPressureInstrument, "slack_p_additive", additive.pressure);
  paid(LoopBlock::kHeatReleaseInstrument, "slack_q_additive", additive.heat_release);
  if (fluctuation.gain > 0.0) {
    out.push_back({LoopBlock::kFlame, "slack_flame_gain", fluctuation.gain, false, 0.0, 0.0});
  }
  if (fluctuation.quadrature_gain > 0.0) {
    out.push_back(
        {LoopBlock::kDelay, "slack_delay_wander", fluctuation.quadrature_gain, false, 0.0, 0.0});
  }
  if (!lines.empty()) {
    const double low = lines.front().frequency_hz;
    const double high = lines.back().frequency_hz;
    out.push_back({LoopBlock::kSource, "line", origin.source, false, low, high});
    out.push_back(
        {LoopBlock::kPressureInstrument, "line_in_p", origin.pressure_hum, false, low, high});
    out.push_back({LoopBlock::kHeatReleaseInstrument, "line_in_q", origin.heat_release_hum, false,
                   low, high});
  }
  return out;
}

}  // namespace howl
