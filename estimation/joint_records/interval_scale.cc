#include "estimation/joint_records/interval_scale.h"

#include <algorithm>
#include <cmath>

#include "estimation/joint_records/loop_names.h"

namespace howl {
namespace {

struct Quantity {
  std::string name;
  double value = 0.0;
  double* std = nullptr;
};

// In an order that loops of one structure share.
std::vector<Quantity> QuantitiesOf(FittedLoop* loop) {
  std::vector<Quantity> out;
  const auto add = [&](const std::string& name, Estimate* estimate) {
    out.push_back({name, estimate->value, &estimate->std});
  };
  add("small_signal.frequency_hz", &loop->small_signal.frequency_hz);
  add("small_signal.growth_rate_1_s", &loop->small_signal.growth_rate_1_s);
  add("small_signal.loop_gain", &loop->small_signal.loop_gain);
  add("tau_s", &loop->tau_s);
  add("delay_spread", &loop->delay_spread);
  if (loop->second_path) {
    add("second_path.share", &loop->second_path->share);
    add("second_path.extra_s", &loop->second_path->extra_s);
  }
  for (std::size_t k = 0; k < loop->modes.size(); ++k) {
    const std::string of = "modes." + std::to_string(k) + ".";
    add(of + "omega_hz", &loop->modes[k].omega_hz);
    add(of + "xi", &loop->modes[k].xi);
    add(of + "N", &loop->modes[k].N);
    add(of + "B", &loop->modes[k].B);
  }
  const auto add_lines = [&](const std::string& name, std::vector<FittedLineError>* lines) {
    for (FittedLineError& line : *lines) {
      add(name, &line.real);
      add(name, &line.imaginary);
    }
  };
  add_lines("line_errors.acoustics", &loop->acoustic_lines);
  add_lines("line_errors.flame", &loop->flame_lines);
  for (FittedNoise& source : loop->noise) {
    const std::string of = "noise." + std::string(LoopNoiseName(source.source));
    for (std::size_t i = 0; i < source.psd.size(); ++i) {
      out.push_back({of + ".psd", std::log(source.psd[i]), &source.log_std[i]});
    }
    if (source.ratio) add(of + ".p_over_q", &*source.ratio);
  }
  return out;
}

struct Sum {
  IntervalScale scale;
  double square = 0.0;
  double most = 0.0;
  std::size_t count = 0;
  std::size_t last = 0;  // point
};

}  // namespace

std::vector<IntervalScale> ScalesOf(std::vector<FittedLoop> wholes, std::vector<HalfLoops> halves) {
  std::vector<Sum> sums;
  for (std::size_t e = 0; e < halves.size(); ++e) {
    const std::vector<Quantity> a = QuantitiesOf(&halves[e][0]);
    const std::vector<Quantity> b = QuantitiesOf(&halves[e][1]);
    const std::vector<Quantity> c = QuantitiesOf(&wholes[e]);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double of_a = 1.0 / std::pow(*a[i].std, 2);
      const double of_b = 1.0 / std::pow(*b[i].std, 2);
      const double mean = (of_a * a[i].value + of_b * b[i].value) / (of_a + of_b);
      const double square = std::pow(a[i].value - b[i].value, 2) / (1.0 / of_a + 1.0 / of_b) +
                            std::pow((c[i].value - mean) / *c[i].std, 2);
      if (!std::isfinite(square)) continue;
      auto sum = std::ranges::find_if(
          sums, [&](const Sum& each) { return each.scale.quantity == a[i].name; });
      if (sum == sums.end()) {
        sum = sums.insert(sums.end(), Sum{});
        sum->scale.quantity = a[i].name;
      }
      if (sum->scale.points == 0 || sum->last != e) ++sum->scale.points;
      sum->last = e;
      sum->square += square;
      ++sum->count;
      if (square <= sum->most) continue;
      sum->most = square;
      sum->scale.worst = e;
    }
  }
  std::vector<IntervalScale> out;
  for (const Sum& sum : sums) {
    out.push_back(sum.scale);
    out.back().halves = std::sqrt(sum.square / static_cast<double>(sum.count));
  }
  return out;
}

void Widen(const std::vector<IntervalScale>& scales, std::vector<FittedLoop>* loops) {
  for (FittedLoop& loop : *loops) {
    for (const Quantity& quantity : QuantitiesOf(&loop)) {
      const auto scale = std::ranges::find(scales, quantity.name, &IntervalScale::quantity);
      if (scale != scales.end()) *quantity.std *= scale->Factor();
    }
  }
}

}  // namespace howl
