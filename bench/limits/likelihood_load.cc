// The likelihood of one operating point's record (whittle.h) by which loops are fitted and budgets
// are made: its value, and its gradient.
#include <memory>

#include "bench/limits/measured.h"
#include "bench/rig_loop_records.h"
#include "bench/simulated_rig.h"
#include "diagnosis/loop_budget/forms/loop_form.h"
#include "estimation/record_fit/loop/point_likelihood.h"
#include "estimation/record_fit/loop/point_prior.h"
#include "estimation/record_fit/starts/point_starts.h"

namespace howl::limits {
namespace {

struct State {
  RecordSpectra record;
  PointStructure structure = PapersForm().structure;
  std::vector<Eigen::VectorXd> starts;
};

std::shared_ptr<State> TheState() {
  static const std::shared_ptr<State> state = [] {
    const LoopRecord point = LoopRecordsOf(SimulatedPoints(2))[0];
    auto out = std::make_shared<State>();
    out->record = MakeRecordSpectra(point.record, point.cycle_hz, FlameInput::kPressureRate);
    out->starts = StartsOf(out->record, out->structure, PriorOf(out->structure, out->record), 4, 1);
    return out;
  }();
  return state;
}

using Part = double (*)(PointLikelihood*, const Eigen::VectorXd&);

// Two places in turn, so that no value is the one that was last asked for.
std::function<double()> Timed(Part part) {
  return [state = TheState(), part] {
    constexpr std::size_t kTimes = 20;
    PointLikelihood likelihood(state->record, state->structure);
    double sum = 0.0;
    for (std::size_t n = 0; n < kTimes; ++n) sum += part(&likelihood, state->starts[n % 2]);
    return sum == sum ? static_cast<double>(kTimes * state->record.bins()) : 0.0;
  };
}

double Value(PointLikelihood* likelihood, const Eigen::VectorXd& at) {
  return likelihood->Value(at);
}

double Gradient(PointLikelihood* likelihood, const Eigen::VectorXd& at) {
  return likelihood->Gradient(at).sum();
}

}  // namespace

std::vector<Measured> LikelihoodLoads() {
  return {{"likelihood", "bin", [] { return Timed(Value); }},
          {"likelihood, gradient", "bin", [] { return Timed(Gradient); }}};
}

}  // namespace howl::limits
