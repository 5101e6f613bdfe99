// What a reader in a jail can and cannot do, and what becomes of one that dies or lies.
#include "casedb/import/jail/jail.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "casedb/import/jail/confine.h"
#include "casedb/import/jail/input.h"
#include "casedb/import/jail/unpacking.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

using Reads = std::function<void(Outlet&)>;

class Jail : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fixtures::test_out_dir() / "jail" / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  // What a child says of itself; -1 when it died.
  static int answer(const std::function<int()>& asks, const JailInputs& inputs = {}) {
    int got = -1;
    const auto read = read_in_jail(
        inputs, [&](Outlet& out) { out.put(asks()); }, [&](Inlet& in) { got = in.take<int>(); });
    return read ? got : -1;
  }
  static std::string refusal(const Reads& reads, const std::function<void(Inlet&)>& takes) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const auto read = read_in_jail({}, reads, takes);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    const std::string said = ::testing::internal::GetCapturedStderr();
    if (kConfines) {  // else a sanitizer tells of each signal
      EXPECT_EQ(said, "");
    }
    return read ? "" : read.error().code;
  }

  fs::path folder_;
};

int failed(long result) {
  return result < 0 ? errno : 0;
}

TEST_F(Jail, ItHasNoDescriptorButItsInputsAndOneSocket) {
  if (!kConfines) GTEST_SKIP() << "no confinement beside a sanitizer";
  const int other = ::open("/proc/self/status", O_RDONLY);  // what a library, a log or a server has open
  ASSERT_GE(other, 3);
  const int kept = ::open(write("input", "12345").c_str(), O_RDONLY);
  JailInputs inputs;
  inputs.descriptors = {kept};
  const auto open_ones = [] {
    int count = 0;
    struct stat status {};
    for (int one = 3; one < 4096; ++one) count += ::fstat(one, &status) == 0 ? 1 : 0;
    return count;
  };
  EXPECT_EQ(answer(open_ones), 1);
  EXPECT_EQ(answer(open_ones, inputs), 2);
  EXPECT_EQ(answer([&] { return failed(::lseek(other, 0, SEEK_CUR)); }, inputs), EBADF);
  EXPECT_EQ(answer(
                [&] {
                  char bytes[5] = {};
                  return static_cast<int>(::pread(kept, bytes, sizeof bytes, 0));
                },
                inputs),
            5);
  EXPECT_EQ(answer([] { return static_cast<int>(::read(STDIN_FILENO, nullptr, 0)); }), 0);  // leads nowhere
  ::close(kept);
  ::close(other);
}

TEST_F(Jail, ItCanMakeNothingAndReachNobody) {
  if (!kConfines) GTEST_SKIP() << "no confinement beside a sanitizer";
  const fs::path there = write("there", "x"), fresh = folder_ / "fresh";
  const int parent = ::getpid();
  const std::vector<std::pair<const char*, std::function<long()>>> attempts = {
      {"open for reading", [&] { return ::open(there.c_str(), O_RDONLY); }},
      {"open for writing", [&] { return ::open(there.c_str(), O_WRONLY); }},
      {"a new file", [&] { return ::open(fresh.c_str(), O_CREAT | O_WRONLY, 0600); }},
      {"a new folder", [&] { return ::mkdir(fresh.c_str(), 0700); }},
      {"removal", [&] { return ::unlink(there.c_str()); }},
      {"rename", [&] { return ::rename(there.c_str(), fresh.c_str()); }},
      {"memory as a file", [] { return ::memfd_create("x", 0); }},
      {"a socket", [] { return ::socket(AF_INET, SOCK_STREAM, 0); }},
      {"a local socket", [] { return ::socket(AF_UNIX, SOCK_STREAM, 0); }},
      {"a process", [] { return ::fork(); }},
      {"a program", [] { return ::execl("/bin/true", "true", nullptr); }},
      {"a signal", [&] { return ::kill(parent, SIGTERM); }},
      {"executable memory",
       [] {
         return ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1L
                                                                                                               : 0L;
       }},
      {"its own limits",
       [] {
         const rlimit none{RLIM_INFINITY, RLIM_INFINITY};
         return ::setrlimit(RLIMIT_AS, &none);
       }},
  };
  for (const auto& [what, does] : attempts)
    EXPECT_EQ(answer([&does = does] { return failed(does()); }), EPERM) << what;
  EXPECT_FALSE(fs::exists(fresh));
  EXPECT_TRUE(fs::exists(there));
}

