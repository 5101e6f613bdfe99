// A full disk, played by a limit on the size of any file: a Failure, and the library as it was, byte for byte.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

enum Outcome { kDone = 10, kDiskFailure, kOtherFailure };

// Runs the function in a process of its own that can write no byte of a file beyond the limit.
template <typename Function>
int outcome_within(rlim_t limit_bytes, const Function& function) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);  // write() then answers EFBIG
    const rlimit limit{limit_bytes, limit_bytes};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(1);
    int outcome = kOtherFailure;
    try {
      function();
      outcome = kDone;
    } catch (const base::Failure& failure) {
      if (failure.code() == "disk") outcome = kDiskFailure;
    } catch (const std::exception&) {
    }
    ::_exit(outcome);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class FullDiskTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder();
  std::filesystem::path library_ = folder_ / "library";
  std::string case_id_, lesion_id_;

  void make() {
    Library library = open_library(library_);
    case_id_ = add_case(library, sample_case());
    lesion_id_ = add_lesion(library, case_id_, sample_lesion()).value();
  }
};

TEST_F(FullDiskTest, ALibraryThatDoesNotFitLeavesNoFolder) {
  int failures = 0;
  for (rlim_t limit_bytes = 0; limit_bytes <= 4096 * 1024; limit_bytes += 8192) {
    library_ = folder_ / "a" / "b" / "library";
    const int outcome = outcome_within(limit_bytes, [&] { open_library(library_); });
    if (outcome == kDone) break;
    ++failures;
    EXPECT_EQ(outcome, kDiskFailure) << limit_bytes;
    EXPECT_TRUE(std::filesystem::is_empty(folder_)) << limit_bytes;
  }
  EXPECT_GT(failures, 10);
  EXPECT_TRUE(Library::open(library_).has_value());  // and in the end it fitted
}

TEST_F(FullDiskTest, AnExistingFolderStaysEmpty) {
  std::filesystem::create_directory(library_);
  EXPECT_EQ(outcome_within(16 * 1024, [&] { open_library(library_); }), kDiskFailure);
  EXPECT_TRUE(std::filesystem::is_empty(library_));
}

TEST_F(FullDiskTest, ACaseThatDoesNotFitChangesNothing) {
  make();
  NewCase big = sample_case("Big");
  big.volume = sample_volume({128, 128, 64});  // 2 MB that do not compress
  const auto before = contents_of(library_);
  EXPECT_EQ(outcome_within(512 * 1024,
                           [&] {
                             Library library = open_library(library_);
                             add_case(library, big);
                           }),
            kDiskFailure);
  EXPECT_EQ(contents_of(library_), before);
}

TEST_F(FullDiskTest, ACaseWhoseRowsDoNotFitTakesItsFilesBack) {
  make();
  NewCase wordy = sample_case("Wordy");
  wordy.volume = sample_volume({9, 7, 5}, 2);  // small files, large rows
  for (int i = 0; i < 2000; ++i) wordy.attributes.emplace_back(std::to_string(i), std::string(500, 'x'));
  const auto before = contents_of(library_);
  EXPECT_EQ(outcome_within(512 * 1024,
                           [&] {
                             Library library = open_library(library_);
                             add_case(library, wordy);
                           }),
            kDiskFailure);
  EXPECT_EQ(contents_of(library_), before);
}

TEST_F(FullDiskTest, AnAttemptThatDoesNotFitChangesNothing) {
  make();
  const auto before = contents_of(library_);
  EXPECT_EQ(outcome_within(384 * 1024,
                           [&] {
                             Library library = open_library(library_);
                             NewAttempt attempt = sample_attempt(case_id_, lesion_id_);
                             attempt.recording = sample_recording(20'000);
                             static_cast<void>(add_attempt(library, attempt).value());
                           }),
            kDiskFailure);
  EXPECT_EQ(contents_of(library_), before);
  Library library = open_library(library_);
  EXPECT_EQ(library.database().text("PRAGMA integrity_check"), "ok");
}

TEST_F(FullDiskTest, WhatIsThereCanStillBeRead) {
  make();
  EXPECT_EQ(outcome_within(64 * 1024,
                           [&] {
                             Library library = open_library(library_);
                             const CaseRow row = find_case(library, case_id_).value();
                             if (!load_volume(library, row)) throw std::runtime_error("no volume");
                           }),
            kDone);
}

TEST_F(FullDiskTest, AnAccountThatDoesNotFitIsNotThereByHalf) {
  make();
  EXPECT_EQ(
      outcome_within(32 * 1024,
                     [&] {
                       Library library = open_library(library_);
                       for (int i = 0; i < 20; ++i)
                         static_cast<void>(
                             add_user(library, "user " + std::to_string(i), Role::trainee, "a password").value());
                     }),
      kDiskFailure);
  Library library = open_library(library_);
  EXPECT_EQ(library.database().integer("SELECT count(*) FROM account"),
            library.identities().integer("SELECT count(*) FROM identity"));
}

}  // namespace
}  // namespace seldinger::casedb
