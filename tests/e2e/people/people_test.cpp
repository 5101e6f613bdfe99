// Cohorts, consent, export and erasure as commands: what researchers get, and that nothing of an erased person is
// left.
#include <algorithm>
#include <fstream>

#include "casedb/attempts/attempts.h"
#include "casedb/people/people.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class PeopleCommands : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("people_commands")};
  std::string case_id_ = library_.demo()["case_id"];

  void SetUp() override {
    for (const char* user : {"Zebedee-Quagmire --role trainee", "tina --role trainee", "mona --role mentor",
                             "rita --role researcher", "adam --role admin"})
      library_.done(std::string("user add ") + user);
  }
  // A simulated attempt stored as one that the person made.
  std::string attempt_of(const std::string& name) {
    auto library = casedb::Library::open(library_.path());
    std::string person_id;
    for (const casedb::Account& one : casedb::list_users(*library))
      if (one.login_name == name) person_id = one.person_id;
    const auto rows = casedb::list_attempts(*library);
    const auto simulated = std::find_if(rows.begin(), rows.end(), [](const auto& one) { return one.synthetic(); });
    const casedb::AttemptRow& row = *simulated;
    casedb::NewAttempt made;
    static_cast<casedb::AttemptHead&>(made) = row;
    made.person_id = person_id;
    made.operator_name = casedb::kPersonOperator;
    made.metrics = row.metrics;
    made.metrics.push_back({"made_up", 1, 0.7234567890123456, "share", ""});
    made.recording = casedb::load_recording(*library, row.attempt_id).value();
    made.duration_s = row.duration_s;
    return casedb::add_attempt(*library, made).value();
  }
  std::string refusal(const std::string& words) {
    const auto ran = library_.call(words);
    EXPECT_EQ(ran.exit_code, 3) << words;
    const std::size_t from = ran.err.find("error: ") + 7;
    return ran.err.substr(from, ran.err.find(':', from) - from);
  }
  static bool holds(const fs::path& folder, const std::string& secret) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && fixtures::whole_file(entry.path()).find(secret) != std::string::npos)
        return true;
    return false;
  }
  std::string at(const char* name) const { return (library_.folder() / name).string(); }
};

TEST_F(PeopleCommands, AnExportHoldsWhoConsentsAndNobodyElse) {
  attempt_of("Zebedee-Quagmire");
  attempt_of("tina");
  attempt_of("tina");
  library_.done("study new Needles");
  library_.done("study researcher Needles --user rita");
  std::ofstream(at("text.txt")) << "May your attempts be used in Needles?\n";
  library_.done("consent text " + at("text.txt") + " --study Needles");
  const Json asked = library_.ask("consent list --user tina")["consents"];
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0]["stands"], false);
  const std::string text = asked[0]["text_id"];
  library_.done("user fact tina confidence 4");
  EXPECT_EQ(refusal("user fact tina confidence 11"), "bad_answer");
  const Json before = library_.ask("export --study Needles --by rita --out " + at("before"));
  EXPECT_EQ(before["attempts"], before["synthetic"]) << "nobody has consented";
  library_.done("consent give " + text + " --user tina");
  EXPECT_EQ(library_.ask("consent list --user tina")["consents"][0]["stands"], true);
  const Json after = library_.ask("export --study Needles --by rita --out " + at("after"));
  EXPECT_EQ(after["attempts"].get<int>(), before["attempts"].get<int>() + 2);
  const auto attempts = fixtures::csv_table(fixtures::whole_file(at("after/attempts.csv")));
  for (std::size_t i = 0; i < attempts.rows.size(); ++i) {
    EXPECT_EQ(attempts.cell(i, "synthetic"), i < 2 ? "0" : "1") << "people come first";
    // Before, simulations in somebody's name had a person, who had not consented.
    EXPECT_EQ(attempts.cell(i, "person_attempt"), i < 2 ? std::to_string(i + 1) : "");
    EXPECT_EQ(attempts.cell(i, "person"), i < 2 ? attempts.cell(0, "person") : "");
  }
  EXPECT_EQ(attempts.cell(0, "days_since_first"), "0");
  const auto facts = fixtures::csv_table(fixtures::whole_file(at("after/facts.csv")));
  ASSERT_EQ(facts.rows.size(), 1U);
  EXPECT_EQ(facts.cell(0, "fact"), "confidence");
  EXPECT_EQ(facts.cell(0, "answer"), "4");
  EXPECT_FALSE(holds(at("after"), "tina"));
  EXPECT_EQ(refusal("export --study Needles --by mona --out " + at("x")), "not_allowed");
  EXPECT_EQ(refusal("export --study Probes --out " + at("x")), "no_study");
  const Json all = library_.ask("export --out " + at("research"));
  EXPECT_EQ(all["attempts"], all["synthetic"]) << "consent to a study is none to any research";
  library_.done("consent withdraw " + text + " --user tina");
  EXPECT_EQ(refusal("consent withdraw " + text + " --user tina"), "not_given");
  EXPECT_EQ(library_.ask("export --study Needles --out " + at("withdrawn"))["attempts"], before["attempts"]);
  library_.done("study researcher Needles --user rita --end");  // before: there was no end to it
  EXPECT_EQ(refusal("export --study Needles --by rita --out " + at("x")), "not_allowed");
  EXPECT_EQ(refusal("study researcher Needles --user rita --end"), "not_enrolled");
}

