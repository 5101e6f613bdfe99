// The re-identification attack on exports: whoever holds two of them, or one and the dashboard's numbers, looks for
// the same attempts. What docs/export.md promises, and what it says is not promised.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string_view>

#include "casedb/attempts/attempts.h"
#include "casedb/people/people.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::CsvTable;
namespace fs = std::filesystem;

constexpr int kPeople = 8, kAttemptsEach = 5, kAttempts = kPeople * kAttemptsEach;

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return *number_in(text);
}

// Of people's rows alone. `truth`: which attempt each is, which the attacker does not see.
struct Exported {
  CsvTable attempts;
  std::vector<std::size_t> rows;
  std::vector<int> truth;
};

// Forty simulated attempts, stored as eight people's who consent to research.
class Made {
 public:
  Made() {
    const std::string case_id = library_.demo()["case_id"];
    library_.done("simulate --operator intermediate --no-pictures --seed 100 --count " + std::to_string(kAttempts) +
                  " --case " + case_id);
    std::ofstream(at("text.txt")) << "May your attempts be used?\n";
    library_.done("study new Needles");
    library_.done("consent text " + at("text.txt"));
    auto library = casedb::Library::open(library_.path());
    std::vector<casedb::AttemptRow> simulated;
    for (const casedb::AttemptRow& row : casedb::list_attempts(*library))
      if (row.operator_name == "intermediate" && row.seed >= 100) simulated.push_back(row);
    EXPECT_EQ(simulated.size(), std::size_t{kAttempts});
    for (int person = 0; person < kPeople; ++person) {
      const std::string name = "user" + std::to_string(person);
      const auto person_id = casedb::add_user(*library, name, casedb::Role::trainee, fixtures::kPassword);
      for (int i = 0; i < kAttemptsEach; ++i) add(*library, simulated.at(stored_.size()), person_id.value());
      const std::string text = library_.ask("consent list --user " + name)["consents"][0]["text_id"];
      library_.done("consent give " + text + " --user " + name);
    }
  }
  const std::vector<std::map<std::string, double>>& stored() const { return stored_; }

  std::string at(const std::string& name) const { return (library_.folder() / name).string(); }

  Exported exported(const std::string& folder, const std::string& words = "") {
    library_.done("export --out " + at(folder) + " " + words);
    Exported all;
    all.attempts = fixtures::csv_table(fixtures::whole_file(at(folder + "/attempts.csv")));
    const auto metrics = fixtures::csv_table(fixtures::whole_file(at(folder + "/metrics.csv")));
    std::map<std::string, int> which;
    for (std::size_t i = 0; i < metrics.rows.size(); ++i)
      if (metrics.cell(i, "metric") == "which")
        which[metrics.cell(i, "attempt")] = static_cast<int>(*number_in(metrics.cell(i, "value")));
    for (std::size_t i = 0; i < all.attempts.rows.size(); ++i) {
      if (all.attempts.cell(i, "synthetic") != "0") continue;
      all.rows.push_back(i);
      all.truth.push_back(which.at(all.attempts.cell(i, "attempt")));
    }
    EXPECT_EQ(all.rows.size(), std::size_t{kAttempts});
    return all;
  }
  // Attempts that one stored value finds alone in an export.
  int found_by(const Exported& there, const std::string& metric, double (*as_written)(double)) const {
    int found = 0;
    for (std::size_t i = 0; i < stored_.size(); ++i) {
      if (!stored_[i].contains(metric)) continue;
      std::vector<int> fit;
      for (std::size_t k = 0; k < there.rows.size(); ++k)
        if (number_in(there.attempts.cell(there.rows[k], metric)) == as_written(stored_[i].at(metric)))
          fit.push_back(there.truth[k]);
      found += fit == std::vector<int>{static_cast<int>(i)};
    }
    return found;
  }

 private:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("export_join")};
  std::vector<std::map<std::string, double>> stored_;  // each attempt's values, as the dashboard has them

  void add(casedb::Library& library, const casedb::AttemptRow& row, const std::string& person_id) {
    casedb::NewAttempt made;
    static_cast<casedb::AttemptHead&>(made) = row;
    made.person_id = person_id;
    made.operator_name = casedb::kPersonOperator;
    made.metrics = row.metrics;
    std::map<std::string, double> values;
    for (const auto& metric : row.metrics)
      if (metric.value) values[metric.id] = *metric.value;
    // Of no column of attempts.csv, so the attacker does not have it.
    made.metrics.push_back({"which", 1, static_cast<double>(stored_.size()), "count", ""});
    made.recording = casedb::load_recording(library, row.attempt_id).value();
    made.duration_s = row.duration_s;
    EXPECT_TRUE(casedb::add_attempt(library, made));
    stored_.push_back(std::move(values));
  }
};

Made& made() {
  static Made one;
  return one;
}

