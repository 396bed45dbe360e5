// Only one run at a time writes to an output folder: two that wrote the same files would leave a
// mix of both, and a trial or a campaign begins with removing what it finds.
//
// The lock is flock(2) on a file of its own in the folder, so that it ends with the process,
// however that ends, and holds between machines where the file system supports that. A file system
// without locks gives none.
#ifndef HOWL_APP_FILES_OUTPUT_LOCK_H_
#define HOWL_APP_FILES_OUTPUT_LOCK_H_

#include <filesystem>
#include <string>
#include <vector>

namespace howl {

class OutputLock {
 public:
  enum class Kind {
    kAlone,    // nobody else may have the folder
    kTogether  // others that have it together may: the shards of a job
  };

  // Makes the folder where it is missing. `file` is the lock's name in it; `who` is what another
  // run is told of this one. Waits two seconds for one that is about to end. Throws UserError where
  // the folder is another's, or cannot be written.
  OutputLock(std::filesystem::path folder, const std::string& file, Kind kind,
             const std::string& who);
  // Removes the file, and the folders that were made if nothing is in them.
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

  // The same for all locks at once, from a signal handler that is about to end the program.
  static void RemoveAll();

 private:
  bool Take(Kind kind);
  void Remove() const;

  std::filesystem::path folder_;
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // folders that were missing, the innermost first
  int descriptor_ = -1;
};

}  // namespace howl

#endif  // HOWL_APP_FILES_OUTPUT_LOCK_H_
