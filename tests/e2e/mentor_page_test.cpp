// docs/mentor.md, run as it stands there: from a DICOM folder to a published case, and to its reviewed version.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/fixtures/page_commands.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;
using fixtures::with;

using fixtures::kProgram;

// The id behind "case " at the beginning of what a command printed.
std::string id_of(const std::string& printed) {
  return printed.rfind("case ", 0) == 0 ? printed.substr(5, 36) : "";
}

TEST(MentorPage, ItsCommandsLeadFromDicomToAPublishedCase) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("mentor_page");
  const std::string library = (scratch / "library").string();
  const auto commands = fixtures::commands_of_page("mentor.md");
  ASSERT_EQ(commands.size(), 13U) << "two accounts, two about a cohort, five commands, four for the review";
  std::string case_id, next_id;
  for (const std::string& command : commands) {
    std::string line = with(with(command, "CASE", case_id), "NEXT", next_id);
    line = with(line, "--library library", "--library '" + library + "'");
    line = with(line, "import ct ",
                "import '" + fixtures::shared_data_dir().string() + "/ct-abdomen-contrast-dicom' ");
    const auto ran = run("printf 'a password\\n' | " + kProgram + " " + line, scratch);
    ASSERT_EQ(ran.exit_code, 0) << command << "\n" << ran.err;
    if (command.rfind("import ", 0) == 0) case_id = id_of(ran.out);
    if (command.rfind("case version ", 0) == 0) next_id = id_of(ran.out);
  }
  ASSERT_EQ(case_id.size(), 36U);
  ASSERT_EQ(next_id.size(), 36U);
  const auto shown = [&](const std::string& id) {
    return Json::parse(run(kProgram + " case show " + id + " --json --library '" + library + "'", scratch).out);
  };
  const Json first = shown(case_id), second = shown(next_id);
  EXPECT_EQ(first.at("state"), "published");
  EXPECT_EQ(first.at("audience"), "own_cohort");
  EXPECT_TRUE(first.at("reviewed_by").is_null());
  EXPECT_EQ(second.at("state"), "published");
  EXPECT_EQ(second.at("version"), 2);
  EXPECT_EQ(second.at("family_id"), case_id);
  EXPECT_EQ(second.at("audience"), "everyone");
  EXPECT_FALSE(second.at("reviewed_by").is_null());
  EXPECT_EQ(second.at("structures").size(), 1U);
  EXPECT_EQ(second.at("rule").size(), 3U);
  EXPECT_EQ(second.at("instrument").at("kind"), "core");
}

}  // namespace
}  // namespace seldinger
