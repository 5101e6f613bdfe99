// A study from its draft to its report by the built program, of simulated people, and of people whose attempts an
// operator made: what is told before the freeze, what each look leaves behind, and that nobody who has gone is in
// the next report.
#include <fstream>

#include "casedb/attempts/attempts.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "tests/assessment/statistics/r_oracle.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/page_commands.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;

constexpr int kPeople = 6, kAttempts = 2;  // of each group, of each of them

class StudyCommands : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("study_commands")};
  std::string case_id_ = library_.demo()["case_id"];

  void SetUp() override {
    for (const char* user : {"rita --role researcher", "mona --role mentor", "adam --role admin"})
      library_.done(std::string("user add ") + user);
    library_.done("study new Needles");
    library_.done("study researcher Needles --user rita");
    std::ofstream(at("text.txt")) << "May your attempts be used in Needles?\n";
    library_.done("consent text " + at("text.txt") + " --study Needles");
  }
  std::string at(const char* name) const { return (library_.folder() / name).string(); }
  std::string refusal(const std::string& words) {
    const auto ran = library_.call(words);
    EXPECT_EQ(ran.exit_code, 3) << words << ran.out;
    const std::size_t from = ran.err.find("error: ") + 7;
    return ran.err.substr(from, ran.err.find(':', from) - from);
  }
  // Six novices and six experts by their facts, whose attempts simulated operators made.
  void people_practise() {
    std::vector<std::vector<std::string>> made;
    for (const char* profile : {"novice", "expert"}) {
      std::vector<std::string>& ids = made.emplace_back();
      // About the operator: people of a group would be people of the library themselves.
      std::ofstream(at("operator.json")) << R"({"like": ")" << profile << R"("})";
      const Json simulated = library_.ask("simulate --no-pictures --case " + case_id_ + " --operator " +
                                          at("operator.json") + " --people " + std::to_string(kPeople) +
                                          " --count " + std::to_string(kAttempts) + " --seed 11");
      for (const Json& one : simulated["attempts"]) ids.push_back(one["attempt_id"]);
      ASSERT_EQ(ids.size(), static_cast<std::size_t>(kPeople * kAttempts));
    }
    auto library = casedb::Library::open(library_.path());
    for (int group = 0; group < 2; ++group)
      for (int i = 0; i < kPeople; ++i) {
        const std::string name = (group == 0 ? "novice-" : "expert-") + std::to_string(i);
        const auto person = casedb::add_user(*library, name, casedb::Role::trainee, fixtures::kPassword);
        ASSERT_TRUE(person.has_value());
        ASSERT_TRUE(casedb::give_fact(*library, *person, "years_in_radiology", group == 0 ? "0.5" : "12"));
        for (int attempt = 0; attempt < kAttempts; ++attempt)
          store(*library, made[static_cast<std::size_t>(group)][static_cast<std::size_t>(i * kAttempts + attempt)],
                *person);
      }
  }
  // The same attempt again, as if the person had made it.
  static void store(casedb::Library& library, const std::string& attempt_id, const std::string& person_id) {
    const auto row = casedb::find_attempt(library, attempt_id);
    casedb::NewAttempt made;
    static_cast<casedb::AttemptHead&>(made) = *row;
    made.person_id = person_id;
    made.operator_name = casedb::kPersonOperator;
    made.started_us = row->started_us;
    made.end = row->end;
    made.metrics = row->metrics;
    made.conditions = row->conditions;
    made.recording = casedb::load_recording(library, attempt_id).value();
    made.duration_s = row->duration_s;
    ASSERT_TRUE(casedb::add_attempt(library, made).has_value());
  }
  void consent(const std::string& name) {
    auto library = casedb::Library::open(library_.path());
    for (const casedb::Account& one : casedb::list_users(*library)) {
      if (one.login_name != name) continue;
      const auto asked = casedb::list_consents(*library, one.person_id);
      ASSERT_TRUE(casedb::give_consent(*library, one.person_id, asked.at(0).text_id));
    }
  }
  Json plan(const char* people = "simulated") {
    library_.done("study template --case " + case_id_ + " --out " + at("template.json"));
    Json plan = Json::parse(fixtures::answered(fixtures::whole_file(at("template.json"))));
    plan["people"] = people;
    plan["stopping"]["per_group"] = 5;
    return plan;
  }
  std::string file_of(const Json& plan, const char* name = "plan.json") {
    std::ofstream(at(name)) << plan.dump();
    return at(name);
  }
};

