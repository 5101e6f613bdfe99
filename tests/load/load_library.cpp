#include "tests/load/load_library.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <map>

#include "assessment/grading/rule.h"
#include "assessment/registry.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/versions.h"
#include "casedb/database/uuid.h"
#include "casedb/grading/curriculum.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/people/people.h"
#include "sim/base/rng.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/sound_check.h"

namespace seldinger::load {
namespace {

namespace fs = std::filesystem;
using namespace casedb;

constexpr int kCases = 8;
constexpr std::int64_t kHalfAYear_us = std::int64_t{182} * 24 * 3'600'000'000;

std::string numbered(const char* words, int number, int digits) {
  std::string text = std::to_string(number);
  return words + std::string(static_cast<std::size_t>(digits) - std::min<std::size_t>(text.size(), 3), '0') + text;
}

// Accounts as add_user makes them, but with the hash of the first: to hash 500 passwords takes half a minute.
class People {
 public:
  explicit People(Library& library) : library_(library) {
    first_ = add_user(library, "admin", Role::admin, kPassword).value();
  }
  std::string add(const std::string& name, Role role) {
    std::string id = new_uuid();
    {
      Transaction transaction(library_.identities());
      library_.identities()
          .prepare("INSERT INTO identity (person_id, name, created_us) VALUES (:id, :name, :now)")
          .bind("id", id)
          .bind("name", name)
          .bind("now", now_us())
          .run();
      transaction.commit();
    }
    Transaction transaction(library_.database());
    library_.database()
        .prepare("INSERT INTO person (person_id, pseudonym, created_us) VALUES (:id, :pseudonym, :now)")
        .bind("id", id)
        .bind("pseudonym", "P-" + id.substr(24))
        .bind("now", now_us())
        .run();
    library_.database()
        .prepare(
            "INSERT INTO account (person_id, role, password_hash, enabled, created_us, epoch) "
            "SELECT :id, :role, password_hash, 1, created_us, 0 FROM account WHERE person_id = :first")
        .bind("id", id)
        .bind("role", name_of(role))
        .bind("first", first_)
        .run();
    transaction.commit();
    return id;
  }

