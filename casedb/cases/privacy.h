// What a case tells of its source's privacy: whether a face is in it, whether a person looked for burned-in text,
// and what of the source did not enter. Counts only: none of it holds a value of the source.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace seldinger::casedb {

// `unchecked`: stored before schema 7.
enum class FaceState { unchecked, none, cropped, defaced };

inline const char* name_of(FaceState state) noexcept {
  switch (state) {
    case FaceState::none:
      return "none";
    case FaceState::cropped:
      return "cropped";
    case FaceState::defaced:
      return "defaced";
    case FaceState::unchecked:
      break;
  }
  return "unchecked";
}

inline std::optional<FaceState> face_state_from(const std::string& name) {
  for (const FaceState state : {FaceState::unchecked, FaceState::none, FaceState::cropped, FaceState::defaced})
    if (name == name_of(state)) return state;
  return std::nullopt;
}

// A person scrolled through the slices and saw no text burned into them.
struct BurnedInCheck {
  std::int64_t checked_us = 0;           // since 1970 UTC
  std::optional<std::string> person_id;  // none: at the command line, without an account
  bool by_operator = false;              // who entered it in that person's name
};

// How many elements of one kind of a source did not enter the case. A private element's kind is its group, as in
// "0009,xxxx": its number is a vendor's own.
struct Dropped {
  std::string tag;      // "0010,0010"; "nifti", "nrrd", "metaimage" for fields of those headers
  std::string keyword;  // "PatientName"; empty where the de-identification table does not name it
  std::string reason;   // "not_on_the_list", "private", "value_not_accepted"
  std::int64_t count = 0;
};

}  // namespace seldinger::casedb
