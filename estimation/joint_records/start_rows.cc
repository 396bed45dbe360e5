// The rows of starts of which a fit of several points takes the best (records_fitter.h).
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "estimation/joint_records/best_row.h"
#include "estimation/joint_records/records_fitter.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/second_path_starts.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "estimation/record_fit/starts/richer_structure.h"

namespace howl {
namespace {

constexpr std::size_t kMostCandidates = 4;
constexpr int kIterationsOfCandidate = 30;

}  // namespace

Eigen::VectorXd RecordsFitter::StartFrom(std::size_t e, const Eigen::VectorXd& common) const {
  return WithBestFlame(points_[e].record, structure_, units_[e].FromCommon(common, base_[e].mean));
}

std::vector<std::size_t> RecordsFitter::Drawn() const {
  const std::size_t count = std::min(size(), kMostCandidates);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(i * size() / count);
  return out;
}

StartRows RecordsFitter::FromOneAnother(const std::vector<PointFit>& alone) const {
  StartRows out;
  for (const std::size_t from : Drawn()) {
    const Eigen::VectorXd common = units_[from].ToCommon(alone[from].parameters);
    std::vector<Eigen::VectorXd>& row = out.emplace_back();
    for (std::size_t e = 0; e < size(); ++e) {
      row.push_back(e == from ? alone[e].parameters : StartFrom(e, common));
    }
  }
  return out;
}

StartRows RecordsFitter::FromPoorer(const RecordsFit& poorer) const {
  StartRows out;
  for (const std::size_t from : Drawn()) {
    const std::vector<LoopMode> further = FurtherModes(points_[from].record, poorer.structure,
                                                       poorer.points[from].parameters, structure_);
    std::vector<Eigen::VectorXd> row;
    for (std::size_t e = 0; e < size(); ++e) {
      const RecordScale& at = points_[e].record.scale;
      const RecordScale& of = points_[from].record.scale;
      std::vector<LoopMode> here = further;
      const double cycle = of.cycle_hz / at.cycle_hz;
      const double residue = cycle * of.pressure / of.heat_release * at.heat_release / at.pressure;
      for (LoopMode& mode : here) {
        mode = {mode.omega * cycle, mode.xi, mode.a * residue, mode.b * residue};
      }
      row.push_back(InRicherStructure(points_[e].record, poorer.structure,
                                      poorer.points[e].parameters, structure_, here));
    }
    if (structure_.second_path && !poorer.structure.second_path) {
      StartRows rows(kSecondPathStarts, row);
      RunUnits(size(), threads_, [&](std::size_t e) {
        const std::vector<Eigen::VectorXd> starts =
            WithTwoPaths(points_[e].record, structure_, base_[e], row[e], kSecondPathStarts);
        for (std::size_t i = 0; i < rows.size(); ++i) {
          rows[i][e] = starts[std::min(i, starts.size() - 1)];
        }
      });
      out.insert(out.end(), rows.begin(), rows.end());
    } else {
      out.push_back(std::move(row));
    }
    if (further.empty()) break;
  }
  return out;
}

std::vector<PointFit> RecordsFitter::Best(const StartRows& starts,
                                          const RecordsFitOptions& options) const {
  PointFitOptions compared = kToCompare;
  compared.iterations = kIterationsOfCandidate;
  const auto on_middle = [&](std::size_t c, std::size_t e) {
    const RecordSpectra& record = points_[e].record;
    PointFit fit = KeptFit(options.units, UnitKey(options, "candidate", c, e), [&] {
      return FitPoint(MiddleOf(record), structure_, base_[e], starts[c][e], compared);
    });
    fit.parameters = BesideMiddle(record, structure_, std::move(fit.parameters));
    return fit;
  };
  const std::vector<Eigen::VectorXd> row =
      starts.size() == 1 ? starts[0] : BestRow({starts.size(), size()}, threads_, on_middle);
  PointFitOptions rough;
  rough.iterations = kIterationsOfCandidate;
  std::vector<PointFit> out(size());
  RunUnits(size(), threads_, [&](std::size_t e) {
    out[e] = KeptFit(options.units, UnitKey(options, "chosen", 0, e), [&] {
      return FitPoint(points_[e].record, structure_, base_[e], row[e], rough);
    });
  });
  return out;
}

}  // namespace howl
