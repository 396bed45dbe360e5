#include "estimation/family/enclose.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <string>

#include "estimation/family/contract.h"
#include "estimation/family/enumerate.h"
#include "estimation/family/inside.h"
#include "estimation/family/local_search.h"
#include "estimation/family/transfer_starts.h"
#include "estimation/family/two_mode_tradeoff.h"
#include "estimation/parallel.h"
#include "model/loop.h"

namespace howl {

namespace {

constexpr double kRounding = 1e-12;         // of a bound: the test itself is evaluated in doubles
constexpr double kFinest = 1e-9;            // of a root cell: no split below
constexpr std::size_t kTrials = 30;         // candidates for a split
constexpr std::size_t kTransferTrials = 6;  // where contraction is dear
constexpr std::size_t kBaseMembers = 1000;
constexpr std::size_t kLocalStarts = 2;

CellVariable VariableOf(FamilyParameter parameter) {
  switch (parameter) {
    case FamilyParameter::kOmega:
      return kCellOmega;
    case FamilyParameter::kXi:
      return kCellXi;
    case FamilyParameter::kN:
      return kCellN;
    case FamilyParameter::kM:
      return kCellM;
    case FamilyParameter::kTau:
      return kCellTau;
    case FamilyParameter::kLoopGain:
      return kCellGain;
  }
  return kCellOmega;
}

// A variable that is split by ratios rather than by differences.
constexpr double kDecadesFloor = 1e-3;
bool SpansDecades(const Interval& x) { return x.upper() > 10.0 * x.lower(); }

enum class SearchState { kNew, kRunning, kClosed, kBudget };

struct BoundSearch {
  std::size_t experiment = 0;
  FamilyParameter parameter = FamilyParameter::kOmega;
  double sign = 1.0;                       // +1: upper end
  const Expression* expression = nullptr;  // in the parameter's place
  SearchState state = SearchState::kNew;
  double inner = -kUnbounded;    // sign * value, of a member
  double settled = -kUnbounded;  // sign * reach of cells too fine to split
  double outer = kUnbounded;     // sign * value
  Member witness;
  DrawFocus focus;  // of the best member
  UnitRandom random{0, 0};
  std::vector<Cell> heap;
  CellCounts counts;
  std::size_t cells = 0;
};

bool ReachesLess(const Cell& a, const Cell& b) { return a.bound < b.bound; }

Range Around(const Interval& x) { return {x.lower(), x.upper()}; }

}  // namespace

double ParameterValue(const Experiment& experiment, const LoopModel& model,
                      FamilyParameter parameter) {
  switch (parameter) {
    case FamilyParameter::kOmega:
      return model.omega_hz;
    case FamilyParameter::kXi:
      return model.xi;
    case FamilyParameter::kN:
      return model.N;
    case FamilyParameter::kM:
      return model.M;
    case FamilyParameter::kTau:
      return model.tau_s;
    case FamilyParameter::kLoopGain:
      break;
  }
  return experiment.flame_slope
             ? LoopGain(model.Loop(), experiment.frequency_hz, *experiment.flame_slope)
             : std::numeric_limits<double>::quiet_NaN();
}

double EnclosedBound::Excess() const {
  return ((inner.lo - outer.lo) + (outer.hi - inner.hi)) / (inner.hi - inner.lo);
}

struct Enclosure::Impl {
  FamilyProblem problem;
  EncloseOptions options;
  CellContractor contractor;
  std::unique_ptr<MemberDrawer> drawer;  // none where transfers leave it nothing to meet
  LocalSearch local;
  std::vector<BoundSearch> searches;
  std::vector<double> range;  // of each search's parameter over the base members
  Enumeration base;
  std::size_t first_expression = 0;
  Cell root;
  bool root_empty;

