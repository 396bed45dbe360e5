// Checks the health of an analysis: why a record has no steady limit cycle, whether its sampling
// rate leaves no room for one, and whether a transfer fits much better with a mistake undone.
//
// In the loop p = G q with G = N s / (s^2 + 2 xi w s + w^2) + ..., N and M positive: Re G > 0 at
// every frequency. The transfer H of a channel with the wrong sign has Re H < 0, and that of p and
// q taken for each other is 1 / G, whose poles are G's zeros. A fit of -H or 1 / H in the place of
// H therefore reveals them, by the same measure as that of mistake_search.h.
#ifndef HOWL_ESTIMATION_HEALTH_ANALYSIS_HEALTH_H_
#define HOWL_ESTIMATION_HEALTH_ANALYSIS_HEALTH_H_

#include <cstdint>
#include <span>

#include "estimation/analysis/analyse.h"
#include "estimation/health/finding.h"

namespace howl {

// Where a record's sampling rate comes from: a number in the config, or the steps of a time column
// that were taken for seconds.
enum class RateSource : std::uint8_t { kNumber, kTimeColumn };

// Finds a record that is no steady limit cycle, with the criterion, the number and the threshold.
Health CheckState(const Analysis& analysis, const CharacteristicsOptions& options);

// Finds a rate at which the search range is empty, and a record whose cycle is slower than 1 Hz, or
// absent, that has one in reach if its time is in milliseconds or microseconds (its rate in kHz or
// MHz).
Health CheckSampling(const NamedRecord& record, const Analysis& analysis,
                     const AnalysisOptions& options, RateSource source);

// Finds transfers with the wrong sign or order, those that are no such model's (a chi-square of
// more than two a degree of freedom), and damping at the end of the transfer fit's search.
Health CheckTransfers(const AnalysisSet& set, const AnalysisOptions& options);

// All checks of an analysis; `set` is that of `records`. Empty `sources`: all rates are numbers of
// the config.
Health CheckAnalysis(std::span<const NamedRecord> records, const AnalysisSet& set,
                     const AnalysisOptions& options, std::span<const RateSource> sources = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_ANALYSIS_HEALTH_H_
