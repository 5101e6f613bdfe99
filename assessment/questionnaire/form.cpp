#include "assessment/questionnaire/form.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace seldinger::assessment::questionnaire {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view without_blanks(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kBlanks);
  return from == text.npos ? std::string_view() : text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

// Finite, and nothing behind it. A comma stands for a point, as paper is typed in many countries.
std::optional<double> number_from(std::string_view typed) {
  std::string text(typed);
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

base::Error bad_answer(const std::string& what) {
  return {"bad_answer", what};
}

base::Result<ItemAnswer> comment_from(std::string_view typed) {
  // What a browser sends for a line's end.
  std::string text;
  for (const char c : typed)
    if (c != '\r') text += c;
  const bool control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
  });
  if (text.size() > kMostCommentBytes || control)
    return bad_answer("takes a comment of up to " + std::to_string(kMostCommentBytes) + " bytes of text");
  return ItemAnswer{AnswerState::answered, {}, text};
}

const ScalePoint* point_of(const Form& form, const Item& item, double value) {
  const Scale* scale = form.find_scale(item.scale);
  if (scale == nullptr) return nullptr;
  const auto found = std::find_if(scale->points.begin(), scale->points.end(),
                                  [&](const ScalePoint& point) { return point.value == value; });
  return found == scale->points.end() ? nullptr : &*found;
}

}  // namespace

std::string number_text(double value) {
  char digits[32];
  return {digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr};
}

const Scale* Form::find_scale(std::string_view scale_id) const noexcept {
  const auto found =
      std::find_if(scales.begin(), scales.end(), [&](const Scale& one) { return one.id == scale_id; });
  return found == scales.end() ? nullptr : &*found;
}

const Item* Form::find_item(std::string_view item_id) const noexcept {
  const auto found = std::find_if(items.begin(), items.end(), [&](const Item& one) { return one.id == item_id; });
  return found == items.end() ? nullptr : &*found;
}

std::vector<std::vector<const Item*>> sections_of(const Form& form) {
  std::vector<std::vector<const Item*>> sections;
  for (const Item& item : form.items) {
    if (sections.empty() || sections.back().back()->section != item.section) sections.emplace_back();
    sections.back().push_back(&item);
  }
  return sections;
}

base::Result<ItemAnswer> answer_from_text(const Form& form, const Item& item, std::string_view typed) {
  typed = without_blanks(typed);
  if (typed.empty()) return ItemAnswer{};
  if (item.kind == ItemKind::comment) return comment_from(typed);
  if (typed == kNotApplicableWord) {
    if (!item.not_applicable) return bad_answer("cannot be answered with n/a");
    return ItemAnswer{AnswerState::not_applicable, {}, {}};
  }
  if (item.kind == ItemKind::choice) {
    const auto found = std::find(item.choices.begin(), item.choices.end(), typed);
    if (found == item.choices.end()) return bad_answer("is answered with none of its choices");
    return ItemAnswer{AnswerState::answered, static_cast<double>(found - item.choices.begin() + 1), {}};
  }
  const auto value = number_from(typed);
  if (item.kind == ItemKind::scale) {
    if (!value || point_of(form, item, *value) == nullptr) return bad_answer("is answered off its scale");
  } else if (!value || *value < item.least || *value > item.most || (item.whole && *value != std::floor(*value))) {
    return bad_answer(std::string("takes a ") + (item.whole ? "whole " : "") + "number from " +
                      number_text(item.least) + " to " + number_text(item.most));
  }
  return ItemAnswer{AnswerState::answered, *value + 0.0, {}};  // no −0
}

std::string text_of(const Item& item, const ItemAnswer& answer) {
  if (answer.state == AnswerState::missing) return {};
  if (answer.state == AnswerState::not_applicable) return std::string(kNotApplicableWord);
  if (item.kind == ItemKind::comment) return answer.text;
  if (!answer.value) return {};
  if (item.kind == ItemKind::choice) {
    const auto place = static_cast<std::size_t>(*answer.value);
    return place >= 1 && place <= item.choices.size() ? item.choices[place - 1] : std::string();
  }
  return number_text(*answer.value);
}

std::optional<double> scored(const Form& form, const Item& item, const ItemAnswer& answer) {
  if (answer.state != AnswerState::answered || !answer.value || item.kind == ItemKind::comment ||
      item.kind == ItemKind::choice)
    return std::nullopt;
  if (item.kind == ItemKind::number) return answer.value;
  const ScalePoint* point = point_of(form, item, *answer.value);
  if (point == nullptr || point->no_opinion) return std::nullopt;
  const Scale& scale = *form.find_scale(item.scale);
  return item.reverse ? scale.low() + scale.high() - *answer.value : *answer.value;
}

bool has_one_measure(const Form& form) {
  const Scale* first = nullptr;
  for (const Item& item : form.items) {
    if (item.kind != ItemKind::scale) continue;
    const Scale* scale = form.find_scale(item.scale);
    if (scale == nullptr) return false;
    if (first == nullptr) first = scale;
    if (scale->low() != first->low() || scale->high() != first->high()) return false;
  }
  return first != nullptr;
}

std::optional<double> mean_score(const Form& form, const std::map<std::string, ItemAnswer>& answers) {
  if (!has_one_measure(form)) return std::nullopt;
  double sum = 0.0, count = 0.0;
  for (const Item& item : form.items) {
    if (item.kind != ItemKind::scale) continue;
    const auto found = answers.find(item.id);
    if (found == answers.end() || found->second.state == AnswerState::missing) return std::nullopt;
    const auto counts = scored(form, item, found->second);
    if (!counts) continue;
    sum += *counts;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return sum / count;
}

std::string label_of(const Form& form, const Item& item, const ItemAnswer& answer) {
  if (answer.state != AnswerState::answered || !answer.value) return {};
  if (item.kind == ItemKind::choice) return text_of(item, answer);
  const ScalePoint* point = item.kind == ItemKind::scale ? point_of(form, item, *answer.value) : nullptr;
  return point == nullptr ? std::string() : point->label;
}

}  // namespace seldinger::assessment::questionnaire
