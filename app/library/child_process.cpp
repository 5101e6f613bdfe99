#include "app/library/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>

#include "app/cli/progress.h"
#include "sim/base/failure.h"

extern char** environ;

namespace seldinger::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostKept = 64 * 1024;
constexpr rlim_t kMostFileBytes = rlim_t{8} << 30;
constexpr int kLowerPriority = 10, kLook_ms = 100;
constexpr std::chrono::seconds kPatience{3};
constexpr std::string_view kEraseLine = "\x1b[K";

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw base::Failure("no_reader", "no file can be opened for a job");
  }
  ~Pipe() {
    for (int& end : ends) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

// Between fork and exec: system calls alone, since other threads of ours may have held any lock.
[[noreturn]] void become(int nothing, int output, int errors, char** argv, char** environment) {
  ::setpgid(0, 0);  // what a terminal tells our group is for us to pass on
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpriority(PRIO_PROCESS, 0, kLowerPriority);
  const rlimit files{kMostFileBytes, kMostFileBytes};
  ::setrlimit(RLIMIT_FSIZE, &files);
  if (::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 || ::dup2(errors, STDERR_FILENO) < 0 ||
      ::close_range(STDERR_FILENO + 1, ~0U, 0) != 0)
    ::_exit(127);
  ::execve("/proc/self/exe", argv, environment);
  ::_exit(127);
}

// Lines of progress are written over with \r; others end.
class Lines {
 public:
  explicit Lines(const std::function<void(std::string_view)>& whole) : whole_(whole) {}
  void add(std::string_view text) {
    for (const char c : text) {
      if (c != '\n' && c != '\r') {
        if (line_.size() < 400) line_ += c;
        continue;
      }
      tell();
      line_.clear();
    }
    if (line_.starts_with(kEraseLine)) tell();
  }

 private:
  void tell() const {
    const std::string_view told =
        std::string_view(line_).substr(line_.starts_with(kEraseLine) ? kEraseLine.size() : 0);
    if (!told.empty()) whole_(told);
  }
  const std::function<void(std::string_view)>& whole_;
  std::string line_;
};

// False: it has ended.
bool read_some(int from, std::string& kept, Lines* lines) {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::read(from, bytes.data(), bytes.size());
  if (count < 0) return errno == EINTR;
  const std::string_view came(bytes.data(), static_cast<std::size_t>(count));
  kept += came.substr(0, kMostKept - kept.size());
  if (lines != nullptr) lines->add(came);
  return count > 0;
}

}  // namespace

ChildEnd run_this_program(const std::vector<std::string>& words, const std::function<void(std::string_view)>& doing,
                          const std::stop_token& stop) {
  std::vector<std::string> all = {"seldinger"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv, environment;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::string watched = std::string(kWatchedVariable) + "=1";
  for (char** one = environ; *one != nullptr; ++one) environment.push_back(*one);
  environment.insert(environment.end(), {watched.data(), nullptr});

  Pipe output, errors;
  int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const pid_t child = nothing < 0 ? -1 : ::fork();
  if (child == 0) become(nothing, output.ends[1], errors.ends[1], argv.data(), environment.data());
  Pipe::close(nothing);
  Pipe::close(output.ends[1]);
  Pipe::close(errors.ends[1]);
  if (child < 0) throw base::Failure("no_reader", "cannot start a process for a job");

  ChildEnd end;
  Lines lines(doing);
  std::optional<Clock::time_point> told;
  bool out_open = true, errors_open = true;
  while (out_open || errors_open) {
    if (stop.stop_requested() && !told) {
      told = Clock::now();
      ::kill(child, SIGTERM);
    }
    if (told && Clock::now() - *told > kPatience) ::kill(child, SIGKILL);
    std::array<pollfd, 2> ready{
        {{out_open ? output.ends[0] : -1, POLLIN, 0}, {errors_open ? errors.ends[0] : -1, POLLIN, 0}}};
    if (::poll(ready.data(), ready.size(), kLook_ms) <= 0) continue;
    if (ready[0].revents != 0) out_open = read_some(output.ends[0], end.output, nullptr);
    if (ready[1].revents != 0) errors_open = read_some(errors.ends[0], end.errors, &lines);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

}  // namespace seldinger::app
