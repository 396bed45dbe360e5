#include "app/text/record_predict_text.h"

#include <algorithm>
#include <cmath>

#include "app/text/text_table.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

std::string WithRange(const PredictedValue& value, int decimals) {
  if (!std::isfinite(value.value)) return "-";
  return Fixed(value.value, decimals) + " (" + Fixed(value.lo, decimals) + " .. " +
         Fixed(value.hi, decimals) + ")";
}

}  // namespace

std::string RecordPredictText(const RecordPrediction& prediction) {
  TextTable table({prediction.operating_parameter, "", "frequency Hz", "growth 1/s", "loop gain",
                   "unstable %"});
  bool any_outside = false;
  for (const RecordPredictionPoint& point : prediction.points) {
    const RestLoopPrediction& loop = point.loop;
    any_outside = any_outside || point.kind == "outside";
    table.AddRow({Significant(point.operating_parameter, 4), point.kind,
                  WithRange(loop.frequency_hz, 1), WithRange(loop.growth_rate_1_s, 1),
                  WithRange(loop.loop_gain, 3),
                  std::isfinite(loop.share_unstable) ? Fixed(kPerCent * loop.share_unstable, 1)
                                                     : std::string("-")});
  }
  std::string text = table.Text();
  text += Wrapped(
              "(..): 95 %, at a measured point by its record, at another by straight lines through "
              "the points, as wide as points scatter about them; unstable: probability that small "
              "oscillations grow; no guarantee",
              2) +
          "\n";
  if (any_outside) {
    text +=
        "outside: further away than the measured range is wide, outside of what the data can "
        "say\n";
  }
  if (prediction.measured_points == 2) {
    text += Wrapped(
                "two operating points do not show how far a rig is from a straight line between "
                "them: the intervals rest on what rigs usually do",
                2) +
            "\n";
  }
  return text;
}

}  // namespace howl
