// Loops that records show, simulated: their spectra are those of the closed form, their cycle is
// the record's, and a fit finds the loop that was simulated.
#include "estimation/joint_records/fitted_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "estimation/joint_records/fitted_loop.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "tests/estimation/joint_records/known_flame.h"
#include "tests/estimation/record_fit/identified.h"
#include "tests/model/density.h"

namespace howl::fitted_rig_test {
namespace {

using C = std::complex<double>;

// The known loop in the units of its record.
LoopPoint TruthOf(const ModalLoop& loop, const RecordSpectra& record) {
  const double turn = 2.0 * std::numbers::pi * record.scale.cycle_hz;
  const double residue = turn * record.scale.pressure / record.scale.heat_release;
  LoopPoint point;
  for (const ModalLoop::Mode& mode : loop.modes) {
    point.modes.push_back({mode.omega_hz / record.scale.cycle_hz, mode.xi, mode.a / residue,
                           mode.b / residue, 0.0, 0.0});
  }
  point.path.tau = loop.tau_s * turn;
  point.flame = KnownFlame(
      record, [&](double v) { return -loop.slope * loop.range * std::tanh(v / loop.range); });
  return point;
}

ModalLoop DuctOfGain(double gain) {
  ModalLoop loop = DuctOfModes(2);
  loop.slope = gain / loop.Open(CycleFrequency(loop, 150.0, 300.0)).real();
  return loop;
}

RecordSpectra SpectraOf(const ModalLoop& loop, const Record& record) {
  return MakeRecordSpectra(record, CycleFrequency(loop, 150.0, 300.0), FlameInput::kPressureRate);
}

// Below onset the loop is linear: with F = slope s e^(-tau s)
//   S_pp = |R|^2 (S_n + S_d) / |1 - R F|^2 + S_p + beta^2 S_b
//   S_qq = (S_n + |F R|^2 S_d) / |1 - R F|^2 + S_q + S_b
TEST(FittedRig, SpectraBelowOnsetAreThoseOfTheClosedForm) {
  const ModalLoop loop = DuctOfGain(0.5);
  const RecordSpectra record = SpectraOf(loop, SimulateModalLoop(loop, 3.0, 4));
  const PointStructure structure = StructureOf({.ratio = std::nullopt}, 2);
  LoopPoint point = TruthOf(loop, record);
  // ln S of each source: levels that show, with a shape where there is one.
  for (const NoiseTerm& term : structure.noise) {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(term.coefficients);
    const bool in_loop = term.source == LoopNoise::kCombustion || term.source == LoopNoise::kDuct;
    c[0] = in_loop ? 0.5 : -3.0;
    if (c.size() > 1) c[1] = -0.8;
    if (c.size() > 2) c[2] = 0.3;
    point.noise.push_back(c);
  }
  point.background_ratio = 0.7;
  const PointFit fit{
      .parameters = ToParameters(structure, point),
      .information = Eigen::MatrixXd::Identity(ToParameters(structure, point).size(),
                                               ToParameters(structure, point).size())};
  const FittedLoop fitted = FittedLoopOf(record, structure, fit);
  const SimulatedRecord simulated =
      SimulateModal(FittedRigOf(record, structure, point, 0.0),
                    {.duration_s = 60.0, .sampling_hz = loop.sampling_hz, .settle_s = 1.0}, 8);
  const double turn = 2.0 * std::numbers::pi * record.scale.cycle_hz;
  const double slope =
      record.slopes.dot(point.flame) * record.scale.heat_release / (turn * record.scale.pressure);
  const auto source = [&](LoopNoise which) {
    for (const FittedNoise& each : fitted.noise) {
      if (each.source == which) return each;
    }
    return FittedNoise{};
  };
  // The densities are stated at the same frequencies for each source.
  const std::vector<double> frequency_hz = fitted.noise[0].frequency_hz;
  for (std::size_t i = 1; i + 1 < frequency_hz.size(); ++i) {
    const C s(0.0, 2.0 * std::numbers::pi * frequency_hz[i]);
    C r = 0.0;
    for (const FittedMode& mode : fitted.modes) {
      const double w = 2.0 * std::numbers::pi * mode.omega_hz.value;
      r += (mode.N.value * s + mode.B.value * w) / (s * s + 2.0 * mode.xi.value * w * s + w * w);
    }
    const C f = slope * s * std::exp(-s * fitted.tau_s.value);
    const double closed = std::norm(1.0 - r * f);
    const auto density = [&](LoopNoise which) { return source(which).psd[i]; };
    const FittedNoise background = source(LoopNoise::kBackground);
    const double of_p =
        std::norm(r) * (density(LoopNoise::kCombustion) + density(LoopNoise::kDuct)) / closed +
        density(LoopNoise::kPressureSensor) +
        std::pow(background.ratio->value, 2) * background.psd[i];
    const double of_q =
        (density(LoopNoise::kCombustion) + std::norm(f * r) * density(LoopNoise::kDuct)) / closed +
        density(LoopNoise::kHeatReleaseSensor) + background.psd[i];
    // 300 segments: 4.3 deviations.
    EXPECT_NEAR(Density(simulated.pressure, loop.sampling_hz, frequency_hz[i], 2000) / of_p, 1.0,
                0.25)
        << frequency_hz[i];
    EXPECT_NEAR(Density(simulated.heat_release, loop.sampling_hz, frequency_hz[i], 2000) / of_q,
                1.0, 0.25)
        << frequency_hz[i];
  }
}

// Of passages upwards through the mean.
double MeanFrequency(const std::vector<double>& x, double sampling_hz) {
  double first = -1.0;
  double last = 0.0;
  int periods = -1;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    if (x[i] > 0.0 || x[i + 1] <= 0.0) continue;
    last = static_cast<double>(i) + x[i] / (x[i] - x[i + 1]);
    if (first < 0.0) first = last;
    ++periods;
  }
  return periods * sampling_hz / (last - first);
}

// The record is another simulator's (modal_loop.h). What a fit of it finds goes on as the record
// did.
TEST(FittedRig, TheCycleIsTheRecords) {
  const ModalLoop loop = DuctOfGain(1.5);
  const Record recorded = SimulateModalLoop(loop, 3.0, 4);
  const RecordSpectra record = SpectraOf(loop, recorded);
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, record);
  LoopPoint start = ToPoint(structure, record.flame.cols(), prior.mean);
  const LoopPoint truth = TruthOf(loop, record);
  start.modes = truth.modes;
  start.path.tau = truth.path.tau;
  start.flame = truth.flame;
  const PointFit fit = FitPoint(record, structure, prior, ToParameters(structure, start));
  ASSERT_TRUE(fit.converged);
  const LoopPoint found = ToPoint(structure, record.flame.cols(), fit.parameters);
  // Begun at half of the cycle's amplitude: that it comes to the record's is the loop's doing.
  const double amplitude = std::sqrt(2.0) * record.scale.pressure;
  const SimulatedRecord simulated =
      SimulateModal(FittedRigOf(record, structure, found, 0.5 * amplitude),
                    {.duration_s = 3.0, .sampling_hz = loop.sampling_hz, .settle_s = 1.0}, 8);
  EXPECT_NEAR(RootMeanSquare(simulated.pressure) / record.scale.pressure, 1.0, 0.01);
  EXPECT_NEAR(RootMeanSquare(simulated.heat_release) / record.scale.heat_release, 1.0, 0.01);
  const double frequency_hz = MeanFrequency(recorded.pressure, loop.sampling_hz);
  EXPECT_NEAR(MeanFrequency(simulated.pressure, loop.sampling_hz), frequency_hz,
              5e-4 * frequency_hz);
}

