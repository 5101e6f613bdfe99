// kill -9 of a writer at any moment: nothing that was acknowledged is lost, nothing is half there.
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>

#include "sim/base/rng.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/until.h"

namespace seldinger::casedb {
namespace {

NewAttempt numbered_attempt(const std::string& case_id, const std::string& lesion_id, std::uint64_t number) {
  NewAttempt attempt = sample_attempt(case_id, lesion_id);
  attempt.seed = number;
  attempt.recording = sample_recording(2500, number);
  attempt.picture_png.resize(3000, static_cast<std::byte>(number));
  attempt.picture_png.push_back(static_cast<std::byte>(number >> 8));
  return attempt;
}

// Adds attempts for ever and writes the id of each stored one to the pipe.
[[noreturn]] void write_for_ever(const std::filesystem::path& folder, const std::string& case_id,
                                 const std::string& lesion_id, std::uint64_t first, int pipe) {
  try {
    Library library = open_library(folder);
    for (std::uint64_t number = first;; ++number) {
      const std::string id = add_attempt(library, numbered_attempt(case_id, lesion_id, number)).value();
      if (::write(pipe, id.data(), id.size()) != 36) ::_exit(3);
    }
  } catch (const std::exception&) {
    ::_exit(2);
  }
}

std::set<std::string> read_ids(int pipe) {
  std::string text;
  char buffer[4096];
  for (ssize_t got; (got = ::read(pipe, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(got));
  std::set<std::string> ids;
  for (std::size_t at = 0; at + 36 <= text.size(); at += 36) ids.insert(text.substr(at, 36));
  return ids;
}

TEST(KillTest, NothingAcknowledgedIsLostAndNothingIsHalf) {
  const auto folder = fresh_folder() / "library";
  std::string case_id, lesion_id;
  {
    Library library = open_library(folder);
    case_id = add_case(library, sample_case());
    lesion_id = add_lesion(library, case_id, sample_lesion()).value();
  }
  std::set<std::string> acknowledged;
  base::Rng rng(2024);
  constexpr int kRounds = 25;
  for (int round = 0; round < kRounds; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    pid_t children[2];  // two writers at once
    for (int i = 0; i < 2; ++i) {
      children[i] = ::fork();
      ASSERT_GE(children[i], 0);
      if (children[i] == 0) {
        ::close(ends[0]);
        write_for_ever(folder, case_id, lesion_id, static_cast<std::uint64_t>(round * 2 + i) * 100'000, ends[1]);
      }
    }
    ::close(ends[1]);
    // Every other round surely kills writers at work, however slow the machine; the others at any moment.
    if (round % 2 == 0) {
      pollfd first_id{ends[0], POLLIN, 0};
      EXPECT_EQ(::poll(&first_id, 1, 30'000), 1);
    }
    fixtures::let_pass(rng.uniform() * 0.12);  // the moment of the kill is what is tested
    for (const pid_t child : children) {
      ::kill(child, SIGKILL);
      fixtures::let_pass(rng.uniform() * 0.01);  // and that of the other one's
    }
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself: " << status;
    }
    acknowledged.merge(read_ids(ends[0]));
    ::close(ends[0]);

    Library library = open_library(folder);
    ASSERT_EQ(library.database().text("PRAGMA integrity_check"), "ok") << "round " << round;
    ASSERT_EQ(library.database().integer("SELECT count(*) FROM pragma_foreign_key_check"), 0);
    ASSERT_EQ(
        library.database().integer("SELECT count(*) FROM attempt a WHERE recording_chunks <> "
                                   "(SELECT count(*) FROM recording_chunk c WHERE c.attempt_id = a.attempt_id)"),
        0);
  }
  Library library = open_library(folder);
  std::set<std::string> there;
  for (const AttemptRow& row : list_attempts(library)) {
    there.insert(row.attempt_id);
    const NewAttempt expected = numbered_attempt(case_id, lesion_id, row.seed);
    EXPECT_EQ(row.metrics.size(), expected.metrics.size());
    const auto recording = load_recording(library, row.attempt_id);
    ASSERT_TRUE(recording.has_value()) << recording.error().code;
    EXPECT_EQ(difference(expected.recording, *recording), "");
    EXPECT_EQ(library.load_asset(row.picture_sha256).value(), expected.picture_png);
  }
  for (const std::string& id : acknowledged) EXPECT_EQ(there.count(id), 1U) << "an acknowledged attempt is lost";
  // The test says something only when writers were at work when they were killed.
  EXPECT_GE(acknowledged.size(), static_cast<std::size_t>(kRounds / 2));
  // An attempt may be stored and its writer killed before it could say so: at most one for each kill.
  EXPECT_LE(there.size(), acknowledged.size() + 2 * kRounds);
  RecordProperty("acknowledged", static_cast<int>(acknowledged.size()));
}

TEST(KillTest, AKilledCreationLeavesALibraryOrRoomForOne) {
  const auto folder = fresh_folder();
  base::Rng rng(7);
  int unfinished = 0;
  for (int round = 0; round < 25; ++round) {
    const auto library = folder / std::to_string(round);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      try {
        open_library(library);
      } catch (const std::exception&) {
        ::_exit(2);
      }
      ::_exit(0);
    }
    fixtures::let_pass(rng.uniform() * 0.025);  // the moment of the kill is what is tested
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    if (!Library::open(library)) ++unfinished;
    const auto again = Library::open_or_create(library);
    ASSERT_TRUE(again.has_value()) << again.error().code << " in round " << round;
  }
  EXPECT_GT(unfinished, 0);  // some were killed early enough for the test to say something
}

}  // namespace
}  // namespace seldinger::casedb
