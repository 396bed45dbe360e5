#include "estimation/family/bounds/bound_members.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace howl {

namespace {

constexpr std::size_t kLocalStarts = 2;

Range Around(const Interval& x) { return {x.lower(), x.upper()}; }

// The focus of the best member so far, with some of its ends changed.
DrawFocus Mutated(BoundSearch& search) {
  DrawFocus focus = search.focus;
  constexpr double kEnds[] = {0.0, 1.0, 0.5};
  for (double* const end : {&focus.xi_end, &focus.phase_end, &focus.gain_end, &focus.loop_phase_end,
                            &focus.omega_end}) {
    if (search.random.Uniform() < 0.3) *end = kEnds[search.random.Index(3)];
  }
  if (search.quantity.expression && search.random.Uniform() < 0.7) {
    const unsigned at = 6u * static_cast<unsigned>(search.random.Index(10));
    focus.pattern ^= (search.random.Next() & 63u) << at;
  }
  return focus;
}

// False where the experiment that is asked for comes out no better than the best so far, whatever
// the others do: the random numbers of the draw are then used up.
bool IsWorthDrawing(const BoundContext& context, BoundSearch& search, const DrawFocus& focus,
                    Member& models) {
  if (search.quantity.expression != nullptr) return true;  // of other experiments too
  const std::optional<Preview> preview = context.drawer->PreviewFocused(search.random, focus);
  if (!preview) return true;
  if (preview->model) {
    models.resize(context.problem.experiments.size());
    models[search.quantity.experiment] = *preview->model;
    if (search.quantity.sign * context.Value(search.quantity, models) > search.inner) return true;
  }
  search.random.SetState(preview->state);
  return false;
}

// One draw; true where it is the best so far.
bool TryFocus(const BoundContext& context, BoundSearch& search, const DrawFocus& focus,
              Member& models, DrawGlobals& globals) {
  if (!context.drawer || !context.drawer->HasSupport()) return false;
  if (!IsWorthDrawing(context, search, focus, models)) return false;
  if (!context.drawer->DrawFocused(search.random, focus, models, globals)) return false;
  const double value = search.quantity.sign * context.Value(search.quantity, models);
  if (!(value > search.inner)) return false;
  search.inner = value;
  search.witness = models;
  search.focus = focus;
  return true;
}

bool CanClimb(const BoundContext& context) {
  return context.local.IsSupported() && !context.base.empty() &&
         (context.contractor.TwoModes() || context.problem.HasTransfer());
}

}  // namespace

void DrawTowardsBound(const BoundContext& context, BoundSearch& search) {
  constexpr int kRounds = 8;
  constexpr int kDraws = 40;
  Member models;
  DrawGlobals best;
  bool any = false;
  double spread = 1.0;
  for (int round = 0; round < kRounds; ++round) {
    for (int draw = 0; draw < kDraws; ++draw) {
      DrawFocus focus = Mutated(search);
      if (any && search.random.Uniform() < 0.8) {
        const auto around = [&](double value) {
          return value > 0.0 ? Range{value / (1.0 + spread), value * (1.0 + spread)}
                             : DrawFocus::kUnset;
        };
        focus.window_hz = around(best.window_hz);
        focus.second = around(best.second);
        focus.N = around(best.N);
        focus.tau_s = around(best.tau_s);
      }
      DrawGlobals globals;
      if (TryFocus(context, search, focus, models, globals)) {
        best = globals;
        any = true;
      }
      search.focus.window_hz = search.focus.second = search.focus.N = search.focus.tau_s =
          DrawFocus::kUnset;
    }
    spread *= 0.3;
  }
}

void DrawInCell(const BoundContext& context, const Cell& cell, BoundSearch& search) {
  const int draws = context.contractor.TwoModes() ? 3 : 6;
  Member models;
  DrawGlobals globals;
  const ExperimentBox& box = cell.boxes[search.quantity.experiment];
  for (int draw = 0; draw < draws; ++draw) {
    DrawFocus focus = Mutated(search);
    focus.xi = Around(box[kCellXi]);
    if (context.contractor.HasWindow()) focus.window_hz = Around(cell.window_hz);
    for (const CellVariable shared : context.contractor.Shared()) {
      if (shared == kCellM || shared == kCellRelative) focus.second = Around(box[shared]);
      if (shared == kCellN) focus.N = Around(box[shared]);
      if (shared == kCellTau) focus.tau_s = Around(box[shared]);
    }
    const auto finite = [](Range& asked) {
      if (!std::isfinite(asked.hi) || !(asked.lo > 0.0)) asked = DrawFocus::kUnset;
    };
    finite(focus.second);
    finite(focus.N);
    TryFocus(context, search, focus, models, globals);
    search.focus.xi = search.focus.window_hz = search.focus.second = search.focus.N =
        search.focus.tau_s = DrawFocus::kUnset;
  }
}

void ClimbTowardsBound(const BoundContext& context, double scale, BoundSearch& search) {
  if (!CanClimb(context) || search.witness.empty()) return;
  MemberQuantity quantity;
  quantity.value = [&](std::span<const LoopModel> models) {
    return context.Value(search.quantity, models);
  };
  for (std::size_t i = 0; i < context.problem.experiments.size(); ++i) {
    if (search.quantity.DependsOn(i)) quantity.experiments.push_back(i);
  }
  std::vector<Member> starts{search.witness};
  for (std::size_t k = 0; k < kLocalStarts; ++k) {
    starts.push_back(context.base[search.random.Index(context.base.size())]);
  }
  for (const Member& start : starts) {
    std::optional<Member> member =
        context.local.Farthest(start, quantity, search.quantity.sign, scale);
    if (!member) continue;
    const double value = search.quantity.sign * context.Value(search.quantity, *member);
    if (!(value > search.inner)) continue;
    search.inner = value;
    search.witness = *std::move(member);
  }
}

}  // namespace howl
