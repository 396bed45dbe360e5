#include "estimation/family/bounds/enclose.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <utility>

#include "estimation/family/bounds/bound_context.h"
#include "estimation/family/bounds/bound_search.h"
#include "estimation/family/bounds/bound_step.h"
#include "estimation/family/bounds/bound_text.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

std::size_t DefaultMaxCells(const FamilyProblem& problem) {
  return problem.model.modes == 1 ? 4000
                                  : std::max<std::size_t>(60, 400 / problem.experiments.size());
}

// sign * outer, of an interrupted search too.
double OuterOf(const BoundContext& context, const BoundSearch& search) {
  if (search.state == SearchState::kNew) {
    return context.root_empty ? -kUnbounded : context.Reach(search.quantity, context.root);
  }
  return search.state == SearchState::kRunning ? OuterSoFar(search) : search.outer;
}

// A search also ends where its cells are too fine to split, short of the stated width.
bool MeetsWidth(const BoundLimits& limits, const BoundSearch& search) {
  return search.state == SearchState::kClosed &&
         (search.outer == search.inner ||
          search.outer - search.inner <=
              BoundTolerance(limits, search) + 2.0 * kBoundRounding * std::abs(search.outer));
}

}  // namespace

double EnclosedBound::Excess() const {
  const double excess = (inner.lo - outer.lo) + (outer.hi - inner.hi);
  const double range = inner.hi - inner.lo;
  // A parameter that is held at one value has no range: rounding is no share of it.
  if (std::abs(excess) <= 1e-9 * std::abs(outer.hi)) return range > 0.0 ? excess / range : 0.0;
  return excess / range;
}

struct Enclosure::Impl {
  EncloseOptions options;
  BoundContext context;
  BoundLimits limits;
  // Two for each quantity, the lower and the upper end: parameters, then expressions.
  std::vector<BoundSearch> searches;
  std::size_t first_expression = 0;

  Impl(const FamilyProblem& problem, const EncloseOptions& asked)
      : options(asked),
        context(problem, asked.seed),
        limits{asked.width, asked.max_cells != 0 ? asked.max_cells : DefaultMaxCells(problem)} {
    for (std::size_t i = 0; options.parameters && i < problem.experiments.size(); ++i) {
      for (const FamilyParameter parameter : kFamilyParameters) {
        if (!HasParameter(problem, i, parameter)) continue;
        // One search serves all experiments that share a parameter.
        const bool shared = IsSharedParameter(problem, parameter);
        if (shared && i > 0) continue;
        AddBothEnds(context, {.experiment = i, .parameter = parameter, .shared = shared}, searches);
      }
    }
    first_expression = searches.size();
    for (const BoundedExpression& bounded : options.expressions) {
      AddBothEnds(context, {.experiment = bounded.experiment, .expression = &bounded.expression},
                  searches);
    }
  }

  EnclosedBound BoundAt(std::size_t lower_end) const {
    const BoundSearch& lower = searches[lower_end];
    const BoundSearch& upper = searches[lower_end + 1];
    return {.outer = {0.0 - OuterOf(context, lower), OuterOf(context, upper)},
            .inner = {0.0 - lower.inner, upper.inner},
            .closed = MeetsWidth(limits, lower) && MeetsWidth(limits, upper)};
  }
};

Enclosure::Enclosure(const FamilyProblem& problem, const EncloseOptions& options)
    : impl_(std::make_unique<Impl>(problem, options)) {}
Enclosure::~Enclosure() = default;

bool Enclosure::Run(const std::function<bool()>& interrupted,
                    const std::function<bool(std::size_t)>& owned) {
  std::vector<std::size_t> units;
  for (std::size_t k = 0; k < Searches(); ++k) {
    if (!owned || owned(k)) units.push_back(k);
  }
  RunUnits(units.size(), impl_->options.threads, [&](std::size_t unit) {
    BoundSearch& search = impl_->searches[units[unit]];
    while (!search.IsDone()) {
      if (interrupted && interrupted()) return;
      StepBound(impl_->context, impl_->limits, search);
    }
  });
  const bool complete =
      std::ranges::all_of(units, [&](std::size_t k) { return impl_->searches[k].IsDone(); });
  if (complete) {
    const CellCounts cells = Counts();
    VLOG(1) << "bounds: " << impl_->searches.size() << " ends; of the boxes " << cells.inside
            << " hold members alone, " << cells.outside << " none, "
            << cells.undecided + cells.pending << " are undecided";
  }
  return complete;
}

std::size_t Enclosure::Searches() const { return impl_->searches.size(); }

bool Enclosure::IsComplete() const {
  return std::all_of(impl_->searches.begin(), impl_->searches.end(),
                     [](const BoundSearch& search) { return search.IsDone(); });
}

bool Enclosure::IsBounded(std::size_t experiment, FamilyParameter parameter) const {
  return HasParameter(impl_->context.problem, experiment, parameter);
}

EnclosedBound Enclosure::Bound(std::size_t experiment, FamilyParameter parameter) const {
  for (std::size_t k = 0; k < impl_->first_expression; k += 2) {
    const BoundQuantity& quantity = impl_->searches[k].quantity;
    if (quantity.parameter != parameter) continue;
    if (quantity.experiment == experiment || quantity.shared) {
      return impl_->BoundAt(k);
    }
  }
  return {};
}

EnclosedBound Enclosure::BoundOfExpression(std::size_t k) const {
  return impl_->BoundAt(impl_->first_expression + 2 * k);
}

CellCounts Enclosure::Counts() const {
  CellCounts sum;
  for (const BoundSearch& search : impl_->searches) {
    sum.inside += search.counts.inside;
    sum.outside += search.counts.outside;
    sum.undecided += search.counts.undecided;
    sum.pending +=
        search.counts.pending + search.heap.size() + (search.state == SearchState::kNew ? 1 : 0);
  }
  return sum;
}

bool Enclosure::IsProvedEmpty() const {
  return std::any_of(impl_->searches.begin(), impl_->searches.end(), [](const BoundSearch& search) {
    return search.state == SearchState::kClosed && search.witness.empty() &&
           search.outer == -kUnbounded;
  });
}

std::vector<Member> Enclosure::Witnesses() const {
  std::vector<Member> members;
  for (const BoundSearch& search : impl_->searches) {
    if (!search.witness.empty()) members.push_back(search.witness);
  }
  return members;
}

void Enclosure::Save(std::ostream& out) const {
  out << SavedHead();
  for (std::size_t k = 0; k < Searches(); ++k) out << SavedSearch(k);
}

std::string Enclosure::SavedHead() const {
  return BoundSearchHead(impl_->context.problem.experiments.size(), Searches());
}

std::string Enclosure::SavedSearch(std::size_t k) const {
  return BoundSearchText(impl_->searches[k]);
}

bool Enclosure::Load(std::istream& in) {
  return ReadBoundSearches(in, impl_->context.problem.experiments.size(), impl_->searches)
      .has_value();
}

}  // namespace howl
