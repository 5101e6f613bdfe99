#include "assessment/grading/plain_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace seldinger::assessment {
namespace {

struct UnitWords {
  std::string_view unit, after;
  double factor;
  int digits;        // from 10 on
  int small_digits;  // below
};
constexpr UnitWords kUnits[] = {
    {"mm", " mm", 1.0, 0, 1},        {"s", " s", 1.0, 0, 1},   {"share", " %", 100.0, 0, 0},
    {"%", " %", 1.0, 0, 0},          {"deg", "°", 1.0, 0, 0},  {"mm²", " mm²", 1.0, 0, 0},
    {"N", " N", 1.0, 1, 1},          {"count", "", 1.0, 0, 0}, {"1", "", 1.0, 1, 1},
    {"1/s", " a second", 1.0, 1, 1}, {"Hz", " Hz", 1.0, 0, 0}, {"mGy", " mGy", 1.0, 1, 1},
    {"Gy·cm²", " Gy·cm²", 1.0, 2, 3}};
constexpr int kMostDigits = 9;

UnitWords words_of(std::string_view unit) {
  for (const UnitWords& words : kUnits)
    if (words.unit == unit) return words;
  return {unit, "", 1.0, 1, 1};
}

// Trailing zeros behind the point say nothing in a sentence.
std::string number(double value, int digits) {
  std::array<char, 400> buffer{};  // the widest double has 309 digits before the point
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, std::fabs(value));
  std::string text = buffer.data();
  if (text.find('.') != text.npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return value < 0.0 && text != "0" ? "−" + text : text;
}

int digits_of(double value, const UnitWords& words) {
  return std::fabs(value * words.factor) < 10.0 ? words.small_digits : words.digits;
}

}  // namespace

std::string plain_value(double value, std::string_view unit) {
  const UnitWords words = words_of(unit);
  return number(value * words.factor, digits_of(value, words)) + std::string(words.after);
}

std::pair<std::string, std::string> plain_apart(double value, double other, std::string_view unit) {
  const UnitWords words = words_of(unit);
  std::pair<std::string, std::string> texts{plain_value(value, unit), plain_value(other, unit)};
  for (int digits = digits_of(value, words) + 1;
       texts.first == texts.second && value != other && digits <= kMostDigits; ++digits)
    texts = {number(value * words.factor, digits) + std::string(words.after),
             number(other * words.factor, digits) + std::string(words.after)};
  return texts;
}

std::string plain_range(double low, double high, std::string_view unit) {
  const UnitWords words = words_of(unit);
  const int digits = std::min(digits_of(low, words), digits_of(high, words));
  const std::string from = number(low * words.factor, digits), to = number(high * words.factor, digits);
  const std::string after(words.after);
  if (from == to) return to + after;
  return from + (low < 0.0 || high < 0.0 ? " to " : "–") + to + after;
}

std::pair<double, double> said_range(double low, double high, std::string_view unit) {
  const UnitWords words = words_of(unit);
  const double tenths = std::pow(10.0, std::min(digits_of(low, words), digits_of(high, words)));
  const auto said = [&](double value) { return std::round(value * words.factor * tenths) / tenths / words.factor; };
  return {said(low), said(high)};
}

std::string plain_times(double count) {
  if (count == 1.0) return "once";
  if (count == 2.0) return "twice";
  return number(count, 1) + " times";
}

std::string plain_code(std::string_view code) {
  std::string words(code);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace seldinger::assessment
