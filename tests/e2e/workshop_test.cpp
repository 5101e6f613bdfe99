// docs/workshops.md as it stands there, on a library with a case and somebody who comes; and who may not.
#include <fstream>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/page_commands.h"

namespace seldinger {
namespace {

TEST(WorkshopCommands, ThePageIsWhatCanBeTyped) {
  fixtures::CommandLibrary library(fixtures::fresh_folder("workshop_commands"));
  const std::string case_id = library.demo()["case_id"];
  for (const char* user : {"rita --role researcher", "tina --role trainee", "adam --role admin"})
    library.done(std::string("user add ") + user);
  const std::string consent = (library.folder() / "consent.txt").string(),
                    form = (library.folder() / "form.json").string();
  std::ofstream(consent) << "May what you do today be used in the study?\n";
  const auto commands = fixtures::commands_of_page("workshops.md");
  ASSERT_EQ(commands.size(), 11U);
  std::string code;
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    std::string line = fixtures::with(fixtures::with(command, " --library library", ""), " CASE", " " + case_id);
    line = fixtures::with(fixtures::with(line, "consent.txt", consent), "form.json", form);
    line = fixtures::with(line, " CODE", " " + code);
    if (line.starts_with("questionnaire template")) {
      fixtures::run(std::string(fixtures::kProgram) + " " + line, library.folder());
    } else if (line.starts_with("workshop open")) {
      const auto opened = library.ask(line);
      ASSERT_EQ(opened["stations"].size(), 2U);
      code = opened["code"];
    } else if (line.starts_with("workshop show")) {
      const auto shown = library.ask(line);
      ASSERT_EQ(shown["participants"].size(), 1U);
      EXPECT_EQ(shown["participants"][0]["number"], 1);
      for (const auto& turn : shown["participants"][0]["turns"])
        EXPECT_EQ(turn["done"], turn["station"] == "Talk") << "no attempt was made";
      EXPECT_EQ(shown.dump().find("tina"), std::string::npos) << "by pseudonym";
      const auto refused = library.call("workshop show " + code + " --by tina");
      EXPECT_EQ(refused.exit_code, 3);
      EXPECT_NE(refused.err.find("not_allowed"), std::string::npos) << refused.err;
    } else {
      library.done(line);
    }
  }
  const auto late = library.call("workshop admit " + code + " --user tina --consent");
  EXPECT_NE(late.err.find("workshop_closed"), std::string::npos) << late.err;

  // Once the study has a plan, it is told when she is to come back.
  const std::string plan = (library.folder() / "plan.json").string();
  library.done("study template --case " + case_id + " --out '" + plan + "'");
  const std::string words = fixtures::answered(fixtures::whole_file(plan));
  std::ofstream(plan) << words;
  library.done("study plan 'Study day' '" + plan + "' --by rita");
  library.done("study freeze 'Study day' --by rita");
  library.done("user fact tina years_in_radiology 0");
  library.done("study enrol 'Study day' --user tina --by rita");
  const auto visits = library.ask("workshop show " + code)["participants"][0]["visits"];
  ASSERT_FALSE(visits.empty());
  for (const auto& one : visits) EXPECT_LT(one["from_us"].get<long long>(), one["to_us"].get<long long>()) << one;
  library.done("check");
}

}  // namespace
}  // namespace seldinger
