#include "app/trial/trial_run.h"

#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <set>
#include <thread>

#include "app/child_process.h"
#include "app/digest.h"
#include "app/interruption.h"
#include "io/user_error.h"
#include "io/whole_file.h"
#include "model/version.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double UnixSeconds() {
  using std::chrono::duration;
  return duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string HowlProgram() { return fs::read_symlink("/proc/self/exe").string(); }

// Threads take units from 0 to count; the first error is thrown when all have stopped.
void RunUnits(std::size_t count, int threads, const Progress& progress,
              const std::function<void(std::size_t)>& unit) {
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::exception_ptr error;
  std::mutex lock;
  const auto work = [&] {
    while (!IsInterrupted()) {
      const std::size_t i = next++;
      if (i >= count) return;
      try {
        unit(i);
      } catch (...) {
        const std::lock_guard<std::mutex> hold(lock);
        if (!error) error = std::current_exception();
        next = count;
      }
      const std::lock_guard<std::mutex> hold(lock);
      if (progress) progress(++done, count);
    }
  };
  std::vector<std::thread> pool;
  for (int t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

void StopIfAsked(const char* what) {
  if (!IsInterrupted()) return;
  throw Interrupted(std::string("interrupted ") + what + ": the same command goes on from there");
}

}  // namespace

std::string TrialRequest::Passphrase() const {
  std::string text = "howl trial " + config_sha256 + " " + std::to_string(options.seed) + " " +
                     std::to_string(options.cases);
  for (const std::string& effect : options.effects) text += " " + effect;
  for (const double severity : options.severities) text += " " + std::to_string(severity);
  return text + "\n" + RigSpecYaml(rig_template, {});
}

void MakeCases(const TrialFolder& folder, const TrialRequest& request, int threads,
               const Progress& progress, TrialLog& log) {
  const std::vector<RigEffect> effects = ListRigEffects();
  const std::vector<CasePlan> plans = PlanCases(request.options, effects);
  // Removes what an earlier run left before it could seal anything.
  fs::remove_all(folder.root / "cases");
  fs::remove_all(folder.root / "key");
  std::vector<nlohmann::json> keys(plans.size());
  std::vector<std::string> hashes(plans.size());
  RunUnits(plans.size(), threads, progress, [&](std::size_t i) {
    keys[i] = MakeRig(request.rig_template, plans[i], folder.CaseFolder(plans[i].name));
    hashes[i] = Sha256OfFolder(folder.CaseFolder(plans[i].name));
  });
  StopIfAsked("while the cases were made");

  Json rig_effects = Json::array();
  for (const RigEffect& effect : effects) {
    rig_effects.push_back({{"id", effect.id},
                           {"block", effect.block},
                           {"in_catalogue", effect.in_catalogue},
                           {"size_name", effect.size_name},
                           {"sizes", effect.sizes}});
  }
  Json cases = Json::object();
  Json case_hashes = Json::object();
  for (std::size_t i = 0; i < plans.size(); ++i) {
    cases[plans[i].name] = keys[i];
    case_hashes[plans[i].name] = hashes[i];
  }
  const Json key = {{"schema", "howl.trial_key/1"},
                    {"command", request.command},
                    {"seed", request.options.seed},
                    {"rig_effects", rig_effects},
                    {"cases", cases}};
  const std::string key_text = key.dump(1) + "\n";
  const std::string sealed = SealText(key_text, request.Passphrase());
  WriteWholeFile(folder.SealedKey(), sealed);
  chmod(folder.SealedKey().c_str(), S_IRUSR);
  chmod(folder.SealedKey().parent_path().c_str(), S_IRWXU);
  const Json seal = {{"schema", "howl.seal/1"},
                     {"sealed_at", TimeStamp()},
                     {"howl_version", Version()},
                     {"howl_sha256", Sha256OfFile(HowlProgram()).value_or("")},
                     {"key_sha256", Sha256(key_text)},
                     {"sealed_key_sha256", Sha256(sealed)},
                     {"cases", case_hashes}};
  const std::string seal_text = seal.dump(1) + "\n";
  WriteWholeFile(folder.Seal(), seal_text);
  log.Append({{"event", "sealed"}, {"at", TimeStamp()}, {"seal_sha256", Sha256(seal_text)}});
}

void RunDiagnoses(const TrialFolder& folder, int threads, const Progress& progress, TrialLog& log) {
  std::set<std::string> done;
  for (const nlohmann::json& entry : log.entries()) {
    if (entry.value("event", "") == "diagnosed") done.insert(entry.value("case", ""));
  }
  const nlohmann::json seal = nlohmann::json::parse(ReadWholeFile(folder.Seal()).value_or(""));
  std::vector<std::string> left;
  for (const auto& [name, hash] : seal.at("cases").items()) {
    if (!done.contains(name)) left.push_back(name);
  }
  if (left.empty()) return;
  // Half of the cases by one program and half by another would be no trial of either.
  if (Sha256OfFile(HowlProgram()).value_or("") != seal.value("howl_sha256", "")) {
    throw UserError(HowlProgram(), 0, "",
                    "has changed since the trial was sealed, expected the program that sealed it");
  }
  RunUnits(left.size(), threads, progress, [&](std::size_t i) {
    const std::string& name = left[i];
    const fs::path out = folder.Diagnosis(name).parent_path();
    fs::remove_all(out);
    const auto start = Clock::now();
    const ChildResult result =
        RunChild({HowlProgram(), "diagnose", (folder.CaseFolder(name) / "config.yaml").string(),
                  "--out", out.string(), "--threads", "1", "--quiet"},
                 "");
    // A terminal's Ctrl-C reaches the child as well, and may end it before this program notices.
    if (result.status < 0) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (IsInterrupted()) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    Json entry = {{"event", "diagnosed"},
                  {"case", name},
                  {"at", TimeStamp()},
                  {"status", result.status},
                  {"seconds", seconds}};
    if (result.status == 0) {
      entry["sha256"] = Sha256OfFile(folder.Diagnosis(name)).value_or("");
    } else {
      entry["error"] = result.err.substr(0, 1000);
      fs::remove_all(out);
    }
    log.Append(entry);
  });
  StopIfAsked("while the diagnoses ran");
}

std::string DecipherKey(const TrialFolder& folder, const TrialRequest& request) {
  const std::optional<std::string> sealed = ReadWholeFile(folder.SealedKey());
  if (!sealed) return "";
  return OpenText(*sealed, request.Passphrase()).value_or("");
}

void OpenKey(const TrialFolder& folder, const std::string& key, TrialLog& log) {
  WriteWholeFile(folder.OpenKey(), key);
  log.Append({{"event", "opened"},
              {"at", TimeStamp()},
              {"unix_s", UnixSeconds()},
              {"key_sha256", Sha256(key)}});
}

}  // namespace howl
