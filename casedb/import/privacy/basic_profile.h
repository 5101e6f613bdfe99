// The standard's table of what identifies: DICOM PS3.15 Table E.1-1, Basic Profile, edition 2024b, 617 tags and
// three ranges of repeating groups (basic_profile_2024b.txt, built in).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace seldinger::casedb {

constexpr std::uint32_t kWholeTag = 0xFFFFFFFFU;

// What happens to an element that is there; none is added. The table's compound codes leave the choice to whoever
// knows which type (1: a value, 2: may be empty, 3: may be absent) the element has in its object. An action that is
// valid for type 1 is valid for 2 and 3 as well, so of the alternatives the one that leaves most of the form is
// taken: D of X/D, Z/D and X/Z/D, Z of X/Z, U of X/Z/U*.
enum class ProfileAction {
  remove,   // X
  empty,    // Z: value of no length; a sequence of no items
  dummy,    // D: a value that says nothing; the items of a sequence with all that is in them
  new_uids  // U: UIDs replaced by others, the same one always by the same; in a sequence all below
};

struct ProfileRow {
  std::uint32_t tag;   // group · 65536 + element
  std::uint32_t mask;  // bits that must agree
  std::string vr;      // empty: unknown
  std::string keyword;
  std::string code;  // of the standard: "X/Z/D"
  ProfileAction action;
};

std::span<const ProfileRow> basic_profile();
const ProfileRow* profile_row(std::uint32_t tag) noexcept;  // nullptr: the table does not name it

}  // namespace seldinger::casedb
