// Bytes of text per second on one core. `vs_naive` is the speed as a multiple of std::getline and
// strtod's on the same text, measured in the same run.
//   HOWL_BENCH_ROWS=30000000   rows of the long record: ten minutes at 50 kHz
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/records/records.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

enum Digits : int { kFew = 6, kMost = 17 };

// A text file for the time of the program: time, p and q to so many significant digits.
class TextFile {
 public:
  TextFile(std::size_t rows, int digits, bool gzip)
      : path_(fs::temp_directory_path() /
              ("howl_records_bench." + std::to_string(getpid()) + "." + std::to_string(digits))) {
    const gzFile file = gzopen(path_.c_str(), gzip ? "wb1" : "wbT");
    gzputs(file, "t,p,q\n");
    char line[100];
    for (std::size_t i = 0; i < rows; ++i) {
      const auto phase = 0.0276 * static_cast<double>(i);
      const int size =
          std::snprintf(line, sizeof(line), "%.5f,%.*g,%.*g\n", static_cast<double>(i) / 50000.0,
                        digits, std::sin(phase), digits, std::cos(1.618 * phase));
      gzwrite(file, line, static_cast<unsigned>(size));
      bytes_ += static_cast<std::size_t>(size);
    }
    gzclose(file);
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile() { fs::remove(path_); }
  const fs::path& path() const { return path_; }
  std::size_t bytes() const { return bytes_; }

 private:
  fs::path path_;
  std::size_t bytes_ = 6;
};

RecordSpec PressureAndHeatRelease(const fs::path& file) {
  return {.file = file, .heat_release = "q", .sampling_hz = 50000.0};
}

Record ReadNaively(const fs::path& file) {
  Record record{.sampling_hz = 50000.0};
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const char* at = line.c_str() + line.find(',') + 1;
    char* end = nullptr;
    record.pressure.push_back(std::strtod(at, &end));
    record.heat_release.push_back(std::strtod(end + 1, nullptr));
  }
  return record;
}

double Seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

void Csv(benchmark::State& state) {
  const TextFile file(500000, static_cast<int>(state.range(0)), false);
  double seconds = 0.0;
  double naive_seconds = 0.0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(
        LoadRecord(PressureAndHeatRelease(file.path()), "bench", 0).pressure.data());
    const auto middle = std::chrono::steady_clock::now();
    state.SetIterationTime(Seconds(middle - start));
    seconds += Seconds(middle - start);
    benchmark::DoNotOptimize(ReadNaively(file.path()).pressure.data());
    naive_seconds += Seconds(std::chrono::steady_clock::now() - middle);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(file.bytes()) * state.iterations());
  state.counters["vs_naive"] = naive_seconds / seconds;
}
BENCHMARK(Csv)->Arg(kFew)->Arg(kMost)->UseManualTime()->Unit(benchmark::kMillisecond);

void CsvWithTime(benchmark::State& state) {
  const TextFile file(500000, static_cast<int>(state.range(0)), false);
  RecordSpec spec = PressureAndHeatRelease(file.path());
  spec.time = "t";
  for (auto _ : state) benchmark::DoNotOptimize(LoadRecord(spec, "bench", 0).pressure.data());
  state.SetBytesProcessed(static_cast<std::int64_t>(file.bytes()) * state.iterations());
}
BENCHMARK(CsvWithTime)->Arg(kFew)->Arg(kMost)->Unit(benchmark::kMillisecond);

// Bytes of unpacked text.
void GzipCsv(benchmark::State& state) {
  const TextFile file(500000, static_cast<int>(state.range(0)), true);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        LoadRecord(PressureAndHeatRelease(file.path()), "bench", 0).pressure.data());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(file.bytes()) * state.iterations());
}
BENCHMARK(GzipCsv)->Arg(kFew)->Arg(kMost)->Unit(benchmark::kMillisecond);

void WriteCsv(benchmark::State& state) {
  const TextFile file(500000, kMost, false);
  const Record record = LoadRecord(PressureAndHeatRelease(file.path()), "bench", 0);
  const fs::path out = file.path().string() + ".out";
  for (auto _ : state) WriteRecordCsv(out, record);
  state.SetBytesProcessed(static_cast<std::int64_t>(fs::file_size(out)) * state.iterations());
  fs::remove(out);
}
BENCHMARK(WriteCsv)->Unit(benchmark::kMillisecond);

// Peak resident memory of the whole program over the size of the record's samples. Runs only when
// asked for, alone (--benchmark_filter=LongRecord/0), since a peak never falls.
void LongRecord(benchmark::State& state) {
  const char* rows = std::getenv("HOWL_BENCH_ROWS");
  if (rows == nullptr) {
    state.SkipWithError("HOWL_BENCH_ROWS is not set");
    return;
  }
  const TextFile file(std::strtoull(rows, nullptr, 10), kMost, state.range(0) != 0);
  RecordSpec spec = PressureAndHeatRelease(file.path());
  spec.time = "t";
  double samples_bytes = 0.0;
  for (auto _ : state) {
    const Record record = LoadRecord(spec, "bench", 0);
    samples_bytes = 16.0 * static_cast<double>(record.pressure.size());
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.SetBytesProcessed(static_cast<std::int64_t>(file.bytes()) * state.iterations());
  state.counters["peak_rss_MB"] = static_cast<double>(usage.ru_maxrss) * 1024e-6;
  state.counters["peak_over_samples"] = static_cast<double>(usage.ru_maxrss) * 1024 / samples_bytes;
}
BENCHMARK(LongRecord)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace howl
