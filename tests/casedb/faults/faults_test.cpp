// kill -9, failing writes, failing fsyncs and a full disk in the midst of an import, of authoring, of an attempt,
// of a bundle's import: no corruption, nothing acknowledged lost, nothing half, and after a repair nothing left
// over. 50 of each; SELDINGER_FAULTS sets another number (the label `long` runs 1,000).
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <set>

#include "casedb/import/import.h"
#include "casedb/import/skin/surface.h"
#include "casedb/keeping/bundle.h"
#include "casedb/keeping/check.h"
#include "sim/base/rng.h"
#include "tests/casedb/faults/faults.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;
using faults::Kind;

int rounds() {
  const char* text = std::getenv("SELDINGER_FAULTS");
  return text == nullptr ? 25 : std::atoi(text);
}

enum Work { kImport, kAuthor, kAttempt, kBundle };

const char* name_of(Kind kind) {
  return kind == Kind::kill ? "kill" : kind == Kind::write ? "write" : kind == Kind::sync ? "sync" : "full";
}

// A ball of soft tissue in air as a MetaImage file, another one for each number.
void write_source(const fs::path& file, int number) {
  constexpr int kSize = 16;
  std::vector<std::int16_t> hu(kSize * kSize * kSize, -1000);
  for (int z = 0; z < kSize; ++z)
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const int dx = 2 * x - kSize + 1, dy = 2 * y - kSize + 1, dz = 2 * z - kSize + 1;
        if (dx * dx + dy * dy + dz * dz < 150) hu[(z * kSize + y) * kSize + x] = 40;
      }
  hu[static_cast<std::size_t>((kSize / 2 * kSize + kSize / 2) * kSize + kSize / 2)] =
      static_cast<std::int16_t>(number % 3000);
  std::ofstream out(file, std::ios::binary);
  out << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
         "False\n"
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 2 2 2\nDimSize = 16 16 16\n"
         "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  out.write(reinterpret_cast<const char*>(hu.data()), static_cast<std::streamsize>(hu.size() * 2));
}

struct Site {
  fs::path folder, source, bundle;
  std::string case_id, lesion_id;
};

// One piece of work, from opening the library to the acknowledgement, which is the id of what was made.
std::string work(const Site& site, Work what, std::uint64_t number) {
  Library library = open_library(site.folder);
  switch (what) {
    case kImport: {
      auto source = read_source(site.source);
      NewCase made;
      made.title = "Ball";
      made.origin = "import";
      made.skin = skin_surface(source.value().volume).value();
      made.volume = std::move(source->volume);
      made.attributes = std::move(source->attributes);
      made.warnings = std::move(source->warnings);
      made.slices_used = source->slices_used;
      return add_case(library, made);
    }
    case kAuthor:
      return add_lesion(library, site.case_id, sample_lesion()).value();
    case kAttempt: {
      NewAttempt attempt = sample_attempt(site.case_id, site.lesion_id);
      attempt.recording = sample_recording(2500, number);
      attempt.picture_png.resize(5000, static_cast<std::byte>(number));
      attempt.picture_png.push_back(static_cast<std::byte>(number >> 8));
      return add_attempt(library, attempt).value();
    }
    case kBundle: {
      const auto cases = import_bundle(library, site.bundle).value();
      return cases.stored.empty() ? cases.present.at(0) : cases.stored[0];
    }
  }
  throw std::logic_error("no such work");
}

std::set<std::string> everything(Library& library) {
  std::set<std::string> ids;
  for (const char* what : {"SELECT case_id AS id FROM training_case", "SELECT lesion_id AS id FROM lesion",
                           "SELECT attempt_id AS id FROM attempt"})
    for (Statement rows = library.database().prepare(what); rows.step();) ids.insert(rows.text("id"));
  return ids;
}

class FaultsTest : public testing::TestWithParam<std::tuple<Work, Kind>> {
 protected:
  fs::path scratch_ = fresh_folder();
  Site site_;
  int next_ = 0;

