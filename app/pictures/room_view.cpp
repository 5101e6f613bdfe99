#include "app/pictures/room_view.h"

#include <glm/geometric.hpp>

#include "app/cli/words.h"
#include "app/pictures/scene.h"
#include "casedb/import/skin/surface.h"
#include "session/case/case_build.h"

namespace seldinger::app {
namespace {

base::Result<cases::Case> case_of(const Scene& scene, const std::string& folder) {
  cases::Case made;
  if (const auto* stored = std::get_if<VolumeOfCase>(&scene.volume)) {
    if (folder.empty()) return base::Error{"no_library", "the scene names a case, but no --library is given", {}};
    auto library = casedb::Library::open(folder);
    if (!library) return error_of("the library", folder, library.error());
    const auto row = casedb::find_case(*library, stored->case_id);
    if (!row) return error_of("the scene's case", stored->case_id, row.error());
    auto built = session::build_case(*library, *row, std::nullopt, {}, session::Needs::metrics);
    if (!built) return built.error();
    made = std::move(*built);
  } else {
    auto volume = volume_of(scene, folder);
    if (!volume) return volume.error();
    made.volume = std::move(*volume);
    auto skin = casedb::skin_surface(made.volume);
    if (skin)
      made.skin = std::move(*skin);
    else if (skin.error().code != "no_body")
      return skin.error();
    made.skin_index = cases::MeshIndex(made.skin);
    const glm::dvec4 middle(glm::dvec3(made.volume.size_voxels - 1) / 2.0, 1.0);
    made.fluoroscope.start.isocentre_lps_mm = glm::dvec3(made.volume.lps_from_voxel * middle);
  }
  const RoomSceneView& view = *scene.room;
  if (view.position) made.position = *view.position;
  if (scene.inserted.needle) made.instrument = scene.instrument;
  for (const cases::Lesion& lesion : scene.inserted.lesions) made.lesions.push_back(lesion);
  for (const cases::Structure& structure : scene.structures) made.structures.push_back(structure);
  if (scene.planned_entry_lps_mm) made.planned_entry_lps_mm = scene.planned_entry_lps_mm;
  made.picture.modality = view.arm ? cases::Modality::xray : cases::Modality::ultrasound;
  if (view.probe) made.picture.probe = view.probe->name;
  made.yields = view.probe && view.probe->press_mm > 0.0;
  return made;
}

cases::State state_of(const Scene& scene, const cases::Case& made) {
  cases::State state;
  if (scene.inserted.needle) {
    cases::NeedleState& needle = state.needle;
    needle.tip_lps_mm = scene.inserted.needle->tip_lps_mm;
    needle.direction = scene.inserted.needle->direction;
    // A needle in the body came in along its own line.
    if (made.skin_index.empty() || made.skin_index.closest(needle.tip_lps_mm).distance_mm >= 0.0) return state;
    const auto entry =
        made.skin_index.first_hit(needle.tip_lps_mm, -needle.direction, scene.inserted.needle->length_mm);
    if (entry) {
      needle.skin.in_body = true;
      needle.skin.entry_lps_mm = needle.tip_lps_mm - needle.direction * entry->distance_mm;
      needle.inserted_mm = entry->distance_mm;
    }
  }
  return state;
}

}  // namespace

base::Result<ColourPicture> paint_room(const Scene& scene, const std::string& library) {
  const auto built = case_of(scene, library);
  if (!built) return built.error();
  const RoomSceneView& view = *scene.room;
  cases::State state = state_of(scene, *built);
  tissue::Displacement displacement{};
  if (view.probe) {
    const HeldProbe& probe = *view.probe;
    state.probe.origin_lps_mm = probe.origin_lps_mm;
    state.probe.axial = probe.axial;
    state.probe.lateral = probe.lateral;
    const tissue::SkinPress press{probe.origin_lps_mm - probe.axial * probe.press_mm, probe.axial, 20.0,
                                  probe.press_mm, 0.0};
    displacement = tissue::displacement_of({{&press, 1}, {}, {}, {}});
  }
  if (view.arm) {
    state.fluoroscopy.in_use = true;
    state.fluoroscopy.arm = *view.arm;
    state.fluoroscopy.arm.isocentre_lps_mm = built->fluoroscope.start.isocentre_lps_mm;
  }
  gpu::Context context;
  const imaging::RoomModel room =
      imaging::make_room_model(*built, {imaging::RoomWish{}.skin_triangles, view.mentor});
  imaging::RoomRenderer renderer(context, room);
  imaging::RoomOptions options;
  options.help = view.help;
  options.mentor = view.mentor;
  options.needle = scene.inserted.needle.has_value();
  options.probe = view.probe.has_value();
  if (view.nick_lps_mm) options.nicks_lps_mm = {&*view.nick_lps_mm, 1};
  imaging::DrawList list;
  imaging::make_draw_list(room, *built, state, options, list);
  imaging::RoomPicture asked;
  asked.width_px = view.width_px;
  asked.height_px = view.height_px;
  asked.views = view.stereo ? 2 : 1;
  if (view.fine)
    asked.quality = *view.fine ? imaging::RoomQuality{} : imaging::kFastRoom;
  else
    asked.quality = imaging::room_quality(context);
  asked.camera = imaging::room_camera(room, *built, state, view.from);
  imaging::zoom(asked.camera, view.zoom);
  if (view.orbit_deg != glm::dvec2(0.0))
    imaging::orbit(asked.camera, room.frame, view.orbit_deg.x, view.orbit_deg.y);
  renderer.draw(list, asked, displacement);

  ColourPicture picture{{}, view.width_px, view.height_px, context.renderer(), 0};
  const std::vector<std::uint8_t> rgba = renderer.read_rgba();
  for (std::size_t i = 0; i < rgba.size(); ++i)
    if (i % 4 != 3) picture.rgb.push_back(rgba[i]);
  for (const imaging::RoomItem& item : list.items) picture.triangles += room.meshes[item.mesh].triangles.size();
  return picture;
}

}  // namespace seldinger::app
