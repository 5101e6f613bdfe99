// A scene file (docs/scenes/README.md): a volume, what is inserted, and a view.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/pictures/room_view.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/console.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"
#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/projection/projection.h"
#include "sim/volume/analytic.h"
#include "sim/volume/classes.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {

struct VolumeFile {
  std::filesystem::path path;  // absolute, or relative to the working folder
};
struct VolumeOfCase {
  std::string case_id;
};

enum class XrayOutput { line_integral, intensity, display };
// What is scattered onto the panel, with or without a grid before it; none: the picture is primary only.
enum class SceneScatter { none, open, grid };
struct XrayView {
  imaging::XrayGeometry geometry;
  double energy_kev = imaging::kHuEnergyKev;
  imaging::ProjectionMethod method = imaging::ProjectionMethod::exact;
  XrayOutput output = XrayOutput::line_integral;
  int supersampling = 1;  // rays a pixel in each direction
  SceneScatter scatter = SceneScatter::none;
  double glare_share = 0.0;  // of the signal, spread over the picture
};
enum class UltrasoundOutput { display, envelope_db, polar_db };
struct UltrasoundSceneView {
  imaging::UltrasoundView view;
  imaging::UltrasoundKnobs knobs;
  imaging::DisplaySize size;
  UltrasoundOutput output = UltrasoundOutput::display;
  cases::ConsoleSetting console{};  // its colour Doppler alone
};
using View = std::variant<imaging::MprView, XrayView, UltrasoundSceneView>;

// What moves the patient of a scene, now.
struct SceneMotion {
  double breath_level = 0.0;  // 0 breathed out, 1 breathed in
  std::optional<glm::dvec3>
      breath_mm{};             // at 1, where it is most: to the right, to the front, downwards; as cases have it
  bool breath_slides = false;  // organs, along the wall (docs/decisions/0095)
  double press_mm = 0.0;  // how deep the probe's head stands in the skin at rest, along its axis; ultrasound only
  double beat_s = 0.0;  // since a heart beat began: so blood flows, and so wide are drawn arteries; ultrasound only
  double drag_mm = 0.0;  // how far the needle's shaft takes tissue along; < 0 on the way out
};

// A structure of the scene that is drawn into its volume, as a case's may be: every picture shows it.
struct DrawnStructure {
  std::size_t at;  // in `structures`
  double hu;
};

struct Scene {
  std::variant<VolumeFile, VolumeOfCase, volume::AnalyticVolume, volume::PhantomOptions> volume;
  imaging::Inserted inserted;
  cases::Instrument instrument;  // size and HU from the needle; kind from needle.instrument
  cases::Approach approach = cases::Approach::in_plane;
  // What a score holds the needle's way against; pictures do not draw them.
  std::optional<glm::dvec3> planned_entry_lps_mm;
  std::vector<cases::Structure> structures;
  std::vector<DrawnStructure> drawn;  // those of them that have a tissue, later ones over earlier ones
  std::optional<SceneMotion> motion;  // nothing: the patient lies still
  std::optional<View> view;
  std::optional<RoomSceneView> room;  // in its place: no picture of the volume, but of what stands around
};

// All problems at once (`bad_scene`). Relative
// paths are those of `folder`. Fields that are not used are named in `unused`.
base::Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& folder,
                                    std::vector<std::string>& unused);

// Reads the file; `notes` gets a line for each field that is not used, to be shown when all went
// well. Refused as scene_from_json, `not_found`, `too_large`.
base::Result<Scene> read_scene(const std::filesystem::path& path, std::vector<std::string>& notes);

// What each voxel of the scene's volume is: as what is drawn there says, by the labels of a case or of analytic
// shapes, elsewhere by HU. And how bright by ultrasound: as an attempt of its law would show it.
struct SceneTissue {
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> echogenicity;
};
// Its view's, by which organs and walls of veins are shown.
cases::SightLaw law_of_tissue(const Scene& scene) noexcept;
base::Result<SceneTissue> tissue_of(const Scene& scene, const volume::Volume& volume, const std::string& library);

// The scene's volume, with what is drawn into it. A case needs `library`. Refused as import refuses; `no_library`.
base::Result<volume::Volume> volume_of(const Scene& scene, const std::string& library);

}  // namespace seldinger::app
