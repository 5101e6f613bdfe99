#include "reports/words/metric_card.h"

#include <algorithm>
#include <cctype>

#include "assessment/grading/reason_words.h"
#include "assessment/registry.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::MetricInfo;

constexpr std::string_view kNull = "Null: ";  // how a definition introduces its reasons

bool of_code(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Replaces each name in snake_case by what `words` has for it; an empty answer leaves the name as it is.
template <typename Words>
std::string with_codes_in_words(std::string_view text, const Words& words) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && of_code(text[end])) ++end;
    if (end == at) {
      out += text[at++];
      continue;
    }
    const std::string_view code = text.substr(at, end - at);
    const std::string said = code.find('_') != code.npos ? words(code) : std::string();
    out += said.empty() ? std::string(code) : said;
    at = end;
  }
  return out;
}

std::string label_in_quotes(std::string_view id) {
  const MetricInfo* info = assessment::find_metric(std::string(id));
  return info != nullptr ? "“" + std::string(info->label) + "”" : "";
}

std::string reason_or_label(std::string_view code) {
  const assessment::ReasonWords* found = assessment::find_reason_words(code);
  return found != nullptr ? std::string(found->words) : label_in_quotes(code);
}

std::string direction_words(assessment::Direction direction) {
  switch (direction) {
    case assessment::Direction::lower_is_better:
      return "lower";
    case assessment::Direction::higher_is_better:
      return "higher";
    case assessment::Direction::none:
      break;
  }
  return "neither: it is reported, not judged";
}

std::string without_final_stop(std::string text) {
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

// "Where the skin was never punctured; where …": the needs' reasons, then the metric's own.
std::string null_words(const MetricInfo& info, std::string_view own) {
  std::string text;
  const auto add = [&](std::string_view words) {
    if (!text.empty()) text += "; ";
    text += words;
  };
  for (const assessment::NeedInfo& need : assessment::needs())
    if ((info.needs & need.need) != 0) add(assessment::reason_words(need.reason));
  if (!own.empty()) add(without_final_stop(with_codes_in_words(own, reason_or_label)));
  return text;
}

}  // namespace

std::string with_labels(std::string_view text) {
  return with_codes_in_words(text, label_in_quotes);
}

std::string unit_words(std::string_view unit) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {{"bool", "yes or no"},
                                                                      {"count", "number of times"},
                                                                      {"share", "percent of the whole"},
                                                                      {"%", "percent"},
                                                                      {"deg", "degrees"},
                                                                      {"s", "seconds (s)"},
                                                                      {"mm", "millimetres (mm)"},
                                                                      {"N", "newtons (N)"},
                                                                      {"1", "a number without a unit"},
                                                                      {"1/s", "per second"},
                                                                      {"mm²", "square millimetres (mm²)"}};
  for (const auto& [known, words] : kWords)
    if (known == unit) return std::string(words);
  return std::string(unit);
}

Card metric_card(std::string_view id, int version) {
  Card card{std::string(id), metric_label(id), 0, "", {}};
  const MetricInfo* info = assessment::find_metric(std::string(id));
  if (info == nullptr) {
    card.definition =
        "This program does not know how it was measured: another version of the program stored the value.";
    return card;
  }
  card.version = info->version;
  const std::string_view all = info->definition;
  const std::size_t null_at = all.find(kNull);
  card.definition = with_labels(all.substr(0, null_at));
  while (card.definition.ends_with(' ')) card.definition.pop_back();
  card.lines.push_back({"Unit", unit_words(info->unit)});
  card.lines.push_back({"Better", direction_words(info->direction)});
  const std::string nulls = null_words(*info, null_at == all.npos ? "" : all.substr(null_at + kNull.size()));
  card.lines.push_back({"No value if", nulls.empty() ? "never: it always has one" : nulls});
  card.lines.push_back({"Version", version_words(card, version, "value was measured")});
  if (*info->history != '\0') card.lines.push_back({"Before", with_labels(info->history)});
  card.lines.push_back({"Source", info->source});
  return card;
}

}  // namespace seldinger::reports
