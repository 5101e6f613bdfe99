#include "app/replay/replay_output.h"

#include <chrono>
#include <cstdio>
#include <future>
#include <iterator>

#include "app/cli/file.h"
#include "app/replay/body_planes.h"
#include "app/replay/png.h"
#include "app/replay/replay_frame.h"
#include "app/replay/video_file.h"
#include "assessment/moments.h"
#include "assessment/score.h"
#include "casedb/database/disk.h"
#include "reports/sheets/blinded_replay.h"
#include "reports/sheets/moments_sheet.h"
#include "reports/sheets/replay_sheet.h"
#include "session/case/case_build.h"
#include "session/monitor/guidance_screen.h"
#include "sim/engine/step.h"

namespace seldinger::app {
namespace {

namespace fs = std::filesystem;

std::string label_of(const casedb::AttemptRow& attempt) {
  return attempt.synthetic() ? reports::simulated_operator_text(attempt.operator_name) : "a person";
}

constexpr const char* kNotVerified =
    "Recorded by another version of the step: drawn with the present one, not verified.";

bool is_comparable(const cases::Recording& recording) {
  return recording.step_version == engine::kStepVersion;
}

// As a page has them, a dozen beside each other: all of them weigh less than 100 kB.
constexpr int kSmallWidthPx = 160, kSmallGreys = 16, kPlaneGreys = 32;

reports::SmallPicture small_of(const session::GreyPicture& picture) {
  if (picture.width_px == 0) return {};
  const session::GreyPicture small = session::shrunk_to(picture, kSmallWidthPx);
  return {png_in_greys(small.grey, small.width_px, small.height_px, kSmallGreys), small.width_px, small.height_px};
}

// What a replay is made of, beside the screen.
struct Scene {
  cases::Case scene;
  assessment::Signals signals;
  reports::Course course;
  std::vector<BodyPlane> planes;
};

std::vector<reports::SheetSegment> rows_of(const std::vector<PlaneSegment>& segments) {
  std::vector<reports::SheetSegment> rows;
  for (const PlaneSegment& segment : segments) rows.push_back({segment.from_mm, segment.to_mm});
  return rows;
}

reports::SheetPlane row_of(const Scene& s, const BodyPlane& plane) {
  reports::SheetPlane row;
  row.name = plane.name;
  row.left = plane.left;
  row.right = plane.right;
  row.upper = plane.upper;
  row.lower = plane.lower;
  row.side_mm = plane.side_mm;
  row.png = png_of(plane.ct);
  row.skin = rows_of(plane.skin);
  for (const PlaneOutline& outline : plane.structures)
    row.structures.push_back({outline.name, std::string(cases::name_of(outline.rule)), rows_of(outline.segments)});
  for (const cases::PoseSample& pose : s.signals.poses) row.way.push_back(plane.at(pose.tip_at_rest_lps_mm()));
  if (s.signals.setting.target) {
    row.target_mm = plane.at(s.signals.setting.target->center_lps_mm);
    row.target_radius_mm = s.signals.setting.target->radius_mm;
  }
  if (s.scene.planned_entry_lps_mm) row.planned_entry_mm = plane.at(*s.scene.planned_entry_lps_mm);
  const cases::PoseSample& last = s.signals.poses.back();
  row.tip_mm = plane.at(last.tip_at_rest_lps_mm());
  row.hub_mm = plane.at(last.tip_at_rest_lps_mm() - last.needle_direction * s.scene.instrument.length_mm);
  return row;
}

// Walks through the recording; `before` and `after` each tick's picture, if any, came onto the screen.
template <typename Before, typename After>
session::Replay walk(const Scene& s, const cases::Recording& recording, session::GuidanceScreen& screen,
                     const Before& before, const After& after) {
  return session::replay(s.scene, recording,
                         [&](const cases::State& state, const tissue::Displacement& displacement) {
                           before(state);
                           screen.tick(state, displacement);
                           after(state);
                         });
}

// `note`: when the replay cannot be held against the recording. `small`: of a page that is soon there.
reports::ReplaySheet sheet_of(const Scene& s, const casedb::AttemptRow& attempt, const cases::Recording& recording,
                              session::GuidanceScreen& screen, const std::string& note, session::Replay& replayed,
                              bool small = false) {
  reports::ReplaySheet sheet;
  sheet.attempt = {attempt, label_of(attempt)};
  sheet.note = note;
  sheet.course = s.course;
  for (const BodyPlane& plane : s.planes) {
    sheet.planes.push_back(row_of(s, plane));
    if (small)
      sheet.planes.back().png = png_in_greys(plane.ct.grey, plane.ct.width_px, plane.ct.height_px, kPlaneGreys);
  }
  const std::vector<assessment::Moment> moments = assessment::telling_moments(s.signals);
  std::vector<session::GreyPicture> pictures;
  const auto take = [&](const assessment::Moment& moment) {
    reports::SheetMoment shown;
    shown.t_s = moment.t_s;
    shown.words = assessment::words_for(moment.kind, attempt.picture.modality);
    shown.live = screen.live();
    pictures.push_back(screen.picture());
    for (const cases::FrameTruth& frame : s.signals.frames) {
      if (frame.t_s > moment.t_s) break;
      shown.tip_seen = frame.needle_tip;
      shown.target_seen = frame.target;
    }
    sheet.moments.push_back(std::move(shown));
  };
  // What was seen when the trigger fell is the picture before, without a core needle's throw.
  std::size_t next = 0;
  const auto due = [&](const cases::State& state) {
    return next < moments.size() && moments[next].t_s <= state.t_s;
  };
  replayed = walk(
      s, recording, screen,
      [&](const cases::State& state) {
        for (; due(state) && moments[next].kind == assessment::MomentKind::fire; ++next) take(moments[next]);
      },
      [&](const cases::State& state) {
        for (; due(state); ++next) take(moments[next]);
      });
  for (; next < moments.size(); ++next) take(moments[next]);
  session::cut_black_edges(pictures);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    sheet.moments[i].png = png_of(pictures[i]);
    if (small) sheet.moments[i].small = small_of(pictures[i]);
  }
  return sheet;
}

// What a rater is shown, at even times: so many pictures, and the moment in which it was fired; and a film of so
// many smaller ones.
constexpr std::size_t kMomentsToRate = 16, kFramesToRate = 121;
constexpr int kFilmWidthPx = 320;

void add_pictures_to_rate(const Scene& s, const cases::Recording& recording, session::GuidanceScreen& screen,
                          session::Replay& replayed, reports::ReplaySheet& sheet) {
  std::vector<session::GreyPicture> pictures;  // of the moments, then of the film: cut alike
  std::vector<session::GreyPicture> frames;
  const double last_s = static_cast<double>(recording.inputs.size()) * recording.dt_s;
  const auto due_s = [&](std::size_t i, std::size_t all) {
    return last_s * static_cast<double>(i) / static_cast<double>(all - 1);
  };
  const auto take = [&](double t_s, const char* words) {
    pictures.push_back(screen.picture());
    sheet.moments.push_back({t_s, words, {}, screen.live(), false, false});
  };
  const auto take_frame = [&](double t_s) {
    frames.push_back(screen.picture());
    sheet.film.push_back({t_s, "", {}, true, false, false});
  };
  std::size_t next = 0, next_frame = 0;
  bool fired = !s.course.fired_s.has_value();
  replayed = walk(
      s, recording, screen,
      [&](const cases::State& state) {
        // What was seen when the trigger fell is the picture before, without a core needle's throw.
        if (fired || state.t_s < *s.course.fired_s) return;
        fired = true;
        take(*s.course.fired_s, "fired");
      },
      [&](const cases::State& state) {
        for (; next + 1 < kMomentsToRate && due_s(next, kMomentsToRate) <= state.t_s; ++next)
          take(due_s(next, kMomentsToRate), "");
        for (; next_frame + 1 < kFramesToRate && due_s(next_frame, kFramesToRate) <= state.t_s; ++next_frame)
          take_frame(due_s(next_frame, kFramesToRate));
      });
  take(last_s, "");
  take_frame(last_s);
  pictures.insert(pictures.end(), std::make_move_iterator(frames.begin()), std::make_move_iterator(frames.end()));
  session::cut_black_edges(pictures);
  for (std::size_t i = 0; i < sheet.moments.size(); ++i) sheet.moments[i].png = png_of(pictures[i]);
  for (std::size_t i = 0; i < sheet.film.size(); ++i)
    sheet.film[i].png = png_of(session::shrunk_to(pictures[sheet.moments.size() + i], kFilmWidthPx));
}

base::Result<Scene> scene_of(casedb::Library& library, const casedb::AttemptRow& attempt,
                             const cases::Recording& recording) {
  session::Needs needs = session::needs_of(attempt.picture.modality);
  if (!recording.forces.empty() && needs == session::Needs::metrics) needs = session::Needs::touch;
  auto built = session::build_case_of(library, attempt, needs);
  if (!built) return built.error();
  Scene s{std::move(*built), {}, {}, {}};
  auto signals = assessment::signals_of(s.scene, recording);
  if (!signals) return signals.error();
  s.signals = std::move(*signals);
  s.course = reports::course_of(s.signals, recording);
  s.planes = body_planes(s.scene, s.signals);
  return s;
}

// Calls `add` with each frame.
template <typename Add>
std::size_t draw_frames(const Scene& s, const cases::Recording& recording, session::GuidanceScreen& screen,
                        const std::string& title, double rate_hz, session::Replay& replayed, const Add& add) {
  const ReplayFrame frame(s.signals, s.planes, s.course, title);
  std::size_t drawn = 0;
  const double last_s = static_cast<double>(recording.inputs.size()) * recording.dt_s;
  replayed = walk(
      s, recording, screen, [](const cases::State&) {},
      [&](const cases::State& state) {
        if (state.t_s + 1e-9 < static_cast<double>(drawn) / rate_hz) return;
        ++drawn;
        add(frame.draw(state, screen.picture(), screen.live()));
        if (drawn % 50 == 0) std::fprintf(stderr, "%.1f of %.1f s\n", state.t_s, last_s);
      });
  return drawn;
}

}  // namespace

