#include "app/cases/import_case.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <system_error>
#include <utility>

#include "app/cli/progress.h"
#include "casedb/cases/authoring.h"
#include "casedb/export/dicom_series.h"
#include "casedb/import/ct_rules.h"
#include "casedb/import/import.h"
#include "casedb/import/prepare.h"
#include "sim/base/failure.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {
namespace {

void progress(const char* what) {
  if (is_watched()) std::fprintf(stderr, "%s …\n", what);
}

// A folder of this process that goes when it does.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "seldinger-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw base::Failure("disk", "cannot make a temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

// By way of DICOM, so that what we made goes where a patient's CT goes.
base::Result<casedb::NewCase> import_built_in(volume::Phantom phantom, const std::string& description,
                                              const std::string& title, const std::string& origin) {
  const TemporaryFolder folder;
  const auto written = casedb::write_dicom_series(phantom.volume, {description}, folder.path());
  if (!written) return written.error();
  auto imported = import_case(folder.path(), {}, title, origin);
  if (imported) imported->labels = std::move(phantom.labels);
  if (imported)  // a block of gel ends where it is meant to
    std::erase_if(imported->warnings, [](const base::Problem& warning) { return warning.code == "cut_body"; });
  if (imported) imported->no_burned_in_text = true;  // we made every voxel
  return imported;
}

}  // namespace

std::optional<std::string> series_of(const Arguments& arguments) {
  if (!arguments.has(kSeries.name)) return std::nullopt;
  return arguments.text(kSeries.name);
}

FaceWish face_of(const Arguments& arguments) {
  const std::string text = arguments.text(kFace.name, "refuse"), reason = arguments.text(kReason.name);
  if (text == "overrule") {
    if (reason.find_first_not_of(' ') == std::string::npos) throw UsageError("--face overrule needs a --reason");
    return {casedb::FaceChoice::overrule, reason};
  }
  if (arguments.has(kReason.name)) throw UsageError("--reason goes with --face overrule");
  if (text == "refuse") return {};
  if (text == "crop") return {casedb::FaceChoice::crop, {}};
  if (text == "deface") return {casedb::FaceChoice::deface, {}};
  throw UsageError("--face is refuse, crop or deface");
}

base::Result<casedb::NewCase> import_case(const std::filesystem::path& source,
                                          const std::optional<std::string>& series, const std::string& title,
                                          const std::string& origin, const FaceWish& face, bool large,
                                          const casedb::Preparation& preparation) {
  if (!title.empty())
    if (const auto fit = casedb::check_case_title(title); !fit) return fit.error();
  progress("reading the volume");
  auto read = casedb::read_source(source, series, large ? casedb::kLargeCtFile : casedb::kCtFile);
  if (!read) return read.error();
  if (const auto judged = casedb::judge_ct(*read); !judged) return judged.error();
  const bool overruled =
      face.choice == casedb::FaceChoice::overrule && casedb::find_face(read->volume, read->says_head).found;
  const auto face_state = casedb::settle_face(read->volume, face.choice, read->says_head);
  if (!face_state) return casedb::with_doubted_hu(face_state.error(), *read);
  casedb::NewCase made;
  const bool prepares = preparation != casedb::Preparation{};
  if (prepares) made.prepared = {preparation, read->volume};
  progress(prepares ? "preparing volume and skin" : "making the skin");
  auto prepared = casedb::prepare(std::move(read->volume), preparation);
  if (!prepared) return casedb::with_doubted_hu(prepared.error(), *read);
  std::move(prepared->warnings.begin(), prepared->warnings.end(), std::back_inserter(read->warnings));
  if (prepares) {
    progress("comparing it with the original CT");
    const auto full = casedb::full_surface(made.prepared->original, preparation.skin_hu);
    if (!full) return casedb::with_doubted_hu(full.error(), *read);
    read->warnings.push_back(
        casedb::told_of(preparation, *prepared, casedb::fidelity_of(made.prepared->original, *full, *prepared)));
  }
  const glm::ivec3 size = prepared->volume.size_voxels;
  made.title = !title.empty() ? title
                              : "CT, " + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " +
                                    std::to_string(size.z);
  made.origin = origin;
  made.volume = std::move(prepared->volume);
  made.skin = std::move(prepared->skin);
  made.attributes = std::move(read->attributes);
  made.warnings = std::move(read->warnings);
  made.slices_used = read->slices_used;
  made.face_state = *face_state;
  if (overruled) made.face_overruled = face.overruled_because;
  made.dropped = std::move(read->dropped);
  return made;
}

namespace {

// Of what a built-in patient is other than an adult, supine, with normal calyces.
std::vector<std::string_view> differences(const volume::PhantomOptions& options) {
  std::vector<std::string_view> told;
  if (options.body != volume::Body::adult) told.push_back(base::name_of(volume::kBodyNames, options.body));
  if (options.posture != volume::Posture::supine)
    told.push_back(base::name_of(volume::kPostureNames, options.posture));
  if (options.calyces != volume::Calyces::normal)
    told.push_back(base::name_of(volume::kCalycesNames, options.calyces));
  return told;
}

}  // namespace

std::string phantom_origin(const volume::PhantomOptions& options) {
  std::string origin = std::string("phantom:") + volume::kPhantomVersion;
  if (options.region != volume::Region::torso)
    origin.append(":").append(base::name_of(volume::kRegionNames, options.region));
  for (const std::string_view one : differences(options)) origin.append(":").append(one);
  return origin;
}

base::Result<casedb::NewCase> import_phantom(const volume::PhantomOptions& options, const std::string& own_title) {
  progress("making the built-in patient");
  const std::string region(base::name_of(volume::kRegionNames, options.region));
  std::string title = own_title;
  if (title.empty()) {
    title = "Built-in " + region;
    for (const std::string_view one : differences(options)) title.append(", ").append(one);
    if (options.calyces != volume::Calyces::normal) title += " calyces";
  }
  auto made = import_built_in(volume::make_phantom(options), "Seldinger built-in " + region + " phantom", title,
                              phantom_origin(options));
  if (made && options.posture == volume::Posture::prone) made->position = cases::PatientPosition::prone;
  return made;
}

std::string gel_block_origin(volume::GelBlock block) {
  const char* which = block == volume::GelBlock::find_the_plane ? ":find_the_plane"
                      : block == volume::GelBlock::keep_the_tip ? ":keep_the_tip"
                                                                : ":out_of_plane";
  return std::string("phantom:gel_block:") + volume::kGelBlockVersion + which;
}

base::Result<casedb::NewCase> import_gel_block(volume::GelBlock block) {
  progress("making a block of gel");
  return import_built_in(volume::make_gel_block(block), "Seldinger built-in gel block", "Gel block",
                         gel_block_origin(block));
}

}  // namespace seldinger::app
