// Damage to a bundle by a hand that knows its format: numbers, lengths, counts, kinds, keys and lines, one at a
// time.
#pragma once

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/casedb/bundle_samples.h"
#include "tests/fixtures/mutate.h"

namespace seldinger::casedb {

// Where what lies in the rows of a case (casedb/cases/bundle_rows.cpp).
struct RowField {
  enum class Is { count, kind, number, text } is;
  std::size_t at = 0, bytes = 0;  // a text's: its letters, behind four bytes of their count
};

inline std::vector<RowField> fields_of(const std::string& rows) {
  using Is = RowField::Is;
  std::vector<RowField> fields;
  std::size_t at = 0;
  const auto put = [&](Is is, std::size_t bytes) {
    fields.push_back({is, at, bytes});
    at += bytes;
  };
  const auto count = [&] {
    std::uint32_t value = 0;
    std::memcpy(&value, rows.data() + at, sizeof value);
    put(Is::count, sizeof value);
    return value;
  };
  const auto text = [&] { put(Is::text, count()); };
  for (std::uint32_t tables = count(); tables > 0; --tables) {
    text();
    const std::uint32_t columns = count();
    for (std::uint32_t i = 0; i < columns; ++i) text();
    for (std::uint64_t values = std::uint64_t{count()} * columns; values > 0; --values) {
      const auto kind = static_cast<Statement::Kind>(rows[at]);
      put(Is::kind, 1);
      if (kind == Statement::Kind::integer || kind == Statement::Kind::real) put(Is::number, 8);
      if (kind == Statement::Kind::text || kind == Statement::Kind::blob) text();
    }
  }
  return fields;
}

template <typename Number>
void put_number(std::string& bytes, std::size_t at, Number value) {
  std::memcpy(bytes.data() + at, &value, std::min(sizeof value, bytes.size() - at));
}

// Of its value, around it, and the ends of what such a number may be.
inline std::uint32_t odd_count(std::uint32_t now, base::Rng& rng) {
  const std::uint32_t odd[] = {0, 1, now - 1, now + 1, 2 * now, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
  return odd[fixtures::any_below(rng, std::size(odd))];
}

inline void mutate_rows(std::string& rows, base::Rng& rng) {
  const std::vector<RowField> fields = fields_of(rows);
  const RowField& field = fields[fixtures::any_below(rng, fields.size())];
  switch (field.is) {
    case RowField::Is::count: {
      std::uint32_t now = 0;
      std::memcpy(&now, rows.data() + field.at, sizeof now);
      put_number(rows, field.at, odd_count(now, rng));
      break;
    }
    case RowField::Is::kind:
      rows[field.at] = static_cast<char>(fixtures::any_below(rng, 7));
      break;
    case RowField::Is::number: {
      constexpr double kInfinite = std::numeric_limits<double>::infinity();
      const double real[] = {0.0, -1.0, 1e-300, 1e155, -1e308, kInfinite, std::nan("")};
      const std::int64_t whole[] = {0, 1, -1, 1LL << 31, 1LL << 53, INT64_MIN, INT64_MAX};
      const std::size_t which = fixtures::any_below(rng, std::size(real));
      if (rng.uniform() < 0.5)
        put_number(rows, field.at, real[which]);
      else
        put_number(rows, field.at, whole[which]);
      break;
    }
    case RowField::Is::text: {  // another text of the rows, so also another key, or a long one; its length is right
      const RowField& other = fields[fixtures::any_below(rng, fields.size())];
      const bool is_text = other.is == RowField::Is::text;
      const std::string now =
          is_text ? rows.substr(other.at, other.bytes)
                  : std::string(fixtures::any_below(rng, 5000), static_cast<char>(rng.bits() & 0x7F));
      put_number(rows, field.at - sizeof(std::uint32_t), static_cast<std::uint32_t>(now.size()));
      rows.replace(field.at, field.bytes, now);
      break;
    }
  }
}

// A number of a line becomes another, a line is there twice, goes, or changes places.
inline void mutate_list(std::string& list, base::Rng& rng) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = list.find('\n', at) + 1;
    lines.push_back(list.substr(at, end - at));
    at = end;
  }
  const std::size_t line = fixtures::any_below(rng, lines.size());
  switch (fixtures::any_below(rng, 4)) {
    case 0:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(fixtures::any_below(rng, lines.size())),
                   lines[line]);
      break;
    case 1:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
      break;
    case 2:
      std::swap(lines[line], lines[fixtures::any_below(rng, lines.size())]);
      break;
    default: {
      static const char* const kNumbers[] = {"0", "1", "-1", "01", "8388609", "4294967296", "18446744073709551615",
                                             ""};
      std::string& text = lines[line];
      const std::size_t from = text.find(' ', fixtures::any_below(rng, text.size())) + 1;
      if (from == 0) break;
      const std::size_t end = text.find_first_of(" \n", from);
      text.replace(from, end - from, kNumbers[fixtures::any_below(rng, std::size(kNumbers))]);
      break;
    }
  }
  list.clear();
  for (const std::string& one : lines) list += one;
}

// A number of the head of a volume, a mesh, labels or classes.
inline void mutate_head(std::string& asset, base::Rng& rng) {
  constexpr std::size_t kHeadBytes = 200;
  const std::size_t at = fixtures::any_below(rng, std::min(asset.size(), kHeadBytes)) / 4 * 4;
  std::uint32_t now = 0;
  std::memcpy(&now, asset.data() + at, std::min(sizeof now, asset.size() - at));
  put_number(asset, at, odd_count(now, rng));
}

}  // namespace seldinger::casedb