TEST_F(Jail, TheKernelFiltersItsCalls) {
  EXPECT_EQ(jail_filters_calls(), kConfines);
}

TEST_F(Jail, ItIsGivenOnlyTheFilesThatWereNamed) {
  JailInputs inputs;
  inputs.files = {write("listed", "abc"), folder_ / "missing"};
  const fs::path other = write("other", "secret");
  fs::create_symlink("other", folder_ / "link");
  fs::create_directories(folder_ / "sub");
  const auto bytes_in = [&](const fs::path& file, Links links) {
    return answer(
        [&] {
          const InputFile in(file, links);
          return in ? static_cast<int>(in.size()) : -2;
        },
        inputs);
  };
  EXPECT_EQ(bytes_in(folder_ / "listed", Links::followed), 3);
  EXPECT_EQ(bytes_in(folder_ / "missing", Links::followed), -2);
  EXPECT_EQ(bytes_in(other, Links::followed), -2);
  EXPECT_EQ(bytes_in("/etc/passwd", Links::followed), -2);
  inputs.beside = folder_;
  EXPECT_EQ(bytes_in(other, Links::refused), 6);
  EXPECT_EQ(bytes_in(folder_ / "link", Links::followed), -2);
  EXPECT_EQ(bytes_in(folder_ / "sub", Links::followed), -2);
  EXPECT_EQ(bytes_in(folder_ / "sub" / ".." / "other", Links::followed), -2);
  EXPECT_EQ(bytes_in(folder_ / "..", Links::followed), -2);
  EXPECT_EQ(bytes_in("/etc/passwd", Links::followed), -2);
}

TEST_F(Jail, ItsMemoryIsTwiceWhatWasAnnouncedAnd64MiB) {
  if (!kConfines) GTEST_SKIP() << "no limit beside a sanitizer";
  const auto takes = [](std::size_t bytes) {
    void* got = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return got == MAP_FAILED ? 0 : 1;
  };
  EXPECT_EQ(answer([&] { return takes(60 * kMiB); }), 1);
  EXPECT_EQ(answer([&] { return takes(65 * kMiB); }), 0);
  JailInputs inputs;
  inputs.bytes = 100 * kMiB;
  EXPECT_EQ(answer([&] { return takes(260 * kMiB); }, inputs), 1);
  EXPECT_EQ(answer([&] { return takes(265 * kMiB); }, inputs), 0);
  const auto after = [&](std::uint64_t announced, std::size_t bytes) {
    return answer([&] {
      announce_bytes(announced);
      return takes(bytes);
    });
  };
  EXPECT_EQ(after(100 * kMiB, 260 * kMiB), 1);
  EXPECT_EQ(after(100 * kMiB, 265 * kMiB), 0);
  EXPECT_EQ(answer([&] {
              for (const std::uint64_t mib : {50, 100, 20, 100}) announce_largest(mib * kMiB);
              return takes(260 * kMiB) * 10 + takes(10 * kMiB);
            }),
            10);
}

TEST_F(Jail, ItsTimeAndItsFilesAreLimited) {
  if (!kConfines) GTEST_SKIP() << "no limit beside a sanitizer";
  JailInputs inputs;
  inputs.bytes = 100 * kSlowestBytesPerSecond;
  const auto limit_of = [](int child, __rlimit_resource resource) {
    rlimit limit{};
    EXPECT_EQ(::prlimit(child, resource, nullptr, &limit), 0);
    return limit.rlim_cur;
  };
  const auto read = read_in_jail(
      inputs,
      [](Outlet& out) {
        out.put(::getpid());
        announce_bytes(7 * kSlowestBytesPerSecond);
        out.put(::getpid());
        announce_bytes(0);
      },
      [&](Inlet& in) {
        const int child = in.take<int>();
        EXPECT_EQ(limit_of(child, RLIMIT_FSIZE), 0U);
        EXPECT_EQ(limit_of(child, RLIMIT_CORE), 0U);
        EXPECT_EQ(in.take<int>(), child);
        EXPECT_EQ(limit_of(child, RLIMIT_CPU), kJailSpareSeconds + 107);
      });
  EXPECT_TRUE(read.has_value());
}

