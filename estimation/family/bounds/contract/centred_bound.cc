#include "estimation/family/bounds/contract/centred_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "estimation/family/bounds/contract/centred_response.h"
#include "estimation/family/bounds/contract/centred_row.h"
#include "model/numerics/constants.h"

namespace howl {

namespace {

constexpr std::array<CellVariable, kResponseVariables> kCellOf = {
    kCellOmega, kCellXi, kCellTangent, kCellGain, kCellM, kCellLoopPhase};

bool IsFinite(const Interval& x) { return std::isfinite(x.lower()) && std::isfinite(x.upper()); }

bool IsFinite(const ResponseRow& row) {
  return IsFinite(row.value) &&
         std::all_of(row.slope.begin(), row.slope.end(), [](const auto& x) { return IsFinite(x); });
}

// x / sqrt(x^2 + y^2): rises with x, and falls with y^2 where x is positive.
Interval Cosine(const Interval& x, const Interval& y) {
  const Interval across = square(y);
  const auto at = [](double a, double b) {
    return a == 0.0 ? Interval(0.0) : Interval(a) / sqrt(square(Interval(a)) + Interval(b));
  };
  const double lo = at(x.lower(), x.lower() > 0.0 ? across.upper() : across.lower()).lower();
  const double hi = at(x.upper(), x.upper() > 0.0 ? across.lower() : across.upper()).upper();
  return {std::max(lo, -1.0), std::min(hi, 1.0)};
}

// Of a phase in (-pi, pi / 2); no value where z may lie elsewhere.
std::optional<Interval> PhaseOf(const Complex<Interval>& z) {
  if (z.re.lower() > 0.0) return Arctangent(z.im / z.re);
  if (z.im.upper() < 0.0) return -(Arctangent(z.re / z.im) + Widened(kPi / 2));
  return std::nullopt;
}

class CentredContractor {
 public:
  CentredContractor(const ContractTarget& target, ExperimentBox& box) : target_(target), box_(box) {
    const Interval rate = target.w_rad_s / target.frequency_hz;
    for (std::size_t k = 0; k < kResponseVariables; ++k) {
      over_[k] = box[kCellOf[k]];
      if (k == kResponseOmega) over_[k] = rate * over_[k];
      middle_[k] = Interval(MiddleOf(over_[k]));
      offset_[k] = over_[k] - middle_[k];
    }
  }

  bool Contract() {
    const CentredResponse at(target_, middle_);
    const CentredResponse over(target_, over_);
    if (!ByCoefficient(at.N(), over.N())) return false;
    for (std::size_t k = 0; k < target_.lines_hz.size(); ++k) {
      if (!has_link_) break;
      const Interval w_line = target_.w_rad_s / target_.frequency_hz * target_.lines_hz[k];
      const ComplexForm z_at = at.AtLine(w_line);
      const ComplexForm z_over = over.AtLine(w_line);
      if (!ByLineGain(k, z_at, z_over) || !ByLinePhase(w_line, z_at, z_over)) return false;
    }
    return Return();
  }

 private:
  // The row, and the row with a variable taken out by the link.
  bool NarrowLinked(const ResponseRow& row, Interval& allowed) {
    if (!NarrowByRow(row, allowed, offset_)) return false;
    for (const ResponseVariable out : {kResponseOmega, kResponseM, kResponseXi}) {
      const double weight = -MiddleOf(row.slope[out]) / MiddleOf(link_.slope[out]);
      if (!std::isfinite(weight)) continue;
      const ResponseRow combined = Combined(row, Interval(weight), link_);
      if (!NarrowByRow(combined, allowed, offset_)) return false;
    }
    return true;
  }

  bool ByCoefficient(const ComplexForm& at, const ComplexForm& over) {
    ResponseRow row{at.value.re, {}};
    link_.value = at.value.im;
    for (std::size_t k = 0; k < kResponseVariables; ++k) {
      row.slope[k] = over.by[k].re;
      link_.slope[k] = over.by[k].im;
    }
    has_link_ = IsFinite(link_);
    Interval zero(0.0);
    if (!has_link_) return true;
    return NarrowByRow(link_, zero, offset_) && (!IsFinite(row) || NarrowLinked(row, box_[kCellN]));
  }

  bool ByLineGain(std::size_t line, const ComplexForm& at, const ComplexForm& over) {
    if (target_.line_response_min.empty()) return true;
    const Interval along = Cosine(over.value.re, over.value.im);
    const Interval across = Cosine(over.value.im, over.value.re);
    ResponseRow row{sqrt(square(at.value.re) + square(at.value.im)), {}};
    for (std::size_t k = 0; k < kResponseVariables; ++k) {
      row.slope[k] = over.by[k].re * along + over.by[k].im * across;
    }
    Interval allowed(target_.line_response_min[line].lower(), Unbounded());
    return !IsFinite(row) || NarrowLinked(row, allowed);
  }

  bool ByLinePhase(const Interval& w_line, const ComplexForm& at, const ComplexForm& over) {
    if (!target_.has_line_error) return true;
    const std::optional<Interval> phase = PhaseOf(at.value);
    if (!phase || !PhaseOf(over.value)) return true;
    const Interval periods = w_line / target_.w_rad_s;
    const Interval size = square(over.value.re) + square(over.value.im);
    const Interval along = over.value.re / size;
    const Interval across = over.value.im / size;
    ResponseRow row;
    row.value = *phase - Widened(kPi / 2) -
                periods * (target_.turns - Arctangent(middle_[kResponseTangent]) -
                           middle_[kResponseLoopPhase]);
    for (std::size_t k = 0; k < kResponseVariables; ++k) {
      row.slope[k] = over.by[k].im * along - over.by[k].re * across;
    }
    row.slope[kResponseTangent] += periods / (1.0 + square(over_[kResponseTangent]));
    row.slope[kResponseLoopPhase] += periods;
    if (!IsFinite(row)) return true;
    Interval whole = row.value;
    for (std::size_t k = 0; k < kResponseVariables; ++k) whole += row.slope[k] * offset_[k];
    const Interval turn = Widened(2 * kPi);
    const Interval turns = (whole - target_.line_error_rad) / turn;
    const double first = std::ceil(turns.lower());
    const double last = std::floor(turns.upper());
    if (first > last) return false;
    if (first < last) return true;
    Interval allowed = target_.line_error_rad + Interval(first) * turn;
    return NarrowLinked(row, allowed);
  }

  // What is left of the offsets.
  bool Return() {
    const Interval rate = target_.w_rad_s / target_.frequency_hz;
    for (std::size_t k = 0; k < kResponseVariables; ++k) {
      Interval x = offset_[k] + middle_[k];
      if (k == kResponseOmega) x = x / rate;
      if (!Narrow(box_[kCellOf[k]], x)) return false;
    }
    return true;
  }

  const ContractTarget& target_;
  ExperimentBox& box_;
  ResponseBox over_, middle_, offset_;
  ResponseRow link_;
  bool has_link_ = false;
};

}  // namespace

bool ContractCentred(const ContractTarget& target, ExperimentBox& box) {
  // A transfer's slabs hold the response at the cycle in the mean value form already.
  if (target.transfer.used && target.lines_hz.empty()) return true;
  for (const CellVariable variable : kCellOf) {
    if (!IsFinite(box[variable])) return true;
  }
  if (!(box[kCellOmega].lower() > 0.0) || !(box[kCellXi].lower() > 0.0)) return true;
  return CentredContractor(target, box).Contract();
}

}  // namespace howl
