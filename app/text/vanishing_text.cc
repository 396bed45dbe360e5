#include "app/text/vanishing_text.h"

#include <cmath>

#include "app/text/text_table.h"

namespace howl {

std::string VanishingText(const VanishingPhi& vanishing, const std::string& operating_parameter) {
  if (!vanishing.available) return "";
  if (std::isinf(vanishing.lo) && std::isinf(vanishing.hi)) {
    return "where the loop gain reaches one, the data cannot tell\n";
  }
  return "the loop gain reaches one, and the cycle vanishes, at " + operating_parameter + " " +
         Significant(vanishing.phi, 4) + " (95 %: " + Significant(vanishing.lo, 4) + " .. " +
         Significant(vanishing.hi, 4) + ")\n";
}

}  // namespace howl