  Impl(const FamilyProblem& p, const EncloseOptions& o)
      : problem(p), options(o), contractor(p), local(p), root(contractor.Root()) {
    root_empty = !contractor.Contract(root);
    if (!NeedsTransferStarts(problem)) drawer = std::make_unique<MemberDrawer>(problem);
    if (options.max_cells == 0) {
      options.max_cells = problem.model.modes == 1
                              ? 4000
                              : std::max<std::size_t>(60, 400 / problem.experiments.size());
    }
    base = EnumerateMembers(problem, kBaseMembers, options.seed, 1);
    if (HasGreedyTradeoff(problem)) {
      for (Member& member : ExtremeMembers(problem)) base.members.push_back(std::move(member));
    }
    for (std::size_t i = 0; options.parameters && i < problem.experiments.size(); ++i) {
      for (const FamilyParameter parameter : kFamilyParameters) {
        BoundSearch search;
        search.experiment = i;
        search.parameter = parameter;
        if (Has(i, parameter)) Add(search);
      }
    }
    first_expression = searches.size();
    for (const BoundedExpression& bounded : options.expressions) {
      BoundSearch search;
      search.experiment = bounded.experiment;
      search.expression = &bounded.expression;
      Add(search);
    }
  }

  // Both ends.
  void Add(BoundSearch search) {
    double lo = kUnbounded, hi = -kUnbounded;
    std::size_t lowest = 0, highest = 0;
    for (std::size_t k = 0; k < base.members.size(); ++k) {
      const double value = Value(search, base.members[k]);
      if (value < lo) lo = value, lowest = k;
      if (value > hi) hi = value, highest = k;
    }
    search.focus.experiment = search.experiment;
    for (const double sign : {-1.0, 1.0}) {
      search.sign = sign;
      search.random = UnitRandom(options.seed, 0x100000 + searches.size());
      if (lo <= hi) {
        search.inner = sign > 0.0 ? hi : -lo;
        search.witness = base.members[sign > 0.0 ? highest : lowest];
      }
      range.push_back(lo < hi ? hi - lo : (lo == hi ? 1e-6 * std::abs(lo) : 0.0));
      searches.push_back(search);
    }
  }

  double Value(const BoundSearch& search, std::span<const LoopModel> models) const {
    const std::size_t i = search.experiment;
    return search.expression ? search.expression->Evaluate(problem.experiments, models, i)
                             : ParameterValue(problem.experiments[i], models[i], search.parameter);
  }

  bool Has(std::size_t i, FamilyParameter parameter) const {
    if (parameter == FamilyParameter::kLoopGain) {
      return problem.experiments[i].flame_slope.has_value();
    }
    if (parameter == FamilyParameter::kM) return problem.model.modes == 2;
    return true;
  }

  // The sign * value that the cell reaches.
  double Reach(const BoundSearch& search, const Cell& cell) const {
    if (search.expression) {
      const RoundingGuard guard;
      const Interval value = search.expression->Evaluate(
          problem.experiments, cell, problem.model.harmonic_ratio, search.experiment);
      return search.sign > 0.0 ? value.upper() : -value.lower();
    }
    Interval value = cell.boxes[search.experiment][VariableOf(search.parameter)];
    if (search.parameter == FamilyParameter::kLoopGain) {
      const RoundingGuard guard;
      const double slope = std::abs(*problem.experiments[search.experiment].flame_slope);
      value = value * contractor.Targets()[search.experiment].w_rad_s * Interval(slope);
    }
    return search.sign > 0.0 ? value.upper() : -value.lower();
  }

  // Draws a member towards the bound; keeps it when it is the best so far.
  bool TryFocus(BoundSearch& search, const DrawFocus& focus, Member& models,
                DrawGlobals& globals) const {
    if (!drawer || !drawer->HasSupport() ||
        !drawer->DrawFocused(search.random, focus, models, globals)) {
      return false;
    }
    const double value = search.sign * Value(search, models);
    if (!(value > search.inner)) return false;
    search.inner = value;
    search.witness = models;
    search.focus = focus;
    return true;
  }

  bool IsLocal() const {
    return local.IsSupported() && !base.members.empty() &&
           (contractor.TwoModes() || problem.HasTransfer());
  }

