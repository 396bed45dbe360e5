#include "diagnosis/budget/held_out.h"

#include <algorithm>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/samples/coherent_lines.h"

namespace howl {
namespace {

constexpr std::size_t kLeastForSets = 4;
constexpr int kIterations = 12;

std::vector<JointBand> BandsOf(const std::vector<JointBand>& bands,
                               const std::vector<std::size_t>& which) {
  std::vector<JointBand> out;
  for (const std::size_t e : which) out.push_back(bands[e]);
  return out;
}

// Every second operating point in the order of the operating parameter.
std::vector<std::vector<std::size_t>> Sets(const std::vector<JointBand>& bands) {
  std::vector<std::size_t> order(bands.size());
  for (std::size_t e = 0; e < order.size(); ++e) order[e] = e;
  if (order.size() < kLeastForSets) return {order};
  std::ranges::stable_sort(order, {},
                           [&](std::size_t e) { return bands[e].record.at.phi_position; });
  std::vector<std::vector<std::size_t>> sets(2);
  for (std::size_t i = 0; i < order.size(); ++i) sets[i % 2].push_back(order[i]);
  return sets;
}

}  // namespace

StructureFit OfPoints(const StructureFit& fit, const std::vector<std::size_t>& which) {
  StructureFit out = fit;
  out.points.clear();
  out.centres.clear();
  for (const std::size_t e : which) {
    out.points.push_back(fit.points[e]);
    out.centres.push_back(fit.centres[e]);
  }
  return out;
}

BudgetRecords MakeBudgetRecords(const std::vector<DiagnosisExperiment>& experiments,
                                const BaseModel& model) {
  BudgetRecords out;
  out.records = MakeCutRecords(experiments, model);
  const std::vector<CoherentLine> lines = FindCoherentLines(out.records);
  MaskLines(lines, &out.records);
  for (const CutRecord& record : out.records) out.whole.push_back(MakeJointBand(record));
  for (const bool second : {false, true}) {
    std::vector<CutRecord> halves = MakeCutRecords(HalfOfRecords(experiments, second), model);
    MaskLines(lines, &halves);
    for (const CutRecord& record : halves) {
      out.halves[second ? 1 : 0].push_back(MakeJointBand(record));
    }
  }
  return out;
}

HeldOutScore ScoreHeldOut(const BudgetRecords& records, const StructureFit& fit) {
  HeldOutScore out;
  out.nats.resize(records.whole.size());
  out.errors.resize(records.whole.size());
  const std::vector<std::vector<std::size_t>> sets = Sets(records.whole);
  StructureOptions options;
  options.iterations = kIterations;
  for (std::size_t half = 0; half < 2; ++half) {
    const std::size_t other_half = 1 - half;
    std::vector<std::vector<JointBand>> bands;
    std::vector<SharedLoop> shared;
    for (const std::vector<std::size_t>& set : sets) {
      bands.push_back(BandsOf(records.halves[half], set));
      shared.push_back(FitStructure(bands.back(), OfPoints(fit, set), options).shared);
    }
    for (std::size_t s = 0; s < sets.size(); ++s) {
      StructureFit own = OfPoints(fit, sets[s]);
      own.shared = shared[sets.size() - 1 - s];
      StructureOptions own_options = options;
      own_options.shared_fixed = true;
      own = FitStructure(bands[s], own, own_options);
      const EffectPointer joined = own.structure.Joined();
      for (std::size_t i = 0; i < sets[s].size(); ++i) {
        const std::size_t e = sets[s][i];
        const JointBand& band = records.halves[other_half][e];
        PointLoop& point = own.points[i];
        const JointResiduals residuals = MakeJointResiduals(band, *joined, own.shared, point);
        const JointEvaluation at =
            EvaluateWithItsFlame(band, own.structure.noise, own.shared, residuals, &point);
        out.nats[e][other_half] = at.log_likelihood;
        out.errors[e][other_half] = PredictionErrors(band, residuals, at);
      }
    }
  }
  return out;
}

}  // namespace howl
