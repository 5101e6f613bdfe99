// DICOM to DICOM without identity: the Basic Profile of PS3.15 Annex E, edition 2024b, on files of images and
// plans.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/credentials.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

constexpr const char* kDeidentificationMethod = "Seldinger: DICOM PS3.15 Basic Profile 2024b";

struct CleanFile {
  std::string bytes;             // a whole file of PS3.10
  std::string sop_instance_uid;  // the new one
  std::map<std::string, std::int64_t> counts;
};

// One file. The transfer syntax stays (deflated becomes explicit little endian, its data set unpacked), and with it
// every pixel; bits of their cells that are not the pixels' are cleared (casedb/export/hidden_bits.h). The same key
// gives the same UIDs; who does not have it cannot tell which belonged to which. Refused, with texts that name no
// file and no value: `not_dicom`, `not_readable`, `truncated`, `damaged`, `too_deep`, `too_large`,
// `unknown_syntax`, `no_instance`; and what the profile cannot make safe, since it does not read pixels, reports or
// documents: `burned_in` (said so, or a screen picture), `secondary_capture`, `may_have_text` (ultrasound,
// photographs, video, which usually carry text, unless BurnedInAnnotation is NO), `report` (SR, encapsulated
// documents, presentation states), `dicomdir`, `unknown_object` (no SOP class of the standard, or raw data),
// `hidden_bits`.
base::Result<CleanFile> deidentify_file(const std::filesystem::path& file, const HashKey& key);

struct Deidentified {
  int files = 0;
  std::map<std::string, std::int64_t> counts;  // what was done, see DataSetCleaner; "kept" is not counted
  std::map<std::string, int> left_out;         // codes of deidentify_file → files of a folder
};

// A file or a folder with all below it into the new or empty folder `out` (into one file when `in` is a file and
// `out` ends in .dcm). New names, image_000001.dcm …, in an order that says nothing of the old ones. Of a folder,
// what cannot be made safe and what is no DICOM is left out and counted; a file that is not whole refuses all.
// `out` appears complete or not at all. Refused besides: `not_found`, `exists`, `nothing_left`,
// `too_many_files`. Throws base::Failure("disk").
base::Result<Deidentified> deidentify(const std::filesystem::path& in, const std::filesystem::path& out,
                                      const HashKey& key);

}  // namespace seldinger::casedb
