#include "app/jobs/config_inputs.h"

#include <filesystem>
#include <vector>

#include "app/files/digest.h"

namespace howl {

std::string ConfigInputsSha256(const Config& config) {
  std::vector<std::filesystem::path> files = {config.source};
  for (const ExperimentConfig& experiment : config.experiments) {
    if (!experiment.record) continue;
    files.push_back(experiment.record->file);
    for (const auto* response :
         {&experiment.record->pressure_response, &experiment.record->heat_release_response}) {
      if (*response && !(*response)->formula) files.push_back((*response)->table);
    }
  }
  std::string list;
  for (const std::filesystem::path& file : files) list += Sha256OfFile(file).value_or("") + "\n";
  return Sha256(list);
}

}  // namespace howl
