#include "assessment/questionnaire/published.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assessment/questionnaire/shipped_forms.h"
#include "assessment/statistics/reliability/grim.h"
#include "assessment/statistics/reliability/whole_sets.h"
#include "sim/base/check.h"

namespace seldinger::assessment::questionnaire {
namespace {

using statistics::ReportedScale;

// Tables 6.1 to 6.3 of F. P. Vidal's thesis; of two answers of experts §6.3.2 says that they range from 1 to 4.
constexpr PublishedSummary kThesis[] = {
    {"6.1", "workshop-2005", "1", "trainees", 20, "5.4", "1.43"},
    {"6.1", "workshop-2005", "2", "trainees", 20, "6.15", "1.04"},
    {"6.1", "workshop-2005", "3", "trainees", 20, "5.55", "1.19"},
    {"6.1", "workshop-2005", "4", "trainees", 20, "4.7", "1.59"},
    {"6.1", "workshop-2005", "5", "trainees", 20, "6.35", "0.99"},
    {"6.2", "workshop-2006", "3", "trainees", 19, "30.42", "2.59"},
    {"6.2", "workshop-2006", "3", "experts", 3, "42.33", "11.85"},
    {"6.2", "workshop-2006", "4", "trainees", 19, "1.68", "1.11"},
    {"6.2", "workshop-2006", "4", "experts", 3, "13.50", "13.48"},
    {"6.2", "workshop-2006", "5", "trainees", 19, "4.32", "1.53"},
    {"6.2", "workshop-2006", "5", "experts", 3, "10.00", "0"},
    {"6.2", "workshop-2006", "6a", "trainees", 19, "8", "6.97"},
    {"6.2", "workshop-2006", "6a", "experts", 3, "", ""},
    {"6.2", "workshop-2006", "6b", "trainees", 19, "2", "4.26"},
    {"6.2", "workshop-2006", "6b", "experts", 3, "", ""},
    {"6.2", "workshop-2006", "7", "trainees", 19, "2.26", "1.05"},
    {"6.2", "workshop-2006", "7", "experts", 3, "3.00", "1.73"},
    {"6.2", "workshop-2006", "8a", "trainees", 19, "3.89", "0.94"},
    {"6.2", "workshop-2006", "8a", "experts", 3, "4.00", "0"},
    {"6.2", "workshop-2006", "8b", "trainees", 19, "2.58", "0.69"},
    {"6.2", "workshop-2006", "8b", "experts", 3, "2.67", "1.53"},
    {"6.2", "workshop-2006", "8c", "trainees", 19, "2.63", "0.96"},
    {"6.2", "workshop-2006", "8c", "experts", 3, "3.00", "1.73", 1, 4},
    {"6.2", "workshop-2006", "8d", "trainees", 19, "2.84", "0.83"},
    {"6.2", "workshop-2006", "8d", "experts", 3, "3.00", "1.73", 1, 4},
    {"6.2", "workshop-2006", "8e", "trainees", 19, "3.22", "0.88"},
    {"6.2", "workshop-2006", "8e", "experts", 3, "3.33", "0.58"},
    {"6.2", "workshop-2006", "8f", "trainees", 19, "3.28", "1.02"},
    {"6.2", "workshop-2006", "8f", "experts", 3, "3.00", "1"},
    {"6.2", "workshop-2006", "8g", "trainees", 19, "3.33", "0.97"},
    {"6.2", "workshop-2006", "8g", "experts", 3, "3.33", "0.58"},
    {"6.2", "workshop-2006", "8h", "trainees", 19, "2.61", "0.92"},
    {"6.2", "workshop-2006", "8h", "experts", 3, "2.33", "0.58"},
    {"6.3", "workshop-2007", "3", "trainees", 10, "30.11", "3.1"},
    {"6.3", "workshop-2007", "3", "experts", 5, "43.40", "3.58"},
    {"6.3", "workshop-2007", "4", "trainees", 10, "1.0", "0.0"},
    {"6.3", "workshop-2007", "4", "experts", 5, "15.60", "5.5"},
    {"6.3", "workshop-2007", "5", "trainees", 10, "3.50", "2.06"},
    {"6.3", "workshop-2007", "5", "experts", 5, "8.70", "0.97"},
    {"6.3", "workshop-2007", "6a", "trainees", 10, "6.94", "8.72"},
    {"6.3", "workshop-2007", "6a", "experts", 5, "", ""},
    {"6.3", "workshop-2007", "6b", "trainees", 10, "0.0", "0.0"},
    {"6.3", "workshop-2007", "6b", "experts", 5, "", ""},
    {"6.3", "workshop-2007", "7", "trainees", 10, "2.29", "0.95"},
    {"6.3", "workshop-2007", "7", "experts", 5, "2.80", "1.1"},
    {"6.3", "workshop-2007", "8a", "trainees", 10, "3.56", "0.53"},
    {"6.3", "workshop-2007", "8a", "experts", 5, "3.80", "0.45"},
    {"6.3", "workshop-2007", "8b", "trainees", 10, "2.44", "0.88"},
    {"6.3", "workshop-2007", "8b", "experts", 5, "3.00", "1.41"},
    {"6.3", "workshop-2007", "8c", "trainees", 10, "2.44", "0.53"},
    {"6.3", "workshop-2007", "8c", "experts", 5, "3.00", "1.41"},
    {"6.3", "workshop-2007", "8d", "trainees", 10, "2.67", "0.87"},
    {"6.3", "workshop-2007", "8d", "experts", 5, "3.25", "1.5"},
    {"6.3", "workshop-2007", "8e", "trainees", 10, "3.33", "0.87"},
    {"6.3", "workshop-2007", "8e", "experts", 5, "4.00", "1.41"},
    {"6.3", "workshop-2007", "8f", "trainees", 10, "3.56", "0.73"},
    {"6.3", "workshop-2007", "8f", "experts", 5, "", ""},
    {"6.3", "workshop-2007", "8g", "trainees", 10, "3.67", "0.87"},
    {"6.3", "workshop-2007", "8g", "experts", 5, "", ""},
    {"6.3", "workshop-2007", "8h", "trainees", 10, "2.44", "0.73"},
    {"6.3", "workshop-2007", "8h", "experts", 5, "3.67", "0.58"},
};

// "1.10" → 1.1 with two decimals.
double number_of(std::string_view printed) {
  double value = 0.0;
  const auto read = std::from_chars(printed.data(), printed.data() + printed.size(), value);
  CHECK(read.ec == std::errc() && read.ptr == printed.data() + printed.size());
  return value;
}
std::size_t decimals_of(std::string_view printed) {
  const std::size_t point = printed.find('.');
  return point == printed.npos ? 0 : printed.size() - point - 1;
}

ReportedScale reported_of(const PublishedSummary& published, const Form& form, const Item& item) {
  ReportedScale reported;
  reported.mean = number_of(published.mean);
  reported.mean_decimals = decimals_of(published.mean);
  reported.sd = number_of(published.sd);
  reported.sd_decimals = decimals_of(published.sd);
  const Scale* scale = form.find_scale(item.scale);
  reported.low = published.least ? *published.least : scale != nullptr ? scale->low() : item.least;
  reported.high = published.most ? *published.most : scale != nullptr ? scale->high() : item.most;
  return reported;
}

// A standard deviation needs two.
std::vector<std::size_t> possible_n(ReportedScale reported, std::size_t most) {
  std::vector<std::size_t> possible;
  for (reported.n = 2; reported.n <= most; ++reported.n)
    if (statistics::sd_is_possible(reported) != statistics::Possible::kNo) possible.push_back(reported.n);
  return possible;
}

void reconstruct(ReportedScale reported, SummaryReading& reading) {
  reported.n = reading.n;
  const statistics::WholeSets sets = statistics::whole_sets_of(reported);
  reading.sets = sets.count;
  reading.all_sets = sets.all;
  if (sets.first.empty()) return;
  const bool alone = reading.n_is_certain() && sets.count == 1 && sets.all;
  reading.reconstruction = alone ? Reconstruction::determined : Reconstruction::one_of_many;
  double sum = 0.0, squares = 0.0;
  for (const std::int64_t one : sets.first) {
    reading.answers.push_back(static_cast<double>(one) / static_cast<double>(reported.items));
    sum += reading.answers.back();
  }
  const double n = static_cast<double>(reading.n);
  for (const double one : reading.answers) squares += (one - sum / n) * (one - sum / n);
  reading.mean = sum / n;
  reading.sd = std::sqrt(squares / (n - 1.0));
}

}  // namespace

std::span<const PublishedSummary> thesis_summaries() {
  return kThesis;
}

std::optional<SummaryReading> read_summary(const PublishedSummary& published) {
  if (published.mean.empty()) return std::nullopt;
  const ShippedForm* shipped = find_shipped_form(published.form_id);
  CHECK(shipped != nullptr);
  SummaryReading reading;
  reading.published = published;
  reading.item = shipped->form.find_item(published.item);
  CHECK(reading.item != nullptr);
  ReportedScale reported = reported_of(published, shipped->form, *reading.item);
  reading.possible_n = possible_n(reported, published.group_size);
  if (reading.possible_n.empty()) {
    reported.items = 2;  // the mean of two whole numbers is a half
    reading.possible_n = possible_n(reported, published.group_size);
    reading.halves = !reading.possible_n.empty();
  }
  if (reading.possible_n.empty()) return reading;
  reading.n = reading.possible_n.back();
  reconstruct(reported, reading);
  return reading;
}

const std::vector<SummaryReading>& thesis_readings() {
  static const std::vector<SummaryReading> kReadings = [] {
    std::vector<SummaryReading> readings;
    for (const PublishedSummary& one : kThesis)
      if (auto reading = read_summary(one)) readings.push_back(std::move(*reading));
    return readings;
  }();
  return kReadings;
}

bool is_printed_as(double value, std::string_view printed) {
  const double half = 0.5 * std::pow(10.0, -static_cast<double>(decimals_of(printed)));
  return std::abs(value - number_of(printed)) <= half + 1e-9;
}

}  // namespace seldinger::assessment::questionnaire
