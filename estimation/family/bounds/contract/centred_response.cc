#include "estimation/family/bounds/contract/centred_response.h"

namespace howl {

namespace {

using Number = Complex<Interval>;

Number Inverse(const Number& d) {
  const Interval size = square(d.re) + square(d.im);
  return {d.re / size, -d.im / size};
}

// d_k at w.
ModeForm Denominator(const Interval& ratio, const Interval& w, const ResponseBox& box) {
  const Interval omega = ratio * box[kResponseOmega];
  const Interval twice = 2.0 * ratio;
  return {{2.0 * omega * box[kResponseXi], w - square(omega) / w},
          {twice * box[kResponseXi], -twice * omega / w},
          {2.0 * omega, Interval(0.0)}};
}

ModeForm Reciprocal(const ModeForm& d) {
  const Number u = Inverse(d.value);
  const Number slope{square(u.im) - square(u.re), -2.0 * u.re * u.im};  // -u^2
  return {u, slope * d.by_omega, slope * d.by_xi};
}

ModeForm Product(const ModeForm& a, const ModeForm& b) {
  return {a.value * b.value, a.by_omega * b.value + a.value * b.by_omega,
          a.by_xi * b.value + a.value * b.by_xi};
}

ModeForm Ratio(const ModeForm& a, const ModeForm& b) {
  const Number inverse = Inverse(b.value);
  const Number q = a.value * inverse;
  return {q, (a.by_omega - q * b.by_omega) * inverse, (a.by_xi - q * b.by_xi) * inverse};
}

ModeForm Difference(const ModeForm& a, const ModeForm& b) {
  return {a.value - b.value, a.by_omega - b.by_omega, a.by_xi - b.by_xi};
}

// e^(j theta) = (1 - j t) / sqrt(1 + t^2)
Number Phasor(const Interval& tangent) {
  const auto sine = [](double t) {  // falls with t
    const Interval x(t);
    return -x / sqrt(1.0 + square(x));
  };
  return {1.0 / sqrt(1.0 + square(tangent)),
          Interval(sine(tangent.upper()).lower(), sine(tangent.lower()).upper())};
}

}  // namespace

CentredResponse::CentredResponse(const ContractTarget& target, const ResponseBox& box)
    : target_(target),
      box_(box),
      phasor_(Phasor(box[kResponseTangent])),
      first_(Denominator(Interval(1.0), target.w_rad_s, box)),
      other_(Reciprocal(Denominator(target.harmonic_ratio, target.w_rad_s, box))) {}

// |G| e^(j theta) a + M b
ComplexForm CentredResponse::Assembled(const ModeForm& a, const ModeForm& b) const {
  const Interval& gain = box_[kResponseGain];
  const Interval& m = box_[kResponseM];
  const Number along = phasor_ * a.value;
  const Interval turn = gain / (1.0 + square(box_[kResponseTangent]));  // -|G| d theta / dt
  ComplexForm form;
  form.value = gain * along + m * b.value;
  form.by[kResponseOmega] = gain * (phasor_ * a.by_omega) + m * b.by_omega;
  form.by[kResponseXi] = gain * (phasor_ * a.by_xi) + m * b.by_xi;
  form.by[kResponseTangent] = turn * Number{along.im, -along.re};
  form.by[kResponseGain] = along;
  form.by[kResponseM] = b.value;
  form.by[kResponseLoopPhase] = {Interval(0.0), Interval(0.0)};
  return form;
}

ComplexForm CentredResponse::N() const {
  const ModeForm share = Product(first_, other_);
  const Interval minus(-1.0);
  return Assembled(first_, {minus * share.value, minus * share.by_omega, minus * share.by_xi});
}

ComplexForm CentredResponse::AtLine(const Interval& w_line) const {
  const ModeForm q = Ratio(first_, Denominator(Interval(1.0), w_line, box_));
  const ModeForm at_line = Reciprocal(Denominator(target_.harmonic_ratio, w_line, box_));
  return Assembled(q, Difference(at_line, Product(q, other_)));
}

}  // namespace howl