// Rows of `one` whose nearest row of `other`, over every column of numbers, is the same attempt.
int joined(const Exported& one, const Exported& other) {
  std::vector<std::string> columns;
  for (const std::string& column : one.attempts.header)
    if (column != "person_attempt" && column != "days_since_first") columns.push_back(column);
  int right = 0;
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    std::pair<double, int> nearest{std::numeric_limits<double>::infinity(), -1};
    for (std::size_t k = 0; k < other.rows.size(); ++k) {
      double apart = 0.0;
      for (const std::string& column : columns) {
        const auto a = number_in(one.attempts.cell(one.rows[i], column));
        const auto b = number_in(other.attempts.cell(other.rows[k], column));
        if (a && b)
          apart += std::abs(*a - *b) / std::max({std::abs(*a), std::abs(*b), 1e-12});
        else
          apart += a.has_value() != b.has_value() ? 1.0 : 0.0;
      }
      nearest = std::min(nearest, {apart, other.truth[k]});
    }
    right += nearest.second == one.truth[i];
  }
  return right;
}

TEST(ExportJoin, OneKnownValueFindsFewOfAnExportWithoutAKey) {
  const auto itself = [](double value) { return value; };
  const Exported exact = made().exported("exact", "--raw none --study Needles --key " + made().at("needles.key"));
  const Exported coarse = made().exported("coarse", "--raw none");
  // A distance has few digits, so one still finds most of forty rows: how many depends on how far they spread.
  const std::pair<const char*, int> most[] = {
      {"ldlj", 10}, {"path_tip", 10}, {"time_total", 20}, {"tip_target_dist", 38}};
  for (const auto& [metric, limit] : most) {
    const int of_exact = made().found_by(exact, metric, itself),
              of_coarse = made().found_by(coarse, metric, two_digits);
    // Two attempts may have lasted as many ticks.
    EXPECT_GE(of_exact, std::string_view(metric) == "time_total" ? kAttempts - 2 : kAttempts)
        << metric << ": this was so without a key, too";
    std::printf("%s finds %d of %d rows, which docs/export.md tells\n", metric, of_coarse, kAttempts);
    EXPECT_LE(of_coarse, limit) << metric;
    EXPECT_EQ(made().found_by(coarse, metric, itself), 0) << metric;
  }
}

// Nothing is promised against who compares whole rows, and the page says so: names alone keep two exports apart.
// Before, the page said that they "cannot be joined".
TEST(ExportJoin, WholeRowsAreJoinedAndThePageSaysSo) {
  const Exported one = made().exported("one", "--raw none"), two = made().exported("two", "--raw none");
  const int right = joined(one, two),
            exact = joined(
                one, made().exported("keyed", "--raw none --study Needles --key " + made().at("needles.key")));
  const std::string page = fixtures::whole_file(fixtures::source_dir() / "docs" / "export.md");
  const std::string readme = fixtures::whole_file(made().at("one/README.txt"));
  constexpr int kChance = 1, kMargin = 4;
  if (std::max(right, exact) > kChance + kMargin) {
    EXPECT_NE(page.find("can still be joined by their values"), std::string::npos);
    EXPECT_NE(readme.find("can still join them by their values"), std::string::npos);
    EXPECT_EQ(page.find("cannot be joined"), std::string::npos);
  }
  std::vector<std::string> names, others;
  for (const std::size_t i : one.rows)
    names.push_back(one.attempts.cell(i, "person") + one.attempts.cell(i, "attempt"));
  for (const std::size_t i : two.rows)
    others.push_back(two.attempts.cell(i, "person") + two.attempts.cell(i, "attempt"));
  for (const std::string& name : names) EXPECT_EQ(std::count(others.begin(), others.end(), name), 0);
  EXPECT_NE(one.truth, two.truth) << "the order of the rows joins them";
}

// Poses would be joined by their course, whatever the digits.
TEST(ExportJoin, RecordingsOfPeopleNeedAKeyAndAStudy) {
  const auto poses_of_people = [&](const std::string& folder, const Exported& all) {
    int files = 0;
    for (const std::size_t i : all.rows)
      for (const char* kind : {"poses", "forces", "frames"})
        files += fs::exists(fs::path(made().at(folder)) / kind / (all.attempts.cell(i, "attempt") + ".csv"));
    return files;
  };
  const std::string key = "--key " + made().at("needles.key");
  EXPECT_EQ(poses_of_people("none", made().exported("none")), 0);
  EXPECT_EQ(poses_of_people("key", made().exported("key", key)), 0);
  EXPECT_EQ(poses_of_people("study", made().exported("study", "--study Needles")), 0);
  const Exported both = made().exported("both", "--study Needles " + key);
  EXPECT_GE(poses_of_people("both", both), 2 * kAttempts);
  for (std::size_t i = 0; i < both.rows.size(); ++i)
    for (const auto& [metric, value] : made().stored()[static_cast<std::size_t>(both.truth[i])])
      EXPECT_EQ(number_in(both.attempts.cell(both.rows[i], metric)), value) << metric << ", bit for bit";
}

}  // namespace
}  // namespace seldinger
