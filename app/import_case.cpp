#include "app/import_case.h"

#include <stdlib.h>
#include <unistd.h>

#include <cstdio>
#include <system_error>

#include "casedb/export/dicom_series.h"
#include "casedb/import/diffusion.h"
#include "casedb/import/import.h"
#include "casedb/import/surface.h"
#include "sim/base/failure.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {
namespace {

void progress(const char* what) {
  if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s …\n", what);
}

// A folder of this process that goes when it does.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "seldinger-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw base::Failure("disk", "no temporary folder can be made");
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

}  // namespace

base::Result<casedb::NewCase> import_case(const std::filesystem::path& source,
                                          const std::optional<std::string>& series, const std::string& title,
                                          const std::string& origin, casedb::FaceChoice face, bool denoise) {
  progress("reading the volume");
  auto read = casedb::read_source(source, series);
  if (!read) return read.error();
  const auto face_state = casedb::settle_face(read->volume, face, read->says_head);
  if (!face_state) return face_state.error();
  if (denoise) {
    progress("taking noise away");
    read->warnings.push_back(casedb::denoise(read->volume));
  }
  progress("making the skin");
  auto skin = casedb::skin_surface(read->volume);
  if (!skin) return skin.error();
  casedb::NewCase made;
  const glm::ivec3 size = read->volume.size_voxels;
  made.title = !title.empty() ? title
                              : "CT, " + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " +
                                    std::to_string(size.z);
  made.origin = origin;
  made.volume = std::move(read->volume);
  made.skin = std::move(*skin);
  made.attributes = std::move(read->attributes);
  made.warnings = std::move(read->warnings);
  made.slices_used = read->slices_used;
  made.face_state = *face_state;
  made.dropped = std::move(read->dropped);
  return made;
}

std::string phantom_origin(volume::Calyces calyces) {
  const char* kind = calyces == volume::Calyces::dilated     ? ":dilated"
                     : calyces == volume::Calyces::opacified ? ":opacified"
                                                             : "";
  return std::string("phantom:") + volume::kPhantomVersion + kind;
}

base::Result<casedb::NewCase> import_phantom(volume::Calyces calyces) {
  progress("making the built-in torso");
  volume::PhantomOptions options;
  options.calyces = calyces;
  volume::Phantom phantom = volume::make_phantom(options);
  const TemporaryFolder folder;
  const auto written =
      casedb::write_dicom_series(phantom.volume, {"Seldinger built-in torso phantom"}, folder.path());
  if (!written) return written.error();
  const std::string title = calyces == volume::Calyces::dilated     ? "Built-in torso, dilated calyces"
                            : calyces == volume::Calyces::opacified ? "Built-in torso, opacified calyces"
                                                                    : "Built-in torso";
  auto imported = import_case(folder.path(), {}, title, phantom_origin(calyces));
  if (imported) imported->labels = std::move(phantom.labels);
  if (imported) imported->no_burned_in_text = true;  // we made every voxel
  return imported;
}

}  // namespace seldinger::app