// From the population to a report's numbers, with no account and no consent.
TEST_F(StudyCommands, SimulatedPeopleAreEnrolledAndSaidToBeSimulated) {
  for (const char* group : {"novice", "expert"})
    library_.done("simulate --no-pictures --people 8 --seed 3 --case " + case_id_ + " --operator " + group);
  library_.done("study plan Needles " + file_of(plan()));
  library_.done("study freeze Needles");
  const Json enrolled = library_.ask("study enrol Needles --all");
  ASSERT_GE(enrolled["enrolments"].size(), 8U) << enrolled.dump();
  for (const Json& one : enrolled["enrolments"]) EXPECT_EQ(one["pseudonym"].get<std::string>().substr(0, 2), "S-");
  const auto look = library_.call("study look Needles");
  EXPECT_EQ(look.exit_code, 0) << look.err;
  EXPECT_NE(look.out.find("SIMULATED"), std::string::npos) << look.out;
  library_.done("report validity --study Needles --out " + at("validity.html"));
  EXPECT_NE(fixtures::whole_file(at("validity.html")).find("SIMULATED"), std::string::npos);
  library_.done("export --study Needles --raw none --out " + at("table"));
  EXPECT_NE(fixtures::whole_file(library_.folder() / "table" / "attempts.csv").find(",S-"), std::string::npos);
  // An export has every simulated person; of a study of real people none of them has an outcome.
  library_.done("study new Real");
  library_.done("study plan Real " + file_of(plan("real")));
  library_.done("export --study Real --raw none --out " + at("real"));
  EXPECT_EQ(library_.ask("study show Real")["looks"].at(0)["people"], 0);
  EXPECT_EQ(library_.ask("study show Needles")["looks"].back()["people"], 16);
}

