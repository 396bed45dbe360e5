#include <glog/logging.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/command_line.h"
#include "app/command_line/negative_answer.h"
#include "app/help/completion.h"
#include "app/help/help_text.h"
#include "app/help/help_topics.h"
#include "app/jobs/output_claim.h"
#include "app/process/interruption.h"
#include "app/process/progress_line.h"
#include "app/process/standard_streams.h"
#include "estimation/kept_memory.h"
#include "estimation/parallel.h"
#include "io/report/run_file.h"
#include "io/user_error.h"
#include "model/version.h"

namespace howl {
namespace {

void Print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

int PrintVersion() {
  std::printf("howl %s\n", std::string(Version()).c_str());
  return kDone;
}

// glog prints what --v or --vmodule ask for, and errors.
void LogAsAsked() {
  const bool asked = FLAGS_v > 0 || !FLAGS_vmodule.empty();
  FLAGS_minloglevel = asked ? google::GLOG_INFO : google::GLOG_ERROR;
}

// The prefix of messages about faults that are not the user's: "howl: ", or the config and the
// command.
std::string running = "howl: ";

std::string NoMemory() {
  return running + "there is not enough memory, expected fewer or shorter records";
}

std::string Fault(const std::exception& error) {
  const std::string what = error.what();
  // Of a library that starts threads.
  if (what.find("pthread_create") != std::string::npos) {
    return "no more threads can be started, expected fewer (--threads 1) or more memory";
  }
  return "fails: " + what;
}

std::vector<std::string> RestOf(CommandLine* line) {
  std::vector<std::string> words;
  while (auto word = line->NextWord()) words.push_back(*std::move(word));
  return words;
}

int Run(const std::vector<std::string>& words) {
  if (IsCompletion(words)) {
    Print(CompletionText(Complete({words.begin() + 2, words.end()})));
    return kDone;
  }
  CommandLine line(words);
  std::optional<std::string> word = line.NextWord();
  const bool asks = word == "help";  // howl help [COMMAND]
  if (asks) word = line.NextWord();
  if (!word) {
    if (line.WantsVersion()) return PrintVersion();
    Print(ProgramHelp());
    return kDone;
  }
  if (asks && std::ranges::count(HelpTopics(), *word) > 0) {
    Print(HelpTopic(*word, RestOf(&line)));
    return kDone;
  }
  const Command& command = FindCommand(*word);
  line.SetCommand(command);
  const std::vector<std::string> operands = RestOf(&line);
  if (operands.size() > 1 && !command.TakesSeveral()) {
    throw UsageError(operands[1] + ": a second config, expected one, after " + operands[0]);
  }
  if (line.WantsVersion()) return PrintVersion();
  if (asks || line.WantsHelp()) {
    Print(CommandHelp(command));
    return kDone;
  }
  if (operands.empty()) {
    throw UsageError(command.name + ": no " + (command.TakesSeveral() ? "file" : "config") +
                     " given, expected howl " + command.name + " " + command.operands);
  }
  const Options options = line.Finish(operands);
  running = options.config.string() + ": " + command.name + ": ";
  LogAsAsked();
  AllowThreads(options.threads);
  KeepFreedMemory();
  ProgressLine progress(command.name, options.quiet);
  ObserveUnits([&](std::size_t done, std::size_t total) { progress.Show(done, total); });
  const std::unique_ptr<OutputClaim> claim =
      command.writes_output
          ? std::make_unique<OutputClaim>(options.out, command.name, ShardOf(options))
          : nullptr;
  const int status = command.run(options);
  if (command.writes_results) NoteRun(options.out, options.config, command.name, options.seed);
  return status;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::SecureStandardStreams();
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  howl::EndWhenInterrupted(howl::OutputLock::RemoveAll);
  try {
    const int status = howl::Run({argv + 1, argv + argc});
    howl::FlushOutput();
    return status;
  } catch (const howl::Interrupted& stop) {
    std::fprintf(stderr, "howl: %s\n", stop.what());
    return howl::kInterrupted;
  } catch (const howl::NegativeAnswer& answer) {
    std::fprintf(stderr, "%s\n", answer.what());
    return howl::kNegativeAnswer;
  } catch (const howl::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const howl::UsageError& error) {
    std::fprintf(stderr, "howl: %s\n", error.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s\n", howl::NoMemory().c_str());
  } catch (const std::length_error&) {
    std::fprintf(stderr, "%s\n", howl::NoMemory().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s%s\n", howl::running.c_str(), howl::Fault(error).c_str());
  }
  return howl::kBadInput;
}
