#include "casedb/import/ct_rules.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "casedb/import/files/number_text.h"
#include "casedb/import/files/problems.h"

namespace seldinger::casedb {
namespace {

// Air is −1000 HU and fat −50 to −150: what has nothing below −200 HU shows no air.
constexpr int kAirBelowHu = -200;
// Targets trained on are 5 to 20 mm: one could lie between two slices of 30 mm, and the skin between them is a
// guess.
constexpr double kTooThickMm = 30.0;

bool has_warning(const Source& source, const char* code) {
  return std::any_of(source.warnings.begin(), source.warnings.end(),
                     [&](const base::Problem& warning) { return warning.code == code; });
}

std::pair<int, int> hu_range(const Source& source) {
  const auto [least, most] = std::minmax_element(source.volume.hu.begin(), source.volume.hu.end());
  return {*least, *most};
}

std::string one_value(const Source& source) {
  const auto [least, most] = hu_range(source);
  return least == most ? "every voxel is " + std::to_string(least) + " HU: no picture of anything" : "";
}

std::string normalised(const Source& source) {
  const auto [least, most] = hu_range(source);
  if (least == most || least < -1 || most > 1) return {};
  return "all values lie from " + std::to_string(least) + " to " + std::to_string(most) +
         ": a mask, or a picture scaled for display or learning, and no HU";
}

// What lies outside the field of view was padded, whatever the values mean.
bool shows_air(const Source& source) {
  const std::vector<std::int16_t>& hu = source.volume.hu;
  return std::any_of(hu.begin(), hu.end(),
                     [](std::int16_t one) { return one > volume::kAirHu && one <= kAirBelowHu; });
}

std::string no_rescale(const Source& source) {
  if (!has_warning(source, "no_rescale") || shows_air(source)) return {};
  return "rescale slope or intercept is missing, and nothing but padding is at " + std::to_string(kAirBelowHu) +
         " HU or below: the values are not HU";
}

// Of a voxel, or of a slice by what it says of itself.
double longest_mm(const Source& source) {
  double mm = std::max({source.volume.spacing_mm.x, source.volume.spacing_mm.y, source.volume.spacing_mm.z});
  for (const auto& [name, value] : source.attributes) {
    double thick_mm = 0.0;
    if (name == "slice_thickness_mm") std::from_chars(value.data(), value.data() + value.size(), thick_mm);
    mm = std::max(mm, thick_mm);
  }
  return mm;
}

std::string too_thick(const Source& source) {
  const double mm = longest_mm(source);
  if (mm < kTooThickMm) return {};
  return "the slices are " + number_text(mm) + " mm thick or apart; " + number_text(kTooThickMm) +
         " mm and more are no CT to practise on: a target of 20 mm fits between two";
}

std::string thick(const Source& source) {
  const double mm = longest_mm(source);
  if (mm <= kThickMm) return {};
  return "the slices are " + number_text(mm) + " mm thick or apart: targets below that size are not told";
}

std::string few_slices(const Source& source) {
  const glm::ivec3& size = source.volume.size_voxels;
  for (int axis = 0; axis < 3; ++axis)
    if (size[axis] == 2)
      return "the case is two slices, " + number_text(2.0 * source.volume.spacing_mm[axis]) +
             " mm in all: a section, no body";
  return {};
}

double smallest_field_mm(const cases::Fluoroscope& machine) {
  const double side_mm = *std::min_element(machine.field_side_mm.begin(), machine.field_side_mm.end());
  return side_mm * machine.source_isocentre_mm / machine.sid_max_mm;
}

const std::vector<CtRule>& all_rules() {
  static const std::string air = "−" + std::to_string(-kAirBelowHu) + " HU";
  static const std::vector<CtRule> rules = {
      {CtVerdict::refuses, "one_value", "every voxel has one value", one_value},
      {CtVerdict::refuses, "normalised", "all values lie from −1 to 1, as in a mask or a scaled picture",
       normalised},
      {CtVerdict::refuses, "no_rescale",
       "DICOM without rescale slope or intercept that has nothing but padding at " + air +
           " or below, or in which a face or no body is found",
       no_rescale},
      {CtVerdict::warns, "no_rescale", "DICOM without rescale slope or intercept: 1 and 0 are taken", nullptr},
      {CtVerdict::warns, "no_air", "nothing is at " + air + " or below", nullptr},
      {CtVerdict::refuses, "thick_slices",
       "a voxel or slice of " + number_text(kTooThickMm) + " mm and more along any axis", too_thick},
      {CtVerdict::warns, "thick_slices", "one of more than " + number_text(kThickMm) + " mm", thick},
      {CtVerdict::warns, "single_slice", "one slice", nullptr},
      {CtVerdict::warns, "few_slices", "two slices", few_slices},
      {CtVerdict::warns, "thin_slab",
       "for fluoroscopy: the volume measures less than " +
           number_text(std::round(smallest_field_mm(cases::Fluoroscope{}))) +
           " mm along an axis, the machine's smallest field at the isocentre",
       nullptr},
      {CtVerdict::refuses, "derived",
       "DICOM that says by its image type or rescale type that it is a projection, or a map of a material "
       "(iodine), "
       "of atomic number or electron density",
       nullptr},
      {CtVerdict::warns, "virtual_image",
       "DICOM whose image type says that it is virtual (monoenergetic, unenhanced), or whose description names "
       "this "
       "or iodine",
       nullptr},
      {CtVerdict::refuses, "mirrored_geometry",
       "NIfTI whose sform mirrors its qform, both said to be the scanner's", nullptr},
      {CtVerdict::warns, "mirrored_geometry", "NIfTI whose sform mirrors its qform, in another frame", nullptr}};
  return rules;
}

}  // namespace

std::span<const CtRule> ct_rules() {
  return all_rules();
}

base::Result<void> judge_ct(Source& source) {
  Problems problems;
  std::vector<base::Problem> warnings;
  std::vector<std::string> refused;
  for (const CtRule& rule : all_rules()) {
    const std::string found = rule.finding == nullptr ? std::string() : rule.finding(source);
    if (found.empty() || std::find(refused.begin(), refused.end(), rule.code) != refused.end()) continue;
    if (rule.verdict == CtVerdict::refuses) {
      problems.add(rule.code, found);
      refused.emplace_back(rule.code);
    } else {
      warnings.push_back({rule.code, found});
    }
  }
  if (!problems.empty()) return problems.error();
  source.warnings.insert(source.warnings.end(), warnings.begin(), warnings.end());
  return {};
}

base::Error with_doubted_hu(base::Error refused, const Source& source) {
  if (!has_warning(source, "no_rescale")) return refused;
  base::Error doubted{"no_rescale",
                      "rescale slope or intercept is missing, so the values may not be HU: what is found in them "
                      "may not be there",
                      {{refused.code, refused.text}}};
  doubted.findings.insert(doubted.findings.end(), refused.findings.begin(), refused.findings.end());
  return doubted;
}

std::optional<base::Problem> thin_slab(const volume::Volume& volume, const cases::Fluoroscope& machine) {
  double thinnest_mm = volume.spacing_mm.x * volume.size_voxels.x;
  for (int axis = 1; axis < 3; ++axis)
    thinnest_mm = std::min(thinnest_mm, volume.spacing_mm[axis] * volume.size_voxels[axis]);
  const double field_mm = smallest_field_mm(machine);
  if (thinnest_mm >= field_mm) return std::nullopt;
  return base::Problem{
      "thin_slab", "the CT is a slab of " + number_text(thinnest_mm) + " mm; the fluoroscope's smallest field is " +
                       number_text(std::round(field_mm)) + " mm: where the CT ends, pictures show no patient"};
}

std::string ct_rules_markdown() {
  std::string text = "| code | then | when |\n|---|---|---|\n";
  for (const CtRule& rule : all_rules())
    text += "| `" + std::string(rule.code) + "` | " + (rule.verdict == CtVerdict::refuses ? "refused" : "warning") +
            " | " + rule.when + " |\n";
  return text;
}

}  // namespace seldinger::casedb