  // From the best member found and from some others to the farthest that a local search reaches.
  void SearchLocally(BoundSearch& search, double scale) const {
    if (!IsLocal() || search.witness.empty()) return;
    MemberQuantity quantity;
    quantity.value = [this, &search](std::span<const LoopModel> models) {
      return Value(search, models);
    };
    for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
      if (search.expression ? search.expression->DependsOn(i, search.experiment)
                            : i == search.experiment) {
        quantity.experiments.push_back(i);
      }
    }
    std::vector<Member> starts{search.witness};
    for (std::size_t k = 0; k < kLocalStarts; ++k) {
      starts.push_back(base.members[search.random.Index(base.members.size())]);
    }
    for (const Member& start : starts) {
      std::optional<Member> member = local.Farthest(start, quantity, search.sign, scale);
      if (!member) continue;
      const double value = search.sign * Value(search, *member);
      if (!(value > search.inner)) continue;
      search.inner = value;
      search.witness = *std::move(member);
    }
  }

  // The best choice of ends so far, with some of them changed.
  DrawFocus Mutated(BoundSearch& search) const {
    DrawFocus focus = search.focus;
    constexpr double kEnds[] = {0.0, 1.0, 0.5};
    for (double* const end : {&focus.xi_end, &focus.phase_end, &focus.gain_end,
                              &focus.loop_phase_end, &focus.omega_end}) {
      if (search.random.Uniform() < 0.3) *end = kEnds[search.random.Index(3)];
    }
    if (search.expression && search.random.Uniform() < 0.7) {
      const unsigned at = 6u * static_cast<unsigned>(search.random.Index(10));
      focus.pattern ^= (search.random.Next() & 63u) << at;
    }
    return focus;
  }