// A known duct whose flame is driven by this, in a cycle near 200 Hz.
struct KnownRig {
  ModalRig rig;
  double cycle_hz = 0.0;
};

KnownRig DuctDrivenBy(ModalDrive drive) {
  KnownRig out;
  ModalRig& rig = out.rig;
  rig.drive = drive;
  rig.tau_s = 0.0033;
  for (const ModalLoop::Mode& mode : DuctOfModes(2).modes) {
    rig.modes.push_back({mode.omega_hz, mode.xi, mode.a, mode.b});
  }
  // R(0) = 0, so that no mean of p is made of one of q.
  rig.modes[1].B = -rig.modes[0].B * rig.modes[1].omega_hz / rig.modes[0].omega_hz;
  const auto open = [&](double f_hz) {
    const C s(0.0, 2.0 * std::numbers::pi * f_hz);
    return DriveResponse(drive, 0.0, s) * ModalResponse(rig.modes, s) * std::exp(-s * rig.tau_s);
  };
  double gain = 0.0;
  for (double f_hz = 185.0; f_hz < 215.0; f_hz += 0.05) {
    if (std::abs(open(f_hz).imag()) > 0.02 * std::abs(open(f_hz)) ||
        std::abs(open(f_hz).real()) < std::abs(gain)) {
      continue;
    }
    gain = open(f_hz).real();
    out.cycle_hz = f_hz;
  }
  const double slope = 1.5 / gain;
  rig.flame = [slope](double v) { return std::tanh(slope * v); };
  rig.combustion = [](double f_hz) { return 2e-5 / (1.0 + std::pow(f_hz / 800.0, 4)); };
  rig.pressure_sensor = [](double) { return 1e-8; };
  rig.heat_release_sensor = [](double) { return 1e-8; };
  rig.past = {1.0, out.cycle_hz, 0.0, 0.0};
  return out;
}

