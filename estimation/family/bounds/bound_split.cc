#include "estimation/family/bounds/bound_split.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "model/numerics/units.h"

namespace howl {

namespace {

constexpr double kFinest = 1e-9;            // of a root cell: no split below
constexpr std::size_t kTrials = 30;         // candidates for a split
constexpr std::size_t kTransferTrials = 6;  // where contraction is dear

// A variable that is split by ratios rather than by differences.
constexpr double kDecadesFloor = 1e-3;
constexpr double kEndless = 1e9;  // of a typical value: where a variable without an end ends
bool SpansDecades(const Interval& x) { return x.upper() > 10.0 * x.lower(); }

// The variables with the largest scores, best first.
class WidestVariables {
 public:
  struct Scored {
    double score = 0.0;
    Interval* variable = nullptr;
  };

  explicit WidestVariables(std::size_t kept) : kept_(kept) {}

  // `from`: the root's; `typical`: a value of the variable's size, in its unit. Not kept where it
  // is too fine.
  void Offer(Interval& x, const Interval& from, double weight, double typical) {
    const double width = Width(x);
    if (!std::isfinite(width) || !(width > 4e-16 * std::abs(x.upper()))) return;
    double score = width / Width(from);
    if (SpansDecades(from)) {
      const double end = kEndless * typical;
      const double floor = kDecadesFloor * (std::isfinite(from.upper()) ? from.upper() : end);
      score = std::log((x.upper() + floor) / (x.lower() + floor)) /
              std::log((std::min(from.upper(), end) + floor) / (from.lower() + floor));
    }
    Scored next{weight * score, &x};
    if (next.score <= kFinest) return;
    for (std::size_t k = 0; k < kept_; ++k) {
      if (next.score > widest_[k].score) std::swap(next, widest_[k]);
    }
  }

  // After the last there may be entries without a variable.
  std::span<const Scored> Kept() const { return {widest_.data(), kept_}; }

 private:
  std::size_t kept_;
  std::array<Scored, kTrials> widest_{};
};

// A typical size of a variable of an experiment, which is the scale of a variable without an end.
double Typical(const Experiment& experiment, CellVariable variable) {
  switch (variable) {
    case kCellOmega:
      return experiment.frequency_hz;
    case kCellGain:
      return experiment.gain;
    case kCellN:
    case kCellM:
      return kRadPerSPerHz * experiment.frequency_hz * experiment.gain;
    case kCellTau:
      return 1.0 / experiment.frequency_hz;
    default:
      return 1.0;
  }
}

void OfferAll(const BoundContext& context, const BoundQuantity& quantity, Cell& cell,
              WidestVariables& widest) {
  const CellContractor& contractor = context.contractor;
  const bool has_transfer = context.problem.HasTransfer();
  const Cell& root = context.root;
  if (contractor.HasWindow() && cell.boxes.size() > 1) {
    // Transfers fix each omega by itself.
    widest.Offer(cell.window_hz, root.window_hz, has_transfer ? 0.05 : 1.0,
                 Typical(context.problem.experiments[0], kCellOmega));
  }
  const double rest =
      quantity.expression ? 1e-3 : (contractor.TwoModes() && !has_transfer ? 0.4 : 0.1);
  for (std::size_t i = 0; i < cell.boxes.size(); ++i) {
    const bool own = quantity.DependsOn(i);
    ExperimentBox& box = cell.boxes[i];
    const ExperimentBox& from = root.boxes[i];
    const auto offer = [&](CellVariable variable, double weight) {
      widest.Offer(box[variable], from[variable], weight,
                   Typical(context.problem.experiments[i], variable));
    };
    offer(kCellXi, own ? 1.0 : rest);
    offer(kCellOmega, own ? 1.0 : rest);
    offer(kCellTangent, own ? 0.7 : 0.5 * rest);
    offer(kCellGain, own ? 0.3 : 0.1 * rest);
    if (!contractor.Targets()[i].lines_hz.empty()) offer(kCellTau, own ? 0.4 : 0.1);
    if (i == 0) {
      for (const CellVariable shared : contractor.Shared()) {
        offer(shared, 1.0);
      }
    }
  }
}

// The farther reach of the variable's two halves; -infinity where neither can hold a member.
double ReachWhenSplit(const BoundContext& context, const BoundQuantity& quantity, Cell& cell,
                      Interval& variable) {
  const Interval whole = variable;
  double reach = -kUnbounded;
  for (const Interval& half : Halves(whole)) {
    variable = half;
    Cell child = cell;
    if (context.contractor.Contract(child)) {
      reach = std::max(reach, context.Reach(quantity, child));
    }
  }
  variable = whole;
  return reach;
}

double Middle(const Interval& x) {
  if (x.lower() > 0.0 && x.upper() > 4.0 * x.lower()) return std::sqrt(x.lower() * x.upper());
  return (x.lower() == 0.0 ? 0.25 : 0.5) * (x.lower() + x.upper());
}

}  // namespace

std::array<Interval, 2> Halves(const Interval& x) {
  const double middle = Middle(x);
  return {Interval(x.lower(), middle), Interval(middle, x.upper())};
}

Interval* ChooseSplit(const BoundContext& context, const BoundQuantity& quantity, Cell& cell) {
  const std::size_t trials = context.problem.HasTransfer() ? kTransferTrials : kTrials;
  // An expression and the two-mode equations link many variables: the widest need not help.
  const bool tries = quantity.expression || context.contractor.TwoModes();
  WidestVariables widest(tries ? trials : 1);
  OfferAll(context, quantity, cell, widest);
  if (!tries) return widest.Kept().front().variable;
  Interval* best = nullptr;
  double best_reach = kUnbounded;
  for (const WidestVariables::Scored& candidate : widest.Kept()) {
    if (candidate.variable == nullptr) break;
    const double reach = ReachWhenSplit(context, quantity, cell, *candidate.variable);
    if (best == nullptr || reach < best_reach) {
      best = candidate.variable;
      best_reach = reach;
    }
  }
  return best;
}

}  // namespace howl
