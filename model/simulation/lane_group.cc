#include "model/simulation/lane_group.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/simulation/lane_effects.h"
#include "model/simulation/past_wave.h"
#include "model/simulation/slow_amplitudes.h"

namespace howl::internal {
namespace {

constexpr int kChunk = 16 * kLoopBlock;  // steps between visits of the recorders

template <int W>
class LaneGroup {
 public:
  LaneGroup(std::span<const SimulationCase* const> cases, const SimulationOptions& options,
            double internal_hz)
      : cases_(cases), step_s_(1.0 / internal_hz) {
    const int ratio = static_cast<int>(std::lround(internal_hz / options.sampling_hz));
    int most_delay_steps = 0;
    const RigParameters& first = cases[0]->rig;
    block_.modes = NumModes(first);
    block_.shape = first.model.flame.shape;
    for (int l = 0; l < W; ++l) {
      // Lanes without a member repeat the first one; nothing of theirs is recorded.
      const RigParameters& rig = cases[Member(l)]->rig;
      const LaneCoefficients c = MakeCoefficients(rig, rig.model.loop, rig.model.flame, step_s_);
      CHECK_GE(c.delay_steps, kMinDelaySteps)
          << "a delay of " << rig.model.loop.tau_s << " s needs a higher internal rate than "
          << internal_hz << " Hz";
      block_.Set(l, c);
      delay_steps_[static_cast<std::size_t>(l)] = c.delay_steps;
      most_delay_steps = std::max(most_delay_steps, c.delay_steps);
    }
    has_effects_ = W == 1 && !first.effects.empty();
    amplitudes_ = SlowAmplitudes(first.model.loop.acoustics.omega_hz);
    if (has_effects_) {
      most_delay_steps *= 4;
      for (const auto& effect : first.effects) {
        const double longest = effect->LongestDelay(first.model.loop.tau_s) / step_s_;
        most_delay_steps = std::max(most_delay_steps, static_cast<int>(std::ceil(longest)));
        drives_ = drives_ || effect->Drives();
      }
    }
    past_ = most_delay_steps + kOrder + kLoopBlock;
    const std::size_t rows = static_cast<std::size_t>(past_) + kChunk + kLoopBlock + kLoopBlock;
    rate_.assign(rows * W, 0.0);
    heat_.assign(rows * W, 0.0);
    pressure_.assign(rows * W, 0.0);
    for (std::size_t l = 0; l < cases.size(); ++l) {
      recorders_.emplace_back(*cases[l], options, ratio);
      const Noise& noise = cases[l]->rig.noise;
      noises_.emplace_back(
          noise.combustion_density, noise.combustion_corner_hz, internal_hz,
          DeriveSeed(cases[l]->seed, static_cast<std::uint64_t>(StreamKey::kCombustion)));
    }
    half_length_ = recorders_[0].half_length();
    settle_steps_ = std::llround(options.settle_s * internal_hz);
    samples_ = std::llround(options.duration_s * options.sampling_hz) * ratio + 2LL * half_length_;
    // The recorders' first sample is the one at step `settle_steps_`, counted from the initial
    // state; the record's first half_length_ later.
    if (has_effects_) StartEffects();
    for (int l = 0; l < W; ++l) SetPast(l);
    if (drives_) released_ = heat_;
  }

  void Run(std::span<SimulatedRecord*> records) {
    // Row of the present step in the buffers, which hold the past before it.
    row_ = past_;
    step_ = 0;
    FillHeat(1, kAhead - 1);
    Record(row_, 1);  // the initial state is the first sample
    while (step_ < settle_steps_ + samples_) {
      for (int i = 0; i < kChunk; i += kLoopBlock) {
        if (has_effects_) UpdateParameters();
        FillHeat(kAhead, kLoopBlock);
        Propagate(&block_, kLoopBlock, Row(heat_, row_ - kBehind), Row(pressure_, row_ + 1),
                  Row(rate_, row_ + 1));
        row_ += kLoopBlock;
        step_ += kLoopBlock;
      }
      Record(row_ - kChunk + 1, kChunk);
      MoveBack();
    }
    for (std::size_t l = 0; l < cases_.size(); ++l) *records[l] = recorders_[l].Finish();
  }

