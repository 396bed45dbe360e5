// The trial's log: one JSON object a line, only ever appended to. Each line holds the SHA-256 of
// the one before, so that no line can be changed, left out or put in afterwards unnoticed; what a
// killed run left unfinished at the end is dropped.
#ifndef HOWL_APP_TRIAL_TRIAL_LOG_H_
#define HOWL_APP_TRIAL_TRIAL_LOG_H_

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace howl {

class TrialLog {
 public:
  explicit TrialLog(std::filesystem::path path);
  // A log that is only read.
  static TrialLog Parse(const std::string& text);
  TrialLog(TrialLog&& other) noexcept;

  // May be called from several threads. The line is on the disk when it returns.
  void Append(nlohmann::ordered_json entry);
  const std::vector<nlohmann::json>& entries() const { return entries_; }
  // The first line whose predecessor was changed; 0 if there is none.
  std::size_t broken_line() const { return broken_line_; }
  std::optional<nlohmann::json> Find(const std::string& event) const;

 private:
  TrialLog();
  // Takes the whole lines; returns where the last of them ends.
  std::size_t Read(const std::string& text);

  std::filesystem::path path_;
  std::vector<nlohmann::json> entries_;
  std::string last_hash_;
  std::size_t broken_line_ = 0;
  std::mutex lock_;
};

// Universal time, to the second.
std::string TimeStamp();

}  // namespace howl

#endif  // HOWL_APP_TRIAL_TRIAL_LOG_H_
