// The fits that a diagnosis has finished, in DIR/diagnosis.state: an append-only log, so that a run
// that was interrupted, or killed, goes on where it stopped. The first line names the format, the
// build of the program (another may fit otherwise), and the inputs; a file of another build, or of
// other inputs, or with one key twice, is rejected and begun anew. An entry is
//
//   key, number of bytes, hash of key and bytes, in one line; the bytes; a line's end
//
// An entry whose hash does not match is skipped and fitted anew; what follows the last whole entry
// is cut off.
#ifndef HOWL_APP_DIAGNOSE_STATE_H_
#define HOWL_APP_DIAGNOSE_STATE_H_

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>

#include "diagnosis/fit_memory.h"

namespace howl {

class DiagnoseState final : public FitMemory {
 public:
  // inputs: all that the fits depend on (InputBytes).
  DiagnoseState(const std::filesystem::path& path, const std::string& inputs);

  std::optional<std::string> Recall(const std::string& key) override;
  void Keep(const std::string& key, const std::string& bytes) override;

  std::size_t recalled() const { return found_.size(); }  // entries at the start
  std::size_t damaged() const { return damaged_; }        // entries that were not believed
  bool refused() const { return refused_; }               // a file was there and was not believed
  // Removes the file; to be called when the results are written.
  void Forget();

 private:
  // The file's whole entries; the offset of their end, 0 where they are not believed.
  std::uintmax_t Load(const std::string& header);

  std::filesystem::path path_;
  std::map<std::string, std::string> found_;
  std::size_t damaged_ = 0;
  bool refused_ = false;
  std::mutex lock_;
  UniqueKeys asked_{"asked for"};
  UniqueKeys kept_{"kept"};
  std::ofstream log_;
};

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_STATE_H_