 private:
  class Line final : public DelayLine {
   public:
    explicit Line(const LaneGroup& group) : group_(group) {}
    void Read(std::span<const double> delay_s, std::span<double> out) const override {
      for (std::size_t i = 0; i < out.size(); ++i) {
        const DelaySteps delay = SplitDelay(delay_s[i], group_.step_s_);
        const int row = group_.fill_row_ + static_cast<int>(i) - delay.steps + kFirstNode<kOrder>;
        CHECK_LE(row + kOrder - 1, group_.row_) << "a delay of " << delay_s[i] << " s is too short";
        CHECK_GE(row, 0) << "a delay of " << delay_s[i] << " s is too long";
        const double* at = group_.rate_.data() + row;
        double sum = delay.weights[0] * at[0];
        for (std::size_t j = 1; j < kOrder; ++j) sum += delay.weights[j] * at[j];
        out[i] = sum;
      }
    }

   private:
    const LaneGroup& group_;
  };

  std::size_t Member(int lane) const {
    const auto l = static_cast<std::size_t>(lane);
    return l < cases_.size() ? l : 0;
  }
  static double* Row(std::vector<double>& rows, int row) {
    return rows.data() + static_cast<std::ptrdiff_t>(row) * W;
  }

  void SetPast(int lane) {
    const RigParameters& rig = cases_[Member(lane)]->rig;
    const auto modes = Modes(rig, rig.model.loop);
    const auto l = static_cast<std::size_t>(lane);
    for (const InitialWave& wave : rig.past) {
      const PastWave past(wave, {modes.data(), static_cast<std::size_t>(block_.modes)});
      for (std::size_t k = 0; k < static_cast<std::size_t>(block_.modes); ++k) {
        block_.y[k][l] += past.mode_integral[k];
        block_.p[k][l] += past.mode_pressure[k];
      }
      for (int i = 0; i <= past_; ++i) {
        const std::size_t at = static_cast<std::size_t>(i) * W + l;
        past.AddAt(step_s_ * (i - past_), &rate_[at], &heat_[at], &pressure_[at]);
      }
    }
  }

  // Heat release of the `count` steps that begin `first` steps after the present one.
  void FillHeat(int first, int count) {
    fill_row_ = row_ + first;
    double* heat = Row(heat_, fill_row_);
    std::array<double, kLoopBlock> tau;
    const std::span<double> taus(tau.data(), static_cast<std::size_t>(count));
    if (has_effects_) {
      std::fill(taus.begin(), taus.end(), effects_.at.loop.tau_s);
      effects_.at.tau_s = taus;
      SetContextTime(first);
    }
    if (has_effects_ && effects_.MovesDelay()) {
      effects_.Delay(taus);
      Line(*this).Read(taus, {heat, static_cast<std::size_t>(count)});
    } else {
      for (int l = 0; l < W; ++l) {
        const double* from =
            Row(rate_, fill_row_ - delay_steps_[static_cast<std::size_t>(l)] + kFirstNode<kOrder>) +
            l;
        double* to = block_.window.data() + l;
        const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(count + kOrder - 1) * W;
        for (std::ptrdiff_t i = 0; i < end; i += W) to[i] = from[i];
      }
      Interpolate(block_, count, heat);
    }
    if (has_effects_) {
      const std::span<double> signal(heat, static_cast<std::size_t>(count));
      effects_.FlameIn(signal);
      ApplyFlame(block_, count, heat);
      effects_.FlameOut(signal);
      AddNoise(count, heat);
      effects_.Source(signal);
      if (drives_) {
        std::copy(signal.begin(), signal.end(), released_.begin() + fill_row_);
        effects_.Drive(signal);
      }
    } else {
      ApplyFlame(block_, count, heat);
      AddNoise(count, heat);
    }
  }

  void AddNoise(int count, double* heat) {
    for (std::size_t l = 0; l < cases_.size(); ++l) {
      if (cases_[l]->rig.noise.combustion_density == 0.0) continue;
      for (int i = 0; i < count; ++i)
        heat[static_cast<std::size_t>(i) * W + l] += noises_[l].Next();
    }
  }