  // A member towards the bound: ends of the tolerances at random, and what is shared by all
  // experiments drawn from ranges that shrink around the best.
  void SearchMember(BoundSearch& search) const {
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
        if (TryFocus(search, focus, models, globals)) {
          best = globals;
          any = true;
        }
        search.focus.window_hz = search.focus.second = search.focus.N = search.focus.tau_s =
            DrawFocus::kUnset;
      }
      spread *= 0.3;
    }
  }

  // A member within the part of the cell that all experiments share.
  void SearchMember(BoundSearch& search, const Cell& cell) const {
    const int draws = contractor.TwoModes() ? 3 : 6;
    Member models;
    DrawGlobals globals;
    const ExperimentBox& box = cell.boxes[search.experiment];
    for (int draw = 0; draw < draws; ++draw) {
      DrawFocus focus = Mutated(search);
      focus.xi = Around(box[kCellXi]);
      if (contractor.HasWindow()) focus.window_hz = Around(cell.window_hz);
      for (const CellVariable shared : contractor.Shared()) {
        if (shared == kCellM || shared == kCellRelative) focus.second = Around(box[shared]);
        if (shared == kCellN) focus.N = Around(box[shared]);
        if (shared == kCellTau) focus.tau_s = Around(box[shared]);
      }
      const auto finite = [](Range& asked) {
        if (!std::isfinite(asked.hi) || !(asked.lo > 0.0)) asked = DrawFocus::kUnset;
      };
      finite(focus.second);
      finite(focus.N);
      TryFocus(search, focus, models, globals);
      search.focus.xi = search.focus.window_hz = search.focus.second = search.focus.N =
          search.focus.tau_s = DrawFocus::kUnset;
    }
  }

  void Push(BoundSearch& search, Cell&& cell) const {
    cell.bound = Reach(search, cell);
    if (cell.bound <= search.inner) {
      ++search.counts.undecided;
      return;
    }
    search.heap.push_back(std::move(cell));
    std::push_heap(search.heap.begin(), search.heap.end(), ReachesLess);
  }

  // The variable to split; nullptr below the finest. Of the widest, relative to the root's, the one
  // whose halves reach least far (an expression may depend on many), or simply the widest.
  Interval* ChooseSplit(const BoundSearch& search, Cell& cell, const Cell& start) const {
    std::array<std::pair<double, Interval*>, kTrials> widest{};
    const std::size_t trials = problem.HasTransfer() ? kTransferTrials : kTrials;
    const std::size_t kept = search.expression || contractor.TwoModes() ? trials : 1;
    const auto offer = [&](Interval& x, const Interval& from, double weight) {
      const double width = Width(x);
      if (!std::isfinite(width) || !(width > 4e-16 * std::abs(x.upper()))) return;
      double score = width / Width(from);
      if (SpansDecades(from)) {
        const double floor = kDecadesFloor * (std::isfinite(from.upper()) ? from.upper() : 1e9);
        score = std::log((x.upper() + floor) / (x.lower() + floor)) /
                std::log((std::min(from.upper(), 1e9) + floor) / (from.lower() + floor));
      }
      std::pair<double, Interval*> next{weight * score, &x};
      if (next.first <= kFinest) return;
      for (std::size_t k = 0; k < kept; ++k) {
        if (next.first > widest[k].first) std::swap(next, widest[k]);
      }
    };
    const bool two_modes = contractor.TwoModes();
    if (contractor.HasWindow() && cell.boxes.size() > 1) {
      // Transfers fix each omega by itself.
      offer(cell.window_hz, start.window_hz, problem.HasTransfer() ? 0.05 : 1.0);
    }
    for (std::size_t i = 0; i < cell.boxes.size(); ++i) {
      const bool own = search.expression ? search.expression->DependsOn(i, search.experiment)
                                         : i == search.experiment;
      ExperimentBox& box = cell.boxes[i];
      const ExperimentBox& from = start.boxes[i];
      const double rest =
          search.expression ? 1e-3 : (two_modes && !problem.HasTransfer() ? 0.4 : 0.1);
      offer(box[kCellXi], from[kCellXi], own ? 1.0 : rest);
      offer(box[kCellOmega], from[kCellOmega], own ? 1.0 : rest);
      offer(box[kCellTangent], from[kCellTangent], own ? 0.7 : 0.5 * rest);
      offer(box[kCellGain], from[kCellGain], own ? 0.3 : 0.1 * rest);
      if (!contractor.Targets()[i].lines_hz.empty()) {
        offer(box[kCellTau], from[kCellTau], own ? 0.4 : 0.1);
      }
      if (i == 0) {
        for (const CellVariable shared : contractor.Shared()) {
          offer(box[shared], from[shared], 1.0);
        }
      }
    }
    if (kept == 1) return widest[0].second;
    Interval* best = nullptr;
    double best_reach = kUnbounded;
    for (const auto& [score, variable] : widest) {
      if (variable == nullptr) break;
      const Interval whole = *variable;
      const double middle = Middle(whole);
      double reach = -kUnbounded;
      for (const bool low : {true, false}) {
        *variable = low ? Interval(whole.lower(), middle) : Interval(middle, whole.upper());
        Cell child = cell;
        if (contractor.Contract(child)) reach = std::max(reach, Reach(search, child));
      }
      *variable = whole;
      if (best == nullptr || reach < best_reach) {
        best = variable;
        best_reach = reach;
      }
    }
    return best;
  }

  static double Middle(const Interval& x) {
    if (x.lower() > 0.0 && x.upper() > 4.0 * x.lower()) return std::sqrt(x.lower() * x.upper());
    return (x.lower() == 0.0 ? 0.25 : 0.5) * (x.lower() + x.upper());
  }

  void Start(BoundSearch& search, double scale) const {
    search.state = SearchState::kRunning;
    if (root_empty) {
      ++search.counts.outside;
    } else {
      SearchMember(search);
      SearchLocally(search, scale);
      Push(search, Cell(root));
    }
  }

  void Finish(BoundSearch& search, SearchState state) const {
    search.state = state;
    double outer = std::max(search.inner, search.settled);
    if (!search.heap.empty()) outer = std::max(outer, search.heap.front().bound);
    search.outer = std::isfinite(outer) ? outer + kRounding * std::abs(outer) : outer;
    (state == SearchState::kClosed ? search.counts.undecided : search.counts.pending) +=
        search.heap.size();
    search.heap.clear();
    search.heap.shrink_to_fit();
  }

  void Step(BoundSearch& search, double tolerance) const {
    if (search.state == SearchState::kNew) return Start(search, tolerance / (0.5 * options.width));
    if (search.heap.empty() || search.heap.front().bound <= search.inner + tolerance) {
      return Finish(search, SearchState::kClosed);
    }
    if (search.cells >= options.max_cells) return Finish(search, SearchState::kBudget);
    std::pop_heap(search.heap.begin(), search.heap.end(), ReachesLess);
    Cell cell = std::move(search.heap.back());
    search.heap.pop_back();
    ++search.cells;
    SearchMember(search, cell);
    Interval* const split = ChooseSplit(search, cell, root);
    if (split == nullptr) {
      ++search.counts.undecided;
      search.settled = std::max(search.settled, cell.bound);
      return;
    }
    const Interval whole = *split;
    const double middle = Middle(whole);
    for (const bool low : {true, false}) {
      *split = low ? Interval(whole.lower(), middle) : Interval(middle, whole.upper());
      Cell child = cell;
      if (contractor.Contract(child)) {
        Push(search, std::move(child));
      } else {
        ++search.counts.outside;
      }
    }
  }

  // Of the two searches from `first`: the lower and the upper end.
  EnclosedBound BoundAt(std::size_t first) const {
    EnclosedBound bound;
    bound.closed = true;
    for (std::size_t k = first; k < first + 2; ++k) {
      const BoundSearch& search = searches[k];
      // A search also ends where its cells are too fine to split, short of the stated width.
      bound.closed &= search.state == SearchState::kClosed &&
                      (search.outer == search.inner ||
                       search.outer - search.inner <= 0.5 * options.width * range[k] +
                                                          2.0 * kRounding * std::abs(search.outer));
      // Of an interrupted search: what its cells still reach.
      double outer = search.outer;
      if (search.state == SearchState::kNew) {
        outer = root_empty ? -kUnbounded : Reach(search, root);
      } else if (search.state == SearchState::kRunning) {
        outer = std::max(search.inner, search.settled);
        if (!search.heap.empty()) outer = std::max(outer, search.heap.front().bound);
        if (std::isfinite(outer)) outer += kRounding * std::abs(outer);
      }
      if (search.sign > 0.0) {
        bound.outer.hi = outer;
        bound.inner.hi = search.inner;
      } else {
        bound.outer.lo = 0.0 - outer;
        bound.inner.lo = 0.0 - search.inner;
      }
    }
    return bound;
  }

  bool IsDone(const BoundSearch& search) const {
    return search.state == SearchState::kClosed || search.state == SearchState::kBudget;
  }
};

