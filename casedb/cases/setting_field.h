// The kinds of values a setting of a case can have, each with how it is got from a CaseSetting and put into it. A
// part of the setting is named by its path of members:
//   number<&CaseSetting::instrument, &Instrument::hu>(-1024, 32767)
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "casedb/cases/case_setting.h"
#include "sim/base/names.h"

namespace seldinger::casedb {

struct NumberField {
  double (*get)(const CaseSetting&);
  void (*set)(CaseSetting&, double);
  double least, most;
};
struct MaybeNumberField {
  std::optional<double> (*get)(const CaseSetting&);
  void (*set)(CaseSetting&, std::optional<double>);
  double least, most;
};
struct MaybeWholeField {
  std::optional<int> (*get)(const CaseSetting&);
  void (*set)(CaseSetting&, std::optional<int>);
  int least, most;
};
// One line of at most kMostSettingText bytes.
constexpr std::size_t kMostSettingText = 200;
struct TextField {
  const std::string& (*get)(const CaseSetting&);
  void (*set)(CaseSetting&, std::string);
};
// One of an enum's names.
struct ChoiceField {
  std::span<const std::string_view> names;
  std::string_view (*get)(const CaseSetting&);
  bool (*set)(CaseSetting&, std::string_view);  // false: no such name, nothing is changed
};
// Yes or no, written as one of two names; in the database by name or as 0 and 1.
struct SwitchField {
  std::string_view no, yes;
  bool stored_as_number;
  bool (*get)(const CaseSetting&);
  void (*set)(CaseSetting&, bool);
};
// What is no single value: whoever loops over the table asks which it is and does it by hand.
enum class Composed {
  further_modalities,  // a list
  gauge,               // a name of the needle's radius, which has a row of its own
  planned_entry,       // a point or none
  pass_rule            // criteria; its options are the command's own
};
struct ComposedField {
  Composed what;
  std::span<const char* const> columns;  // all of them
};

using SettingField = std::variant<NumberField, MaybeNumberField, MaybeWholeField, TextField, ChoiceField,
                                  SwitchField, ComposedField>;

// A visitor of SettingField: one lambda for each kind, so that a new kind does not compile until all know it.
template <typename... Cases>
struct OfKind : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
OfKind(Cases...) -> OfKind<Cases...>;

template <auto member, auto... further>
constexpr auto& part_of(auto& whole) {
  if constexpr (sizeof...(further) == 0)
    return whole.*member;
  else
    return part_of<further...>(whole.*member);
}

template <auto... path>
consteval NumberField number(double least, double most) {
  return {[](const CaseSetting& from) { return part_of<path...>(from); },
          [](CaseSetting& to, double value) { part_of<path...>(to) = value; }, least, most};
}
template <auto... path>
consteval MaybeNumberField maybe_number(double least, double most) {
  return {[](const CaseSetting& from) { return part_of<path...>(from); },
          [](CaseSetting& to, std::optional<double> value) { part_of<path...>(to) = value; }, least, most};
}
template <auto... path>
consteval MaybeWholeField maybe_whole(int least, int most) {
  return {[](const CaseSetting& from) { return part_of<path...>(from); },
          [](CaseSetting& to, std::optional<int> value) { part_of<path...>(to) = value; }, least, most};
}
template <auto... path>
consteval TextField one_line() {
  return {[](const CaseSetting& from) -> const std::string& { return part_of<path...>(from); },
          [](CaseSetting& to, std::string value) { part_of<path...>(to) = std::move(value); }};
}
template <const auto& table, auto... path>
consteval ChoiceField choice() {
  return {base::kNamesOf<table>,
          [](const CaseSetting& from) { return base::name_of(table, part_of<path...>(from)); },
          [](CaseSetting& to, std::string_view name) {
            const auto value = base::from_name(table, name);
            if (value) part_of<path...>(to) = *value;
            return value.has_value();
          }};
}
template <auto... path>
consteval SwitchField yes_or_no(std::string_view no, std::string_view yes, bool stored_as_number) {
  return {no, yes, stored_as_number, [](const CaseSetting& from) { return part_of<path...>(from); },
          [](CaseSetting& to, bool value) { part_of<path...>(to) = value; }};
}

}  // namespace seldinger::casedb