// Only what lay in memory at once counted: a bundle of 500 large cases, or 7,000 pictures to de-identify, died of
// SIGXCPU after the minute that any reader has.
TEST_F(Jail, WorkOneAfterTheOtherCountsTogether) {
  if (!kConfines) GTEST_SKIP() << "no limit beside a sanitizer";
  JailInputs inputs;
  inputs.bytes = 3 * kSlowestBytesPerSecond;
  inputs.work_bytes = 4 * kSlowestBytesPerSecond;
  const auto seconds_of = [](int child) {
    rlimit limit{};
    EXPECT_EQ(::prlimit(child, RLIMIT_CPU, nullptr, &limit), 0);
    return limit.rlim_cur;
  };
  const auto read = read_in_jail(
      inputs,
      [](Outlet& out) {
        out.put(::getpid());
        announce_work(0);
        for (int part = 0; part < 1000; ++part) announce_work(kSlowestBytesPerSecond / 2);
        out.put(::getpid());
        announce_work(0);
        announce_work(std::uint64_t{1} << 50);
        out.put(::getpid());
        announce_work(0);
      },
      [&](Inlet& in) {
        EXPECT_EQ(seconds_of(in.take<int>()), kJailSpareSeconds + 7);
        EXPECT_EQ(seconds_of(in.take<int>()), kJailSpareSeconds + 507);
        EXPECT_EQ(seconds_of(in.take<int>()), kMostJailSeconds) << "it may lie, but not without end";
      });
  EXPECT_TRUE(read.has_value());
}

// It said nothing while it worked, and was given up after ten minutes.
TEST_F(Jail, WorkIsASignOfLife) {
  JailInputs inputs;
  inputs.longest_silence = std::chrono::milliseconds(1000);
  const auto works = [](bool says_so) {
    for (int part = 0; part < 4; ++part) {
      const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(400);
      while (std::chrono::steady_clock::now() < end) {
      }
      if (says_so) announce_work(1);
    }
    return 1;
  };
  EXPECT_EQ(answer([&] { return works(true); }, inputs), 1);
  EXPECT_EQ(answer([&] { return works(false); }, inputs), -1);
}

