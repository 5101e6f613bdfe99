#include "casedb/import/dicom/identity.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string>

#include "casedb/import/dicom/dicom_slice.h"
#include "casedb/import/files/number_text.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

enum class Form { plain, name, date };

struct Identifier {
  DicomTag tag;
  const char* words;
  Form form;
};
// PS3.3 §C.7.1.1 (patient) and §C.7.2.1 (general study).
constexpr std::array<Identifier, std::tuple_size_v<decltype(SliceIdentity::marks)>> kIdentifiers = {
    {{0x00100020, "patient ID", Form::plain},
     {0x00100010, "name", Form::name},
     {0x00100030, "birth date", Form::date},
     {0x00100040, "sex", Form::plain},
     {0x0020000D, "study", Form::plain}}};
constexpr std::size_t kOfThePatient = 4;  // the first ones
constexpr std::size_t kMostGroups = 4, kMostRuns = 6;

std::string comparable(std::string text, Form form) {
  if (form == Form::date) std::erase(text, '.');  // 1950.01.02, as ACR-NEMA wrote it
  if (form != Form::name) return text;
  std::string name;
  for (const char c : text) {
    if (c == ' ' && (name.empty() || name.back() == ' ')) continue;
    name.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
  }
  while (!name.empty() && (name.back() == '^' || name.back() == '=' || name.back() == ' ')) name.pop_back();
  return name;
}

std::uint64_t mark_of(const std::string& text) {
  if (text.empty()) return 0;
  return std::max<std::uint64_t>(base::hash_bytes(std::as_bytes(std::span(text))), 1);
}

using Marks = std::vector<std::uint64_t>;

// The slices that say one thing, by their rank along the stack.
struct AlikeSlices {
  Marks marks;
  std::vector<std::size_t> ranks;
};

// Places along the stack, from the frame's origin; nothing for a slice without a sound place, which stands last.
struct PlaceAlong {
  std::size_t slice;
  std::optional<double> at_mm;
};

std::vector<PlaceAlong> places_along(const std::vector<DicomSlice>& slices) {
  glm::dvec3 normal(0.0);
  for (const DicomSlice& slice : slices)
    if (normal == glm::dvec3(0.0)) normal = glm::cross(slice.row, slice.column);
  std::vector<PlaceAlong> places;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const bool placed = slices[i].row != glm::dvec3(0.0);
    places.push_back({i, placed ? std::optional(glm::dot(slices[i].position_lps_mm, normal)) : std::nullopt});
  }
  std::stable_sort(places.begin(), places.end(), [](const PlaceAlong& a, const PlaceAlong& b) {
    if (a.at_mm.has_value() != b.at_mm.has_value()) return a.at_mm.has_value();
    return a.at_mm && *a.at_mm < *b.at_mm;
  });
  return places;
}

// "12 at -10 to 12, 20 mm": runs of neighbours along the stack.
std::string group_text(const AlikeSlices& group, const std::vector<PlaceAlong>& places) {
  std::string text;
  std::size_t runs = 0, nowhere = 0;
  for (std::size_t first = 0; first < group.ranks.size();) {
    std::size_t last = first;
    while (last + 1 < group.ranks.size() && group.ranks[last + 1] == group.ranks[last] + 1) ++last;
    const auto &from = places[group.ranks[first]].at_mm, &to = places[group.ranks[last]].at_mm;
    if (!from || !to)
      nowhere += last - first + 1;
    else if (++runs <= kMostRuns)
      text += (text.empty() ? "" : ", ") + number_text(*from) + (last > first ? " to " + number_text(*to) : "");
    first = last + 1;
  }
  if (runs > kMostRuns) text += " and " + std::to_string(runs - kMostRuns) + " more places";
  std::string all = std::to_string(group.ranks.size());
  if (!text.empty()) all += " at " + text + " mm";
  if (nowhere > 0)
    all +=
        (text.empty() ? "" : ", " + std::to_string(nowhere) + " of them") + std::string(" without a sound place");
  return all;
}

// What speaks against the slices by the identifiers `from` up to `to`; empty: nothing.
std::string difference(const std::vector<DicomSlice>& slices, std::size_t from, std::size_t to) {
  std::string differing;
  bool some_say_nothing = false;
  for (std::size_t i = from; i < to; ++i) {
    const std::uint64_t first = slices.front().identity.marks[i];
    const auto says_other = [&](const DicomSlice& slice) { return slice.identity.marks[i] != first; };
    if (std::none_of(slices.begin(), slices.end(), says_other)) continue;
    differing += (differing.empty() ? "" : ", ") + std::string(kIdentifiers[i].words);
    some_say_nothing = some_say_nothing || std::any_of(slices.begin(), slices.end(), [&](const DicomSlice& slice) {
                         return slice.identity.marks[i] == 0;
                       });
  }
  if (differing.empty()) return {};
  const std::vector<PlaceAlong> places = places_along(slices);
  std::vector<AlikeSlices> groups;
  for (std::size_t rank = 0; rank < places.size(); ++rank) {
    const auto& all = slices[places[rank].slice].identity.marks;
    Marks marks(all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(to));
    auto known =
        std::find_if(groups.begin(), groups.end(), [&](const AlikeSlices& one) { return one.marks == marks; });
    if (known == groups.end()) known = groups.insert(known, {std::move(marks), {}});
    known->ranks.push_back(rank);
  }
  std::string text = " (" + differing + (some_say_nothing ? "; some say none): " : "): ");
  for (std::size_t i = 0; i < std::min(groups.size(), kMostGroups); ++i)
    text += (i == 0 ? "" : "; ") + group_text(groups[i], places);
  if (groups.size() > kMostGroups) text += "; " + std::to_string(groups.size() - kMostGroups) + " groups more";
  return text + ", along the stack";
}

}  // namespace

SliceIdentity identity_of(const DicomFile& header) {
  SliceIdentity identity;
  for (std::size_t i = 0; i < kIdentifiers.size(); ++i)
    identity.marks[i] = mark_of(comparable(header.text(kIdentifiers[i].tag), kIdentifiers[i].form));
  return identity;
}

void judge_identity(const std::vector<DicomSlice>& slices, Problems& problems) {
  if (slices.empty()) return;
  if (const std::string text = difference(slices, 0, kOfThePatient); !text.empty())
    problems.add("mixed_patients", "the slices of the series are not all of one patient" + text);
  if (const std::string text = difference(slices, kOfThePatient, kIdentifiers.size()); !text.empty())
    problems.add("mixed_studies", "the slices of the series are not all of one study" + text);
}

}  // namespace seldinger::casedb