  void StartEffects() {
    line_ = std::make_unique<Line>(*this);
    effects_.Start(*cases_[0], step_s_, line_.get());
  }

  void SetContextTime(int steps_ahead) {
    const auto steps = static_cast<double>(step_ + steps_ahead - settle_steps_ - half_length_);
    effects_.at.time_s = steps * step_s_;
  }

  // Slow changes: constant within a block, taken at its first sample.
  void UpdateParameters() {
    const RigParameters& rig = cases_[0]->rig;
    const auto present = static_cast<std::size_t>(row_) + 1;
    amplitudes_.Update({rate_.data(), present}, {pressure_.data(), present}, step_ == 0, step_s_,
                       &effects_.at);
    SetContextTime(kAhead);
    if (!effects_.MoveParameters(rig)) return;
    const LoopParameters<double>& loop = effects_.at.loop;
    const LaneCoefficients c = MakeCoefficients(rig, loop, effects_.at.flame, step_s_);
    CHECK(effects_.MovesDelay() ||
          (c.delay_steps >= kMinDelaySteps && c.delay_steps + kOrder < past_))
        << "delay of " << loop.tau_s << " s";
    // p and its integral go on without a jump: y = omega times the integral changes its unit.
    for (std::size_t k = 0; k < kMaxModes; ++k) {
      if (block_.omega[k][0] > 0.0) block_.y[k][0] *= c.omega_rad_s[k] / block_.omega[k][0];
    }
    block_.Set(0, c);
    delay_steps_[0] = c.delay_steps;
  }

  // Hands rows [row, row + count) to the recorders, less what settling throws away.
  void Record(int row, int count) {
    const std::int64_t first_step = step_ - (row_ - row);
    const std::int64_t skip = std::max<std::int64_t>(settle_steps_ - first_step, 0);
    if (skip >= count) return;
    const auto from = static_cast<std::size_t>(row + skip);
    const auto n = static_cast<std::size_t>(count - skip);
    line_p_.resize(n);
    line_q_.resize(n);
    const std::vector<double>& heat = drives_ ? released_ : heat_;
    for (std::size_t l = 0; l < cases_.size(); ++l) {
      for (std::size_t i = 0; i < n; ++i) {
        line_p_[i] = pressure_[(from + i) * W + l];
        line_q_[i] = heat[(from + i) * W + l];
      }
      recorders_[l].Push(line_p_, line_q_);
    }
  }

  // The last rows become the past of the next chunk.
  void MoveBack() {
    const int shift = row_ - past_;
    const auto move = [shift](std::vector<double>& rows) {
      std::copy(rows.begin() + static_cast<std::ptrdiff_t>(shift) * W, rows.end(), rows.begin());
    };
    move(rate_);
    move(heat_);
    if (drives_) move(released_);
    move(pressure_);
    row_ = past_;
  }

  std::span<const SimulationCase* const> cases_;
  double step_s_;
  LaneBlock<W> block_;
  std::array<int, W> delay_steps_{};
  int past_ = 0;
  int half_length_ = 0;
  std::int64_t settle_steps_ = 0;
  std::int64_t samples_ = 0;
  std::vector<double> rate_;
  std::vector<double> heat_;
  std::vector<double> released_;  // heat release without what else drives the acoustics
  std::vector<double> pressure_;
  std::vector<double> line_p_;
  std::vector<double> line_q_;
  std::vector<Recorder> recorders_;
  std::vector<ColouredNoise> noises_;
  int row_ = 0;
  int fill_row_ = 0;
  std::int64_t step_ = 0;
  bool has_effects_ = false;
  bool drives_ = false;
  LaneEffects effects_;
  std::unique_ptr<Line> line_;
  SlowAmplitudes amplitudes_;
};

}  // namespace

void RunLanes(std::span<const SimulationCase* const> cases, const SimulationOptions& options,
              double internal_hz, std::span<SimulatedRecord*> records) {
  // A few members in eight lanes would cost as much as eight. The bits are the same either way.
  if (cases.size() > 2) {
    LaneGroup<8>(cases, options, internal_hz).Run(records);
    return;
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    LaneGroup<1>(cases.subspan(i, 1), options, internal_hz).Run(records.subspan(i, 1));
  }
}

}  // namespace howl::internal