TEST_F(Jail, WhateverItDiesOfIsOneRefusal) {
  const auto nothing = [](Inlet& in) { static_cast<void>(in.take<int>()); };
  EXPECT_EQ(refusal([](Outlet&) { std::abort(); }, nothing), "reader_died");
  EXPECT_EQ(refusal(
                [](Outlet&) {
                  ::raise(SIGSEGV);
                  ::_exit(0);
                },
                nothing),
            "reader_died");
  EXPECT_EQ(refusal([](Outlet&) { ::_exit(0); }, nothing), "reader_died");
  EXPECT_EQ(refusal([](Outlet&) { throw std::runtime_error("out"); }, nothing), "reader_died");
  EXPECT_EQ(refusal(
                [](Outlet&) {
                  if (::write(STDERR_FILENO, "noise", 5) != 5) ::_exit(0);
                  throw 1;
                },
                nothing),
            "reader_died");
  EXPECT_EQ(refusal([](Outlet& out) { out.put(1); }, nothing), "");
  if (kConfines) {
    EXPECT_EQ(refusal([](Outlet& out) { out.put(static_cast<int>(std::vector<char>(kGiB, 'x').back())); }, nothing),
              "reader_died");
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child was left";
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(Jail, WhatItMustNotSayIsNotBelieved) {
  const auto text = [](Inlet& in) { static_cast<void>(in.take_text(10)); };
  EXPECT_EQ(refusal([](Outlet& out) { out.put_text("0123456789"); }, text), "");
  EXPECT_EQ(refusal([](Outlet& out) { out.put_text("0123456789a"); }, text), "reader_died");
  EXPECT_EQ(refusal([](Outlet& out) { out.put<std::uint64_t>(~0ULL); }, text), "reader_died");
  EXPECT_EQ(refusal(
                [](Outlet& out) {
                  out.put_text("ab");
                  out.put(1);
                },
                text),
            "reader_died")
      << "more than is asked";
  const auto error = [](Inlet& in) { static_cast<void>(in.take_error()); };
  EXPECT_EQ(refusal(
                [](Outlet& out) {
                  out.put_error({"damaged", "is damaged", {{"truncated", "so"}}});
                },
                error),
            "");
  EXPECT_EQ(refusal([](Outlet& out) { out.put_error({"\x1b[2J", "is damaged"}); }, error), "reader_died");
  const auto announced = [](Inlet& in) { static_cast<void>(in.take<int>()); };
  EXPECT_EQ(refusal(
                [](Outlet& out) {
                  announce_bytes(~0ULL);
                  out.put(1);
                },
                announced),
            "reader_died");
  std::string shown;
  ASSERT_TRUE(
      read_in_jail(
          {}, [](Outlet& out) { out.put_text("a\x1b[31m\nb"); }, [&](Inlet& in) { shown = in.take_text(100); })
          .has_value());
  EXPECT_EQ(shown, "a?[31m?b");
  // C1, which went through: 9B is what ESC [ is, in eight bits and in UTF-8.
  ASSERT_TRUE(read_in_jail(
                  {},
                  [](Outlet& out) {
                    out.put_text(
                        "a\x9B"
                        "31m\xC2\x9B"
                        "b \xC3\x9F \xE2\x82\xAC \xE4");
                  },
                  [&](Inlet& in) { shown = in.take_text(100); })
                  .has_value());
  EXPECT_EQ(shown, "a?31m??b \xC3\x9F \xE2\x82\xAC \xE4");
}

TEST_F(Jail, LongAnswersComeWhole) {
  std::vector<int> got(3'000'000);
  const auto read = read_in_jail(
      {},
      [](Outlet& out) {
        std::vector<int> numbers(3'000'000);
        for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i);
        for (std::size_t i = 0; i < 1000; ++i) out.put(numbers[i]);
        out.put_bytes(std::as_bytes(std::span(numbers).subspan(1000)));
      },
      [&](Inlet& in) { in.take_bytes(std::as_writable_bytes(std::span(got))); });
  ASSERT_TRUE(read.has_value());
  for (std::size_t i = 0; i < got.size(); ++i) ASSERT_EQ(got[i], static_cast<int>(i));
  EXPECT_GT(last_jail_use().peak_bytes, 8 * kMiB);
  EXPECT_LT(last_jail_use().peak_bytes, 64 * kMiB + (kConfines ? 0 : kGiB));
}

TEST_F(Jail, HowFarBytesMayUnpack) {
  EXPECT_FALSE(unpacks_too_far(kCtFile, 1, 64 * kMiB));
  EXPECT_TRUE(unpacks_too_far(kCtFile, 1, 64 * kMiB + 1));
  EXPECT_FALSE(unpacks_too_far(kCtFile, 40 * kMiB, 4000 * kMiB));
  EXPECT_TRUE(unpacks_too_far(kCtFile, kGiB, 4 * kGiB + 1)) << "only with --large";
  EXPECT_FALSE(unpacks_too_far(kLargeCtFile, kGiB, 4 * kGiB + 1));
  EXPECT_EQ(most_unpacked(kDicomDataSet, 1000), 64 * kMiB);
  EXPECT_EQ(most_unpacked(kDicomDataSet, 100 * kMiB), 200 * kMiB);
  EXPECT_EQ(most_unpacked(kDicomDataSet, 900 * kMiB), kGiB);
  EXPECT_FALSE(unpacks_too_far(label_file_limit(100), 70'000, 64 * kMiB));
  EXPECT_TRUE(unpacks_too_far(label_file_limit(100), kGiB, 65 * kMiB));
}

}  // namespace
}  // namespace seldinger::casedb
