#include "reports/words/check_words.h"

#include "assessment/grading/plain_words.h"

namespace seldinger::reports {
namespace {

struct Row {
  std::string_view name;
  const char* label;
};
constexpr Row kCheckLabels[] = {
    {"lesion_present", "Lesion"},           {"lesion_inside_body", "In the body"},
    {"lesion_not_in_bone", "Not in bone"},  {"lesion_reachable", "Free path"},
    {"entry_on_skin", "Entry on the skin"}, {"structure_in_volume", "Within the CT"},
    {"rule_present", "Pass rule"},          {"rule_meaningful", "Rule means something here"},
    {"rule_possible", "Rule can be met"},   {"burned_in_unchecked", "Text in the pictures"}};

}  // namespace

std::string check_label(std::string_view name) {
  for (const Row& row : kCheckLabels)
    if (row.name == name) return row.label;
  return assessment::plain_code(name);
}

std::string check_words(const casedb::Check& check) {
  const std::size_t colon = check.text.find(": ");
  if (check.holds || !check.name.starts_with("rule_") || colon == std::string::npos) return check.text;
  return check.text.substr(colon + 2);
}

}  // namespace seldinger::reports
