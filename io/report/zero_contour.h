// Where a quantity on a grid is zero: the line of marching squares (W. E. Lorensen and H. E. Cline,
// Comput. Graph. 21:163, 1987, in two dimensions), linear along each side of a square. A square
// with a value that is not finite has none; where its corners alternate in sign the mean of the
// four decides.
#ifndef HOWL_IO_REPORT_ZERO_CONTOUR_H_
#define HOWL_IO_REPORT_ZERO_CONTOUR_H_

#include <array>
#include <vector>

namespace howl {

using ContourPoint = std::array<double, 2>;
using ContourSegment = std::array<ContourPoint, 2>;

// value[j * x.size() + i] at (x[i], y[j]).
std::vector<ContourSegment> ZeroContour(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& value);

}  // namespace howl

#endif  // HOWL_IO_REPORT_ZERO_CONTOUR_H_
