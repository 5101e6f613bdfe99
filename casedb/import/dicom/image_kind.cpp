#include "casedb/import/dicom/image_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <vector>

#include "casedb/import/dicom/dicom_file.h"
#include "casedb/import/dicom/terms.h"

namespace seldinger::casedb {
namespace {

bool names_any(const std::vector<std::string>& words, Terms terms) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return is_term(word, terms); });
}

// Projections and maps of another quantity, by the words vendors and PS3.3 §C.8.16.1 (derived pixel contrast) use
// in an image type; reformats and averages (MPR, MEAN, RESAMPLED) stay slices of HU.
constexpr std::array<const char*, 16> kProjections = {
    "MIP",      "MAXIP", "MINIP", "MAXIMUM", "MINIMUM", "VRT",       "SSD",     "SUBTRACTION", "MULTIPLICATION",
    "DIVISION", "CBF",   "CBV",   "MTT",     "TTP",     "PERFUSION", "QUANTITY"};
constexpr std::array<const char*, 5> kProjectionTechniques = {"MAX_IP", "MIN_IP", "VOLUME_RENDER", "SURFACE_RENDER",
                                                              "CURVED_MPR"};  // PS3.3 §C.8.16.2.1.3

// Multi-energy CT, PS3.3 §C.8.15.2.1.1.5: values of an image type. Fractions, atomic numbers and densities are no
// HU; what was modified, or computed for one energy, still is.
constexpr std::array<const char*, 5> kMaterialTypes = {"MAT_SPECIFIC", "MAT_FRACTIONAL", "MAT_VALUE_BASED",
                                                       "EFF_ATOMIC_NUM", "ELECTRON_DENSITY"};
constexpr std::array<const char*, 3> kVirtualTypes = {"VMI", "MAT_REMOVED", "MAT_MODIFIED"};
// And the words of vendors before there were such values, without their numbers (MONOE_70KEV): virtual
// non-contrast, virtual unenhanced.
constexpr std::array<const char*, 3> kMaterialWords = {"IODINE", "ZEFF", "RHO"};
constexpr std::array<const char*, 9> kVirtualWords = {"VMI",   "VNC",           "VUE",           "VIRTUAL", "MONO",
                                                      "MONOE", "MONOENERGETIC", "MONOCHROMATIC", "MONOPLUS"};
// That a material was taken out: the picture is of what is left.
constexpr std::array<const char*, 3> kTakenOut = {"REMOVED", "SUPPRESSED", "SUBTRACTED"};
constexpr std::array<const char*, 3> kWithout = {"NO", "NON", "WITHOUT"};  // before the material's name

bool is_of_a_material(const std::vector<std::string>& words) {
  if (names_any(words, kTakenOut)) return false;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (is_term(words[i], kMaterialWords) && (i == 0 || !is_term(words[i - 1], kWithout))) return true;
  return false;
}

// In capitals, of letters only: "MonoE_70keV" is MONOE and KEV.
std::vector<std::string> words_in(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + " ") {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    } else if (!word.empty()) {
      words.push_back(std::move(word));
      word.clear();
    }
  }
  return words;
}

std::vector<std::string> values_of(const std::string& image_type) {
  std::vector<std::string> values;
  std::size_t begin = 0;
  while (begin <= image_type.size()) {
    const std::size_t end = std::min(image_type.find('\\', begin), image_type.size());
    std::string value = image_type.substr(begin, end - begin);
    while (!value.empty() && value.back() == ' ') value.pop_back();
    values.push_back(std::move(value));
    begin = end + 1;
  }
  return values;
}

}  // namespace

std::string image_type_of(const DicomFile& header) {
  const std::string frame_type = header.text(0x00089007);
  return frame_type.empty() ? header.text(0x00080008) : frame_type;
}

ImageKind image_kind_of(const DicomFile& header) {
  const std::string type = image_type_of(header);
  const std::vector<std::string> words = words_in(type), values = values_of(type);
  if (names_any(words, kProjections) || is_term(header.text(0x00089207), kProjectionTechniques) ||
      header.text(0x00089206) == "DISTORTED")
    return ImageKind::projection;
  if (names_any(values, kMaterialTypes)) return ImageKind::material;
  if (names_any(values, kVirtualTypes) || names_any(words, kVirtualWords)) return ImageKind::virtual_hu;
  if (is_of_a_material(words)) return ImageKind::material;
  if (names_any(words, kMaterialWords)) return ImageKind::virtual_hu;
  const std::vector<std::string> described = words_in(header.text(0x0008103E));
  return names_any(described, kMaterialWords) || names_any(described, kVirtualWords) ? ImageKind::described
                                                                                     : ImageKind::slice;
}

}  // namespace seldinger::casedb
