// One member of the family between and beyond the operating points that were measured.
//
// At each measured operating parameter phi_k a member has a loop. The quantities that are
// interpolated from point to point are those that an experiment determines, so that a parameter
// that it leaves open (xi) does not spoil them:
//
//   y = (ln f, ln |G(j 2 pi f)|, ln xi, ln tau, M / N, ln |Phi'(0)|),   f: where arg L is 180
//   degrees
//
// omega and N follow from y by the closed form of (5a) or (5c) with arg G = 2 pi f tau - 3 pi / 2.
// A shared parameter stays shared; where omega or N is shared, ln omega and ln N stand in the place
// of the first two.
//
//   between    y is linear in phi between the two neighbours
//   beyond     y leaves the member's own last point with the slope of a straight line through all
//              points (least squares)
//
// A rig does not follow straight lines. The steps between neighbours, less the member's mean
// slope b, show by how much (a random walk about a line, for which the linear rule is the best
// predictor):
//
//   r_k = (y_(k+1) - y_k - b (phi_(k+1) - phi_k)) / sqrt(phi_(k+1) - phi_k),    k = 1 .. n - 1
//
// and each path is one draw: y(phi) + sqrt(v(phi)) e, e = sum_k z_k r_k / sqrt(n - 2) / s with z
// normal and s^2 chi-square over its n - 2 degrees of freedom, so that what goes together from
// point to point goes together in the draw. With d the distance from the last point and h the mean
// step
//
//   v = (phi - phi_k) (phi_(k+1) - phi) / (phi_(k+1) - phi_k)   between
//   v = d + d^2 / h                                             beyond: the slope may be any seen
//
// Next to an experiment that is not reliable, line and steps are those of all experiments;
// elsewhere those of the reliable ones, where there are three. Two points have no step to spare: e
// = 0.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_OPERATING_PATH_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_OPERATING_PATH_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/random.h"

namespace howl {

// kOutside: further beyond than the measured range is wide.
enum class PointKind : std::uint8_t { kMeasured, kBetween, kBeyond, kOutside };

// The measured operating points in order of phi; experiments at one phi are one point.
class OperatingPoints {
 public:
  explicit OperatingPoints(std::span<const Experiment> experiments);

  std::size_t size() const { return phi_.size(); }
  double phi(std::size_t k) const { return phi_[k]; }
  // Every experiment there is reliable.
  bool IsReliable(std::size_t k) const { return reliable_[k]; }
  const std::vector<std::size_t>& ExperimentsAt(std::size_t k) const { return experiments_[k]; }
  double width() const { return phi_.back() - phi_.front(); }

  PointKind KindOf(double phi) const;
  // The point that was measured there; rounding of phi does not matter.
  std::optional<std::size_t> Measured(double phi) const;
  // The points between which phi lies: one of them twice at it and beyond the ends.
  std::pair<std::size_t, std::size_t> Neighbours(double phi) const;
  // A neighbour is not reliable.
  bool RestsOnUnreliable(double phi) const;

 private:
  std::vector<double> phi_;
  std::vector<bool> reliable_;
  std::vector<std::vector<std::size_t>> experiments_;
};

// A member's loop at one phi.
struct OperatingLoop {
  LoopModel model;
  double frequency_hz = 0.0;  // where arg L is 180 degrees
  double gain = 0.0;          // |G| there
  double flame_slope = 0.0;   // Phi'(0), not positive; zero: not known
  double LoopGain() const;    // |L Phi'(0)| there; zero without a slope
};

class MemberPath {
 public:
  // No value where the member's loop has no crossing within a fifth of an experiment's frequency.
  // `random` draws e, and the slopes at rest within their standard deviations where these are
  // known (never so flat that a reliable experiment has less loop gain than the test asks for).
  static std::optional<MemberPath> Make(const FamilyProblem& problem, const OperatingPoints& points,
                                        std::span<const LoopModel> member, UnitRandom random);

  // No value where no loop has that frequency, gain, damping and delay. `points` as it was made.
  std::optional<OperatingLoop> At(const OperatingPoints& points, double phi) const;
  // ln |L Phi'(0)| at the crossing; no value without a loop or without a flame slope.
  std::optional<double> LogLoopGain(const OperatingPoints& points, double phi) const;

 private:
  static constexpr int kSize = 7;
  using Coordinates = Eigen::Matrix<double, kSize, 1>;
  struct Course {  // of a choice of points
    Coordinates slope = Coordinates::Zero();
    Coordinates deviate = Coordinates::Zero();  // e
    double mean_step = 1.0;                     // h
  };

  std::optional<OperatingLoop> LoopOf(const Coordinates& y) const;
  Coordinates CoordinatesAt(const OperatingPoints& points, double phi) const;
  static Course CourseOf(std::span<const double> phi, std::span<const Coordinates> nodes,
                         UnitRandom random);

  std::vector<Coordinates> nodes_;  // one for each operating point
  Course all_;
  Course reliable_;
  bool natural_ = false;      // ln omega and ln N are carried
  bool second_is_M_ = false;  // M is carried, not M / N
  bool two_modes_ = false;
  bool has_slope_ = false;
  bool xi_increasing_ = false;
  double xi_max_ = 0.0;
  double harmonic_ratio_ = 0.0;
};

// Paths of all members, with several draws of each where the members are few: the same for a seed
// whatever the number of threads.
std::vector<MemberPath> MakePaths(const FamilyProblem& problem, const OperatingPoints& points,
                                  std::span<const Member> members, std::uint64_t seed, int threads);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_OPERATING_PATH_H_
