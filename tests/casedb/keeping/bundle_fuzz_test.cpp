// Damaged bundles, by chance and by a hand that knows the format: refused with a code or taken whole, never a
// crash, never much more memory than an honest one takes.
#include <sqlite3.h>

#include "casedb/import/jail/confine.h"
#include "casedb/import/jail/jail.h"
#include "casedb/keeping/bundle.h"
#include "casedb/keeping/check.h"
#include "tests/casedb/keeping/mutate_bundle.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/cpu_time.h"
#include "tests/fixtures/mutate.h"
#include "tests/fixtures/outcomes.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

// The most memory of ours, of SQLite's and of the jail's that a check of the file takes.
std::size_t most_bytes(const fs::path& file, std::string& code) {
  const std::size_t before = fixtures::live_bytes();
  const auto sqlite_before = static_cast<std::size_t>(sqlite3_memory_used());
  fixtures::forget_peak();
  sqlite3_memory_highwater(1);
  const auto bundle = check_bundle(file);
  code = bundle ? "none" : bundle.error().code;
  return fixtures::peak_bytes() - before + static_cast<std::size_t>(sqlite3_memory_highwater(0)) - sqlite_before +
         last_jail_use().peak_bytes;
}

// Into the file a damaged bundle, by kind: any of its bytes, its list, its rows or an asset; who `knows_format`
// damages what means something.
void damage(const fs::path& file, const Parts& good, const std::string& bytes, std::size_t kind, bool knows_format,
            base::Rng& rng) {
  if (kind == 0) {  // as a disk or a line does it: noticed, whatever it is
    std::string damaged = bytes;
    fixtures::mutate(damaged, rng);
    std::ofstream(file, std::ios::binary) << damaged;
  } else {
    Parts parts = good;
    if (kind == 1) {
      (knows_format ? mutate_list : fixtures::mutate)(parts.list, rng);
      put_as_listed(file, parts);
    } else if (kind == 2) {
      (knows_format ? mutate_rows : fixtures::mutate)(parts.rows[fixtures::any_below(rng, parts.rows.size())], rng);
      put(file, parts);
    } else {
      const auto [name, content] = parts.assets[fixtures::any_below(rng, parts.assets.size())];
      std::string damaged = content;
      (knows_format ? mutate_head : fixtures::mutate)(damaged, rng);
      const auto swapped = std::as_bytes(std::span(damaged));
      swap_asset(parts, name, {swapped.begin(), swapped.end()});
      put(file, parts);
    }
  }
}

TEST(BundleFuzz, DamageIsRefusedWithinBounds) {
  const fs::path scratch = fresh_folder(), file = scratch / "a.sdbundle";
  Library home = open_library(scratch / "home"), away = open_library(scratch / "away");
  for (std::uint64_t i = 0; i < 2; ++i) {
    NewCase labelled = sample_case("Case " + std::to_string(i));
    labelled.volume = sample_volume({9, 7, 5}, i);
    labelled.labels = sample_labels();
    const std::string case_id = add_case(home, labelled);
    static_cast<void>(add_lesion(home, case_id, sample_lesion()).value());
  }
  ASSERT_TRUE(write_bundle(home, {}, file, "0.1.0").has_value());
  const Parts good = parts_of(file);
  const std::string bytes = fixtures::whole_file(file);
  std::string code;
  const std::size_t bound = 2 * most_bytes(file, code) + (std::size_t{64} << 20);
  ASSERT_EQ(code, "none");

  const std::set<std::string> known = {"damaged",        "too_large",    "not_a_bundle",
                                       "bundle_version", "newer_schema", "bundle_values"};
  const auto before = state_of(away);
  base::Rng rng(77);
  fixtures::Outcomes outcomes;
  int taken = 0, imported = 0;
  const int rounds = fixtures::fuzz_rounds(250);
  for (int round = 0; round < rounds; ++round) {
    const std::size_t kind = fixtures::any_below(rng, 4);
    damage(file, good, bytes, kind, round % 2 == 0, rng);
    const double start_s = fixtures::cpu_s();
    ASSERT_LE(most_bytes(file, code), bound) << "round " << round << ", kind " << kind;
    ASSERT_LT(fixtures::cpu_s() - start_s, 20.0) << "round " << round;
    if (kConfines) {  // a sanitizer keeps what was freed
      ASSERT_LE(last_jail_use().peak_bytes, 2 * last_jail_use().announced_bytes + kJailSpareBytes)
          << "round " << round << ", kind " << kind;
    }
    outcomes.add(check_bundle(file));
    if (code != "none") {
      ASSERT_TRUE(known.contains(code)) << code;
      const auto cases = import_bundle(away, file);
      ASSERT_FALSE(cases.has_value());
      ASSERT_EQ(cases.error().code, code);
      continue;
    }
    ASSERT_TRUE(kind != 0 || fixtures::whole_file(file) == bytes)
        << "round " << round << ": damage was not noticed";
    ++taken;
    if (++imported > 10) continue;
    // What is taken makes a library that holds.
    const fs::path folder = scratch / "taken";
    fs::remove_all(folder);
    Library library = open_library(folder);
    ASSERT_TRUE(import_bundle(library, file).has_value());
    ASSERT_TRUE(check_library(folder, false).value().holds());
    for (const CaseRow& row : list_cases(library)) ASSERT_TRUE(load_volume(library, row).has_value());
  }
  EXPECT_EQ(state_of(away), before);
  EXPECT_TRUE(check_library(scratch / "away", false).value().holds());
  outcomes.expect_both();
  EXPECT_LT(taken, rounds / 4);
  RecordProperty("taken", taken);
}

}  // namespace
}  // namespace seldinger::casedb
