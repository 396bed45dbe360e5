#include "app/diagnose/search_options.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "app/diagnose/listed_names.h"
#include "app/input/diagnose_input.h"
#include "app/process/interruption.h"
#include "app/process/progress_line.h"

namespace howl {

DiagnosisOptions SearchOptions(const Config& config, const Options& options) {
  DiagnosisOptions how;
  how.model = BaseOf(config);
  how.choose_modes = !StatesModes(config);
  how.choose_delays = !StatesDelays(config);
  how.threads = options.threads;
  how.withheld = Withheld(options);
  how.seed = options.seed;
  std::ranges::copy(DeclaredEffectsOf(config), std::back_inserter(how.further));
  if (!options.quiet && isatty(STDERR_FILENO) != 0) {
    how.progress = [](std::size_t done, std::size_t total) {
      static ProgressLine line("starts of the search", false);
      line.Show(done, total);
    };
  }
  how.stopped = IsInterrupted;
  return how;
}

}  // namespace howl
