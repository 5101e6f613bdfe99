#include "app/statistics/answer_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "assessment/statistics/reasons.h"

namespace seldinger::app {
namespace {

using assessment::statistics::Answer;

// Four digits, as somebody quotes it; all of them are in the JSON.
std::string rounded(double value) {
  std::array<char, 48> text{};
  const double size = std::abs(value);
  const char* format = value == std::round(value) && size < 1e15 ? "%.0f"
                       : size >= 1000.0 && size < 1e6            ? "%.1f"
                                                                 : "%.4g";
  std::snprintf(text.data(), text.size(), format, value == 0.0 ? 0.0 : value);
  return text.data();
}

std::string rounded_p(double p) {
  if (p < 0.0001) return "p < 0.0001";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "p = %.3g", p);
  return text.data();
}

std::size_t letters_of(std::string_view text) {  // of UTF-8
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
}

std::string line(const std::string& name, const std::string& what) {
  constexpr std::size_t kNames = 12;
  const std::size_t used = letters_of(name);
  return "  " + name + std::string(used < kNames ? kNames - used : 2, ' ') + what + "\n";
}

std::string counts_of(const Answer& answer) {
  std::string text = std::to_string(answer.n);
  const bool told = answer.groups.size() > 1 || (answer.groups.size() == 1 && answer.groups.front().name != "all");
  for (std::size_t i = 0; told && i < answer.groups.size(); ++i)
    text += (i == 0 ? " (" : ", ") + answer.groups[i].name + " " + std::to_string(answer.groups[i].n);
  if (told) text += ")";
  if (answer.missing > 0) text += "; left out because something is missing: " + std::to_string(answer.missing);
  return text;
}

std::string test_of(const Answer& answer) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (answer.statistic) add("statistic " + rounded(*answer.statistic));
  for (std::size_t i = 0; i < answer.df.size(); ++i) add((i == 0 ? "df " : "") + rounded(answer.df[i]));
  if (answer.p_value) add(rounded_p(*answer.p_value));
  return text;
}

// Names flush left, numbers flush right.
std::string table_of(const Answer& answer) {
  std::vector<std::vector<std::string>> cells(1, {""});
  for (const auto& one : answer.rows) {
    for (const auto& number : one.values)
      if (std::find(cells[0].begin() + 1, cells[0].end(), number.name) == cells[0].end())
        cells[0].push_back(number.name);
  }
  for (const auto& one : answer.rows) {
    std::vector<std::string> row(cells[0].size(), "–");
    row[0] = one.name;
    for (const auto& number : one.values)
      row[static_cast<std::size_t>(std::find(cells[0].begin() + 1, cells[0].end(), number.name) -
                                   cells[0].begin())] = rounded(number.value);
    cells.push_back(std::move(row));
  }
  std::vector<std::size_t> widths(cells[0].size(), 0);
  for (const auto& row : cells)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], letters_of(row[i]));
  std::string text;
  for (const auto& row : cells) {
    text += "  " + row[0] + std::string(widths[0] - letters_of(row[0]), ' ');
    for (std::size_t i = 1; i < row.size(); ++i)
      text += "  " + std::string(widths[i] - letters_of(row[i]), ' ') + row[i];
    text += "\n";
  }
  return text;
}

}  // namespace

std::string text_of_answer(const Answer& answer) {
  std::string text = answer.test;
  if (!answer.method.empty()) text += ": " + answer.method;
  text += "\n" + line("n", counts_of(answer));
  if (const auto* reason = assessment::statistics::find_reason(answer.reason.c_str()))
    text += line("no estimate", std::string(reason->words) + " (" + reason->code + ")");
  if (answer.estimate) {
    std::string what = rounded(*answer.estimate);
    if (answer.ci95) what += " [95 % CI " + rounded(answer.ci95->low) + " to " + rounded(answer.ci95->high) + "]";
    if (!answer.estimate_name.empty()) what += ", " + answer.estimate_name;
    text += line("estimate", what);
  } else if (answer.ci95) {
    text += line("95 % CI", rounded(answer.ci95->low) + " to " + rounded(answer.ci95->high));
  }
  if (const std::string test = test_of(answer); !test.empty()) text += line("test", test);
  std::size_t widest = 10;
  for (const auto& one : answer.more) widest = std::max(widest, letters_of(one.name));
  for (const auto& one : answer.more)
    text += "  " + one.name + std::string(widest - letters_of(one.name) + 2, ' ') + rounded(one.value) + "\n";
  if (!answer.rows.empty()) text += "\n" + table_of(answer);
  for (const std::string& note : answer.notes)
    text += (&note == &answer.notes.front() ? "\n" : "") + std::string("  note: ") + note + "\n";
  return text;
}

}  // namespace seldinger::app
