// From a source to a case ready for the library: read, skin made, nothing stored yet.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/command.h"
#include "casedb/cases/cases.h"
#include "casedb/import/privacy/face.h"
#include "sim/base/result.h"
#include "sim/volume/gel_block.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {

inline constexpr Option kSeries{"--series", "UID|N", "which series, when the folder holds several"};
std::optional<std::string> series_of(const Arguments& arguments);  // nothing where it was not given

inline constexpr Option kFace{"--face", "refuse|crop|deface",
                              "a volume with a face: default refuse; crop keeps what is below the chin; deface "
                              "removes the front of the face"};
// The same, where somebody may be behind the command who overrules the detector.
inline constexpr Option kFaceOrOverrule{
    "--face", "refuse|crop|deface|overrule",
    "a volume with a face: default refuse; crop keeps what is below the chin; deface removes the front of the "
    "face; overrule: an admin (--by) says that it is not a face, with --reason"};
inline constexpr Option kReason{"--reason", "TEXT", "why what looks like a face is not one; kept with the case"};

// What becomes of what looks like a face, and why it is taken for none (where it is overruled).
struct FaceWish {
  casedb::FaceChoice choice = casedb::FaceChoice::refuse;
  std::string overruled_because;
};
// Throws UsageError, also where there is no reason to overrule, or one to do something else.
FaceWish face_of(const Arguments& arguments);

// `large`: up to kLargeCtFile. An empty title becomes "CT, <nx> x <ny> x <nz>". Progress goes to standard error
// when it is a terminal.
base::Result<casedb::NewCase> import_case(const std::filesystem::path& source,
                                          const std::optional<std::string>& series, const std::string& title,
                                          const std::string& origin, const FaceWish& face = {}, bool large = false,
                                          const casedb::Preparation& preparation = {});

// A built-in patient: the phantom written as a DICOM series to a temporary folder and imported like any patient;
// prone where it lies prone. Without a title it is named after what it is.
base::Result<casedb::NewCase> import_phantom(const volume::PhantomOptions& options, const std::string& title = {});
// What a case of it has as its origin: one for each version of the phantom and each of its kinds.
std::string phantom_origin(const volume::PhantomOptions& options);

// A block of gel, likewise.
base::Result<casedb::NewCase> import_gel_block(volume::GelBlock block);
std::string gel_block_origin(volume::GelBlock block);

}  // namespace seldinger::app
