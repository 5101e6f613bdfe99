#include "casedb/import/jail/confine.h"

#include <fcntl.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <csignal>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>

namespace seldinger::casedb {
namespace {

std::uint64_t mapped_bytes() {
  unsigned long long pages = 0;
  if (std::FILE* statm = std::fopen("/proc/self/statm", "re")) {  // proc(5): the first number is the total size
    if (std::fscanf(statm, "%llu", &pages) != 1) pages = 0;
    std::fclose(statm);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit(int resource, rlim_t most, bool for_good) {
  rlimit now{};
  ::getrlimit(static_cast<__rlimit_resource>(resource), &now);
  now.rlim_cur = std::min(now.rlim_max, most);
  if (for_good) now.rlim_max = now.rlim_cur;
  ::setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

rlim_t seconds_for(std::uint64_t work_bytes) {
  return std::min(kMostJailSeconds, kJailSpareSeconds + work_bytes / kSlowestBytesPerSecond);
}

void raise(int child, __rlimit_resource resource, const std::function<rlim_t(rlim_t)>& raised) {
  rlimit now{};
  if (::prlimit(child, resource, nullptr, &now) != 0 || now.rlim_cur == RLIM_INFINITY) return;
  now.rlim_cur = std::min(now.rlim_max, raised(now.rlim_cur));
  ::prlimit(child, resource, &now, nullptr);
}

// close_range(2) came with Linux 5.9.
void close_from(int first, int last) {
  if (first > last || ::syscall(SYS_close_range, first, last, 0) == 0) return;
  for (int open = first; open <= std::min(last, 65535); ++open) ::close(open);
}

void leave_descriptors(std::vector<int> kept) {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (std::find(kept.begin(), kept.end(), standard) == kept.end()) ::dup2(nowhere, standard);
  std::sort(kept.begin(), kept.end());
  int next = STDERR_FILENO + 1;
  for (const int one : kept) {
    close_from(next, one - 1);
    next = std::max(next, one + 1);
  }
  close_from(next, std::numeric_limits<int>::max());
}

bool leave_system_calls() {
  const std::unique_ptr<void, void (*)(scmp_filter_ctx)> filter(::seccomp_init(SCMP_ACT_ERRNO(EPERM)),
                                                                &::seccomp_release);
  if (!filter) return false;
  bool good = true;
  for (const int call : {SCMP_SYS(read),         SCMP_SYS(pread64),
                         SCMP_SYS(write),        SCMP_SYS(sendmsg),
                         SCMP_SYS(recvmsg),      SCMP_SYS(close),
                         SCMP_SYS(dup),          SCMP_SYS(fstat),
                         SCMP_SYS(lseek),        SCMP_SYS(brk),
                         SCMP_SYS(munmap),       SCMP_SYS(mremap),
                         SCMP_SYS(madvise),      SCMP_SYS(futex),
                         SCMP_SYS(getrandom),    SCMP_SYS(clock_gettime),
                         SCMP_SYS(gettimeofday), SCMP_SYS(getpid),
                         SCMP_SYS(gettid),       SCMP_SYS(sched_yield),
                         SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask),
                         SCMP_SYS(rt_sigreturn), SCMP_SYS(restart_syscall),
                         SCMP_SYS(exit),         SCMP_SYS(exit_group)})
    good = good && ::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0) == 0;
  const auto with = [&](int call, unsigned argument, scmp_datum_t mask, scmp_datum_t value) {
    const scmp_arg_cmp compared{argument, SCMP_CMP_MASKED_EQ, mask, value};
    good = good && ::seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, call, 1, &compared) == 0;
  };
  with(SCMP_SYS(mmap), 2, PROT_EXEC, 0);
  with(SCMP_SYS(mprotect), 2, PROT_EXEC, 0);
  with(SCMP_SYS(newfstatat), 3, AT_EMPTY_PATH, AT_EMPTY_PATH);                         // what fstat is in glibc
  with(SCMP_SYS(tgkill), 0, ~scmp_datum_t{0}, static_cast<scmp_datum_t>(::getpid()));  // abort()
  return good && ::seccomp_load(filter.get()) == 0;
}

}  // namespace

bool confine(std::vector<int> kept, std::uint64_t bytes, std::uint64_t work_bytes) {
  if (!kConfines) return true;
  leave_descriptors(std::move(kept));
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
  limit(RLIMIT_CORE, 0, true);
  limit(RLIMIT_FSIZE, 0, true);
  limit(RLIMIT_CPU, seconds_for(work_bytes), false);
  limit(RLIMIT_AS, mapped_bytes() + kJailSpareBytes + 2 * bytes, false);
  return leave_system_calls();
}

void widen(int child, std::uint64_t bytes) {
  if (kConfines) raise(child, RLIMIT_AS, [&](rlim_t now) { return now + 2 * bytes; });
}

void allow_work(int child, std::uint64_t work_bytes) {
  if (kConfines) raise(child, RLIMIT_CPU, [&](rlim_t) { return seconds_for(work_bytes); });
}

}  // namespace seldinger::casedb
