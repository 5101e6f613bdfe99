#include "casedb/import/dicom/allow_list.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "casedb/import/dicom/terms.h"
#include "casedb/import/privacy/basic_profile.h"

namespace seldinger::casedb {
namespace {

// PS3.3 C.7.3.1.1.2.
constexpr const char* kPositions[] = {"HFP", "HFS", "HFDR", "HFDL", "FFDR", "FFDL", "FFP",  "FFS",
                                      "LFP", "LFS", "RFP",  "RFS",  "AFDR", "AFDL", "PFDR", "PFDL"};
// The regions of PS3.16 Annex L a CT puncture case can show.
constexpr const char* kBodyParts[] = {
    "ABDOMEN",   "ABDOMENPELVIS", "BREAST", "CHEST",    "CHESTABDOMEN", "CHESTABDPELVIS", "CSPINE", "HEAD",
    "HEADNECK",  "HEART",         "HIP",    "KIDNEY",   "LIVER",        "LSPINE",         "LUNG",   "NECK",
    "NECKCHEST", "PANCREAS",      "PELVIS", "SHOULDER", "SPINE",        "THORAX",         "TSPINE", "WHOLEBODY"};
constexpr const char* kHeadParts[] = {
    "HEAD", "HEADNECK", "SKULL", "BRAIN", "FACE", "ORBIT",  "SINUS", "JAW",      "MANDIBLE",       "MAXILLA",
    "NOSE", "EAR",      "IAC",   "SELLA", "TMJ",  "ZYGOMA", "EYE",   "PSINUSES", "CIRCLEOFWILLIS", "WHOLEBODY"};
constexpr const char* kManufacturers[] = {"Canon Medical Systems",
                                          "CANON_MEC",
                                          "GE MEDICAL SYSTEMS",
                                          "GE HEALTHCARE",
                                          "Hitachi Medical Corporation",
                                          "HITACHI",
                                          "NeuroLogica",
                                          "Philips",
                                          "Philips Medical Systems",
                                          "PHILIPS",
                                          "PNMS",
                                          "SIEMENS",
                                          "Siemens Healthineers",
                                          "Siemens Healthcare",
                                          "TOSHIBA",
                                          "TOSHIBA_MEC",
                                          "UIH",
                                          "Neusoft",
                                          "NMS",
                                          "Seldinger"};
constexpr const char* kScanOptions[] = {"AXIAL MODE", "HELICAL MODE", "HELIX",     "SCOUT MODE",     "CINE MODE",
                                        "AXIAL",      "HELICAL",      "SPIRAL_CT", "VOLUMETRIC MODE"};
constexpr const char* kFilters[] = {"BODY FILTER", "HEAD FILTER", "BODY",  "HEAD",    "LARGE",   "MEDIUM",
                                    "SMALL",       "FLAT",        "WEDGE", "WEDGE_2", "WEDGE_3", "NONE"};
// Kernels that vendors name in words: GE, and Philips' letters.
constexpr const char* kKernelWords[] = {"STANDARD", "SOFT", "DETAIL", "BONE",   "BONEPLUS", "LUNG", "CHST",
                                        "CHEST",    "EDGE", "ULTRA",  "SMOOTH", "SHARP",    "A",    "B",
                                        "C",        "D",    "E",      "F",      "L",        "UA",   "UB",
                                        "UC",       "YA",   "YB",     "YC",     "EA",       "EB",   "EC"};

std::string plain_number(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

template <const auto& kTerms>
std::string one_of(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  return is_term(value, kTerms) ? value : "";
}

// One number between two limits, written with six digits.
template <int kLeast, int kMost>
std::string number(const DicomFile& file, DicomTag tag) {
  const auto values = file.numbers(tag);
  return values.size() == 1 && values[0] >= kLeast && values[0] <= kMost ? plain_number(values[0]) : "";
}

template <int kMost>
std::string positive(const DicomFile& file, DicomTag tag) {
  const auto values = file.numbers(tag);
  return values.size() == 1 && values[0] > 0.0 && values[0] < kMost ? plain_number(values[0]) : "";
}

std::string modality(const DicomFile& file, DicomTag tag) {
  return file.text(tag) == "CT" ? "CT" : "";
}

std::string sex(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  return value == "M" || value == "F" || value == "O" ? value : "";
}

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

// "045Y" is 45. Under a year 0; from 90 on "90+", as ages above 89 identify (45 CFR 164.514(b)(2)(i)(C)).
std::string age(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  if (value.size() != 4 || !std::all_of(value.begin(), value.begin() + 3, is_digit)) return "";
  const int count = std::stoi(value.substr(0, 3));
  const int days = value[3] == 'Y' ? 365 : value[3] == 'M' ? 30 : value[3] == 'W' ? 7 : value[3] == 'D' ? 1 : 0;
  if (days == 0) return "";
  const int years = value[3] == 'Y' ? count : count * days / 365;
  return years >= 90 ? "90+" : std::to_string(years);
}

// The five years a date lies in: "2010-2014". CT exists since 1971.
std::string year_band(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  if (value.size() < 8 || !std::all_of(value.begin(), value.begin() + 8, is_digit)) return "";
  const int year = std::stoi(value.substr(0, 4)), month = std::stoi(value.substr(4, 2)),
            day = std::stoi(value.substr(6, 2));
  if (year < 1970 || year > 2099 || month < 1 || month > 12 || day < 1 || day > 31) return "";
  const int first = year / 5 * 5;
  return std::to_string(first) + "-" + std::to_string(first + 4);
}

// Siemens' "B31f" and "Br40d\3", Toshiba's "FC08-H": at most two letters, two digits, a letter, a level. Too short
// for a name, and no other text fits.
bool is_kernel_code(std::string_view text) {
  std::size_t at = 0;
  const auto take = [&](std::string_view of, std::size_t most) {
    std::size_t taken = 0;
    for (; taken < most && at < text.size() && of.find(text[at]) != std::string_view::npos; ++taken) ++at;
    return taken;
  };
  constexpr std::string_view kDigits = "0123456789";
  const bool toshiba = text.starts_with("FC");
  if (toshiba)
    at = 2;
  else if (take("BDHIJQSTU", 1) == 0)
    return false;
  if (!toshiba) take("cflprv", 1);
  if (take(kDigits, 2) != 2) return false;
  take("dfhmsu", 1);
  if (toshiba && text.substr(at) == "-H") at += 2;
  if (at < text.size() && text[at] == '\\') {
    ++at;
    if (take("12345", 1) == 0) return false;
  }
  return at == text.size();
}

std::string kernel(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  return is_term(value, kKernelWords) || is_kernel_code(value) ? value : "";
}

// Which agent, how much and how it was given is free text; that there was one is not.
std::string contrast(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  static constexpr const char* kNone[] = {"NONE", "None", "none", "NO", "No", "no", "N"};
  return value.empty() || is_term(value, kNone) ? "" : "given";
}

// Its first three parts, of PS3.3 C.8.2.1.1.1.
std::string image_type(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag) + "\\";
  static constexpr const char* kParts[] = {"ORIGINAL", "DERIVED", "PRIMARY", "SECONDARY", "AXIAL"};
  std::string kept;
  std::size_t at = 0;
  for (int part = 0; part < 3 && at < value.size(); ++part) {
    const std::size_t end = value.find('\\', at);
    const std::string one = value.substr(at, end - at);
    if (!is_term(one, kParts)) break;
    kept += (kept.empty() ? "" : " ") + one;
    at = end + 1;
  }
  return kept;
}

std::string lossy(const DicomFile& file, DicomTag tag) {
  const std::string value = file.text(tag);
  return value == "01" ? "yes" : value == "00" ? "no" : "";
}

constexpr AllowedAttribute kAllowed[] = {
    {0x00080060, "modality", "Modality", "CT", modality},
    {0x00080008, "image_type", "ImageType", "ORIGINAL or DERIVED, PRIMARY or SECONDARY, AXIAL", image_type},
    {0x00080020, "study_years", "StudyDate", "five years, as 2010-2014", year_band},
    {0x00080070, "manufacturer", "Manufacturer", "one of the makers of CT scanners", one_of<kManufacturers>},
    {0x00100040, "patient_sex", "PatientSex", "M, F or O", sex},
    {0x00101010, "patient_age_years", "PatientAge", "whole years; 90 and more is 90+", age},
    {0x00180010, "contrast_agent", "ContrastBolusAgent", "given", contrast},
    {0x00180015, "body_part_examined", "BodyPartExamined", "a term of PS3.16 Annex L", one_of<kBodyParts>},
    {0x00180022, "scan_options", "ScanOptions", "a mode by the vendors' usual terms", one_of<kScanOptions>},
    {0x00180050, "slice_thickness_mm", "SliceThickness", "above 0, below 100", positive<100>},
    {0x00180060, "tube_voltage_kv", "KVP", "10 to 500", number<10, 500>},
    {0x00180088, "slice_distance_mm", "SpacingBetweenSlices", "above 0, below 100", positive<100>},
    {0x00180090, "data_diameter_mm", "DataCollectionDiameter", "above 0, below 2000", positive<2000>},
    {0x00181100, "picture_diameter_mm", "ReconstructionDiameter", "above 0, below 2000", positive<2000>},
    {0x00181120, "gantry_tilt_deg", "GantryDetectorTilt", "-45 to 45", number<-45, 45>},
    {0x00181150, "exposure_time_ms", "ExposureTime", "above 0, below 100000", positive<100000>},
    {0x00181151, "tube_current_ma", "XRayTubeCurrent", "above 0, below 5000", positive<5000>},
    {0x00181152, "exposure_mas", "Exposure", "above 0, below 10000", positive<10000>},
    {0x00181160, "filter", "FilterType", "one of the vendors' usual terms", one_of<kFilters>},
    {0x00181210, "kernel", "ConvolutionKernel", "a vendor's word, or a code as B31f, Br40d\\3, FC08", kernel},
    {0x00185100, "patient_position", "PatientPosition", "a term of PS3.3 C.7.3.1.1.2", one_of<kPositions>},
    {0x00282110, "lossy_compression", "LossyImageCompression", "yes or no", lossy},
};
static_assert(std::size(kAllowed) <= kMostAttributes);

// What the volume is made from: these are used, and enter in no other way.
constexpr DicomTag kUsed[] = {0x00080016, 0x0020000D, 0x0020000E, 0x00200011, 0x00200032, 0x00200037,
                              0x00280002, 0x00280004, 0x00280008, 0x00280010, 0x00280011, 0x00280030,
                              0x00280100, 0x00280101, 0x00280102, 0x00280103, 0x00280120, 0x00280121,
                              0x00280301, 0x00281052, 0x00281053, 0x00281054, 0x00283000};

std::string tag_text(DicomTag tag) {
  std::array<char, 16> text;
  if ((tag >> 16 & 1U) != 0)
    std::snprintf(text.data(), text.size(), "%04X,xxxx", tag >> 16);
  else
    std::snprintf(text.data(), text.size(), "%04X,%04X", tag >> 16, tag & 0xFFFFU);
  return text.data();
}

}  // namespace

std::span<const AllowedAttribute> allow_list() {
  return kAllowed;
}

bool is_on_allow_list(DicomTag tag) noexcept {
  return std::any_of(std::begin(kAllowed), std::end(kAllowed),
                     [&](const AllowedAttribute& allowed) { return allowed.tag == tag; });
}

std::vector<std::pair<std::string, std::string>> allowed_attributes(const DicomFile& file) {
  std::vector<std::pair<std::string, std::string>> kept;
  for (const AllowedAttribute& allowed : kAllowed)
    if (std::string value = allowed.accept(file, allowed.tag); !value.empty())
      kept.emplace_back(allowed.name, std::move(value));
  return kept;
}

bool says_head(const DicomFile& file) {
  return is_term(file.text(0x00180015), kHeadParts);
}

std::vector<DroppedElement> dropped_elements(const DicomFile& file) {
  std::vector<DroppedElement> dropped;
  for (const DicomTag tag : file.tags) {
    if ((tag >> 16 & 1U) != 0) {
      dropped.push_back({tag, DropReason::private_element});
    } else if (is_on_allow_list(tag)) {
      const AllowedAttribute& allowed =
          *std::find_if(std::begin(kAllowed), std::end(kAllowed), [&](const auto& one) { return one.tag == tag; });
      if (!file.text(tag).empty() && allowed.accept(file, tag).empty())
        dropped.push_back({tag, DropReason::value_not_accepted});
    } else if (std::find(std::begin(kUsed), std::end(kUsed), tag) == std::end(kUsed)) {
      dropped.push_back({tag, DropReason::not_on_the_list});
    }
  }
  dropped.shrink_to_fit();
  return dropped;
}

void DroppedCount::add(const std::vector<DroppedElement>& elements) {
  for (const DroppedElement& one : elements) {
    const bool vendors = one.reason == DropReason::private_element;
    ++counts_[{vendors ? one.tag & 0xFFFF0000U : one.tag, one.reason}];
  }
}

std::vector<Dropped> DroppedCount::counts() const {
  static constexpr const char* kReasons[] = {"not_on_the_list", "private", "value_not_accepted"};
  std::vector<Dropped> all;
  for (const auto& [kind, count] : counts_) {
    const ProfileRow* row = profile_row(kind.first);
    const bool named = row != nullptr && row->mask == kWholeTag;
    Dropped one{tag_text(kind.first), named ? row->keyword : std::string(),
                kReasons[static_cast<std::size_t>(kind.second)], count};
    all.push_back(std::move(one));
  }
  return all;
}

std::string allow_list_markdown() {
  std::string text =
      "# What enters a case\n\nMade from the table in `casedb/import/dicom/allow_list.cpp` by `seldinger help "
      "--attributes`; "
      "a test compares.\nBeside voxels and geometry nothing else of a source enters a case. Values are checked and "
      "written anew; one that does not\nfit is dropped and counted. Dates, names, UIDs, private elements, free "
      "text and "
      "file names never enter.\n\n| attribute | element | values |\n|---|---|---|\n";
  for (const AllowedAttribute& allowed : kAllowed)
    text += std::string("| ") + allowed.name + " | (" + tag_text(allowed.tag) + ") " + allowed.keyword + " | " +
            allowed.values + " |\n";
  return text;
}

}  // namespace seldinger::casedb
