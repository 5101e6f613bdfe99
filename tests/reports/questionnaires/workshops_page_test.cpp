// The page of the three workshops: every printed value stands on it, and what it says against the thesis follows
// from the tables.
#include "reports/questionnaires/workshops_page.h"

#include <gmock/gmock.h>

#include "assessment/questionnaire/published.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
using ::testing::HasSubstr;
using ::testing::Not;

const questionnaire::SummaryReading& reading(std::string_view table, std::string_view item,
                                             std::string_view group) {
  for (const auto& one : questionnaire::thesis_readings())
    if (one.published.table == table && one.published.item == item && one.published.group == group) return one;
  throw std::out_of_range("no such reading");
}
double mean_of(std::string_view table, std::string_view item, std::string_view group) {
  return std::stod(std::string(reading(table, item, group).published.mean));
}
double sd_of(std::string_view table, std::string_view item, std::string_view group) {
  return std::stod(std::string(reading(table, item, group).published.sd));
}

TEST(WorkshopsPage, PrintsEveryValueAndFigure) {
  const std::string page = workshops_page();
  for (const auto& one : questionnaire::thesis_readings())
    EXPECT_THAT(page, HasSubstr(std::string(one.published.mean) + " ± " + std::string(one.published.sd)));
  for (const char* figure : {"6.14", "6.16", "6.17", "6.18"})
    EXPECT_THAT(page, HasSubstr("<strong>Figure " + std::string(figure) + "</strong>"));
  EXPECT_THAT(page, HasSubstr("Training only"));
  for (const char* outside : {"http://", "https://", "<script", "src=", ">nan", "-nan", ">inf"})
    EXPECT_THAT(page, Not(HasSubstr(outside))) << outside;
  EXPECT_THAT(page, Not(HasSubstr("<span class=\"no\">no</span>"))) << "what was recomputed is what was printed";
}

TEST(WorkshopsPage, SaysOfTheTextWhatTheTablesSay) {
  EXPECT_LT(sd_of("6.2", "8b", "trainees"), sd_of("6.2", "8a", "trainees")) << "8a was not the least disputed";
  for (const char* table : {"6.2", "6.3"})
    EXPECT_GT(mean_of(table, "8e", "experts"), mean_of(table, "8e", "trainees"))
        << "experts found it more appropriate";
  EXPECT_GT(mean_of("6.2", "8f", "trainees"), mean_of("6.2", "8f", "experts"));
  EXPECT_LT(mean_of("6.3", "5", "experts"), 10.0);
  // No set of answers to item 2 of 2005 is agreement throughout.
  questionnaire::PublishedSummary agreed = reading("6.1", "2", "trainees").published;
  agreed.least = 5;
  const auto all_agree = questionnaire::read_summary(agreed);
  EXPECT_TRUE(all_agree->possible_n.empty() || all_agree->sets == 0) << all_agree->possible_n.size();
}

}  // namespace
}  // namespace seldinger::reports
