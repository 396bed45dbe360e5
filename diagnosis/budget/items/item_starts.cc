#include "diagnosis/budget/items/item_starts.h"

#include <glog/logging.h>

#include <algorithm>

#include "diagnosis/budget/items/mode_starts.h"
#include "diagnosis/fit/fit_starts.h"

namespace howl {
namespace {

// A source that is added begins at a tenth of the power that the base leaves to it.
constexpr double kFirstShare = -2.3;
// A model error that made up for an effect would hide it: the search for an effect's parameters
// begins with less of it.
constexpr double kErrorAtStart = 0.2;

// A term for the source with at least so many coefficients, added or lengthened.
StructureFit WithNoise(const StructureFit& from, const NoiseTerm& added) {
  StructureFit out = from;
  std::vector<NoiseTerm>& noise = out.structure.noise;
  const auto same = std::ranges::find(noise, added.source, &NoiseTerm::source);
  if (same == noise.end()) {
    noise.push_back(added);
    for (std::size_t e = 0; e < out.points.size(); ++e) {
      Eigen::VectorXd start = Eigen::VectorXd::Zero(added.coefficients);
      // The combustion's spectrum in units of q is a source of the same kind in the duct, which
      // stands in the same units (noise_sources.h).
      const Eigen::VectorXd& combustion = from.points[e].noise[0];
      const Eigen::Index shared = std::min(start.size(), combustion.size());
      start.head(shared) = combustion.head(shared);
      start[0] += kFirstShare;
      out.points[e].noise.push_back(start);
      out.centres[e].noise.push_back(start);
    }
    return out;
  }
  const auto j = static_cast<std::size_t>(same - noise.begin());
  const Eigen::Index was = same->coefficients;
  same->coefficients = std::max(was, added.coefficients);
  for (std::vector<PointLoop>* all : {&out.points, &out.centres}) {
    for (PointLoop& point : *all) {
      Eigen::VectorXd& c = point.noise[j];
      c.conservativeResize(same->coefficients);
      c.tail(same->coefficients - was).setZero();
    }
  }
  return out;
}

// Finite values next to the effect's null, within its bounds, where a fit can begin that never ends
// below the structure without the effect.
std::vector<double> AlmostNull(const Effect& effect) {
  std::vector<double> out;
  for (const EffectParameter& p : effect.parameters()) {
    out.push_back(std::clamp(p.null_value, p.low, p.high));
  }
  return out;
}

}  // namespace

std::vector<StructureFit> StartsWith(const std::vector<JointBand>& bands, const StructureFit& from,
                                     const BudgetItem& item) {
  switch (item.kind) {
    case ItemKind::kNoise:
      return {WithNoise(from, item.noise)};
    case ItemKind::kComplexResidues: {
      StructureFit out = from;
      out.structure.complex_residues = true;
      const int modes = bands[0].record.model.modes;
      for (std::vector<PointLoop>* all : {&out.points, &out.centres}) {
        for (PointLoop& point : *all) point.base_b = Eigen::VectorXd::Zero(modes);
      }
      return {out};
    }
    case ItemKind::kMode:
      return ModeStarts(bands, from);
    case ItemKind::kEffect:
      break;
  }
  LOG(FATAL) << "an effect has starts of its own: " << item.id;
}

std::vector<EffectStart> EffectStarts(const LoopStructure& structure, const BudgetItem& item) {
  // A search on a grid knows the base's modes alone.
  const bool grid = structure.further_modes == 0 && !structure.complex_residues;
  std::vector<EffectStart> out;
  for (const EffectPointer& form : item.forms) {
    out.push_back({form, AlmostNull(*form)});
    if (!item.fitted.empty()) {
      out.push_back({form, item.fitted});
      continue;
    }
    for (const std::vector<double>& values : StartValues(*form, {})) {
      out.push_back({form, values, true, false});
      if (grid && form->ChangesAcousticCut()) out.push_back({form, values, true, true});
    }
  }
  return out;
}

StructureFit StartWith(const std::vector<JointBand>& bands, const StructureFit& from,
                       const EffectStart& start) {
  StructureFit out = from;
  out.structure.effects.push_back(start.form);
  out.shared.values.insert(out.shared.values.end(), start.values.begin(), start.values.end());
  std::vector<EffectContext> points;
  for (const JointBand& band : bands) points.push_back(band.record.at);
  out.shared.tau_s = CorrectedDelay(points, *start.form, start.values, from.shared.tau_s);
  if (!start.of_catalogue) return out;
  out.shared.eps_a *= kErrorAtStart;
  out.shared.eps_b *= kErrorAtStart;
  if (!start.new_acoustics) return out;
  const EffectPointer joined = out.structure.Joined();
  for (std::size_t e = 0; e < bands.size(); ++e) {
    const std::vector<AcousticLocals> best =
        AcousticStarts(bands[e].record, *joined, out.shared.values, 1);
    if (!best.empty()) out.points[e].acoustics = best[0];
  }
  return out;
}

}  // namespace howl
