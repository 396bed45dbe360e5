#include "app/text/predict_text.h"

#include <algorithm>
#include <cmath>

#include "app/text/text_table.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

// "219.9 (219.5 .. 220.3)"
std::string WithRange(const SampledValue& value, int decimals) {
  if (!std::isfinite(value.median)) return "-";
  return Fixed(value.median, decimals) + " (" + Fixed(value.lo, decimals) + " .. " +
         Fixed(value.hi, decimals) + ")";
}

std::string Significance(const SampledValue& value) {
  if (!std::isfinite(value.median)) return "-";
  return Significant(value.median, 3) + " (" + Significant(value.lo, 3) + " .. " +
         Significant(value.hi, 3) + ")";
}

std::string PointText(const PointPrediction& point) {
  return Significant(point.phi, 4) + (point.rests_on_unreliable ? " *" : "");
}

bool Any(const PredictReport& report, bool (*test)(const PointPrediction&)) {
  return std::ranges::any_of(report.points, test);
}

std::string Table(const PredictReport& report) {
  const std::string amplitude = report.flame == "assumed" ? "q over saturation" : "p amplitude";
  TextTable table(
      {report.operating_parameter, "", "frequency Hz", "growth 1/s", amplitude, "unstable %"});
  for (const PointPrediction& point : report.points) {
    table.AddRow({PointText(point), PointKindName(point.kind), WithRange(point.frequency_hz, 1),
                  WithRange(point.growth_rate, 1), Significance(point.amplitude),
                  Fixed(kPerCent * point.share_unstable, 1)});
  }
  return table.Text();
}

std::string Guarantees(const PredictReport& report) {
  std::string text;
  for (const auto& point : report.guaranteed) {
    if (!point || !point->frequency_hz) continue;
    text += "guaranteed: every member of the family closes its loop at " + point->experiment +
            " within " + Fixed(point->frequency_hz->lo, 1) + " .. " +
            Fixed(point->frequency_hz->hi, 1) + " Hz\n";
  }
  return text;
}

// "the cycle ends at phi 0.6432 (0.6171 .. out of reach)"
// verb: "begin" or "end".
std::string EndText(const CycleEnd& end, const std::string& name, const std::string& verb) {
  std::string text = "the cycle " + verb + "s at " + name + " ";
  if (!std::isfinite(end.median)) {
    text = "where the cycle " + verb +
           "s, the data cannot tell: " + Fixed(kPerCent * end.share_crossing, 0) +
           " % of the members have it " + verb + " within reach";
    const double nearest = end.median > 0.0 ? end.lo : end.hi;
    if (std::isfinite(nearest)) {
      text += std::string(", 2.5 % ") + (end.median > 0.0 ? "below " : "above ") + name + " " +
              Significant(nearest, 4);
    }
    return Wrapped(text, 2) + "\n";
  }
  const auto bound = [](double value) {
    return std::isfinite(value) ? Significant(value, 4) : std::string("out of reach");
  };
  return text + Significant(end.median, 4) + " (" + bound(end.lo) + " .. " + bound(end.hi) + ")\n";
}

std::string CycleText(const PredictReport& report) {
  if (!report.cycle) return "";
  const CycleLimits& cycle = *report.cycle;
  if (cycle.share_unstable < 0.5) {
    return "most members are stable at every measured point: where a cycle begins or ends, the "
           "data cannot tell\n";
  }
  return EndText(cycle.below, report.operating_parameter, "begin") +
         EndText(cycle.above, report.operating_parameter, "end");
}

}  // namespace

std::string PredictText(const PredictReport& report) {
  std::string text = Table(report);
  text += Wrapped("(..): 95 % of the members, " + std::to_string(report.members) + " in " +
                      std::to_string(report.paths) + " draws; no guarantee",
                  2) +
          "\n";
  if (report.flame == "assumed") {
    text +=
        Wrapped(
            "the flame's shape is assumed (a hyperbolic tangent): amplitudes are those of q over "
            "the flame's saturation",
            2) +
        "\n";
  }
  if (Any(report, [](const auto& point) { return point.rests_on_unreliable; })) {
    text += "* next to an experiment that is not reliable\n";
  }
  if (Any(report, [](const auto& point) { return point.kind == PointKind::kOutside; })) {
    text +=
        "outside: further away than the measured range is wide, outside of what the data can "
        "say\n";
  }
  if (Any(report, [](const auto& point) { return 10 * point.without > point.members; })) {
    text +=
        Wrapped(
            "at some points more than a tenth of the draws have no loop (prediction.json counts "
            "them): the interval is that of the others",
            2) +
        "\n";
  }
  if (Any(report, [](const auto& point) {
        return point.kind == PointKind::kMeasured && !point.rests_on_unreliable &&
               point.share_unstable < 0.5;
      })) {
    text += Wrapped(
                "most members are stable at rest at a reliable point, where the rig oscillated: "
                "what keeps that cycle going is not in them",
                2) +
            "\n";
  }
  if (!report.scatter_known) {
    text += Wrapped(
                "two operating points do not show how far a rig is from a straight line between "
                "them: the intervals hold the members' scatter alone, expect more",
                2) +
            "\n";
  }
  return text + Guarantees(report) + CycleText(report);
}

}  // namespace howl
