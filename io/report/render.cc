#include "io/report/render.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <thread>

#include "estimation/parallel.h"
#include "io/report/script.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

constexpr int kNoSuchCommand = 127;
constexpr int kHung = -1;
constexpr int kStopped = -2;

// A working folder of its own, removed with it.
class WorkFolder {
 public:
  WorkFolder() {
    std::string form = (std::filesystem::temp_directory_path() / "howl_figures_XXXXXX").string();
    if (mkdtemp(form.data()) == nullptr) throw UserError(form, 0, "", "cannot be made");
    path_ = form;
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The child's exit status; it is ended when it takes too long, or when the user wants no more.
int WaitFor(pid_t child, const RenderOptions& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::chrono::milliseconds nap{1};
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    if (ended < 0 && errno != EINTR) return 1;
    const bool hung =
        std::chrono::duration<double>(Clock::now() - start).count() > options.longest_s;
    if (hung || options.stopped()) {
      kill(child, SIGKILL);
      while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      return hung ? kHung : kStopped;
    }
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, std::chrono::milliseconds{20});
  }
}

// Runs gnuplot on folder/name.gp; its exit status, kNoSuchCommand where there is no gnuplot, kHung
// or kStopped where it was ended.
int RunGnuplot(const std::filesystem::path& folder, const std::string& name,
               const std::string& format, const RenderOptions& options) {
  const std::string log = (folder / (name + "." + format + ".log")).string();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string program = "gnuplot";
  std::string flag = "-e";
  std::string setting = "format='" + format + "'";
  std::string script = name + ".gp";
  char* arguments[] = {program.data(), flag.data(), setting.data(), script.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return kNoSuchCommand;
  return WaitFor(child, options);
}

std::string FirstLine(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find('\n', at);
    if (end == std::string::npos) end = text.size();
    std::string line = text.substr(at, end - at);
    if (line.find_first_not_of(" ^\t") != std::string::npos) return line;
    at = end + 1;
  }
  return "no message";
}

void ReplaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::map<std::string, std::string> RenderFigures(const std::vector<Figure>& figures,
                                                 const std::filesystem::path& folder,
                                                 const RenderOptions& options,
                                                 std::vector<std::string>& missing) {
  const WorkFolder work;
  std::map<std::string, std::string> svgs;
  std::vector<std::string> faults(figures.size());
  std::atomic<bool> no_gnuplot = false;
  std::atomic<bool> hangs = false;
  RunUnits(figures.size(), options.threads, [&](std::size_t i) {
    const Figure& figure = figures[i];
    std::ofstream(work.path() / (figure.name + ".csv")) << figure.csv;
    std::ofstream(work.path() / (figure.name + ".gp")) << WholeScript(figure);
    for (const char* format : {"svg", "pdf"}) {
      if (hangs || options.stopped()) return;
      const int status =
          no_gnuplot ? kNoSuchCommand : RunGnuplot(work.path(), figure.name, format, options);
      if (status == kNoSuchCommand) {
        no_gnuplot = true;
      } else if (status == kHung || status == kStopped) {
        hangs = hangs || status == kHung;
        faults[i] = "it took too long, and was ended; figures after it were not tried";
        std::filesystem::remove(work.path() / (figure.name + "." + format));
      } else if (status != 0) {
        faults[i] = FirstLine(
            ReadWholeFile(work.path() / (figure.name + "." + format + ".log")).value_or(""));
        std::filesystem::remove(work.path() / (figure.name + "." + format));
      }
    }
  });
  if (options.stopped()) return {};
  for (std::size_t i = 0; i < figures.size(); ++i) {
    for (const char* ending : {".csv", ".gp", ".svg", ".pdf"}) {
      const auto made = work.path() / (figures[i].name + ending);
      const auto target = folder / (figures[i].name + ending);
      if (std::filesystem::exists(made)) {
        const std::string text = ReadWholeFile(made).value_or("");
        WriteWholeFile(target, text);
        if (ending == std::string(".svg")) svgs[figures[i].name] = text;
      } else {
        std::error_code ignored;
        std::filesystem::remove(target, ignored);  // of an earlier report
      }
    }
    if (!faults[i].empty()) {
      missing.push_back("gnuplot could not draw " + figures[i].name + ": " + faults[i]);
    }
  }
  if (no_gnuplot) {
    missing.push_back(
        "gnuplot is not installed (Debian: gnuplot-nox): the figures are not drawn; their data and "
        "scripts are in figures/");
  }
  return svgs;
}

std::string InlineSvg(const std::string& svg, const std::string& name, const std::string& title) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string::npos) return {};
  std::string out = svg.substr(start);
  // gnuplot gives every file the same ids for its markers.
  ReplaceAll(out, "id='", "id='" + name + "_");
  ReplaceAll(out, "id=\"", "id=\"" + name + "_");
  ReplaceAll(out, "href='#", "href='#" + name + "_");
  ReplaceAll(out, "url(#", "url(#" + name + "_");
  ReplaceAll(out, "fill=\"#ffffff\"/>", "fill=\"none\"/>");  // the page is the paper
  ReplaceAll(out, "<svg", "<svg role=\"img\" aria-label=\"" + title + "\"");
  const std::size_t own_title = out.find("<title>");
  const std::size_t end = out.find("</title>");
  if (own_title != std::string::npos && end != std::string::npos) {
    out.erase(own_title, end + 8 - own_title);
  }
  return out;
}

}  // namespace howl
