// The thesis' tables 6.1 to 6.3: how many can have answered and what they can have said, against every set of
// answers there is, and the statistics of what was reconstructed against what was printed.
#include "assessment/questionnaire/published.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "assessment/questionnaire/shipped_forms.h"

namespace seldinger::assessment::questionnaire {
namespace {

std::string name_of(const SummaryReading& reading) {
  return std::string(reading.published.table) + " " + std::string(reading.published.item) + " " +
         std::string(reading.published.group);
}
std::map<std::string, const SummaryReading*> by_name() {
  std::map<std::string, const SummaryReading*> all;
  for (const SummaryReading& one : thesis_readings()) all.emplace(name_of(one), &one);
  return all;
}

// How many ways there are to tick n answers on a scale with the printed mean and SD: by how many ticked each point.
std::size_t ways(const SummaryReading& reading, std::size_t n) {
  const Scale& scale = *find_shipped_form(reading.published.form_id)->form.find_scale(reading.item->scale);
  const int least = reading.published.least.value_or(scale.low()),
            most = reading.published.most.value_or(scale.high());
  std::size_t found = 0;
  const auto tick = [&](const auto& self, int value, std::size_t left, double sum, double squares) -> void {
    if (value > most) {
      if (left > 0) return;
      const double count = static_cast<double>(n), mean = sum / count;
      const double sd = std::sqrt(std::max(0.0, (squares - sum * mean) / (count - 1.0)));
      found += is_printed_as(mean, reading.published.mean) && is_printed_as(sd, reading.published.sd) ? 1U : 0U;
      return;
    }
    for (std::size_t many = 0; many <= left; ++many)
      self(self, value + 1, left - many, sum + static_cast<double>(many) * value,
           squares + static_cast<double>(many) * value * value);
  };
  tick(tick, least, n, 0.0, 0.0);
  return found;
}

TEST(ThesisTables, AreAllThere) {
  std::map<std::string_view, std::size_t> rows, told;
  for (const PublishedSummary& one : thesis_summaries()) {
    ++rows[one.table];
    told[one.table] += one.mean.empty() ? 0U : 1U;
    EXPECT_EQ(one.mean.empty(), one.sd.empty());
    const ShippedForm* form = find_shipped_form(one.form_id);
    ASSERT_NE(form, nullptr);
    EXPECT_NE(form->form.find_item(one.item), nullptr) << one.item;
  }
  EXPECT_EQ(rows, (std::map<std::string_view, std::size_t>{{"6.1", 5}, {"6.2", 28}, {"6.3", 28}}));
  EXPECT_EQ(told, (std::map<std::string_view, std::size_t>{{"6.1", 5}, {"6.2", 26}, {"6.3", 24}}))
      << "N.A.: experts' 6a and 6b, and in 2007 8f and 8g";
}

TEST(ThesisTables, AreReadAsEnumerationSays) {
  std::size_t checked = 0;
  for (const SummaryReading& one : thesis_readings()) {
    const Scale* scale = find_shipped_form(one.published.form_id)->form.find_scale(one.item->scale);
    if (scale == nullptr || one.halves || scale->points.size() > 7) continue;
    std::vector<std::size_t> possible;
    for (std::size_t n = 2; n <= one.published.group_size; ++n)
      if (ways(one, n) > 0) possible.push_back(n);
    EXPECT_EQ(one.possible_n, possible) << name_of(one);
    EXPECT_EQ(one.sets, ways(one, one.n)) << name_of(one);
    ++checked;
  }
  EXPECT_EQ(checked, 5U + 18U + 16U) << "table 6.1; questions 7 to 8h";
}

// An n is stated as certain where mean and SD leave one alone.
TEST(ThesisTables, SayHowManyCanHaveAnswered) {
  const auto all = by_name();
  for (const char* item : {"8e", "8f", "8g", "8h"})
    EXPECT_EQ(all.at(std::string("6.2 ") + item + " trainees")->possible_n, std::vector<std::size_t>{18}) << item;
  EXPECT_EQ(all.at("6.2 8c trainees")->possible_n, (std::vector<std::size_t>{16, 19}));
  EXPECT_EQ(all.at("6.2 4 experts")->possible_n, std::vector<std::size_t>{3});
  EXPECT_EQ(all.at("6.2 4 experts")->answers, (std::vector<double>{4.5, 7.0, 29.0}));
  for (const char* item : {"8a", "8b", "8c", "8d", "8e", "8f", "8g", "8h"})
    EXPECT_EQ(all.at(std::string("6.3 ") + item + " trainees")->possible_n, std::vector<std::size_t>{9}) << item;
  EXPECT_EQ(all.at("6.3 7 trainees")->possible_n, std::vector<std::size_t>{7});
  EXPECT_EQ(all.at("6.3 8d experts")->possible_n, std::vector<std::size_t>{4});
  EXPECT_EQ(all.at("6.3 8h experts")->possible_n, std::vector<std::size_t>{3});
  for (const char* item : {"1", "4"})
    EXPECT_GT(all.at(std::string("6.1 ") + item + " trainees")->possible_n.size(), 1U) << "one decimal tells less";
}

// The means and SDs that come from no whole numbers.
TEST(ThesisTables, NameWhatComesFromNoWholeNumbers) {
  std::set<std::string> halves, impossible;
  for (const SummaryReading& one : thesis_readings()) {
    if (one.halves) halves.insert(name_of(one));
    if (one.possible_n.empty()) impossible.insert(name_of(one));
  }
  EXPECT_EQ(halves, (std::set<std::string>{"6.2 4 experts", "6.3 5 experts", "6.3 5 trainees", "6.3 6a trainees"}));
  EXPECT_TRUE(impossible.empty());
}

TEST(ThesisTables, OfReconstructedAnswersAreThePrintedOnesToTheirDigits) {
  std::set<std::string> not_reconstructed, determined;
  for (const SummaryReading& one : thesis_readings()) {
    if (one.reconstruction == Reconstruction::none) {
      not_reconstructed.insert(name_of(one));
      EXPECT_FALSE(one.mean.has_value());
      continue;
    }
    ASSERT_EQ(one.answers.size(), one.n) << name_of(one);
    double sum = 0.0, squares = 0.0;
    const double n = static_cast<double>(one.n);
    for (const double answer : one.answers) {
      sum += answer;
      squares += answer * answer;
      const auto fits =
          answer_from_text(find_shipped_form(one.published.form_id)->form, *one.item, std::to_string(answer));
      EXPECT_TRUE(fits.has_value() || one.halves) << name_of(one) << " " << answer;
    }
    EXPECT_TRUE(is_printed_as(sum / n, one.published.mean)) << name_of(one);
    EXPECT_TRUE(is_printed_as(std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1.0))), one.published.sd))
        << name_of(one);
    EXPECT_NEAR(*one.mean, sum / n, 1e-12);
    if (one.reconstruction == Reconstruction::determined) determined.insert(name_of(one));
  }
  EXPECT_EQ(not_reconstructed, std::set<std::string>{"6.2 6a trainees"}) << "6 to 19 people, to the whole number";
  EXPECT_EQ(determined,
            (std::set<std::string>{"6.2 3 experts", "6.2 4 experts", "6.2 8b experts", "6.2 8c experts",
                                   "6.2 8d experts", "6.2 8e experts", "6.2 8g experts", "6.2 8h experts",
                                   "6.3 8a experts", "6.3 8a trainees", "6.3 8c trainees", "6.3 8h experts"}));
}

TEST(ThesisTables, ANumberThatIsNoneIsPrintedNowhere) {
  EXPECT_FALSE(is_printed_as(std::nan(""), "1.0"));
  EXPECT_TRUE(is_printed_as(2.285714, "2.29"));
  EXPECT_TRUE(is_printed_as(1.105, "1.1"));
  EXPECT_FALSE(is_printed_as(2.28, "2.29"));
}

}  // namespace
}  // namespace seldinger::assessment::questionnaire
