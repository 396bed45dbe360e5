#include "estimation/joint_records/fit_units.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace howl {
namespace {

// Three numbers of the fit, its iterations, whether it converged, and how many parameters it has.
constexpr std::size_t kHead = 6;
constexpr double kMostParameters = 10'000.0;
constexpr double kMostIterations = 1e9;

// Whether it is a whole number from the first to the last; -0 is none, as no fit is kept with it.
bool IsCount(double x, double first, double last) {
  return x >= first && x <= last && x == std::floor(x) && !std::signbit(x);
}

// Of a symmetric matrix the lower half is kept: most of what a unit has.
std::size_t Triangle(std::size_t size) { return size * (size + 1) / 2; }

}  // namespace

std::string PointFitBytes(const PointFit& fit) {
  const auto size = static_cast<std::size_t>(fit.parameters.size());
  const std::array<double, kHead> head = {fit.log_likelihood,    fit.log_posterior,
                                          fit.log_evidence,      double(fit.iterations),
                                          double(fit.converged), static_cast<double>(size)};
  std::string bytes(sizeof(double) * (kHead + size + Triangle(size)), '\0');
  char* to = bytes.data();
  const auto write = [&](const double* from, std::size_t count) {
    std::memcpy(to, from, count * sizeof(double));
    to += count * sizeof(double);
  };
  write(head.data(), kHead);
  write(fit.parameters.data(), size);
  for (std::size_t i = 0; i < size; ++i) {
    write(fit.information.col(static_cast<Eigen::Index>(i)).data() + i, size - i);
  }
  return bytes;
}

std::optional<PointFit> PointFitOf(const std::string& bytes) {
  std::array<double, kHead> head;
  if (bytes.size() < sizeof head) return std::nullopt;
  std::memcpy(head.data(), bytes.data(), sizeof head);
  if (!IsCount(head[3], 0.0, kMostIterations) || !IsCount(head[4], 0.0, 1.0) ||
      !IsCount(head[5], 1.0, kMostParameters)) {
    return std::nullopt;
  }
  const auto size = static_cast<std::size_t>(head[5]);
  if (bytes.size() != sizeof(double) * (kHead + size + Triangle(size))) return std::nullopt;
  PointFit fit;
  fit.log_likelihood = head[0];
  fit.log_posterior = head[1];
  fit.log_evidence = head[2];
  fit.iterations = static_cast<int>(head[3]);
  fit.converged = head[4] != 0.0;
  const auto rows = static_cast<Eigen::Index>(size);
  fit.parameters.resize(rows);
  fit.information.resize(rows, rows);
  const char* from = bytes.data() + sizeof head;
  const auto read = [&](double* to, std::size_t count) {
    std::memcpy(to, from, count * sizeof(double));
    from += count * sizeof(double);
  };
  read(fit.parameters.data(), size);
  for (std::size_t i = 0; i < size; ++i) {
    read(fit.information.col(static_cast<Eigen::Index>(i)).data() + i, size - i);
  }
  fit.information.triangularView<Eigen::StrictlyUpper>() = fit.information.transpose().eval();
  return fit;
}

PointFit KeptFit(FitUnits* units, const std::string& key, const std::function<PointFit()>& fit) {
  if (units == nullptr) return fit();
  if (const std::optional<std::string> bytes = units->Recall(key)) {
    if (std::optional<PointFit> kept = PointFitOf(*bytes)) return *std::move(kept);
  }
  PointFit found = fit();
  // Parameters alone have a size where a fit has found no information.
  if (found.information.size() == found.parameters.size() * found.parameters.size()) {
    units->Keep(key, PointFitBytes(found));
  }
  return found;
}

}  // namespace howl