Enclosure::Enclosure(const FamilyProblem& problem, const EncloseOptions& options)
    : impl_(std::make_unique<Impl>(problem, options)) {}
Enclosure::~Enclosure() = default;

bool Enclosure::Run(const std::function<bool()>& interrupted) {
  RunUnits(impl_->searches.size(), impl_->options.threads, [&](std::size_t k) {
    BoundSearch& search = impl_->searches[k];
    const double tolerance = 0.5 * impl_->options.width * impl_->range[k];
    while (!impl_->IsDone(search)) {
      if (interrupted && interrupted()) return;
      impl_->Step(search, tolerance);
    }
  });
  return IsComplete();
}

bool Enclosure::IsComplete() const {
  return std::all_of(impl_->searches.begin(), impl_->searches.end(),
                     [&](const BoundSearch& search) { return impl_->IsDone(search); });
}

bool Enclosure::IsBounded(std::size_t experiment, FamilyParameter parameter) const {
  return impl_->Has(experiment, parameter);
}

EnclosedBound Enclosure::Bound(std::size_t experiment, FamilyParameter parameter) const {
  for (std::size_t k = 0; k < impl_->first_expression; k += 2) {
    const BoundSearch& search = impl_->searches[k];
    if (search.experiment == experiment && search.parameter == parameter) return impl_->BoundAt(k);
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

namespace {

constexpr std::string_view kMagic = "howl.enclosure/1";

void Write(std::ostream& out, double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a ", value);
  out << text;
}

bool Read(std::istream& in, double& value) {
  std::string text;
  if (!(in >> text)) return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

void Write(std::ostream& out, const Interval& x) {
  Write(out, x.lower());
  Write(out, x.upper());
}

bool Read(std::istream& in, Interval& x) {
  double lo = 0.0, hi = 0.0;
  if (!Read(in, lo) || !Read(in, hi) || !(lo <= hi)) return false;
  x.assign(lo, hi);
  return true;
}

template <typename Model, typename Visitor>
bool VisitModel(Model& model, const Visitor& visit) {
  return visit(model.omega_hz) && visit(model.xi) && visit(model.N) && visit(model.M) &&
         visit(model.tau_s) && visit(model.harmonic_ratio);
}

}  // namespace

void Enclosure::Save(std::ostream& out) const {
  out << kMagic << ' ' << impl_->searches.size() << ' ' << impl_->problem.experiments.size()
      << '\n';
  const auto write = [&](const double& value) {
    Write(out, value);
    return true;
  };
  for (const BoundSearch& search : impl_->searches) {
    out << static_cast<int>(search.state) << ' ' << search.random.State() << ' ' << search.cells
        << ' ' << search.counts.inside << ' ' << search.counts.outside << ' '
        << search.counts.undecided << ' ' << search.counts.pending << ' ' << search.focus.pattern
        << ' ';
    for (const double value :
         {search.inner, search.settled, search.outer, search.focus.xi_end, search.focus.phase_end,
          search.focus.gain_end, search.focus.loop_phase_end, search.focus.omega_end}) {
      Write(out, value);
    }
    out << search.witness.size() << ' ';
    for (const LoopModel& model : search.witness) VisitModel(model, write);
    out << search.heap.size() << '\n';
    for (const Cell& cell : search.heap) {
      Write(out, cell.bound);
      Write(out, cell.window_hz);
      for (const ExperimentBox& box : cell.boxes) {
        for (const Interval& x : box) Write(out, x);
      }
      out << '\n';
    }
  }
}

bool Enclosure::Load(std::istream& in) {
  std::string magic;
  std::size_t searches = 0, experiments = 0;
  if (!(in >> magic >> searches >> experiments) || magic != kMagic ||
      searches != impl_->searches.size() || experiments != impl_->problem.experiments.size()) {
    return false;
  }
  std::vector<BoundSearch> loaded = impl_->searches;
  const auto read = [&](double& value) { return Read(in, value); };
  for (BoundSearch& search : loaded) {
    int state = 0;
    std::uint64_t random = 0;
    std::size_t witness = 0, heap = 0;
    in >> state >> random >> search.cells >> search.counts.inside >> search.counts.outside >>
        search.counts.undecided >> search.counts.pending >> search.focus.pattern;
    if (!in || state < 0 || state > static_cast<int>(SearchState::kBudget)) return false;
    search.state = static_cast<SearchState>(state);
    search.random.SetState(random);
    for (double* const value : {&search.inner, &search.settled, &search.outer, &search.focus.xi_end,
                                &search.focus.phase_end, &search.focus.gain_end,
                                &search.focus.loop_phase_end, &search.focus.omega_end}) {
      if (!Read(in, *value)) return false;
    }
    if (!(in >> witness) || (witness != 0 && witness != experiments)) return false;
    search.witness.resize(witness);
    for (LoopModel& model : search.witness) {
      if (!VisitModel(model, read)) return false;
    }
    if (!(in >> heap)) return false;
    search.heap.clear();
    for (std::size_t k = 0; k < heap; ++k) {
      Cell cell;
      cell.boxes.resize(experiments);
      if (!Read(in, cell.bound) || !Read(in, cell.window_hz)) return false;
      for (ExperimentBox& box : cell.boxes) {
        for (Interval& x : box) {
          if (!Read(in, x)) return false;
        }
      }
      search.heap.push_back(std::move(cell));
    }
  }
  impl_->searches = std::move(loaded);
  return true;
}

}  // namespace howl
