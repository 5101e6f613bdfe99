// The board of a workshop's day over a real library: what is to be seen from the back of the room, and nothing of
// who it is.
#include <gmock/gmock.h>

#include "casedb/people/consent.h"
#include "casedb/people/people.h"
#include "casedb/workshops/workshops.h"
#include "tests/casedb/library_samples.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"

namespace seldinger::web {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Board, ShowsNumbersAndNothingOfWhoTheyAre) {
  auto library = casedb::open_library(fixtures::fresh_test_folder("web") / "library");
  const std::string study = casedb::add_study(library, "Secret study").value();
  ASSERT_TRUE(casedb::add_consent_text(library, study, "May we?"));
  const auto day =
      casedb::open_workshop(library, {study, "Autumn <day>", {{"Kidney"}, {"Talk"}}, {"novices", "masters"}})
          .value();
  std::vector<std::string> secrets = {"Secret study", "novices", "masters", study};
  for (const char* name : {"Zebedee", "Ursula"}) {
    const std::string person = casedb::add_user(library, name, casedb::Role::trainee, "a password").value();
    const auto came =
        casedb::admit_to_workshop(library, day, person, name[0] == 'Z' ? "novices" : "masters", true).value();
    secrets.insert(secrets.end(), {name, person, came.pseudonym});
  }
  ASSERT_TRUE(casedb::tick_in_workshop(library, day, 2, "Talk"));
  const auto all = casedb::list_participants(library, day);
  FakeSite fake;
  const auto questions = std::move(questions_of(std::move(library)).value());
  Site site(*questions, fake.surroundings, routes());
  FakeBrowser browser(site);
  const Response board = browser.get("/board?code=" + day.code);
  EXPECT_EQ(board.status, 200);
  EXPECT_EQ(header_of(board, "Refresh"), "10") << "by itself";
  EXPECT_THAT(board.body, HasSubstr("Autumn &lt;day&gt;"));
  EXPECT_THAT(board.body, HasSubstr("0 of 2 people are through all stations"));
  EXPECT_THAT(board.body, HasSubstr("✓ <bdi>Talk</bdi>"));
  EXPECT_THAT(board.body, HasSubstr("▶ <bdi>" + day.stations[all[0].order[0]].title + "</bdi>"));
  EXPECT_THAT(board.body, HasSubstr("<th scope=\"row\">2</th>"));
  for (const std::string& secret : secrets) EXPECT_THAT(bytes_of(board, true), Not(HasSubstr(secret)));
  EXPECT_THAT(board.body, Not(HasSubstr("<script")));
  const Response none = browser.get("/board?code=XXXXXX");
  EXPECT_EQ(none.status, 404);
  EXPECT_THAT(none.body, HasSubstr("No workshop has that code"));
}

}  // namespace
}  // namespace seldinger::web
