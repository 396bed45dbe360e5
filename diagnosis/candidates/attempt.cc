#include "diagnosis/candidates/attempt.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/verdict/verdict.h"

namespace howl {
namespace {

constexpr double kGainDataSize = 500.0;  // independent bins that a shared parameter draws on
constexpr double kOverdispersion = 2.5;

}  // namespace

Attempt Named(const AttemptContext& at, const Effect& effect) {
  Attempt out;
  out.candidate.effect = effect.id();
  out.candidate.block = effect.block();
  out.kind = effect.kind();
  out.held_out = at.base_held_out;
  out.parameters = static_cast<double>(effect.parameters().size());
  return out;
}

bool ShowsInFlameAlone(const Attempt& attempt) {
  return attempt.fit && (attempt.leaks || !attempt.fit->effect->ChangesAcousticCut());
}

bool ShowsInFlame(const Attempt& attempt) {
  return attempt.fit && attempt.fit->effect->ChangesFlameCut();
}

double NoiseGivenReference(const AttemptContext& at) { return at.reference ? kNearNoise : 0.0; }

bool ShowsLimits(const AttemptContext& at, Channel channel) {
  const bool pressure = channel == Channel::kPressure;
  const ReferenceModel* known = at.reference;
  const bool known_edge =
      known && (pressure ? known->pressure_sharp_edge : known->heat_release_sharp_edge);
  const bool known_levels = known && known->quantisation_levels > 0.0;
  return (!known_edge && HasSharpEdge(*at.records, channel)) ||
         (pressure && !known_levels && FindQuantisation(*at.records).found);
}

EstimatedParameter WithoutError(const std::string& name, double value, const std::string& unit) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  return {name, value, unknown, unknown, unit};
}

double PriceOfParameters(double parameters) { return 0.5 * parameters * std::log(kGainDataSize); }

void PayForParameters(Attempt* attempt) {
  attempt->candidate.gain -= PriceOfParameters(attempt->parameters);
}

double PValue(double gain, double parameters, std::size_t catalogue) {
  if (gain <= 0.0) return 1.0;
  const boost::math::chi_squared distribution(parameters);
  const double one =
      boost::math::cdf(boost::math::complement(distribution, 2.0 * gain / kOverdispersion));
  return -std::expm1(static_cast<double>(catalogue) * std::log1p(-std::min(one, 1.0 - 1e-12)));
}

}  // namespace howl
