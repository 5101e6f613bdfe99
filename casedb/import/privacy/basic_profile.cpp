#include "casedb/import/privacy/basic_profile.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> basic_profile();
}

namespace seldinger::casedb {
namespace {

ProfileAction action_of(const std::string& code) {
  static constexpr std::array<std::pair<const char*, ProfileAction>, 9> kActions = {
      {{"X", ProfileAction::remove},
       {"Z", ProfileAction::empty},
       {"D", ProfileAction::dummy},
       {"U", ProfileAction::new_uids},
       {"X/Z", ProfileAction::empty},
       {"X/D", ProfileAction::dummy},
       {"Z/D", ProfileAction::dummy},
       {"X/Z/D", ProfileAction::dummy},
       {"X/Z/U*", ProfileAction::new_uids}}};
  const auto found =
      std::find_if(kActions.begin(), kActions.end(), [&](const auto& one) { return code == one.first; });
  CHECK(found != kActions.end());
  return found->second;
}

ProfileRow row_from(const std::string& line) {
  std::istringstream words(line);
  ProfileRow row{0, 0, {}, {}, {}, ProfileAction::remove};
  std::string tag;
  CHECK(words >> row.code >> tag >> row.vr >> row.keyword && tag.size() == 9);
  row.action = action_of(row.code);
  if (row.vr == "-") row.vr.clear();
  if (row.keyword == "-") row.keyword.clear();
  for (const char c : tag) {
    if (c == ',') continue;
    const std::size_t digit = std::string_view("0123456789ABCDEF").find(c);
    row.tag = row.tag << 4 | (digit == std::string_view::npos ? 0U : static_cast<std::uint32_t>(digit));
    row.mask = row.mask << 4 | (digit == std::string_view::npos ? 0U : 15U);
  }
  return row;
}

std::vector<ProfileRow> read_table() {
  CHECK(embedded::basic_profile().size() == 1);
  std::istringstream lines{std::string(embedded::basic_profile().front().content)};
  std::vector<ProfileRow> rows;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) rows.push_back(row_from(line));
  std::sort(rows.begin(), rows.end(), [](const ProfileRow& a, const ProfileRow& b) { return a.tag < b.tag; });
  return rows;
}

}  // namespace

std::span<const ProfileRow> basic_profile() {
  static const std::vector<ProfileRow> rows = read_table();
  return rows;
}

const ProfileRow* profile_row(std::uint32_t tag) noexcept {
  const auto rows = basic_profile();
  const auto exact = std::lower_bound(rows.begin(), rows.end(), tag,
                                      [](const ProfileRow& row, std::uint32_t t) { return row.tag < t; });
  if (exact != rows.end() && exact->tag == tag && exact->mask == kWholeTag) return &*exact;
  // Repeating groups: even ones only; odd ones are private.
  if ((tag >> 16 & 1U) != 0) return nullptr;
  const auto range = std::find_if(rows.begin(), rows.end(), [&](const ProfileRow& row) {
    return row.mask != kWholeTag && (tag & row.mask) == (row.tag & row.mask);
  });
  return range == rows.end() ? nullptr : &*range;
}

}  // namespace seldinger::casedb