 private:
  Library& library_;
  std::string first_;
};

struct Task {
  std::string case_id, lesion_id;
};

Task published_case(Library& library, int number) {
  Task made;
  made.case_id = add_case(library, sample_case("Kidney " + std::to_string(number)));
  made.lesion_id = add_lesion(library, made.case_id, sample_lesion()).value();
  CaseSetting setting = find_case(library, made.case_id).value();
  for (const char* text : {"hit >= 1", "time_total <= 30"})
    setting.rule.criteria.push_back(assessment::criterion_from(text).value());
  EXPECT_TRUE(set_setting(library, made.case_id, setting).has_value());
  static_cast<void>(confirm_no_burned_in_text(library, made.case_id, std::nullopt));
  EXPECT_TRUE(
      publish_case(library, made.case_id, fixtures::sound_check(library, made.case_id), "chief", true).has_value());
  return made;
}

// Who practises gets better: from one hit in four to nine in ten.
NewAttempt attempt_of(const CaseRow& row, const Task& task, const std::string& person_id, double practice,
                      base::Rng& rng) {
  NewAttempt made = sample_attempt(task.case_id, task.lesion_id);
  made.recording = sample_recording(20);
  made.picture_png.clear();
  made.person_id = person_id;
  made.operator_name = kPersonOperator;
  made.end = AttemptEnd::fired;
  made.approach = row.approach;
  made.instrument.kind = row.instrument.kind;
  made.picture.modality = row.modality;
  made.metrics.clear();
  for (const assessment::MetricInfo& info : assessment::registry()) {
    double value = rng.uniform();
    if (info.id == std::string_view("hit")) value = rng.uniform() < 0.25 + 0.65 * practice ? 1.0 : 0.0;
    if (info.id == std::string_view("time_total")) value = 60.0 - 40.0 * practice + 5.0 * rng.normal();
    if (info.id == std::string_view("gap_share") || info.id == std::string_view("tracking_jumps")) value = 0.0;
    if (info.id == std::string_view("sample_rate_p5")) value = 1000.0;
    made.metrics.push_back({std::string(info.id), info.version, value, std::string(info.unit), ""});
  }
  return made;
}

void make(const fs::path& folder, int attempts) {
  Library library = open_library(folder);
  for (Sqlite* database : {&library.database(), &library.identities()}) database->run("PRAGMA synchronous = OFF");
  People people(library);
  const std::string chief = people.add("chief", Role::mentor),
                    researcher = people.add("researcher", Role::researcher);
  std::vector<std::string> cohorts, trainees;
  for (int i = 0; i < kCohorts; ++i) {
    const std::string programme = "Programme " + std::to_string(i % kProgrammes);
    cohorts.push_back(add_cohort(library, numbered("Cohort ", i, 2), programme, "").value());
    for (const std::string& mentor : {chief, people.add(mentor_name(i), Role::mentor)})
      EXPECT_TRUE(enrol(library, cohorts.back(), mentor, Post::mentor).has_value());
    if (i < kProgrammes) {
      EXPECT_TRUE(appoint_director(library, programme, people.add(director_name(i), Role::director)).has_value());
    }
  }
  const std::string study = add_study(library, "Learning curves").value();
  EXPECT_TRUE(add_researcher(library, study, researcher).has_value());
  EXPECT_TRUE(add_consent_text(library, study, "May we use what you do?").has_value());
  for (int i = 0; i < kTrainees; ++i) {
    trainees.push_back(people.add(trainee_name(i), Role::trainee));
    EXPECT_TRUE(enrol(library, cohorts[static_cast<std::size_t>(i % kCohorts)], trainees.back(), Post::learner)
                    .has_value());
    if (i % 5 == 0) {
      EXPECT_TRUE(give_consent(library, trainees.back(), list_consents(library, trainees.back()).at(0).text_id)
                      .has_value());
    }
  }
  std::vector<Task> tasks;
  std::vector<CaseRow> rows;
  for (int i = 0; i < kCases; ++i) {
    tasks.push_back(published_case(library, i));
    rows.push_back(find_case(library, tasks.back().case_id).value());
  }
  const std::string curriculum = add_curriculum(library, "First year", "chief").value();
  for (const Task& task : tasks)
    EXPECT_TRUE(add_curriculum_item(library, curriculum, task.case_id, {}, {}, "chief").has_value());
  EXPECT_TRUE(publish_curriculum(library, curriculum, director_name(0)).has_value());

  const std::int64_t now = now_us();
  {
    Transaction transaction(library.database());
    library.database().run("UPDATE enrolment SET from_us = " + std::to_string(now - 2 * kHalfAYear_us));
    transaction.commit();
  }
  base::Rng rng(28);
  for (int i = 0; i < attempts; ++i) {
    const auto of = static_cast<std::size_t>(i % kTrainees), at = static_cast<std::size_t>(i / kTrainees % kCases);
    const double practice = static_cast<double>(i) / attempts;
    NewAttempt made = attempt_of(rows[at], tasks[at], trainees[of], practice, rng);
    made.started_us =
        now - kHalfAYear_us + static_cast<std::int64_t>(practice * static_cast<double>(kHalfAYear_us));
    if (i < kTrainees && i % 4 == 0) {
      made.recording = sample_recording();
      for (const char c : std::string_view("\x89PNG\r\n\x1a\nrest")) made.picture_png.push_back(std::byte(c));
    }
    EXPECT_TRUE(add_attempt(library, made).has_value());
  }
}

}  // namespace

std::string trainee_name(int number) {
  return numbered("trainee ", number, 3);
}
std::string mentor_name(int cohort) {
  return numbered("mentor ", cohort, 2);
}
std::string director_name(int number) {
  return numbered("director ", number, 1);
}

void load_library(const fs::path& folder, int attempts) {
  const fs::path made = fixtures::test_out_dir() / "made" / ("load-" + std::to_string(attempts));
  if (!fs::exists(made)) {
    const fs::path now = made.string() + ".now";  // whole or not there
    fs::remove_all(now);
    fs::create_directories(now.parent_path());
    const auto begun = std::chrono::steady_clock::now();
    make(now, attempts);
    const auto took =
        std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begun);
    std::printf("a library of %d attempts made in %.1f s\n", attempts, static_cast<double>(took.count()) / 1000.0);
    if (testing::Test::HasFailure()) return;
    fs::rename(now, made);
  }
  fs::create_directories(folder.parent_path());
  fs::copy(made, folder, fs::copy_options::recursive);
}

}  // namespace seldinger::load
