#include <glog/logging.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/interruption.h"
#include "app/progress_line.h"
#include "estimation/parallel.h"
#include "io/report/run_file.h"
#include "io/user_error.h"
#include "model/version.h"

namespace howl {
namespace {

void PrintOptions(const std::vector<OptionHelp>& options) {
  for (const OptionHelp& option : options) {
    const std::string left = option.name + (option.value.empty() ? "" : " " + option.value);
    std::printf("  %-22s %s\n", left.c_str(), option.text.c_str());
  }
}

void PrintHelp() {
  std::printf(
      "howl %s: grey-box identification of self-excited feedback loops\n\n"
      "howl COMMAND CONFIG [options]\n\nCommands:\n",
      std::string(Version()).c_str());
  for (const Command& command : Commands()) {
    std::printf("  %-10s %s\n", command.name.c_str(), command.summary.c_str());
  }
  std::printf("\nOptions of every command:\n");
  PrintOptions(CommonOptions());
  std::printf(
      "\nhowl COMMAND --help explains one command.\n"
      "Exit status: 0 done; 1 the answer is negative; 2 bad input.\n");
}

void PrintCommandHelp(const Command& command) {
  std::printf("howl %s CONFIG [options]: %s\n\n%s\n", command.name.c_str(), command.summary.c_str(),
              command.details.c_str());
  if (!command.options.empty()) {
    std::printf("\nOptions:\n");
    PrintOptions(command.options);
  }
  std::printf("\nOptions of every command:\n");
  PrintOptions(CommonOptions());
}

const Command* FindCommand(const std::string& name) {
  for (const Command& command : Commands()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

int Run(const std::vector<std::string>& words) {
  if (words.empty() || words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    PrintHelp();
    return kDone;
  }
  if (words[0] == "--version") {
    std::printf("howl %s\n", std::string(Version()).c_str());
    return kDone;
  }
  const Command* command = FindCommand(words[0]);
  if (command == nullptr) {
    throw UsageError(words[0] + ": no such command, expected one that howl --help lists");
  }
  const Options options = ParseOptions({words.begin() + 1, words.end()}, command->options);
  if (options.help) {
    PrintCommandHelp(*command);
    return kDone;
  }
  if (options.config.empty()) {
    throw UsageError(command->name + ": no config given, expected howl " + command->name +
                     " CONFIG");
  }
  ProgressLine progress(command->name, options.quiet);
  ObserveUnits([&](std::size_t done, std::size_t total) { progress.Show(done, total); });
  const int status = command->run(options);
  if (command->writes_results) NoteRun(options.out, options.config, command->name, options.seed);
  return status;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = google::GLOG_ERROR;
  try {
    return howl::Run({argv + 1, argv + argc});
  } catch (const howl::Interrupted& stop) {
    std::fprintf(stderr, "howl: %s\n", stop.what());
    return howl::kInterrupted;
  } catch (const howl::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const howl::UsageError& error) {
    std::fprintf(stderr, "howl: %s\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "howl: %s\n", error.what());
  }
  return howl::kBadInput;
}
