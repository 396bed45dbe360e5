// Guaranteed bounds of every parameter over the family.
//
// For each bound (one end of one parameter of one experiment) a best-first search over cells
// (estimation/family/bounds/contract/cell.h): the cell that reaches farthest is split and
// contracted (estimation/family/bounds/contract/contract.h) until it reaches no farther than a
// member that was found, to within half the stated width. So no member lies outside `outer`, and
// members were found at both ends of `inner`. One step of a search:
// estimation/family/bounds/bound_step.h.
//
// Every bound is a unit of work of its own, so the result is the same whatever the number of
// threads, and whether or not the run was interrupted, saved, loaded and resumed.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_ENCLOSE_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_ENCLOSE_H_

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/bounds/expression.h"
#include "estimation/family/problem/family_parameter.h"
#include "estimation/family/problem/problem.h"

namespace howl {

// An expression to be bounded, for the model of one experiment.
struct BoundedExpression {
  Expression expression;
  std::size_t experiment = 0;
};

struct EncloseOptions {
  double width = 0.01;  // (outer - inner) / inner range of the parameter, both ends together
  std::size_t max_cells =
      0;  // a bound; 0: 4000 with one mode, 400 / experiments (60 at least) with two
  std::uint64_t seed = 0;
  int threads = 1;
  bool parameters = true;  // false: the expressions alone
  std::vector<BoundedExpression> expressions;
};

struct EnclosedBound {
  Range outer;             // lo > hi: proved empty
  Range inner{1.0, -1.0};  // lo > hi: no member was found
  bool closed = false;     // outer and inner meet to the stated width
  // (outer - inner) / inner range
  double Excess() const;
};

class Enclosure {
 public:
  explicit Enclosure(const FamilyProblem& problem, const EncloseOptions& options = {});
  ~Enclosure();
  Enclosure(const Enclosure&) = delete;
  Enclosure& operator=(const Enclosure&) = delete;

  // Until every bound is closed or out of budget, or `interrupted` (asked between cells, possibly
  // from several threads) says true. True when complete. Call again to go on. `owned`: of the
  // searches, 0 to Searches() - 1, those that this process runs; all without it.
  bool Run(const std::function<bool()>& interrupted = nullptr,
           const std::function<bool(std::size_t)>& owned = nullptr);
  bool IsComplete() const;
  std::size_t Searches() const;

  // The state of an interrupted run as text, exact: a head, then each search. Load expects the same
  // problem and options; false on anything else than what Save wrote. A search whose text is
  // damaged begins anew. Searches that several processes ran are joined as one text after another.
  void Save(std::ostream& out) const;
  std::string SavedHead() const;
  std::string SavedSearch(std::size_t k) const;
  bool Load(std::istream& in);

  EnclosedBound Bound(std::size_t experiment, FamilyParameter parameter) const;
  EnclosedBound BoundOfExpression(std::size_t k) const;  // of options.expressions
  bool IsBounded(std::size_t experiment, FamilyParameter parameter) const;  // has bounds at all
  CellCounts Counts() const;
  // Proved: the search left no cell.
  bool IsProvedEmpty() const;
  // The members that `inner` rests on.
  std::vector<Member> Witnesses() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_ENCLOSE_H_