base::Result<std::string> replay_to_rate(casedb::Library& library, const casedb::AttemptRow& attempt,
                                         const cases::Recording& recording) {
  const base::Error cannot{
      "not_to_be_rated",
      "an attempt whose replay does not match its recording tick for tick cannot be shown to raters"};
  if (!is_comparable(recording)) return cannot;
  const auto s = scene_of(library, attempt, recording);
  if (!s) return s.error();
  reports::ReplaySheet sheet;
  sheet.attempt.row.picture = attempt.picture;
  sheet.attempt.row.instrument = attempt.instrument;
  sheet.course = s->course;
  for (const BodyPlane& plane : s->planes) sheet.planes.push_back(row_of(*s, plane));
  session::GuidanceScreen screen(s->scene, recording.hashes.empty() ? 0 : recording.hashes.back());
  session::Replay replayed;
  add_pictures_to_rate(*s, recording, screen, replayed, sheet);
  if (!replayed.same) return cannot;
  return reports::blinded_replay(std::move(sheet));
}

base::Result<reports::DrawnPictures> telling_pictures(casedb::Library& library, const std::string& attempt_id) {
  const auto attempt = casedb::find_attempt(library, attempt_id);
  if (!attempt) return attempt.error();
  const auto recording = casedb::load_recording(library, attempt_id);
  if (!recording) return recording.error();
  const auto s = scene_of(library, *attempt, *recording);
  if (!s) return s.error();
  session::GuidanceScreen screen(s->scene, recording->hashes.empty() ? 0 : recording->hashes.back());
  session::Replay replayed;
  const reports::ReplaySheet sheet =
      sheet_of(*s, *attempt, *recording, screen, is_comparable(*recording) ? "" : kNotVerified, replayed, true);
  if (!replayed.same && is_comparable(*recording))
    return base::Error{"replay_differs", "the replay does not match the recording tick for tick: nothing is drawn"};
  return reports::moments_sheet(sheet);
}

