// What the values of an enum are called in files, the database, JSON and on the command line: one table beside each
// enum, asked in both directions.
//   enum class Subject { patient, phantom };
//   inline constexpr auto kSubjectNames = base::names<Subject>({{Subject::patient, "patient"}, …});
//   base::name_of(kSubjectNames, Subject::phantom); base::from_name(kSubjectNames, "phantom");
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "sim/base/check.h"

namespace seldinger::base {

template <typename Value>
struct Named {
  Value value;
  std::string_view name;
};

template <typename Value, std::size_t n>
using Names = std::array<Named<Value>, n>;

// Does not compile where a value or a name occurs twice.
template <typename Value, std::size_t n>
consteval Names<Value, n> names(const Named<Value> (&rows)[n]) {
  Names<Value, n> table = std::to_array(rows);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(table[i].value != table[j].value && table[i].name != table[j].name);
  return table;
}

// CHECKs that the value is in the table.
template <typename Value, std::size_t n>
constexpr std::string_view name_of(const Names<Value, n>& table, std::type_identity_t<Value> value) {
  for (const Named<Value>& one : table)
    if (one.value == value) return one.name;
  CHECK(false);
}

template <typename Value, std::size_t n>
constexpr std::optional<Value> from_name(const Names<Value, n>& table, std::string_view name) {
  for (const Named<Value>& one : table)
    if (one.name == name) return one.value;
  return std::nullopt;
}

// The names alone, in the table's order.
template <const auto& table>
inline constexpr auto kNamesOf = [] {
  std::array<std::string_view, table.size()> alone;
  for (std::size_t i = 0; i < table.size(); ++i) alone[i] = table[i].name;
  return alone;
}();

namespace internal {
template <const auto& table>
constexpr auto alternatives() {
  constexpr std::size_t size = [] {
    std::size_t sum = table.size();  // '|' between them and a 0 at the end
    for (const auto& one : table) sum += one.name.size();
    return sum;
  }();
  std::array<char, size> text{};
  std::size_t at = 0;
  for (const auto& one : table) {
    if (at > 0) text[at++] = '|';
    for (const char c : one.name) text[at++] = c;
  }
  return text;
}
template <const auto& table>
inline constexpr auto kAlternativesText = alternatives<table>();
}  // namespace internal

// "patient|phantom", as a command's help shows the values of an option; ends with a 0.
template <const auto& table>
inline constexpr const char* kAlternatives = internal::kAlternativesText<table>.data();

// "mpr, xray or ultrasound".
inline std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace seldinger::base
