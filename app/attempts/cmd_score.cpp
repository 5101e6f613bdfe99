// score.
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/attempts/grade_text.h"
#include "app/attempts/metrics_text.h"
#include "app/attempts/poses_csv.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "app/pictures/scene.h"
#include "app/pictures/xray_sight.h"
#include "assessment/score.h"
#include "casedb/import/skin/surface.h"
#include "session/case/case_build.h"
#include "session/guidance/frame_truth.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/base/vectors.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"

namespace seldinger::app {
namespace {

// What the picture at each row's probe pose shows: the view's kind, depth and size (app/attempts/poses_csv.h).
void add_frames(const Scene& scene, const imaging::MprView& size, cases::Recording& recording) {
  for (const cases::PoseSample& pose : recording.poses) {
    const imaging::MprView view = imaging::view_under_probe(
        pose.probe_origin_lps_mm, glm::normalize(pose.probe_axial), glm::normalize(pose.probe_lateral),
        size.pixel_mm * size.width_px, size.pixel_mm * size.height_px, size.pixel_mm);
    imaging::NeedlePose needle;
    needle.tip_lps_mm = pose.tip_lps_mm;
    needle.direction = glm::normalize(pose.needle_direction);
    needle.length_mm = scene.instrument.length_mm;
    recording.frames.push_back(session::frame_truth(pose.t_s, view, needle, scene.inserted.lesions));
  }
}

// As a fixed X-ray view shows it at each row: seen, but with no beam to account for.
void add_frames(const Scene& scene, const XrayView& view, const volume::Volume& volume,
                cases::Recording& recording) {
  XraySight sight(volume, view);
  imaging::Inserted inserted = scene.inserted;
  if (!inserted.needle) inserted.needle = imaging::needle_pose(scene.instrument, {}, {0.0, 0.0, 1.0});
  for (const cases::PoseSample& pose : recording.poses) {
    inserted.needle->tip_lps_mm = pose.tip_lps_mm;
    inserted.needle->direction = glm::normalize(pose.needle_direction);
    recording.frames.push_back(session::frame_truth(pose.t_s, sight.see(inserted)));
  }
}

// As ultrasound with the view's probe, depth and settings shows it from each row's probe pose.
base::Result<void> add_frames(const Scene& scene, const UltrasoundSceneView& of_scene, const volume::Volume& volume,
                              const cases::MeshIndex& skin, const std::string& library,
                              cases::Recording& recording) {
  auto found = tissue_of(scene, volume, library);
  if (!found) return found.error();
  auto& [classes, echogenicity] = *found;
  imaging::UltrasoundView view = of_scene.view;
  imaging::Inserted inserted = scene.inserted;
  imaging::settle_lesions(volume, classes, echogenicity, inserted.lesions, view.sight_law);
  if (!inserted.needle) inserted.needle = imaging::needle_pose(scene.instrument, {}, {0.0, 0.0, 1.0});
  for (const cases::PoseSample& pose : recording.poses) {
    view.origin_lps_mm = pose.probe_origin_lps_mm;
    view.axial = glm::normalize(pose.probe_axial);
    const glm::dvec3 across = pose.probe_lateral - view.axial * glm::dot(pose.probe_lateral, view.axial);
    view.lateral = glm::length(across) > 1e-6 ? glm::normalize(across) : base::perpendiculars(view.axial).u;
    inserted.needle->tip_lps_mm = pose.tip_lps_mm;
    inserted.needle->direction = glm::normalize(pose.needle_direction);
    recording.frames.push_back(session::frame_truth(
        pose.t_s, imaging::ultrasound_visible({&volume, classes, echogenicity}, view, inserted,
                                              session::element_depths(skin, view, session::kContactStride))));
  }
  return {};
}

base::Result<assessment::Scored> score_poses(const Arguments& arguments, std::vector<std::string>& notes) {
  const std::string scene_path = arguments.required("--scene"), library = library_folder_if_any(arguments).string();
  const auto scene = read_scene(scene_path, notes);
  if (!scene) return error_of("--scene", scene_path, scene.error());
  if (scene->motion)
    return base::Error{"bad_scene", "poses can only be scored in a patient who does not move: scene.motion", {}};
  const auto text = read_text_of(arguments, "--poses");
  if (!text) return text.error();
  auto recording = recording_from_csv(*text);
  if (!recording) return error_of("--poses", arguments.text("--poses"), recording.error());
  auto volume = volume_of(*scene, library);
  if (!volume) return volume.error();
  cases::Case built;
  const auto skin = casedb::skin_surface(*volume);
  if (skin)
    built.skin_index = cases::MeshIndex(*skin);
  else if (skin.error().code != "no_body")  // without a body the metrics of the skin are null, the others hold
    return skin.error();
  built.lesions = scene->inserted.lesions;
  built.instrument = scene->instrument;
  built.approach = scene->approach;
  built.structures = scene->structures;
  built.planned_entry_lps_mm = scene->planned_entry_lps_mm;
  if (scene->view) {
    if (const auto* xray = std::get_if<XrayView>(&*scene->view)) {
      built.picture.modality = cases::Modality::xray;
      add_frames(*scene, *xray, *volume, *recording);
    } else if (const auto* mpr = std::get_if<imaging::MprView>(&*scene->view)) {
      add_frames(*scene, *mpr, *recording);
    } else {
      built.picture.modality = cases::Modality::ultrasound;
      const auto added = add_frames(*scene, std::get<UltrasoundSceneView>(*scene->view), *volume, built.skin_index,
                                    library, *recording);
      if (!added) return added.error();
    }
  }
  return assessment::score(built, *recording);
}

// What it is worth as measured now; `grade` is set with it.
base::Result<assessment::Scored> score_attempt(const Arguments& arguments,
                                               std::optional<casedb::AttemptGrade>& grade) {
  auto library = open_library(arguments);
  if (!library) return library.error();
  const std::string& attempt_id = arguments.positional(0);
  auto attempt = casedb::find_attempt(*library, attempt_id);
  if (!attempt) return attempt.error();
  const auto recording = casedb::load_recording(*library, attempt_id);
  if (!recording) return recording.error();
  const auto scene = session::build_case_of(*library, *attempt, session::Needs::metrics);
  if (!scene) return scene.error();
  auto scored = assessment::score(*scene, *recording);
  if (!scored) return scored;
  // Stored versions that are measured no more stay, for a rule that names one.
  std::vector<assessment::MetricValue>& older = attempt->older_metrics;
  older.insert(older.begin(), attempt->metrics.begin(), attempt->metrics.end());
  attempt->metrics = scored->metrics;
  grade = casedb::Grader(*library).look_at(*attempt);
  return scored;
}

int run_score(const Arguments& arguments) {
  const bool stored = arguments.positionals() == 1;
  if (stored == arguments.has("--poses")) throw UsageError("give either ATTEMPT or --poses with --scene");
  std::vector<std::string> notes;
  std::optional<casedb::AttemptGrade> grade;
  const auto scored = stored ? score_attempt(arguments, grade) : score_poses(arguments, notes);
  if (!scored) return refuse(scored.error());
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  if (arguments.has("--json")) {
    std::fputs(json_of_score(*scored, grade ? &*grade : nullptr).c_str(), stdout);
  } else {
    if (grade) std::fputs(text_of_grade(*grade).c_str(), stdout);
    print_metrics(scored->metrics);
  }
  return kDone;
}

constexpr Option kScoreOptions[] = {kLibrary,
                                    {"--poses", "FILE.csv", "poses of an attempt made elsewhere"},
                                    {"--scene", "SCENE.json", "the scene they were made in"},
                                    kJson};

}  // namespace

Command score_command() {
  return {.name = "score",
          .positionals = "[ATTEMPT]",
          .max_positionals = 1,
          .options = kScoreOptions,
          .summary = "Computes the metrics of a stored attempt, or of a pose file.",
          .run = &run_score};
}

}  // namespace seldinger::app
