#include "diagnosis/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/gap/gap.h"
#include "diagnosis/samples/gain_fluctuation.h"
#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/samples/static_map.h"

namespace howl {
namespace {

constexpr double kBand = 0.2;                 // of the cycle's frequency
constexpr std::size_t kFewestSamples = 2048;  // of a half
constexpr double kKnownLine = 0.25;

bool Contains(const std::vector<DiagnosisExperiment>& reference, const DiagnosisExperiment& rig) {
  return std::any_of(reference.begin(), reference.end(), [&](const DiagnosisExperiment& each) {
    return each.name == rig.name || IsSamePhi(each.phi, rig.phi);
  });
}

// The gain that a free complex factor in each band still has, added to the band's grid points.
class BandGains {
 public:
  explicit BandGains(Eigen::Index grid) : sum_(Eigen::VectorXd::Zero(grid)), count_(sum_) {}

  void Add(const CutRecord& record, const Eigen::VectorXcd& predicted,
           const Eigen::VectorXcd& residual, const Eigen::VectorXd& variance) {
    const double cycle = record.at.cycle_frequency_hz;
    const Eigen::Index bands = BandOf(sum_.size() - 1) + 1;
    Eigen::VectorXcd product = Eigen::VectorXcd::Zero(bands);
    Eigen::VectorXd norm = Eigen::VectorXd::Zero(bands);
    for (Eigen::Index k = 0; k < residual.size(); ++k) {
      if (record.masked[static_cast<std::size_t>(k)]) continue;
      const auto b =
          std::min<Eigen::Index>(std::lround(record.frequency(k) / cycle / kBand), bands - 1);
      product[b] += std::conj(predicted[k]) * residual[k] / variance[k];
      norm[b] += std::norm(predicted[k]) / variance[k];
    }
    for (Eigen::Index i = 0; i < sum_.size(); ++i) {
      const Eigen::Index b = BandOf(i);
      if (norm[b] <= 0.0) continue;
      sum_[i] += std::norm(product[b]) / norm[b] / kBinCorrelation;
      count_[i] += 1.0;
    }
  }

  Eigen::VectorXd Means() const {
    Eigen::VectorXd out = Eigen::VectorXd::Ones(sum_.size());
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      if (count_[i] > 0.0) out[i] = sum_[i] / count_[i];
    }
    return out;
  }

 private:
  // Bands are centred on multiples of their width, and so on the cycle's harmonics.
  static Eigen::Index BandOf(Eigen::Index grid_point) {
    return std::lround(static_cast<double>(grid_point) * kReferenceStep / kBand);
  }
  Eigen::VectorXd sum_;
  Eigen::VectorXd count_;
};

struct SelfTest {
  BandGains acoustic;
  BandGains flame;
  double gap_squared = 0.0;
  double tests = 0.0;
  std::vector<double> fluctuation_gains;

  // records: with what another part of the reference predicts of them.
  void Add(const std::vector<CutRecord>& records) {
    const EffectFit fit = FitBase(records);
    std::vector<Eigen::VectorXd> flame_noise;
    for (std::size_t e = 0; e < records.size(); ++e) {
      const ExperimentFit& at = fit.experiments[e];
      acoustic.Add(records[e], records[e].windowed_pressure - at.acoustic_residual,
                   at.acoustic_residual, at.acoustic_noise);
      flame.Add(records[e],
                records[e].windowed_heat_release.head(records[e].flame_count) - at.flame_residual,
                at.flame_residual, at.flame_noise);
      flame_noise.push_back(at.flame_noise);
    }
    const double gap = Gap(ComputeGapParts(records, fit.experiments, flame_noise, true));
    gap_squared += gap * gap;
    tests += 1.0;
    fluctuation_gains.push_back(EstimateGainFluctuation(records, fit).gain);
  }
};

// V_A without a model: the variance that the record's own smooth transfer from q to p leaves over.
void SetSensorNoise(const std::vector<DiagnosisExperiment>& experiments,
                    std::vector<CutRecord>* records, const EffectFit& base) {
  const std::vector<ReferencePoint> own = DescribeReference(experiments, *records, base);
  for (std::size_t e = 0; e < records->size(); ++e) {
    CutRecord with = (*records)[e];
    PutReference(own[e], &with);
    (*records)[e].sensor_noise = with.reference.acoustic_shape;
  }
}

Eigen::VectorXd Share(const CutRecord& record, const Eigen::VectorXd& kappa, Eigen::Index count) {
  Eigen::VectorXd out(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto i = static_cast<Eigen::Index>(
        std::lround(record.frequency(k) / record.at.cycle_frequency_hz / kReferenceStep));
    out[k] = 1.0 / std::max(kappa[std::min(i, kappa.size() - 1)], 1.0);
  }
  return out;
}

double Samples(const std::vector<DiagnosisExperiment>& experiments) {
  double sum = 0.0;
  for (const DiagnosisExperiment& each : experiments) {
    sum += static_cast<double>(each.record.pressure.size());
  }
  return sum;
}

// The bias by noise in q is the same in reference and rig, and therefore no evidence.
std::vector<CutRecord> CutAsRecorded(const std::vector<DiagnosisExperiment>& experiments,
                                     const BaseModel& model) {
  std::vector<CutRecord> records = MakeCutRecords(experiments, model);
  for (CutRecord& record : records) DriveAsRecorded(&record);
  return records;
}

}  // namespace

void KeepReference(const std::vector<CutRecord>& from, std::vector<CutRecord>* to) {
  for (std::size_t e = 0; e < from.size(); ++e) {
    if (from[e].reference.acoustic.size() == (*to)[e].extended()) {
      (*to)[e].reference = from[e].reference;
      DriveAsRecorded(&(*to)[e]);
      (*to)[e].flame_share = from[e].flame_share;
    }
  }
}

