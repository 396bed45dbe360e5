#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/command_line/command.h"
#include "app/input/record_input.h"
#include "app/text/delay_text.h"
#include "app/text/health_text.h"
#include "app/text/instrument_text.h"
#include "app/text/loop_gain_text.h"
#include "app/text/text_table.h"
#include "app/text/vanishing_text.h"
#include "estimation/analysis/second_crossing.h"
#include "estimation/analysis/spectra/half_width.h"
#include "io/config/reading/config_reading.h"
#include "io/result_files.h"
#include "io/results/analysis_files.h"
#include "io/results/health_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr std::size_t kShownLines = 4;
constexpr int kMostFurtherDecimals = 3;
constexpr const char* kSound =
    "every record has a steady limit cycle, and no mistake of sign, order or sampling rate shows";

// "219.87±0.02": the half width of the 95 % interval, with more decimals where it would be zero.
std::string WithInterval(const Estimate& estimate, int decimals) {
  if (!std::isfinite(estimate.value)) return "-";
  const double half = HalfWidth95(estimate);
  if (!std::isfinite(half)) return Fixed(estimate.value, decimals);
  if (half > 0.0) {
    const int needed = static_cast<int>(std::ceil(-std::log10(half)));
    decimals = std::clamp(needed, decimals, decimals + kMostFurtherDecimals);
  }
  return Fixed(estimate.value, decimals) + "±" + Fixed(half, decimals);
}

std::string StateText(const Analysis& analysis) {
  const Characteristics& cycle = analysis.characteristics;
  if (cycle.state == CycleState::kLimitCycle && !cycle.stationary) return "not stationary";
  return std::string(CycleStateName(cycle.state));
}

void PrintCharacteristics(const AnalysisSet& set, const std::string& operating_parameter) {
  TextTable table(
      {"name", operating_parameter, "state", "f Hz", "phase deg", "gain", "tau ms", "loop gain"});
  for (const Analysis& analysis : set.analyses) {
    const Characteristics& cycle = analysis.characteristics;
    const bool has_cycle = cycle.state != CycleState::kNoLimitCycle;
    const auto shown = [&](const Estimate& estimate, int decimals) {
      return has_cycle ? WithInterval(estimate, decimals) : std::string("-");
    };
    Estimate tau_ms = analysis.tau_s.value_or(Estimate{});
    tau_ms.value *= 1e3;
    tau_ms.std *= 1e3;
    table.AddRow({analysis.name, Significant(analysis.phi, 4), StateText(analysis),
                  shown(cycle.frequency_hz, 2), shown(cycle.phase_deg, 2), shown(cycle.gain, 3),
                  shown(tau_ms, 3), shown(analysis.loop_gain.value_or(Estimate{}), 3)});
  }
  std::printf("%s:\n%s", kPlusMinusLegend, table.Text().c_str());
}

// Of records that have an oscillation beside the cycle, or none that is a cycle but several.
void PrintOscillations(const AnalysisSet& set) {
  TextTable table(
      {"experiment", "cycle", "state", "f Hz", "phase deg", "gain", "% of p", "% of q"});
  bool any = false;
  for (const Analysis& analysis : set.analyses) {
    if (analysis.oscillations.size() < 2) continue;
    any = true;
    for (const Oscillation& one : analysis.oscillations) {
      const Characteristics& c = one.characteristics;
      table.AddRow({analysis.name, one.is_cycle ? "yes" : "no",
                    std::string(CycleStateName(c.state)), WithInterval(c.frequency_hz, 2),
                    WithInterval(c.phase_deg, 2), WithInterval(c.gain, 3),
                    Fixed(kPerCent * one.p_share, 0),
                    analysis.has_heat_release ? Fixed(kPerCent * one.q_share, 0) : "-"});
    }
  }
  if (!any) return;
  std::printf(
      "\nrecords with several oscillations (`cycle_hz: [low, high]` picks another; shares of the "
      "mean "
      "square;\n%s):\n%s",
      kPlusMinusLegend, table.Text().c_str());
}

void PrintLines(const AnalysisSet& set) {
  TextTable table(
      {"experiment", "line Hz", "harmonic", "p", "q", "width Hz", "coherence", "loop deg"});
  for (const Analysis& analysis : set.analyses) {
    std::size_t shown = 0;
    for (const SpectralLine& line : analysis.lines) {
      if (++shown > kShownLines) break;
      table.AddRow({analysis.name, WithInterval(line.frequency_hz, 2),
                    line.harmonic > 0 ? std::to_string(line.harmonic) : "no",
                    Significant(line.p_amplitude, 3), Significant(line.q_amplitude, 3),
                    line.width_hz < line.resolution_hz ? "< " + Significant(line.resolution_hz, 2)
                                                       : Significant(line.width_hz, 2),
                    analysis.has_heat_release ? Fixed(line.coherence, 2) : "-",
                    line.harmonic > 0 ? "-" : Fixed(LoopPhaseErrorAt(analysis, line).value, 0)});
    }
  }
  const std::string title = std::string("strongest lines (all in lines.csv; ") + kPlusMinusLegend +
                            "; loop deg: by how much the loop's phase misses a second crossing "
                            "there):";
  std::printf("\n%s\n%s", Wrapped(title, 2).c_str(), table.Text().c_str());
}

