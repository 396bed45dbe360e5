// Shared base of the residuals that see the acoustics G alone or the loop L of one experiment.
//
// A derived Functor evaluates one residual from Acoustics<T> (or LoopParameters<T>); the base turns
// it into a Ceres block, in two forms:
//   reduced, (5b), (5c): blocks log omega_hz, log xi, log N [, log tau_s]
//   full, (5a):          blocks log omega_hz, log xi, log N, log M or log(M / N) [, log tau_s]
#ifndef HOWL_ESTIMATION_RESIDUALS_ACOUSTIC_RESIDUAL_H_
#define HOWL_ESTIMATION_RESIDUALS_ACOUSTIC_RESIDUAL_H_

#include <ceres/autodiff_cost_function.h>

#include <string>
#include <utility>

#include "estimation/log_parameters.h"
#include "estimation/residuals/residual_adder.h"
#include "model/loop/loop.h"

namespace howl {

// Functor: template <T> T Residual(const Acoustics<T>&) const.
template <typename Functor>
struct AcousticResidual {
  template <typename T>
  bool operator()(const T* log_omega_hz, const T* log_xi, const T* log_N, T* residual) const {
    *residual = functor.Residual(OneModeFromLogs(log_omega_hz, log_xi, log_N));
    return true;
  }

  template <typename T>
  bool operator()(const T* log_omega_hz, const T* log_xi, const T* log_N, const T* log_second,
                  T* residual) const {
    *residual =
        functor.Residual(TwoModesFromLogs(second_mode, log_omega_hz, log_xi, log_N, log_second));
    return true;
  }

  static ceres::CostFunction* CreateReduced(Functor functor) {
    return new ceres::AutoDiffCostFunction<AcousticResidual, 1, 1, 1, 1>(
        new AcousticResidual{std::move(functor), {}});
  }

  static ceres::CostFunction* CreateFull(Functor functor, SecondMode second_mode) {
    return new ceres::AutoDiffCostFunction<AcousticResidual, 1, 1, 1, 1, 1>(
        new AcousticResidual{std::move(functor), second_mode});
  }

  Functor functor;
  SecondMode second_mode;
};

// Functor: template <T> T Residual(const LoopParameters<T>&) const.
template <typename Functor>
struct LoopResidual {
  template <typename T>
  bool operator()(const T* log_omega_hz, const T* log_xi, const T* log_N, const T* log_tau_s,
                  T* residual) const {
    using std::exp;
    *residual = functor.Residual(
        LoopParameters<T>{OneModeFromLogs(log_omega_hz, log_xi, log_N), exp(*log_tau_s)});
    return true;
  }

  template <typename T>
  bool operator()(const T* log_omega_hz, const T* log_xi, const T* log_N, const T* log_second,
                  const T* log_tau_s, T* residual) const {
    using std::exp;
    *residual = functor.Residual(LoopParameters<T>{
        TwoModesFromLogs(second_mode, log_omega_hz, log_xi, log_N, log_second), exp(*log_tau_s)});
    return true;
  }

  static ceres::CostFunction* CreateReduced(Functor functor) {
    return new ceres::AutoDiffCostFunction<LoopResidual, 1, 1, 1, 1, 1>(
        new LoopResidual{std::move(functor), {}});
  }

  static ceres::CostFunction* CreateFull(Functor functor, SecondMode second_mode) {
    return new ceres::AutoDiffCostFunction<LoopResidual, 1, 1, 1, 1, 1, 1>(
        new LoopResidual{std::move(functor), second_mode});
  }

  Functor functor;
  SecondMode second_mode;
};

// Adds the functor's block for experiment i: the full form with two modes, unless the config asks
// for the reduced one.
template <typename Functor>
void AddAcoustic(ResidualAdder& problem, int i, Functor functor, const std::string& suffix = "") {
  using Residual = AcousticResidual<Functor>;
  const bool full = problem.HasTwoModes() && problem.Spec().form != EquationForm::kReduced;
  problem.Add(i,
              full ? Residual::CreateFull(std::move(functor), problem.SecondModeOfModel())
                   : Residual::CreateReduced(std::move(functor)),
              problem.AcousticBlocks(i, full), suffix);
}

template <typename Functor>
void AddLoop(ResidualAdder& problem, int i, Functor functor, const std::string& suffix = "") {
  using Residual = LoopResidual<Functor>;
  problem.Add(i,
              problem.HasTwoModes()
                  ? Residual::CreateFull(std::move(functor), problem.SecondModeOfModel())
                  : Residual::CreateReduced(std::move(functor)),
              problem.LoopBlocks(i), suffix);
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_ACOUSTIC_RESIDUAL_H_
