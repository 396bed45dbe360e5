// Runs another program to its end.
#ifndef HOWL_APP_PROCESS_CHILD_PROCESS_H_
#define HOWL_APP_PROCESS_CHILD_PROCESS_H_

#include <filesystem>
#include <string>
#include <vector>

namespace howl {

struct ChildResult {
  int status = -1;  // exit status; -1 where a signal ended it
  std::string out;
  std::string err;
};

// `input` is the program's standard input. An interruption (interruption.h) ends the program too,
// and so does the end of this one, however it ends. May be called from several threads. Throws
// UserError where the program cannot be started.
ChildResult RunChild(const std::vector<std::string>& words, const std::string& input);

std::filesystem::path ThisProgram();
// The folder of this program: where its siblings are.
std::filesystem::path ProgramFolder();

}  // namespace howl

#endif  // HOWL_APP_PROCESS_CHILD_PROCESS_H_
