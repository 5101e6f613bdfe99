// Tests that the generated documents are what their tables say. To renew one: seldinger help --commands >
// docs/commands.md
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/cli/error_codes.h"
#include "app/commands.h"
#include "assessment/grading/worthwhile.h"
#include "assessment/operators/profile.h"
#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "casedb/import/dicom/allow_list.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/places.h"
#include "web/routes.h"

namespace {

std::string file(const std::string& name) {
  return seldinger::fixtures::whole_file(seldinger::fixtures::source_dir() / name);
}

TEST(Docs, CommandsAreTheTable) {
  EXPECT_EQ(file("docs/commands.md"), seldinger::app::commands_markdown());
}

TEST(Docs, MetricsAreTheRegistry) {
  EXPECT_EQ(file("docs/metrics.md"), seldinger::assessment::metrics_markdown());
}

TEST(Docs, DifferencesAreTheTable) {
  EXPECT_EQ(file("docs/differences.md"), seldinger::assessment::worthwhile_markdown());
}

TEST(Docs, StepsAreTheTables) {
  EXPECT_EQ(file("docs/steps.md"), seldinger::assessment::steps_markdown());
}

TEST(Docs, OperatorsAreTheTable) {
  EXPECT_EQ(file("docs/operators.md"), seldinger::assessment::operators_markdown());
}

TEST(Docs, RoutesAreTheRegistry) {
  EXPECT_EQ(file("docs/routes.md"), seldinger::web::routes_markdown());
}

TEST(Docs, AttributesAreTheAllowList) {
  EXPECT_EQ(file("docs/attributes.md"), seldinger::casedb::allow_list_markdown());
}

TEST(Docs, ErrorsAreTheTable) {
  EXPECT_EQ(file("docs/errors.md"), seldinger::app::errors_markdown());
}

TEST(Docs, HelpNamesEveryCommandAndOption) {
  for (const auto& command : seldinger::app::commands()) {
    EXPECT_NE(seldinger::app::help_text().find(command.name), std::string::npos) << command.name;
    for (const auto& option : command.options)
      EXPECT_NE(seldinger::app::help_text(command).find(option.name), std::string::npos) << option.name;
  }
}

TEST(Docs, TheReadmeNamesOnlyCommandsThatExist) {
  const std::string readme = file("README.md");
  ASSERT_FALSE(readme.empty());
  for (std::size_t at = readme.find("`seldinger "); at != std::string::npos;
       at = readme.find("`seldinger ", at + 1)) {
    const std::string rest = readme.substr(at + 11, 40);
    bool known = false;
    for (const auto& command : seldinger::app::commands()) known = known || rest.rfind(command.name, 0) == 0;
    EXPECT_TRUE(known) << rest;
  }
}

TEST(Docs, TheReadmesLinksLeadSomewhere) {
  const std::string readme = file("README.md");
  int links = 0;
  for (std::size_t at = readme.find("]("); at != std::string::npos; at = readme.find("](", at + 1), ++links) {
    const std::string target = readme.substr(at + 2, readme.find(')', at) - at - 2);
    EXPECT_TRUE(std::filesystem::exists(seldinger::fixtures::source_dir().string() + "/" + target)) << target;
  }
  EXPECT_GT(links, 5);
}

}  // namespace