std::vector<CoherentLine> NewLines(const std::vector<CoherentLine>& lines,
                                   const std::vector<CoherentLine>& known) {
  std::vector<CoherentLine> out;
  for (const CoherentLine& line : lines) {
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const CoherentLine& other) {
      return std::abs(other.frequency_hz - line.frequency_hz) < 2.0 &&
             other.strength >= kKnownLine * line.strength;
    });
    if (!is_known) out.push_back(line);
  }
  return out;
}

ReferenceModel AbsorbReference(const std::vector<DiagnosisExperiment>& reference,
                               const std::vector<DiagnosisExperiment>& rig,
                               std::vector<CutRecord>* records) {
  ReferenceModel out;
  std::vector<CutRecord> own = CutAsRecorded(reference, (*records)[0].model);
  out.lines = FindCoherentLines(own);
  MaskLines(out.lines, &own);
  const EffectFit base = FitBase(own);
  out.points = DescribeReference(reference, own, base);
  SetSensorNoise(reference, &own, base);
  const Eigen::Index grid = out.points[0].acoustic.size();
  SelfTest test{BandGains(grid), BandGains(grid)};
  const bool paired = std::all_of(rig.begin(), rig.end(), [&](const DiagnosisExperiment& each) {
    return Contains(reference, each);
  });
  const bool halves =
      std::all_of(reference.begin(), reference.end(), [](const DiagnosisExperiment& each) {
        return each.record.pressure.size() >= 2 * kFewestSamples;
      });
  const double data_ratio = Samples(rig) / Samples(reference);
  const double length_ratio =
      data_ratio * static_cast<double>(reference.size()) / static_cast<double>(rig.size());
  // The ratio of the lengths of the predicted and the predicting record in the self-test.
  double fluctuation_scale = data_ratio;
  if (paired && halves) {
    std::vector<CutRecord> part[2];
    std::vector<ReferencePoint> described[2];
    for (const int i : {0, 1}) {
      const std::vector<DiagnosisExperiment> half = HalfOfRecords(reference, i == 1);
      part[i] = CutAsRecorded(half, (*records)[0].model);
      MaskLines(FindCoherentLines(part[i]), &part[i]);
      const EffectFit fit = FitBase(part[i]);
      described[i] = DescribeReference(half, part[i], fit);
      SetSensorNoise(half, &part[i], fit);
    }
    for (const int i : {0, 1}) {
      for (std::size_t e = 0; e < part[i].size(); ++e) {
        PutReference(described[1 - i][e], &part[i][e]);
      }
      test.Add(part[i]);
    }
    fluctuation_scale *= 2.0;
  } else if (!paired && reference.size() > 1) {
    for (std::size_t e = 0; e < own.size(); ++e) {
      std::vector<ReferencePoint> others = out.points;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
      PutReference(PointAt(others, "", reference[e].phi), &own[e]);
    }
    test.Add(own);
  }
  const double noise_alone = 1.0 + length_ratio;
  const auto kappa = [&](const BandGains& gains) -> Eigen::VectorXd {
    if (test.tests == 0.0) return Eigen::VectorXd::Constant(grid, noise_alone);
    // In the self-test, predicted and predicting records are as long as each other.
    return (gains.Means() * 0.5 * noise_alone).cwiseMax(noise_alone);
  };
  out.acoustic_kappa = kappa(test.acoustic);
  out.flame_kappa = kappa(test.flame);
  if (test.tests > 0.0) out.gap_floor = std::sqrt(test.gap_squared / test.tests);
  if (!test.fluctuation_gains.empty()) {
    const auto [least, most] =
        std::minmax_element(test.fluctuation_gains.begin(), test.fluctuation_gains.end());
    out.fluctuation_gain = fluctuation_scale * (*most + 2.0 * (*most - *least));
  }

  // The reference's own flags are found as the rig's are.
  for (std::size_t e = 0; e < own.size(); ++e) {
    PutReference(out.points[e], &own[e]);
    own[e].reference.acoustic_share = Share(own[e], out.acoustic_kappa, own[e].acoustic_count);
    own[e].flame_share =
        own[e].flame_share.cwiseProduct(Share(own[e], out.flame_kappa, own[e].flame_count)).eval();
  }
  const EffectFit absorbed = FitBase(own);
  if (test.fluctuation_gains.empty()) {
    out.fluctuation_gain = 2.0 * fluctuation_scale * EstimateGainFluctuation(own, absorbed).gain;
  }
  const ClippingFit p = FitClipping(own, Channel::kPressure, absorbed);
  const ClippingFit q = FitClipping(own, Channel::kHeatRelease, absorbed);
  out.pressure_clipping_gain = data_ratio * p.gain;
  out.heat_release_clipping_gain = data_ratio * q.gain;
  out.pressure_sharp_edge = p.sharp_edge;
  out.heat_release_sharp_edge = q.sharp_edge;
  const FewLevels levels = FindQuantisation(own);
  if (levels.found) out.quantisation_levels = levels.levels;

  for (CutRecord& record : *records) DriveAsRecorded(&record);
  MaskLines(out.lines, records);
  const EffectFit plain = FitBase(*records);
  SetSensorNoise(rig, records, plain);
  for (std::size_t e = 0; e < records->size(); ++e) {
    CutRecord& record = (*records)[e];
    PutReference(PointAt(out.points, rig[e].name, rig[e].phi), &record);
    record.reference.acoustic_share = Share(record, out.acoustic_kappa, record.acoustic_count);
    record.flame_share =
        record.flame_share.cwiseProduct(Share(record, out.flame_kappa, record.flame_count)).eval();
  }
  return out;
}

}  // namespace howl
