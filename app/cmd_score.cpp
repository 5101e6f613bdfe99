// score.
#include <cstdio>

#include "app/answers_json.h"
#include "app/attempt_loop.h"
#include "app/case_build.h"
#include "app/command.h"
#include "app/file.h"
#include "app/poses_csv.h"
#include "app/scene.h"
#include "app/simulation.h"
#include "casedb/import/surface.h"
#include "sim/imaging/mpr/visibility.h"

namespace seldinger::app {
namespace {

using Metrics = std::vector<assessment::MetricValue>;

// What the picture at each row's probe pose shows: the view's kind, depth and size (contracts.md, Attempts).
void add_frames(const Scene& scene, cases::Recording& recording) {
  const std::optional<glm::dvec3> target =
      scene.inserted.lesions.empty() ? std::nullopt : std::optional(scene.inserted.lesions[0].center_lps_mm);
  for (const cases::PoseSample& pose : recording.poses) {
    imaging::MprView view = *scene.view;
    view.u = pose.probe_lateral;
    view.v = pose.probe_axial;
    view.center_lps_mm = pose.probe_origin_lps_mm + pose.probe_axial * (view.pixel_mm * view.height_px / 2);
    imaging::NeedlePose needle;
    needle.tip_lps_mm = pose.tip_lps_mm;
    needle.direction = pose.needle_direction;
    needle.length_mm = scene.instrument.length_mm;
    const imaging::Visible visible = imaging::mpr_visible(view, needle, target);
    cases::FrameTruth frame;
    frame.t_s = pose.t_s;
    frame.needle_tip = visible.needle_tip;
    frame.target = visible.target;
    frame.needle_length_mm = visible.needle_length_mm;
    recording.frames.push_back(frame);
  }
}

base::Result<Metrics> score_poses(const std::string& poses, const std::string& scene_path,
                                  const std::string& library) {
  const auto scene = read_scene(scene_path);
  if (!scene) return scene.error();
  const auto text = read_text(poses);
  if (!text) return text.error();
  auto recording = recording_from_csv(*text);
  if (!recording) return recording.error();
  auto volume = volume_of(*scene, library);
  if (!volume) return volume.error();
  auto skin = casedb::skin_surface(*volume);
  if (!skin) return skin.error();
  cases::Case built;
  built.skin_index = cases::MeshIndex(*skin);
  built.lesions = scene->inserted.lesions;
  built.instrument = scene->instrument;
  built.approach = scene->approach;
  if (scene->view) add_frames(*scene, *recording);
  return measure(built, *recording);
}

base::Result<Metrics> score_attempt(const std::string& attempt_id, const std::string& folder) {
  auto library = casedb::Library::open(folder);
  if (!library) return library.error();
  const auto attempt = casedb::find_attempt(*library, attempt_id);
  if (!attempt) return attempt.error();
  const auto recording = casedb::load_recording(*library, attempt_id);
  if (!recording) return recording.error();
  const auto row = casedb::find_case(*library, attempt->case_id);
  if (!row) return row.error();
  const auto scene =
      build_case(*library, *row, attempt->lesion, attempt->instrument, attempt->picture, attempt->approach);
  if (!scene) return scene.error();
  return measure(*scene, *recording);
}

}  // namespace

int run_score(const Arguments& arguments) {
  const bool stored = arguments.positionals() == 1;
  if (stored == arguments.has("--poses")) throw UsageError("give either ATTEMPT or --poses with --scene");
  const auto metrics =
      stored ? score_attempt(arguments.positional(0), arguments.required("--library"))
             : score_poses(arguments.text("--poses"), arguments.required("--scene"), arguments.text("--library"));
  if (!metrics) return refuse(metrics.error());
  if (arguments.has("--json"))
    std::fputs(json_of_metrics(*metrics).c_str(), stdout);
  else
    print_metrics(*metrics);
  return kDone;
}

}  // namespace seldinger::app
