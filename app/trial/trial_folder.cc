#include "app/trial/trial_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <set>

#include "app/files/digest.h"
#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

class Changes {
 public:
  explicit Changes(const fs::path& root) : root_(root) {}

  void Add(const fs::path& path, const std::string& what) {
    lines_.push_back(path.lexically_relative(root_).string() + ": " + what);
  }
  // Checks that the file's hash is `expected`.
  void Compare(const fs::path& path, const std::string& expected, const std::string& since) {
    const std::optional<std::string> hash = Sha256OfFile(path);
    if (!hash) {
      Add(path, "is missing or cannot be read");
    } else if (*hash != expected) {
      Add(path, "has changed since " + since);
    }
  }
  std::vector<std::string> lines() && { return std::move(lines_); }

 private:
  fs::path root_;
  std::vector<std::string> lines_;
};

double ModifiedAt(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return 0.0;
  return static_cast<double>(status.st_mtim.tv_sec) +
         1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

void CompareSealed(const TrialFolder& folder, const TrialLog& log, Changes& changes) {
  const std::optional<nlohmann::json> sealed = log.Find("sealed");
  if (!sealed) {
    changes.Add(folder.Log(), "has no entry of the sealing");
    return;
  }
  changes.Compare(folder.Seal(), TextAt(*sealed, "seal_sha256"), "the sealing");
  const nlohmann::json seal =
      ParseJsonOrNone<nlohmann::json>(ReadWholeFile(folder.Seal()).value_or(""));
  if (!seal.is_object()) return;
  changes.Compare(folder.SealedKey(), TextAt(seal, "sealed_key_sha256"), "the sealing");
  if (fs::exists(folder.OpenKey())) {
    changes.Compare(folder.OpenKey(), TextAt(seal, "key_sha256"), "the sealing");
  }
  const nlohmann::json cases = ObjectAt(seal, "cases");
  for (const auto& [name, hash] : cases.items()) {
    if (!IsCaseName(name)) {
      changes.Add(folder.Seal(), "has a name that no case has");
    } else if (Sha256OfFolder(folder.CaseFolder(name)) != hash) {
      changes.Add(folder.CaseFolder(name), "has changed since the sealing");
    }
  }
}

void CompareDiagnoses(const TrialFolder& folder, const TrialLog& log, Changes& changes) {
  double opened_at = 0.0;
  std::set<std::string> seen;
  for (const nlohmann::json& entry : log.entries()) {
    const std::string event = TextAt(entry, "event");
    if (event == "opened") {
      if (opened_at > 0.0) changes.Add(folder.OpenKey(), "was opened twice");
      opened_at = NumberAt(entry, "unix_s", 0.0);
    }
    if (event != "diagnosed") continue;
    const std::string name = TextAt(entry, "case");
    if (!IsCaseName(name)) {
      changes.Add(folder.Log(), "has a name that no case has");
      continue;
    }
    const fs::path path = folder.Diagnosis(name);
    if (opened_at > 0.0) changes.Add(path, "was made after the key was opened");
    if (!seen.insert(name).second) changes.Add(path, "was made twice");
    if (NumberAt(entry, "status", -1.0) == 0) {
      changes.Compare(path, TextAt(entry, "sha256"), "it was logged");
    } else if (fs::exists(path)) {
      changes.Add(path, "is there, but the logged diagnosis failed");
    }
  }
  if (opened_at == 0.0) return;
  for (const std::string& name : seen) {
    if (ModifiedAt(folder.Diagnosis(name)) > opened_at) {
      changes.Add(folder.Diagnosis(name), "was written anew after the key was opened");
    }
  }
}

}  // namespace

void RemoveUnpublished(const TrialFolder& folder) {
  RemoveUnpublished(folder.books);
  RemoveUnpublished(folder.SealedKey().parent_path());
}

bool IsCaseName(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
}

std::string Sha256OfFolder(const fs::path& folder) {
  std::map<std::string, std::string> files;
  std::error_code missing;
  for (const auto& entry : fs::recursive_directory_iterator(folder, missing)) {
    if (entry.is_directory()) continue;
    files[entry.path().lexically_relative(folder).string()] =
        Sha256OfFile(entry.path()).value_or("unreadable");
  }
  std::string list;
  for (const auto& [name, hash] : files) list += hash + "  " + name + "\n";
  return Sha256(list);
}

std::vector<std::string> FindChanges(const TrialFolder& folder, const TrialLog& log) {
  Changes changes(folder.root);
  if (log.broken_line() > 0) {
    changes.Add(folder.Log(), "line " + std::to_string(log.broken_line()) +
                                  " does not follow from the one before");
  }
  CompareSealed(folder, log, changes);
  CompareDiagnoses(folder, log, changes);
  if (const auto scored = log.Find("scored")) {
    const nlohmann::json files = ObjectAt(*scored, "files");
    for (const auto& [file, hash] : files.items()) {
      changes.Compare(folder.root / file, hash.is_string() ? hash.get<std::string>() : "",
                      "the scoring");
    }
  }
  return std::move(changes).lines();
}

}  // namespace howl
