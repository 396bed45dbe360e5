// Finished units of a long job, in one file that only ever grows, so that a run that was
// interrupted, or killed, loses none of them. The first line is a header that says whose units they
// are; each unit then is
//
//   key, number of bytes, hash of key and bytes, in one line; the bytes; a line's end
//
// A unit whose hash does not match is not believed; what follows the last whole unit is cut off.
#ifndef HOWL_APP_JOBS_UNIT_STORE_H_
#define HOWL_APP_JOBS_UNIT_STORE_H_

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace howl {

using Units = std::map<std::string, std::string>;  // bytes by key; a key has no blanks

struct StoredUnits {
  bool is_there = false;
  std::string header;  // without its line's end
  Units units;
  std::size_t damaged = 0;     // units that were not believed
  bool repeats_a_key = false;  // no program wrote that
  std::uintmax_t end = 0;      // of the last whole unit, in bytes
};
StoredUnits ReadUnits(const std::filesystem::path& path);

// A whole file of this form.
std::string StoreText(std::string_view header, const Units& units);

// The program that runs: its version and its SHA-256. Another build may compute other units.
std::string ProgramIdentity();

class UnitStore {
 public:
  // Goes on with the file where its header is this one; begins it anew where it is another's, or
  // has a key twice.
  UnitStore(std::filesystem::path path, const std::string& header);

  const Units& found() const { return stored_.units; }  // at the start
  std::size_t damaged() const { return stored_.damaged; }
  bool refused() const { return refused_; }  // a file was there and was begun anew

  // May be called from several threads. With a full disk the unit is not kept, and the run goes on.
  void Append(const std::string& key, const std::string& bytes);
  // Removes the file; to be called when the results are written.
  void Forget();

 private:
  std::filesystem::path path_;
  StoredUnits stored_;
  bool refused_ = false;
  std::mutex lock_;
  std::ofstream log_;
};

// On standard error: how many fits are done already, or why the work is begun anew.
void SayWhereItGoesOn(const UnitStore& store, const std::filesystem::path& path);

}  // namespace howl

#endif  // HOWL_APP_JOBS_UNIT_STORE_H_
