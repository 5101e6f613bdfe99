// Each role's job in a real browser: tests/browser/roles.mjs, with what npm brings for it.
#include <gtest/gtest.h>

#include "casedb/attempts/attempts.h"
#include "casedb/database/uuid.h"
#include "casedb/people/people.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using fixtures::kProgram;
using fixtures::run;

// The drills of the first hour, which the trainee has begun: of each what the simulated expert did there, as if the
// trainee had done it day after day, the first times beside the target.
void let_the_trainee_practise(const fs::path& folder) {
  auto library = std::move(casedb::Library::open(folder).value());
  std::string trainee;
  for (const casedb::Account& one : casedb::list_users(library))
    if (one.login_name == "trainee") trainee = one.person_id;
  constexpr std::int64_t kDay_us = std::int64_t{86'400} * 1'000'000;
  std::int64_t days_ago = 40;
  for (const casedb::AttemptRow& row : casedb::list_attempts(library)) {
    casedb::NewAttempt mine;
    static_cast<casedb::AttemptHead&>(mine) = row;
    mine.operator_name = casedb::kPersonOperator;
    mine.person_id = trainee;
    mine.end = casedb::AttemptEnd::fired;
    mine.duration_s = row.duration_s;
    mine.recording = casedb::load_recording(library, row.attempt_id).value();
    mine.picture_png = library.load_asset(row.picture_sha256).value();
    for (int i = 0; i < 6; ++i) {
      mine.started_us = casedb::now_us() - --days_ago * kDay_us;
      mine.metrics = row.metrics;
      for (casedb::MetricValue& one : mine.metrics) {
        if (one.id == "hit" && i < 3) one.value = 0.0;
        if (one.id == "tip_target_dist" && one.value) *one.value += 8.0 / (i + 1);
      }
      ASSERT_TRUE(casedb::add_attempt(library, mine).has_value());
    }
  }
}

TEST(Browser, EachRoleDoesItsJobAtADeskAndOnAPhone) {
  const auto folder = fixtures::fresh_test_folder("browser");
  if (run("command -v node && command -v npm && command -v chromium", folder).exit_code != 0)
    GTEST_SKIP() << "node, npm or chromium is absent: apt-get install nodejs npm chromium";
  // Kept between runs, beside what else tests make once.
  const fs::path with = fixtures::test_out_dir() / "made" / "browser";
  fs::create_directories(with);
  const fixtures::FileLock alone(with.string() + ".lock");
  const std::string from = (fixtures::source_dir() / "tests/browser").string();
  const auto fetched =
      run("cd '" + with.string() + "' && cp '" + from + "'/package*.json '" + from + "/.npmrc' '" + from +
              "/roles.mjs' . && { npm ls || npm ci --ignore-scripts --no-audit --no-fund; }",
          folder);
  if (fetched.exit_code != 0) GTEST_SKIP() << "npm could not bring playwright-core and axe-core:\n" << fetched.err;
  fixtures::demo_library("--drills", folder / "library");
  let_the_trainee_practise(folder / "library");
  const auto done = run("node '" + with.string() + "/roles.mjs' '" + kProgram + "' '" +
                            (folder / "library").string() + "' '" + (folder / "pictures").string() + "'",
                        folder);
  EXPECT_EQ(done.exit_code, 0) << done.err.substr(0, 6000);
}

}  // namespace
}  // namespace seldinger
