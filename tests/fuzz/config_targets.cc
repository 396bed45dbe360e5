#include <filesystem>
#include <fstream>

#include "app/campaign/campaign_spec.h"
#include "app/jobs/job_spec.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "tests/fuzz/target.h"

namespace howl {

std::vector<FuzzTarget> ConfigTargets() {
  const auto reading = [](auto read) {
    return [read](std::string_view input) { Answered([&] { (void)read(InputFile(input)); }); };
  };
  const auto any_config = [](const std::filesystem::path& path) {
    return LoadConfig(path, LoopsTaken::kAny);
  };
  return {{"config", reading(any_config)},
          {"campaign", reading(LoadCampaign)},
          {"job", reading(LoadJob)}};
}

}  // namespace howl
