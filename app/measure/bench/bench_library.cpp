// Bench stage library: what a site with thousands of cases and attempts waits for. There is no choice of method
// here and so no error; the goals stand in the column reference.
#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "app/cli/version.h"
#include "app/measure/bench/bench.h"
#include "assessment/metrics/metric.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/backup.h"
#include "casedb/keeping/bundle.h"
#include "casedb/keeping/check.h"
#include "sim/base/failure.h"

namespace seldinger::measure {
namespace {

namespace fs = std::filesystem;

// A folder of this process that goes when it does.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "seldinger-bench-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw base::Failure("disk", "cannot make a temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

// Copies every row of a table `count` times under new ids: an id becomes eight digits and what was behind them.
void multiply(casedb::Sqlite& database, const std::string& table, const std::vector<std::string>& ids, int count) {
  std::string to, from;
  for (const std::string& column : casedb::columns_of(database, table)) {
    to += (to.empty() ? "" : ", ") + column;
    bool is_id = false;
    for (const std::string& id : ids) is_id = is_id || id == column;
    std::string value = column;
    if (is_id) value = "printf('%08x', n) || substr(" + column + ", 9)";
    if (column == "created_us" || column == "started_us") value = column + " + n";
    from += (from.empty() ? "" : ", ") + value;
  }
  database.run("WITH RECURSIVE numbers(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM numbers WHERE n < " +
               std::to_string(count) + ") INSERT INTO " + table + " (" + to + ") SELECT " + from +
               " FROM numbers, " + table + " WHERE true");
}

casedb::NewCase small_case() {
  casedb::NewCase made;
  made.title = "Case";
  made.origin = "import";
  made.volume = volume::make_volume({16, 16, 16}, {1, 1, 1}, glm::dmat3(1.0), {0, 0, 0});
  for (std::size_t i = 0; i < made.volume.hu.size(); ++i) made.volume.hu[i] = static_cast<std::int16_t>(i % 97);
  made.skin.vertices_lps_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  made.skin.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  made.skin.cut = {0, 0, 0, 0};
  for (int i = 0; i < 8; ++i) made.attributes.emplace_back("attribute_" + std::to_string(i), "a value");
  made.warnings = {{"single_slice", "one slice only"}};
  made.slices_used = 16;
  return made;
}

}  // namespace

base::Result<void> bench_library(const app::Arguments&, bool quick, std::vector<BenchRow>& rows) {
  const int cases = quick ? 500 : 5000, attempts = quick ? 2000 : 20'000;
  const TemporaryFolder folder;
  auto library = casedb::Library::open_or_create(folder.path() / "library");
  if (!library) return library.error();
  const std::string case_id = casedb::add_case(*library, small_case());
  const auto lesion_id = casedb::add_lesion(*library, case_id, {{8, 8, 8}, 2.0, 20.0});
  if (!lesion_id) return lesion_id.error();
  casedb::NewAttempt attempt;
  attempt.case_id = case_id;
  attempt.lesion_id = *lesion_id;
  attempt.operator_name = "novice";
  attempt.program_version = app::kVersion;
  attempt.recording.inputs.resize(10);
  attempt.recording.hashes.resize(10);
  for (int i = 0; i < 30; ++i) attempt.metrics.push_back({"metric_" + std::to_string(i), 1, 0.5 + i, "mm", ""});
  if (const auto made = casedb::add_attempt(*library, attempt); !made) return made.error();
  casedb::Sqlite& database = library->database();
  {
    casedb::Transaction transaction(database);
    database.run("PRAGMA defer_foreign_keys = ON");
    for (const char* table : {"attempt", "recording_chunk", "metric_value"})
      multiply(database, table, {"attempt_id"}, attempts - 1);
    for (const casedb::TravellingTable& table : casedb::travelling_tables())
      multiply(database, std::string(table.name), {"case_id", "lesion_id"}, cases - 1);
    transaction.commit();
  }
  const auto time = [&](const char* method, const char* goal, int size, int n, const std::function<void()>& work) {
    BenchRow row{"library", method, "", "cpu", "1 thread", std::to_string(size), 0, 0, 0, 0, "", "", goal};
    time_into(row, n, work);
    rows.push_back(row);
  };
  const int n = quick ? 3 : 9;
  time("list cases with lesions", "goal: 50 ms for 5000", cases, n, [&] {
    static_cast<void>(casedb::list_case_heads(*library));
    static_cast<void>(casedb::list_lesions(*library));
  });
  time("find one case", "", cases, n, [&] { static_cast<void>(casedb::find_case(*library, case_id)); });
  time("list all attempts", "goal: 1 s for 20000", attempts, n,
       [&] { static_cast<void>(casedb::list_attempts(*library)); });
  time("list a page of 50 attempts", "", attempts, n,
       [&] { static_cast<void>(casedb::list_attempts(*library, static_cast<std::size_t>(attempts) / 2, 50)); });
  std::optional<base::Error> refused;
  const auto keep = [&](const auto& result) {
    if (!result) refused = result.error();
  };
  time("check", "", cases, 1, [&] { keep(casedb::check_library(library->folder(), false)); });
  time("back up", "", cases, 1, [&] { keep(casedb::back_up(*library, folder.path() / "backup", app::kVersion)); });
  time("restore", "", cases, 1,
       [&] { keep(casedb::restore(folder.path() / "backup", folder.path() / "restored")); });
  time("bundle export", "", cases, 1,
       [&] { keep(casedb::write_bundle(*library, {}, folder.path() / "all.sdbundle", app::kVersion)); });
  auto other = casedb::Library::open_or_create(folder.path() / "other");
  if (!other) return other.error();
  time("bundle import", "", cases, 1, [&] { keep(casedb::import_bundle(*other, folder.path() / "all.sdbundle")); });
  if (refused) return *refused;
  return {};
}

}  // namespace seldinger::measure