void PrintTransfers(const AnalysisSet& set, const ModelSpec& model) {
  TextTable table(
      {"experiment", "points", "omega Hz", "xi", "N", "M/N", "chi2/dof", "explained %", "noise %"});
  bool any = false;
  for (const Analysis& analysis : set.analyses) {
    if (!analysis.transfer_fit) continue;
    any = true;
    const TransferFit& fit = *analysis.transfer_fit;
    table.AddRow({analysis.name, std::to_string(fit.points.size()), WithInterval(fit.omega_hz, 2),
                  WithInterval(fit.xi, 4), WithInterval(fit.N, 0),
                  model.modes == 2 ? Significant(fit.M.value / fit.N.value, 3) : "-",
                  Fixed(fit.chi_square_per_dof, 2), Fixed(kPerCent * fit.explained_power, 1),
                  Fixed(kPerCent * fit.noise_power, 1)});
  }
  if (any) {
    std::printf("\nq-to-p transfer where p and q are coherent, %s fitted (%s):\n%s",
                model.modes == 2 ? "two modes" : "one mode", kPlusMinusLegend,
                table.Text().c_str());
  }
}

void PrintGrowth(const AnalysisSet& set) {
  for (const Analysis& analysis : set.analyses) {
    if (!analysis.growth) continue;
    const Growth& growth = *analysis.growth;
    std::printf("%s: grows at %s 1/s near %s Hz, from %.2f to %.2f s (%s)\n", analysis.name.c_str(),
                WithInterval(growth.rate_per_s, 3).c_str(),
                WithInterval(growth.frequency_hz, 2).c_str(), growth.start_s, growth.end_s,
                kPlusMinusLegend);
  }
}

bool AnyHeatRelease(const AnalysisSet& set) {
  for (const Analysis& analysis : set.analyses) {
    if (analysis.has_heat_release) return true;
  }
  return false;
}

int RunAnalyseCommand(const Options& options) {
  const Config config = LoadConfig(options.config, LoopsTaken::kAny);
  const std::vector<NamedRecord> records = LoadRecords(config);
  if (records.empty()) {
    throw UserError(config.source.string(), config.experiments.front().line, "experiments",
                    "no experiment has a record, expected at least one to analyse");
  }
  const AnalysisOptions analysis_options = MakeAnalysisOptions(config, options);
  const AnalysisSet set = AnalyseRecords(records, analysis_options);
  const Health health = CheckRecords(config, records, set, analysis_options);
  nlohmann::ordered_json analysis = AnalysisJson(set);
  analysis["oscillations"] = OscillationsJson(set);
  analysis["health"] = HealthJson(health);
  WriteWholeFile(options.out / kCharacteristicsCsv,
                 CharacteristicsCsv(set, config.operating_parameter));
  WriteWholeFile(options.out / kLinesCsv, LinesCsv(set, config.operating_parameter));
  WriteWholeFile(options.out / kOscillationsCsv, OscillationsCsv(set, config.operating_parameter));
  WriteWholeFile(options.out / kTransferCsv, TransferCsv(set, config.operating_parameter));
  WriteWholeFile(options.out / kFlameCurveCsv, FlameCurveCsv(set, config.operating_parameter));
  WriteWholeFile(options.out / "analysis.json", analysis.dump(2) + "\n");
  if (options.quiet) return kDone;
  PrintCharacteristics(set, config.operating_parameter);
  PrintOscillations(set);
  PrintLines(set);
  PrintTransfers(set, config.model);
  PrintGrowth(set);
  if (!AnyHeatRelease(set)) {
    std::printf("phase, gain, delay, flame curve and transfer need heat release: not available\n");
  }
  std::printf("%s", InstrumentText(config, set).c_str());
  std::printf("%s", LowLoopGainText(set).c_str());
  std::printf("%s", DelayText(set.delay).c_str());
  std::printf("%s", VanishingText(set.vanishing_phi, config.operating_parameter).c_str());
  const std::string written =
      "written: characteristics.csv, lines.csv, oscillations.csv, transfer.csv, flame_curve.csv "
      "and analysis.json in " +
      options.out.string();
  std::printf("%s\n", Wrapped(written, 2).c_str());
  std::printf("%s", HealthText(health, kSound, "analysis.json").c_str());
  return kDone;
}

}  // namespace

Command AnalyseCommand() {
  return {
      "analyse",
      "turn records into characteristics with their uncertainty",
      "Reads the records that the config names and estimates, for each: the limit cycle's\n"
      "frequency, q-to-p phase and gain, delay, flame curve and loop gain; all significant\n"
      "spectral lines; each of several oscillations; whether the record is stationary; and the\n"
      "q-to-p transfer wherever the two are coherent. Writes characteristics.csv, lines.csv,\n"
      "oscillations.csv, transfer.csv, flame_curve.csv and analysis.json. What is printed after\n"
      "a ± is half of a 95 % interval; the files' columns _std are standard deviations, that\n"
      "half width over 1.96.",
      {},
      RunAnalyseCommand};
}

}  // namespace howl
