// A library on a disk that Linux mounted read-only, as it does when the disk fails, or in a folder without the
// permission to write: it is read, exported and backed up, and whatever would change it says so.
// Was: check, list, export, serve and even backup refused (exit 4).
#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

#include "casedb/keeping/backup.h"
#include "casedb/keeping/bundle.h"
#include "casedb/keeping/check.h"
#include "casedb/people/people.h"
#include "tests/casedb/faults/faults.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr int kHeld = 10, kDidNotHold = 11, kCannotMount = 12;

class ReadOnlyTest : public testing::Test {
 protected:
  fs::path scratch_ = fresh_folder(), folder_ = scratch_ / "library", out_ = scratch_ / "out";
  std::string case_id_, lesion_id_, attempt_id_;

  void SetUp() override {
    faults::set({});
    fs::create_directory(out_);
    fs::permissions(out_, fs::perms::all);
  }
  void add_content(Library& library) {
    case_id_ = add_case(library, sample_case());
    lesion_id_ = add_lesion(library, case_id_, sample_lesion()).value();
    attempt_id_ = add_attempt(library, sample_attempt(case_id_, lesion_id_)).value();
    static_cast<void>(add_user(library, "ann", Role::mentor, "a long password").value());
  }
  // Runs in a child with the library's folder mounted read-only, and says what became of it.
  template <typename Function>
  int on_read_only_disk(const Function& function) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
      const int spaces = CLONE_NEWNS | (::geteuid() == 0 ? 0 : CLONE_NEWUSER);
      const char* at = folder_.c_str();
      if (::unshare(spaces) != 0 || ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
          ::mount(at, at, nullptr, MS_BIND, nullptr) != 0 ||
          ::mount(nullptr, at, nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) != 0)
        ::_exit(kCannotMount);
      ::_exit(outcome_of(function));
    }
    return status_of(child);
  }
  // The same as somebody who may read the folder, and not write it.
  template <typename Function>
  int without_permission(const Function& function) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
      constexpr uid_t kNobody = 65534;
      const bool root = ::geteuid() == 0;
      for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
        if (root && ::lchown(entry.path().c_str(), kNobody, kNobody) != 0) ::_exit(kDidNotHold);
        ::chmod(entry.path().c_str(), entry.is_directory() ? 0500 : 0400);
      }
      if (root && ::lchown(folder_.c_str(), kNobody, kNobody) != 0) ::_exit(kDidNotHold);
      ::chmod(folder_.c_str(), 0500);
      // Its parents may be closed to nobody: from inside, they do not matter.
      if (::chdir(folder_.c_str()) != 0) ::_exit(kDidNotHold);
      if (root && ::setuid(kNobody) != 0) ::_exit(kDidNotHold);
      folder_ = ".";
      ::_exit(outcome_of(function));
    }
    return status_of(child);
  }
  template <typename Function>
  static int outcome_of(const Function& function) {
    try {
      function();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "threw: %s\n", error.what());
      return kDidNotHold;
    }
    std::fflush(nullptr);
    return testing::Test::HasFailure() ? kDidNotHold : kHeld;
  }
  static int status_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  template <typename Function>
  static void expect_refused(const Function& function) {
    try {
      function();
      ADD_FAILURE() << "was done";
    } catch (const base::Failure& failure) {
      EXPECT_EQ(failure.code(), "read_only") << failure.what();
    }
  }
  void expect_readable_only(bool can_go_out) {
    Library library = open_library(folder_);
    EXPECT_TRUE(library.read_only());
    const auto cases = list_cases(library);
    ASSERT_EQ(cases.size(), 1U);
    EXPECT_EQ(load_volume(library, cases.front()).value().hu, sample_volume().hu);
    ASSERT_EQ(list_attempts(library).size(), 1U);
    EXPECT_EQ(difference(load_recording(library, attempt_id_).value(), sample_recording()), "");
    EXPECT_TRUE(log_in(library, "ann", "a long password").has_value());
    EXPECT_TRUE(check_library(folder_, false).value().holds());
    if (can_go_out) {
      ASSERT_TRUE(write_bundle(library, {case_id_}, out_ / "a.sdbundle", "0.1.0").has_value());
      ASSERT_TRUE(back_up(library, out_ / "backup", "0.1.0").has_value());
      ASSERT_TRUE(restore(out_ / "backup", out_ / "restored").has_value());
      EXPECT_TRUE(check_library(out_ / "restored", false).value().holds());
      Library restored = open_library(out_ / "restored");
      EXPECT_EQ(list_attempts(restored).size(), 1U);
    }
    expect_refused([&] { add_case(library, sample_case("B")); });
    expect_refused([&] { static_cast<void>(add_lesion(library, case_id_, sample_lesion())); });
    expect_refused([&] { static_cast<void>(add_attempt(library, sample_attempt(case_id_, lesion_id_))); });
    expect_refused([&] { static_cast<void>(set_level(library, "ann", Level::trainee)); });
    expect_refused([&] { static_cast<void>(check_library(folder_, true)); });
  }
};

TEST_F(ReadOnlyTest, ADiskMountedReadOnlyIsReadAndBackedUp) {
  {
    Library library = open_library(folder_);
    add_content(library);
  }
  const auto before = contents_of(folder_);
  const int outcome = on_read_only_disk([&] { expect_readable_only(true); });
  if (outcome == kCannotMount)
    GTEST_SKIP()
        << "this machine lets nobody mount in a name space of their own, so no disk can be read-only here; "
           "the permissions are tried by the test below";
  EXPECT_EQ(outcome, kHeld);
  EXPECT_EQ(contents_of(folder_), before);
}

// The disk failed in the midst of it: the log holds what the database's file does not.
TEST_F(ReadOnlyTest, WhatOnlyTheLogHoldsIsReadToo) {
  fs::path running = scratch_ / "running";
  {
    Library library = open_library(running);
    add_content(library);
    fs::copy(running, folder_, fs::copy_options::recursive);  // as the disk is when the machine stops
    ASSERT_GT(fs::file_size(folder_ / "seldinger.sqlite-wal"), 0U);
  }
  fs::remove(folder_ / "seldinger.sqlite-shm");
  fs::remove(folder_ / "identities.sqlite-shm");
  const auto before = contents_of(folder_);
  const int outcome = on_read_only_disk([&] { expect_readable_only(true); });
  if (outcome == kCannotMount) GTEST_SKIP() << "this machine lets nobody mount in a name space of their own";
  EXPECT_EQ(outcome, kHeld);
  EXPECT_EQ(contents_of(folder_), before);
}

TEST_F(ReadOnlyTest, AFolderWithoutThePermissionIsReadToo) {
  {
    Library library = open_library(folder_);
    add_content(library);
  }
  EXPECT_EQ(without_permission([&] { expect_readable_only(false); }), kHeld);
  fs::permissions(folder_, fs::perms::owner_all);
  fs::permissions(folder_ / "assets", fs::perms::owner_all);
}

}  // namespace
}  // namespace seldinger::casedb
