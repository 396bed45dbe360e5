#include "app/trial/trial_run.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "app/files/digest.h"
#include "app/process/child_process.h"
#include "app/process/interruption.h"
#include "app/trial/trial_seal.h"
#include "io/json_fields.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// Of more than two causes the verdict is unknown, and what stands beside them is not scored: two
// more may come in, and go again, on the way.
constexpr const char* kMostItemsOfCase = "4";

double UnixSeconds() {
  using std::chrono::duration;
  return duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

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

void MakeCases(const TrialFolder& folder, const TrialRequest& request, int threads,
               const Progress& progress, TrialLog& log) {
  std::vector<CasePlan> plans = PlanCases(request.options, ListRigEffects());
  // Removes what an earlier run left before it could seal anything.
  fs::remove_all(folder.books / "key");
  if (request.shard) {
    std::size_t unit = 0;
    std::erase_if(plans, [&](const CasePlan&) { return !request.shard->Owns(unit++); });
  } else {
    fs::remove_all(folder.root / "cases");
  }
  SealedCases cases;
  std::mutex lock;
  RunUnits(plans.size(), threads, progress, [&](std::size_t i) {
    const fs::path one = folder.CaseFolder(plans[i].name);
    fs::remove_all(one);
    nlohmann::json withheld = MakeRig(request.rig_template, plans[i], one);
    std::string sha256 = Sha256OfFolder(one);
    const std::lock_guard<std::mutex> hold(lock);
    cases.withheld[plans[i].name] = std::move(withheld);
    cases.sha256[plans[i].name] = std::move(sha256);
  });
  StopIfAsked("while the cases were made");
  const std::string seal_sha256 = WriteSeal(folder, request, cases);
  log.Append({{"event", "sealed"}, {"at", TimeStamp()}, {"seal_sha256", seal_sha256}});
}

void RunDiagnoses(const TrialFolder& folder, int threads, const Progress& progress, TrialLog& log) {
  std::set<std::string> done;
  for (const nlohmann::json& entry : log.entries()) {
    if (TextAt(entry, "event") == "diagnosed") done.insert(TextAt(entry, "case"));
  }
  const nlohmann::json seal = nlohmann::json::parse(ReadWholeFile(folder.Seal()).value_or(""));
  std::vector<std::string> left;
  for (const auto& [name, hash] : seal.at("cases").items()) {
    if (!done.contains(name)) left.push_back(name);
  }
  if (left.empty()) return;
  // Half of the cases by one program and half by another would be no trial of either.
  if (Sha256OfFile(ThisProgram()).value_or("") != TextAt(seal, "howl_sha256")) {
    throw UserError(ThisProgram().string(), 0, "",
                    "has changed since the trial was sealed, expected the program that sealed it");
  }
  RunUnits(left.size(), threads, progress, [&](std::size_t i) {
    const std::string& name = left[i];
    const fs::path out = folder.Diagnosis(name).parent_path();
    fs::remove_all(out);
    const auto start = Clock::now();
    const ChildResult result = RunChild(
        {ThisProgram().string(), "diagnose", (folder.CaseFolder(name) / "config.yaml").string(),
         "--out", out.string(), "--threads", "1", "--quiet", "--most-items", kMostItemsOfCase},
        "");
    // A terminal's Ctrl-C reaches the child as well, and may end it before this program notices.
    if (result.status < 0) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (IsInterrupted()) return;
    // That is no answer of the diagnosis: the system ended it, mostly for want of memory.
    if (result.status < 0) {
      throw UserError(out.string(), 0, "",
                      "its diagnosis was ended by a signal, expected the same command again, which "
                      "goes on from here");
    }
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
