// What the samples of one channel show of the instrument that took them.
//
//   clipped    the largest (or smallest) value stands far more often than the values beside it: a
//              converter or an amplifier at its end. A sine that was sampled in step with its
//              period has each of its values equally often, so that counts beside it tell the two.
//   stuck      one value, for longer than repetitions by chance last: of n samples, where a share r
//              of all runs of equal values goes on after its first, runs of ln n / ln(1 / r) are
//              expected.
//   held       nearly every value stands several times in a row: sampled slower than it is stored.
//   coarse     few different values: a signal of a few steps of the converter.
//   appended   the record's start comes again, sample for sample: a file behind itself.
#ifndef HOWL_ESTIMATION_HEALTH_SAMPLE_HEALTH_H_
#define HOWL_ESTIMATION_HEALTH_SAMPLE_HEALTH_H_

#include <span>
#include <string>
#include <vector>

#include "estimation/analysis/instruments/draw_clipped.h"
#include "estimation/analysis/spectra/gap.h"
#include "estimation/health/finding.h"

namespace howl {

// `channel`: "p" or "q". Samples are finite, as they were recorded.
Health CheckSamples(const std::string& experiment, const std::string& channel,
                    std::span<const double> samples, double sampling_hz);

// What was lost wherever a stuck signal stands still: all samples of such a run but its first. Of a
// signal that is not stuck none.
std::vector<Gap> StuckSamples(std::span<const double> samples);

// The largest and the smallest value, where they stand as often as those of a clipped signal;
// infinite where they do not.
RangeEnds RepeatedEnds(std::span<const double> samples);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_SAMPLE_HEALTH_H_
