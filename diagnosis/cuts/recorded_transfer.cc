#include "diagnosis/cuts/recorded_transfer.h"

namespace howl {
namespace {

// Transfer functions are smooth over several bins. They are therefore evaluated on every kStride-th
// bin and interpolated by cubic Lagrange polynomials.
constexpr Eigen::Index kStride = 4;

// Row i holds the weights of node i for the bins between nodes 1 and 2.
Eigen::Matrix4d LagrangeWeights() {
  Eigen::Matrix4d weights;
  for (Eigen::Index k = 0; k < kStride; ++k) {
    const double u = static_cast<double>(k) / static_cast<double>(kStride);
    weights.col(k) << -u * (u - 1.0) * (u - 2.0) / 6.0, (u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0,
        -(u + 1.0) * u * (u - 2.0) / 2.0, (u + 1.0) * u * (u - 1.0) / 6.0;
  }
  return weights;
}

template <typename F>
Eigen::VectorXcd OnBand(const CutRecord& record, F&& transfer) {
  static const Eigen::Matrix4d weights = LagrangeWeights();
  // Real and imaginary parts are the rows.
  using Bins = Eigen::Matrix<double, 2, Eigen::Dynamic>;
  const Eigen::Index n = record.extended();
  const Eigen::Index blocks = n / kStride + 1;
  Bins nodes(2, blocks + 3);
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    const Response at =
        transfer(record.frequency_hz[0] + static_cast<double>((i - 1) * kStride) * record.bin_hz);
    nodes.col(i) << at.real(), at.imag();
  }
  Eigen::VectorXcd fine(blocks * kStride);
  Eigen::Map<Bins> bins(reinterpret_cast<double*>(fine.data()), 2, fine.size());
  for (Eigen::Index i = 0; i < blocks; ++i) {
    bins.middleCols<kStride>(i * kStride).noalias() = nodes.middleCols<4>(i).lazyProduct(weights);
  }
  fine.conservativeResize(n);
  return fine;
}

}  // namespace

Response FurtherResponse(const std::vector<FurtherMode>& modes, double frequency_hz) {
  Response sum = 0.0;
  for (const FurtherMode& mode : modes) {
    const double omega = kRadPerSPerHz * mode.omega_hz;
    const double w = kRadPerSPerHz * frequency_hz;
    sum += Response(mode.b * omega, mode.a * w) /
           Response(omega * omega - w * w, 2.0 * mode.xi * omega * w);
  }
  return sum;
}

Eigen::VectorXcd RecordedTransfer(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals,
                                  const std::vector<FurtherMode>& further) {
  const Acoustics<double> acoustics = ToAcoustics(record.model, locals);
  const auto path = [&](double f) {
    Response g = effect.Acoustics(acoustics, f, record.at, x);
    if (!further.empty()) g += FurtherResponse(further, f);
    const Response k = g * effect.PressureInstrument(f, x);
    // Complex quotients are slow, and most effects need none.
    const Response h = effect.HeatReleaseInstrument(f, x);
    return h == 1.0 ? k : k / h;
  };
  if (record.reference.acoustic.size() > 0) {
    Eigen::VectorXcd k = OnBand(record, path).cwiseProduct(record.reference.acoustic);
    for (Eigen::Index i = 0; i < k.size(); ++i) {
      k[i] /= 1.0 + effect.PressureLeak(record.frequency_hz[i], record.at, x) * k[i];
    }
    return k;
  }
  return OnBand(record, [&](double f) {
    const Response k = path(f);
    const Response leak = effect.PressureLeak(f, record.at, x);
    return leak == 0.0 ? k : k / (1.0 + leak * k);
  });
}

}  // namespace howl