TEST_F(PeopleCommands, NothingOfAnErasedPersonIsLeftInLibraryBackupOrExport) {
  const std::string attempt_id = attempt_of("Zebedee-Quagmire");
  attempt_of("tina");
  library_.done("cohort add Autumn --programme Radiology");
  library_.done("cohort enrol Autumn --user mona --mentor");
  library_.done("cohort enrol Autumn --user Zebedee-Quagmire");
  EXPECT_EQ(library_.ask("cohort show Autumn")["enrolments"].size(), 2U);
  EXPECT_TRUE(holds(library_.path(), "Zebedee-Quagmire"));
  EXPECT_TRUE(holds(library_.path(), attempt_id));
  EXPECT_EQ(refusal("user erase Zebedee-Quagmire --by mona"), "not_allowed");
  EXPECT_EQ(refusal("user erase Nobody"), "no_user");
  const Json erased = library_.ask("user erase Zebedee-Quagmire --by adam");
  EXPECT_EQ(erased["attempts"], 1);
  EXPECT_EQ(erased["overwritten"], true);
  library_.done("backup " + at("backup"));
  library_.done("export --out " + at("export"));
  for (const char* place : {"library", "backup", "export"})
    for (const std::string& secret : {std::string("Zebedee-Quagmire"), attempt_id})
      EXPECT_FALSE(holds(at(place), secret)) << place;
  library_.done("check");
  EXPECT_EQ(library_.ask("cohort show Autumn")["enrolments"].size(), 1U);
  EXPECT_EQ(refusal("attempt show " + attempt_id), "no_attempt");
}

TEST_F(PeopleCommands, AttemptsAndCasesAreDeletedByWhoMay) {
  const std::string attempt_id = attempt_of("tina");
  EXPECT_EQ(refusal("attempt delete " + attempt_id + " --by mona"), "not_allowed");
  EXPECT_EQ(refusal("case delete " + case_id_), "has_attempts");
  library_.done("attempt delete " + attempt_id + " --by tina");
  EXPECT_EQ(refusal("attempt delete " + attempt_id), "no_attempt");
  const std::string next = library_.ask("case version " + case_id_ + " --by mona")["case_id"];
  EXPECT_EQ(refusal("case delete " + next + " --by rita"), "not_allowed");
  library_.done("case delete " + next + " --by mona");
  EXPECT_EQ(refusal("case show " + next), "no_case");
  library_.done("check");
}

}  // namespace
}  // namespace seldinger