TEST_F(StudyCommands, APlanIsFrozenBeforeOutcomesAreToldAndEveryLookIsPrinted) {
  people_practise();
  for (int i = 0; i < kPeople; ++i) {
    consent("novice-" + std::to_string(i));
    if (i > 0) consent("expert-" + std::to_string(i));
  }
  EXPECT_EQ(refusal("study look Needles --by rita"), "no_plan");
  Json draft = plan("real");
  draft["primary"][0]["metric"] = "no_such";
  EXPECT_EQ(refusal("study plan Needles " + file_of(draft) + " --by rita"), "bad_study_plan");
  const Json stored = library_.ask("study plan Needles " + file_of(plan("real")) + " --by rita");
  EXPECT_TRUE(stored["frozen_us"].is_null());

  // A draft: counts of all together, by nobody's group, and no rows.
  const Json blind = library_.ask("study look Needles --by rita");
  EXPECT_EQ(blind["blinded"], true);
  EXPECT_EQ(blind["consenting"], 2 * kPeople - 1);
  EXPECT_EQ(blind["attempts"], (2 * kPeople - 1) * kAttempts);
  EXPECT_FALSE(blind.contains("primary"));
  library_.done("report validity --study Needles --by rita --out " + at("draft.html"));
  EXPECT_EQ(fixtures::whole_file(at("draft.html")).find("p, Holm"), std::string::npos);
  EXPECT_EQ(refusal("export --study Needles --by rita --out " + at("early")), "blinded");
  EXPECT_EQ(refusal("study enrol Needles --user novice-0"), "plan_not_frozen");
  EXPECT_EQ(refusal("study freeze Needles --by mona"), "not_allowed");
  draft = plan("real");
  draft["decision"] = "REPLACE: what is decided by them, and about whom?";
  library_.done("study plan Needles " + file_of(draft) + " --by rita");
  EXPECT_EQ(refusal("study freeze Needles --by rita"), "bad_study_plan");
  library_.done("study plan Needles " + file_of(plan("real")) + " --by rita");
  library_.done("export --study Needles --raw none --out " +
                at("operators"));  // who has the files, and it is noted

  const Json frozen = library_.ask("study freeze Needles --by rita");
  EXPECT_EQ(frozen["plan_sha256"], stored["plan_sha256"]);
  EXPECT_GT(frozen["frozen_us"].get<std::int64_t>(), 0);
  EXPECT_EQ(refusal("study plan Needles " + file_of(plan("real")) + " --by rita"), "plan_frozen");
  EXPECT_EQ(refusal("study enrol Needles --user expert-0 --by adam"), "no_consent");
  EXPECT_EQ(library_.ask("study enrol Needles --all --by rita")["enrolments"].size(),
            static_cast<std::size_t>(2 * kPeople - 1));
  EXPECT_EQ(refusal("study enrol Needles --user novice-0"), "already_enrolled");

  const Json look = library_.ask("study look Needles --by rita");
  EXPECT_EQ(look["complete"], true);
  const Json& primary = look["primary"][0];
  EXPECT_EQ(primary["groups"][0]["persons"], kPeople);
  EXPECT_EQ(primary["groups"][1]["persons"], kPeople - 1);
  EXPECT_EQ(primary["answer"]["n"], 2 * kPeople - 1) << "a person is one, however many attempts";
  EXPECT_GT(primary["answer"]["estimate"].get<double>(), 0.9) << "simulated novices are further off";
  EXPECT_EQ(primary["p_holm"], primary["answer"]["p_value"]) << "one primary outcome";
  EXPECT_TRUE(look["secondary"][0]["answer"]["p_value"].is_null());

  library_.done("study deviate Needles 'The second day was a Tuesday' --by rita");
  EXPECT_EQ(library_.ask("study lock Needles --by rita")["lock"]["data_sha256"], look["data_sha256"]);
  EXPECT_EQ(refusal("study lock Needles --by rita"), "data_locked");
  library_.done("report validity --study Needles --by rita --out " + at("report.html"));
  const std::string page = fixtures::whole_file(at("report.html"));
  for (const std::string& told : {frozen["plan_sha256"].get<std::string>(), look["data_sha256"].get<std::string>(),
                                  std::string("those that are analysed here"), std::string("study look"),
                                  std::string("report validity"), std::string("export before the freeze"),
                                  std::string("The second day was a Tuesday"), std::string("missing")})
    EXPECT_NE(page.find(told), std::string::npos) << told;
  for (const char* outside : {"http://", "https://", "<script", "src=", "novice-0", "SIMULATED"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_EQ(library_.ask("study show Needles --by rita")["looks"].size(), 3U);

  // Who withdraws or is erased is in no later look.
  const std::string text = library_.ask("consent list --user novice-1")["consents"][0]["text_id"];
  library_.done("consent withdraw " + text + " --user novice-1");
  library_.done("user erase expert-1 --by adam");
  const Json later = library_.ask("study look Needles --by rita");
  EXPECT_EQ(later["primary"][0]["answer"]["n"], 2 * kPeople - 3);
  EXPECT_EQ(later["flow"]["enrolled"], 2 * kPeople - 1);
  EXPECT_EQ(later["flow"]["erased"], 1);
  EXPECT_EQ(later["flow"]["groups"][0]["withdrew"], 1);
  EXPECT_NE(later["data_sha256"], look["data_sha256"]);
  library_.done("check");
}

// What a reviewer does with a report's data: run the script beside it.
TEST_F(StudyCommands, RRedoesEveryNumberOfAReport) {
  for (const char* group : {"novice", "expert"})
    library_.done("simulate --no-pictures --people 8 --count 2 --seed 5 --case " + case_id_ + " --operator " +
                  group);
  EXPECT_EQ(refusal("report validity --study Needles --out " + at("r.html") + " --data " + at("early")), "no_plan");
  library_.done("study plan Needles " + file_of(plan()));
  EXPECT_EQ(refusal("report validity --study Needles --out " + at("r.html") + " --data " + at("early")),
            "plan_not_frozen");
  EXPECT_FALSE(std::filesystem::exists(at("early")));
  library_.done("study freeze Needles");
  library_.done("study enrol Needles --all");
  library_.done("report validity --study Needles --out " + at("r.html") + " --data " + at("data"));
  EXPECT_EQ(refusal("report validity --study Needles --out " + at("r.html") + " --data " + at("data")), "exists");
  const std::string people = fixtures::whole_file(library_.folder() / "data" / "people.csv");
  EXPECT_EQ(people.find("S-"), std::string::npos) << "pseudonyms stay in the library";
  const Json looks = library_.ask("study show Needles")["looks"];
  EXPECT_NE(looks.dump().find("with its data"), std::string::npos) << looks.dump();
  if (!fixtures::has_r()) GTEST_SKIP() << "there is no Rscript (Debian: r-base-core) to redo it";
  const auto redone =
      fixtures::run("Rscript --vanilla '" + at("data") + "/redo.R' '" + at("data") + "'", at("redone"));
  EXPECT_EQ(redone.exit_code, 0) << redone.out << redone.err;
  EXPECT_NE(redone.out.find("0 differ"), std::string::npos) << redone.out;
  EXPECT_EQ(redone.out.rfind("0 numbers", 0), std::string::npos) << redone.out;
}

// docs/studies.md, as it stands there.
TEST_F(StudyCommands, ThePageIsWhatCanBeTyped) {
  const auto commands = fixtures::commands_of_page("studies.md");
  ASSERT_EQ(commands.size(), 12U);
  for (std::size_t i = 2; i < commands.size(); ++i) {           // the study and its researcher are there
    if (commands[i].find("study plan") != std::string::npos) {  // its words are one's own by then
      const std::string own = fixtures::answered(fixtures::whole_file(at("plan.json")));
      std::ofstream(at("plan.json")) << own;
    }
    std::string line = fixtures::with(commands[i], " --library library", "");
    line = fixtures::with(fixtures::with(line, "CASE", case_id_), "plan.json", at("plan.json"));
    library_.done(fixtures::with(line, "validity.html", at("validity.html")));
  }
  EXPECT_NE(fixtures::whole_file(at("validity.html")).find("Two people came a week late"), std::string::npos);
}

}  // namespace
}  // namespace seldinger
