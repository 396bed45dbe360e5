// A reader as a fuzzer calls it: any bytes in, and either what they hold or one line that says what
// is wrong. Anything else that happens (another exception, a CHECK, a sanitizer's finding) ends the
// program. libFuzzer calls it with inputs that it makes (fuzz_main.cc), every check with those that
// are kept (corpus_test.cc).
#ifndef HOWL_TESTS_FUZZ_TARGET_H_
#define HOWL_TESTS_FUZZ_TARGET_H_

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

struct FuzzTarget {
  std::string name;  // of its corpus in tests/fuzz/corpus too
  std::function<void(std::string_view)> run;
};

// Configs, and what else is YAML.
std::vector<FuzzTarget> ConfigTargets();
// Records in every format.
std::vector<FuzzTarget> RecordTargets();
// What a report, howl list and howl regress read of results.
std::vector<FuzzTarget> ResultTargets();
// What an interrupted, sharded or submitted run reads of itself.
std::vector<FuzzTarget> StateTargets();
// What fits, campaigns and trials read of what they kept.
std::vector<FuzzTarget> KeptTargets();

std::vector<FuzzTarget> AllTargets();

// A folder of this process, in memory where the system has such a place; removed with the process.
const std::filesystem::path& ScratchFolder();
// The path of a file in it that has these bytes, until the next call.
std::filesystem::path InputFile(std::string_view bytes);

// The input is several files, each behind a line "#file NAME". Of the names those that are known
// are written to the folder, where those that the input has not are removed.
void WriteFiles(const std::filesystem::path& folder, std::span<const std::string_view> known,
                std::string_view input);

// That what is said is one line of text, and not too long.
void CheckIsOneLine(std::string_view line);

// Runs `read`. A UserError is an answer: it must be one line of text, and not too long.
void Answered(const std::function<void()>& read);

}  // namespace howl

#endif  // HOWL_TESTS_FUZZ_TARGET_H_
