// How far below its maximum a fit that is only compared (point_fit.h) ends, by what the next step
// seemed to gain there: ducts of two modes, one and two of them fitted, from every start.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "estimation/record_fit/point_fit.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl {
namespace {

constexpr double kFar = 10.0;  // nats
constexpr double kNear = 1.0;

struct Row {
  double converged = 0.0;
  int far = 0;
  int near = 0;
  int unconverged = 0;
};

void AddRecord(std::uint64_t seed, int modes, int* fits, std::vector<Row>* rows) {
  const ModalLoop loop = DuctOfModes(2);
  const RecordSpectra record =
      MakeRecordSpectra(SimulateModalLoop(loop, 1.0, seed), CycleFrequency(loop, 150.0, 300.0),
                        FlameInput::kPressureRate);
  const PointStructure structure = FreeStructure(modes);
  const PointPrior prior = PriorOf(structure, record);
  for (const Eigen::VectorXd& start : StartsOf(record, structure, prior, 6, 1)) {
    ++*fits;
    std::vector<PointFit> ends;
    double most = -1e300;
    for (const Row& row : *rows) {
      PointFitOptions options = kToCompare;
      options.converged = row.converged;
      ends.push_back(FitPoint(record, structure, prior, start, options));
      most =
          std::max(most, FitPoint(record, structure, prior, ends.back().parameters).log_posterior);
    }
    for (std::size_t i = 0; i < rows->size(); ++i) {
      Row& row = (*rows)[i];
      const double below = most - ends[i].log_posterior;
      if (!ends[i].converged) {
        ++row.unconverged;
      } else if (below > kFar) {
        ++row.far;
      } else if (below > kNear) {
        ++row.near;
      }
    }
  }
}

void Run() {
  std::vector<Row> rows = {{1.0}, {0.1}, {0.01}};
  int fits = 0;
  for (const std::uint64_t seed : {3, 4, 5, 6}) {
    for (const int modes : {1, 2}) AddRecord(seed, modes, &fits, &rows);
  }
  std::printf("of %d fits\nnats of the next step  by 10 nats and more  by 1 to 10  unconverged\n",
              fits);
  for (const Row& row : rows) {
    std::printf("%21.2f %20d %11d %12d\n", row.converged, row.far, row.near, row.unconverged);
  }
}

}  // namespace
}  // namespace howl

int main() { howl::Run(); }