base::Result<ReplayWritten> write_replay(casedb::Library& library, const casedb::AttemptRow& attempt,
                                         const cases::Recording& recording, const fs::path& out, double rate_hz) {
  const auto began = std::chrono::steady_clock::now();
  const bool sheet = out.extension() == ".html", film = out.extension() == ".mp4";
  const bool there = casedb::without_paths([&] { return fs::exists(fs::symlink_status(out)); });
  if (!sheet && !film && there) return base::Error{"exists", "there is already something of that name"};
  const auto built = scene_of(library, attempt, recording);
  if (!built) return built.error();
  const Scene& s = *built;
  session::GuidanceScreen screen(s.scene, recording.hashes.empty() ? 0 : recording.hashes.back());
  const bool comparable = is_comparable(recording);
  const std::string note = comparable ? "" : kNotVerified;
  const std::string title = reports::picture_text(attempt.picture) + (comparable ? "" : " - not verified");

  ReplayWritten written;
  if (sheet) {
    const reports::ReplaySheet made = sheet_of(s, attempt, recording, screen, note, written.replay);
    if (written.replay.same || !comparable) write_file(out, reports::replay_sheet(made));
    written.pictures = made.moments.size();
  } else if (film) {
    VideoFile video(out, ReplayFrame::kWidthPx, ReplayFrame::kHeightPx, rate_hz);
    written.pictures = draw_frames(s, recording, screen, title, rate_hz, written.replay,
                                   [&](const Canvas& canvas) { video.add(canvas.rgb()); });
    if (written.replay.same || !comparable) video.keep();
  } else {
    casedb::NewFolder folder(out);
    std::size_t number = 0;
    std::future<void> writing;  // packing one takes as long as drawing the next
    const auto wait = [&] {
      if (writing.valid()) writing.get();
    };
    written.pictures = draw_frames(s, recording, screen, title, rate_hz, written.replay, [&](Canvas canvas) {
      char name[32];
      std::snprintf(name, sizeof name, "frame_%06zu.png", ++number);
      wait();
      writing = std::async(std::launch::async, [file = folder.unfinished() / name, drawn = std::move(canvas)] {
        casedb::NewFile whole(file, casedb::FileAccess::as_umask);
        whole.write(png_from_rgb(drawn.rgb(), drawn.width_px(), drawn.height_px()));
        whole.keep_unsynced();
      });
    });
    wait();
    if ((written.replay.same || !comparable) && !folder.keep())
      return base::Error{"exists", "there is already something of that name"};
  }
  written.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return written;
}

}  // namespace seldinger::app