  void SetUp() override {
    faults::set({});
    site_ = {scratch_ / "library", scratch_ / "source.mha", scratch_ / "case.sdbundle", "", ""};
    Library library = open_library(site_.folder);
    site_.case_id = add_case(library, sample_case());
    site_.lesion_id = add_lesion(library, site_.case_id, sample_lesion()).value();
  }
  void TearDown() override {
    faults::set({});
    fs::remove_all(scratch_);
  }
  // What the next piece of work needs, made before anything can fail.
  void prepare(Work what) {
    ++next_;
    if (what == kImport) write_source(site_.source, next_);
    if (what != kBundle) return;
    Library other = open_library(scratch_ / "other");
    NewCase made = sample_case("Case");
    made.volume = sample_volume({9, 7, 5}, static_cast<std::uint64_t>(next_) + 10);
    const std::string case_id = add_case(other, made);
    ASSERT_TRUE(write_bundle(other, {case_id}, site_.bundle, "0.1.0").has_value());
  }
  struct Outcome {
    int status = 0;
    std::string acknowledged;
    long operations = 0;
  };
  // The work in a process of its own, under the plan.
  Outcome under(const faults::Plan& plan, Work what) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    std::fflush(nullptr);  // what is not out yet would be said twice
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      faults::set(plan);
      int code = 20;
      try {
        const std::string id = work(site_, what, static_cast<std::uint64_t>(next_));
        faults::real_write(ends[1], id.data(), id.size());
        const long count = faults::operations(plan.kind == Kind::none ? Kind::kill : plan.kind);
        faults::real_write(ends[1], &count, sizeof count);
        code = 10;
      } catch (const base::Failure&) {
        code = 11;
      } catch (...) {
      }
      ::_exit(code);
    }
    ::close(ends[1]);
    std::string said;
    char buffer[256];
    for (ssize_t got; (got = ::read(ends[0], buffer, sizeof buffer)) > 0;)
      said.append(buffer, static_cast<std::size_t>(got));
    ::close(ends[0]);
    Outcome outcome;
    ::waitpid(child, &outcome.status, 0);
    if (said.size() >= 36) outcome.acknowledged = said.substr(0, 36);
    if (said.size() == 36 + sizeof outcome.operations)
      std::memcpy(&outcome.operations, said.data() + 36, sizeof outcome.operations);
    return outcome;
  }
};

TEST_P(FaultsTest, NothingAcknowledgedIsLostAndNothingIsLeftOver) {
  const auto [what, kind] = GetParam();
  prepare(what);
  // How many operations there are to strike. A plan far behind them never strikes.
  const Outcome counted = under({kind, 1'000'000'000, false}, what);
  ASSERT_TRUE(WIFEXITED(counted.status) && WEXITSTATUS(counted.status) == 10);
  ASSERT_GT(counted.operations, 2);
  std::set<std::string> expected;
  {
    Library library = open_library(site_.folder);
    expected = everything(library);
  }
  base::Rng rng(static_cast<std::uint64_t>(what) * 10 + static_cast<std::uint64_t>(kind));
  int struck = 0;
  for (int round = 0; round < rounds(); ++round) {
    prepare(what);
    const long at = 1 + static_cast<long>(rng.uniform() * static_cast<double>(counted.operations));
    const Outcome outcome = under({kind, at, round % 2 == 0}, what);
    SCOPED_TRACE(std::string(name_of(kind)) + " at " + std::to_string(at) + " of " +
                 std::to_string(counted.operations) + ", round " + std::to_string(round));
    if (kind == Kind::kill) {
      ASSERT_TRUE(WIFSIGNALED(outcome.status) ? WTERMSIG(outcome.status) == SIGKILL
                                              : WEXITSTATUS(outcome.status) == 10);
      struck += WIFSIGNALED(outcome.status);
    } else {
      ASSERT_TRUE(WIFEXITED(outcome.status)) << "it crashed";
      ASSERT_TRUE(WEXITSTATUS(outcome.status) == 10 || WEXITSTATUS(outcome.status) == 11) << "no Failure of ours";
      struck += WEXITSTATUS(outcome.status) == 11;
    }
    const auto report = check_library(site_.folder, true);
    ASSERT_TRUE(report.has_value()) << report.error().code;
    ASSERT_TRUE(report->holds()) << report->findings.front().code << ": " << report->findings.front().text;
    const auto again = check_library(site_.folder, false);
    ASSERT_TRUE(again->holds()) << again->findings.front().code;
    Library library = open_library(site_.folder);
    const std::set<std::string> there = everything(library);
    if (!outcome.acknowledged.empty()) expected.insert(outcome.acknowledged);
    for (const std::string& id : expected) ASSERT_TRUE(there.contains(id)) << "lost";
    // Stored, but killed or failed before it could say so: whole, and there to stay.
    ASSERT_LE(there.size(), expected.size() + 1);
    expected = there;
  }
  EXPECT_GE(struck, rounds() / 4) << "too few faults were met for this to say much";
  Library library = open_library(site_.folder);
  for (const CaseRow& row : list_cases(library)) {
    EXPECT_TRUE(load_volume(library, row).has_value());
    EXPECT_TRUE(load_skin(library, row).has_value());
    EXPECT_TRUE(load_classes(library, row).has_value());
  }
  for (const AttemptRow& row : list_attempts(library))
    EXPECT_TRUE(load_recording(library, row.attempt_id).has_value());
}

std::string name_of_run(const testing::TestParamInfo<std::tuple<Work, Kind>>& run) {
  const char* const names[] = {"import", "author", "attempt", "bundle"};
  return std::string(names[std::get<0>(run.param)]) + "_" + name_of(std::get<1>(run.param));
}

INSTANTIATE_TEST_SUITE_P(All, FaultsTest,
                         testing::Combine(testing::Values(kImport, kAuthor, kAttempt, kBundle),
                                          testing::Values(Kind::kill, Kind::write, Kind::sync, Kind::full)),
                         name_of_run);

}  // namespace
}  // namespace seldinger::casedb
