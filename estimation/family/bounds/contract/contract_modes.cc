// The equations of one mode and of two (contract.h).
#include <algorithm>
#include <cmath>

#include "estimation/family/bounds/contract/contract.h"

namespace howl {
namespace {

// 1 / cos(theta) = sqrt(1 + t^2)
Interval Secant(const Interval& tangent) { return sqrt(1.0 + square(tangent)); }

// Both ends of y = a b with b >= 0.
bool NarrowProduct(Interval& product, Interval& a, Interval& b) {
  return Narrow(product, a * b) && Narrow(a, Quotient(product, b)) &&
         Narrow(b, Quotient(product, a));
}

// g = (4 z xi^2 + (1 - z)^2) / (1 + r z), z > 0: rises with xi, and is convex in z, as it is
// z / r + a + c / (1 + r z) with c = 1 + 2 b / r + 1 / r^2 > 0, b = 1 - 2 xi^2.
Interval ModeShape(const Interval& z, const Interval& xi, const Interval& r) {
  if (!std::isfinite(z.upper()) || !std::isfinite(xi.upper())) return {0.0, kUnbounded};
  const auto at = [&](double point, double damping) {
    const Interval x(point);
    return (4.0 * x * square(Interval(damping)) + square(1.0 - x)) / (1.0 + r * x);
  };
  const double hi = std::max(at(z.lower(), xi.upper()).upper(), at(z.upper(), xi.upper()).upper());
  const Interval b = 1.0 - 2.0 * square(Interval(xi.lower()));
  const Interval c = 1.0 + 2.0 * b / r + 1.0 / square(r);
  if (!(c.lower() > 0.0)) {  // strong damping: no use is made of convexity
    return Interval((4.0 * z * square(xi) + square(1.0 - z)) / (1.0 + r * z));
  }
  // Least near (1 + r z)^2 = r^2 c; the tangent there bounds a convex function from below.
  const double near = (std::sqrt(c.lower()) * r.lower() - 1.0) / r.lower();
  const double point = std::clamp(near, z.lower(), z.upper());
  const Interval slope = 1.0 / r - r * c / square(1.0 + r * Interval(point));
  const Interval tangent = at(point, xi.lower()) + slope * (z - Interval(point));
  return {std::max(tangent.lower(), 0.0), hi};
}

// F = (y / xi - t) g about the middle of the box (mean value form): its error falls with the square
// of the box, where the plain product's falls with the box alone. y' is negative; f is the
// frequency at which y vanishes, scale = z / (omega / f)^2.
Interval CentredProduct(const Interval& f, const Interval& scale, const Interval& ratio,
                        const ExperimentBox& box, const Interval& y, const Interval& g) {
  const Interval& omega = box[kCellOmega];
  const Interval& xi = box[kCellXi];
  const Interval& t = box[kCellTangent];
  if (!(xi.lower() > 0.0) || !std::isfinite(omega.upper())) return {-kUnbounded, kUnbounded};
  const auto middle = [](const Interval& x) { return Interval(0.5 * (x.lower() + x.upper())); };
  const Interval omega_m = middle(omega), xi_m = middle(xi), t_m = middle(t);
  const Interval z_m = scale * square(omega_m / f);
  const Interval g_m = (4.0 * z_m * square(xi_m) + square(1.0 - z_m)) / (1.0 + ratio * z_m);
  const Interval y_m = 0.5 * (f / omega_m - omega_m / f);
  const Interval z = scale * square(omega / f);
  const Interval h = y / xi - t;
  const Interval lift = 1.0 + ratio * z;
  const Interval b = 1.0 - 2.0 * square(xi);
  const Interval g_z =
      1.0 / ratio - ratio * (1.0 + 2.0 * b / ratio + 1.0 / square(ratio)) / square(lift);
  const Interval y_omega = -0.5 * (f / square(omega) + 1.0 / f);
  const Interval f_omega = y_omega / xi * g + h * g_z * (2.0 * scale * omega / square(f));
  const Interval f_xi = h * 8.0 * z * xi / lift - y / square(xi) * g;
  return (y_m / xi_m - t_m) * g_m + f_omega * (omega - omega_m) + f_xi * (xi - xi_m) -
         g * (t - t_m);
}

bool NarrowOmega(const ContractTarget& target, const Interval& detuning, ExperimentBox& box) {
  return Narrow(box[kCellOmega], OmegaOf(target.frequency_hz, detuning));
}

}  // namespace

bool ContractPhase(const ContractTarget& target, ExperimentBox& box) {
  Interval y = DetuningOf(target.frequency_hz, box[kCellOmega]);
  return NarrowProduct(y, box[kCellTangent], box[kCellXi]) && NarrowOmega(target, y, box);
}

bool ContractGain(const ContractTarget& target, ExperimentBox& box) {
  const Interval secant = Secant(box[kCellTangent]);
  // xi exp(-asinh(xi t)) rises with xi at every t.
  const auto shape = [&](double xi, const Interval& tangent) {
    const Interval x(xi);
    const Interval across = x * tangent;
    const auto at = [&](double v) {
      const Interval value(v);
      const Interval root = sqrt(1.0 + square(value));
      return v > 0.0 ? 1.0 / (root + value) : root - value;
    };
    return x * Interval(at(across.upper()).lower(), at(across.lower()).upper());
  };
  const Interval& xi = box[kCellXi];
  Interval product = box[kCellXi] * box[kCellOmega] * (target.w_rad_s / target.frequency_hz);
  if (std::isfinite(xi.upper())) {
    Narrow(product, target.w_rad_s * Interval(shape(xi.lower(), box[kCellTangent]).lower(),
                                              shape(xi.upper(), box[kCellTangent]).upper()));
  }
  Interval scale = 2.0 * product * secant;
  if (!NarrowProduct(box[kCellN], box[kCellGain], scale)) return false;
  // Backward to xi and omega, through N and the gain.
  const Interval rate = target.w_rad_s / target.frequency_hz;
  Interval mode = Quotient(Quotient(scale, 2.0 * secant), rate);
  return Narrow(box[kCellXi], Quotient(mode, box[kCellOmega])) &&
         Narrow(box[kCellOmega], Quotient(mode, box[kCellXi]));
}

bool ContractTwoModes(const ContractTarget& target, ExperimentBox& box) {
  const Interval& r = target.harmonic_ratio;
  Interval& omega = box[kCellOmega];
  Interval& xi = box[kCellXi];
  Interval& tangent = box[kCellTangent];
  Interval y = DetuningOf(target.frequency_hz, omega);
  Interval y_r = DetuningOf(target.frequency_hz / r, omega);
  // y_r <= xi t <= y, both modes' coefficients being positive.
  Interval across = xi * tangent;
  if (!NarrowLower(across, y_r.lower()) || !NarrowUpper(across, y.upper()) ||
      !NarrowLower(y, across.lower()) || !NarrowUpper(y_r, across.upper())) {
    return false;
  }
  // H_1 = t - y_r / xi >= 0,  H_r = y / xi - t >= 0
  Interval h_1 = tangent - Quotient(y_r, xi);
  Interval h_r = Quotient(y, xi) - tangent;
  if (!NarrowLower(h_1, 0.0) || !NarrowLower(h_r, 0.0)) return false;
  const Interval z = square(omega / target.frequency_hz);
  const Interval g_1 = ModeShape(z, xi, r);
  const Interval g_r = ModeShape(square(r) * z, xi, 1.0 / r);
  // N = r K H_1 g_1,  M = K H_r g_r,  K = w |G| cos(theta) / (r - 1)
  const Interval rate = target.w_rad_s / (Secant(tangent) * (r - 1.0));
  const Interval k = rate * box[kCellGain];
  Interval& n = box[kCellN];
  Interval& m = box[kCellM];
  Interval& relative = box[kCellRelative];
  Interval product_1 = h_1 * g_1;
  Interval product_r = h_r * g_r;
  const Interval f_r = target.frequency_hz / r;
  if (!Narrow(product_1, -CentredProduct(f_r, 1.0 / square(r), r, box, y_r, g_1)) ||
      !Narrow(product_r, CentredProduct(target.frequency_hz, square(r), 1.0 / r, box, y, g_r))) {
    return false;
  }
  if (!Narrow(n, r * k * product_1) || !Narrow(m, k * product_r) ||
      !Narrow(relative, Quotient(product_r, r * product_1)) || !Narrow(relative, Quotient(m, n)) ||
      !Narrow(m, relative * n) || !Narrow(n, Quotient(m, relative))) {
    return false;
  }
  if (!Narrow(h_1, Quotient(n, r * k * g_1)) || !Narrow(h_r, Quotient(m, k * g_r)) ||
      !Narrow(h_r, relative * r * h_1 * g_1 / g_r) ||
      !Narrow(h_1, Quotient(h_r * g_r, relative * r * g_1)) ||
      !Narrow(box[kCellGain], Quotient(n, r * rate * h_1 * g_1)) ||
      !Narrow(box[kCellGain], Quotient(m, rate * h_r * g_r))) {
    return false;
  }
  if (!Narrow(y, xi * (h_r + tangent)) || !Narrow(y_r, xi * (tangent - h_1)) ||
      !Narrow(tangent, Quotient(y, xi) - h_r) || !Narrow(tangent, Quotient(y_r, xi) + h_1) ||
      !Narrow(xi, Quotient(y, h_r + tangent)) || !Narrow(xi, Quotient(y_r, tangent - h_1))) {
    return false;
  }
  return Narrow(omega, OmegaOf(target.frequency_hz, y)) &&
         Narrow(omega, OmegaOf(target.frequency_hz / r, y_r));
}

}  // namespace howl