TEST(FittedRig, AFitFindsTheLoopThatWasSimulated) {
  const std::array<std::pair<ModalDrive, FlameInput>, 3> inputs = {
      {{ModalDrive::kPressureRate, FlameInput::kPressureRate},
       {ModalDrive::kPressure, FlameInput::kPressure},
       {ModalDrive::kVelocity, FlameInput::kVelocity}}};
  for (const auto& [drive, input] : inputs) {
    const KnownRig known = DuctDrivenBy(drive);
    ASSERT_GT(known.cycle_hz, 0.0);
    const SimulatedRecord simulated =
        SimulateModal(known.rig, {.duration_s = 3.0, .sampling_hz = 10000.0, .settle_s = 1.0}, 11);
    const RecordSpectra record =
        MakeRecordSpectra(Record{simulated.sampling_hz, simulated.pressure, simulated.heat_release},
                          known.cycle_hz, input);
    const PointStructure structure = FreeStructure(2);
    const PointPrior prior = PriorOf(structure, record);
    LoopPoint start = ToPoint(structure, record.flame.cols(), prior.mean);
    const double turn = 2.0 * std::numbers::pi * known.cycle_hz;
    const double residue = turn * record.scale.pressure / record.scale.heat_release;
    for (std::size_t k = 0; k < 2; ++k) {
      const ResidueMode& mode = known.rig.modes[k];
      // Off by some of its standard deviations.
      start.modes[k] = {1.005 * mode.omega_hz / known.cycle_hz,
                        1.1 * mode.xi,
                        1.05 * mode.N / residue,
                        mode.B / residue,
                        0.0,
                        0.0};
    }
    start.path.tau = 1.005 * known.rig.tau_s * turn;
    start.flame = KnownFlame(record, known.rig.flame);
    const PointFit fit = FitPoint(record, structure, prior, ToParameters(structure, start));
    ASSERT_TRUE(fit.converged);
    const FittedLoop loop = FittedLoopOf(record, structure, fit);
    const auto near = [&, drive = drive](const Estimate& estimate, double value, const char* what) {
      EXPECT_LT(std::abs(estimate.value - value), 4.0 * estimate.std)
          << what << " of drive " << static_cast<int>(drive) << ": " << estimate.value << " +- "
          << estimate.std << " for " << value;
      EXPECT_LT(estimate.std, 0.2 * std::abs(value)) << what;
    };
    near(loop.tau_s, known.rig.tau_s, "tau");
    for (std::size_t k = 0; k < 2; ++k) {
      near(loop.modes[k].omega_hz, known.rig.modes[k].omega_hz, "omega");
      near(loop.modes[k].xi, known.rig.modes[k].xi, "xi");
      near(loop.modes[k].N, known.rig.modes[k].N, "N");
      near(loop.modes[k].B, known.rig.modes[k].B, "B");
    }
  }
}

}  // namespace
}  // namespace howl::fitted_rig_test
