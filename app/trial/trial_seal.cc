#include "app/trial/trial_seal.h"

#include <sys/stat.h>

#include "app/files/digest.h"
#include "app/process/child_process.h"
#include "io/json_text.h"
#include "io/whole_file.h"
#include "model/version.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

std::string KeyText(const TrialRequest& request, const SealedCases& cases) {
  Json rig_effects = Json::array();
  for (const RigEffect& effect : ListRigEffects()) {
    rig_effects.push_back({{"id", effect.id},
                           {"block", effect.block},
                           {"in_catalogue", effect.in_catalogue},
                           {"size_name", effect.size_name},
                           {"sizes", effect.sizes}});
  }
  const Json key = {{"schema", "howl.trial_key/1"},
                    {"command", request.command},
                    {"seed", request.options.seed},
                    {"rig_effects", rig_effects},
                    {"cases", cases.withheld}};
  return JsonText(key, 1) + "\n";
}

}  // namespace

std::string WriteSeal(const TrialFolder& folder, const TrialRequest& request,
                      const SealedCases& cases) {
  const std::string key = KeyText(request, cases);
  const std::string sealed = SealText(key, request.Passphrase());
  WriteWholeFile(folder.SealedKey(), sealed);
  chmod(folder.SealedKey().c_str(), S_IRUSR);
  chmod(folder.SealedKey().parent_path().c_str(), S_IRWXU);
  const Json seal = {{"schema", "howl.seal/1"},
                     {"howl_version", Version()},
                     {"howl_sha256", Sha256OfFile(ThisProgram()).value_or("")},
                     {"key_sha256", Sha256(key)},
                     {"sealed_key_sha256", Sha256(sealed)},
                     {"cases", cases.sha256}};
  const std::string text = seal.dump(1) + "\n";
  WriteWholeFile(folder.Seal(), text);
  return Sha256(text);
}

}  // namespace howl
