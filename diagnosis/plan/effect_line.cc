#include "diagnosis/plan/effect_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace howl {
namespace {

constexpr double kSpread = 3.0;  // of a parameter that has one start
// Frequencies over the cycle's at which an effect is looked at.
constexpr std::array kLookedAt = {0.37, 1.0, 1.9, 3.3};
constexpr double kSameResponse = 1e-12;

bool Near(Response a, Response b) { return std::abs(a - b) <= kSameResponse * std::abs(b); }

// Whether the loop with these values is the loop without the effect.
bool IsNull(const Effect& effect, const CutRecord& record, const std::vector<double>& x) {
  const EffectContext& at = record.at;
  const Acoustics<double> acoustics{at.cycle_frequency_hz, 0.1, 1000.0, 100.0,
                                    record.model.harmonic_ratio};
  for (const double ratio : kLookedAt) {
    const double f = ratio * at.cycle_frequency_hz;
    const Complex<double> g = AcousticResponse(acoustics, f);
    if (!Near(effect.Acoustics(acoustics, f, at, x), {g.re, g.im}) ||
        !Near(effect.PressureInstrument(f, x), 1.0) ||
        !Near(effect.HeatReleaseInstrument(f, x), 1.0) || effect.PressureLeak(f, at, x) != 0.0 ||
        !Near(effect.FlameIn(f, at, x), 1.0) || !Near(effect.FlameOut(f, at, x), 1.0)) {
      return false;
    }
  }
  for (const double position : {-0.5, 0.5}) {
    EffectContext moved = at;
    moved.phi_position = position;
    double omega_factor = 1.0;
    double xi_add = 0.0;
    effect.ModulateAcoustics(position, 1.3, x, &omega_factor, &xi_add);
    if (!Near(effect.DelayFactor(moved, x), 1.0) || !Near(omega_factor, 1.0) ||
        std::abs(xi_add) > kSameResponse) {
      return false;
    }
  }
  return effect.DelayPerAmplitude(x) == 0.0;
}

double StartOf(const EffectParameter& p) {
  for (const double start : p.starts) {
    if (start > 0.0 && start != p.null_value) return start;
  }
  const double reach = p.high - (std::isfinite(p.null_value) ? p.null_value : p.low);
  return p.starts.empty() || p.starts[0] == p.null_value
             ? (std::isfinite(p.null_value) ? p.null_value + 0.1 * reach : 10.0 * p.low)
             : p.starts[0];
}

std::optional<std::size_t> SizeParameter(const Effect& effect, const CutRecord& record) {
  const std::vector<EffectParameter>& parameters = effect.parameters();
  std::vector<double> typical;
  for (const EffectParameter& p : parameters) typical.push_back(StartOf(p));
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    std::vector<double> x = typical;
    x[j] = parameters[j].null_value;
    if (IsNull(effect, record, x) && !IsNull(effect, record, typical)) return j;
  }
  return std::nullopt;
}

double SizeOf(const EffectParameter& p, double x) {
  if (!std::isfinite(p.null_value)) return 1.0 / x;
  if (p.scale == ParameterScale::kLogarithmic) return std::log(x / p.null_value);
  return x - p.null_value;
}

std::vector<double> Alternatives(const EffectParameter& p, bool spread) {
  if (p.starts.size() > 1) return p.starts;
  const double start = p.starts.empty() ? p.null_value : p.starts[0];
  if (!spread || !(start > 0.0) || !std::isfinite(start)) return {start};
  std::vector<double> out = {start};
  for (const double other : {start / kSpread, start * kSpread}) {
    if (other >= p.low && other <= p.high) out.push_back(other);
  }
  return out;
}

}  // namespace

double EffectLine::ParameterAt(double size) const {
  const EffectParameter& p = parameter();
  if (!std::isfinite(p.null_value)) return 1.0 / size;
  return p.scale == ParameterScale::kLogarithmic ? p.null_value * std::exp(size)
                                                 : p.null_value + size;
}

std::vector<double> EffectLine::ValuesAt(double size) const {
  std::vector<double> out = values;
  out[size_parameter] = ParameterAt(size);
  return out;
}

std::vector<EffectLine> EffectLines(const EffectPointer& effect, const CutRecord& record) {
  if (effect->kind() != EffectKind::kTransfer) return {};
  const std::optional<std::size_t> size = SizeParameter(*effect, record);
  if (!size) return {};
  const std::vector<EffectParameter>& parameters = effect->parameters();
  const EffectParameter& p = parameters[*size];
  EffectLine line;
  line.effect = effect;
  line.values.assign(parameters.size(), 0.0);
  line.size_parameter = *size;
  line.typical = std::abs(SizeOf(p, StartOf(p)));
  const bool infinite = !std::isfinite(p.null_value);
  line.largest = infinite ? 1.0 / p.low : SizeOf(p, p.high);
  line.both_signs = !infinite && p.low < p.null_value && p.null_value < p.high;
  if (!(line.largest > 0.0)) return {};
  bool spread = true;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    spread = spread && (j == *size || parameters[j].starts.size() < 2);
  }
  std::vector<EffectLine> lines = {line};
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    if (j == *size) continue;
    std::vector<EffectLine> next;
    for (const EffectLine& one : lines) {
      for (const double value : Alternatives(parameters[j], spread)) {
        next.push_back(one);
        next.back().values[j] = value;
      }
    }
    lines = std::move(next);
  }
  return lines;
}

}  // namespace howl
