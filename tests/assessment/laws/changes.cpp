#include "tests/assessment/laws/changes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "sim/case/c_arm.h"

namespace seldinger::assessment {
namespace {

// Poses are thinned to 200 Hz, and under 60 Hz an attempt is not graded: a change keeps a recording between them.
constexpr double kLeastHz = 66.0, kMostHz = 190.0;

void each_time(cases::Recording& recording, const std::function<double(double)>& to) {
  for (auto& pose : recording.poses) pose.t_s = to(pose.t_s);
  for (auto& force : recording.forces) force.t_s = to(force.t_s);
  for (auto& frame : recording.frames) frame.t_s = to(frame.t_s);
  if (recording.events)
    for (auto& event : *recording.events) event.t_s = to(event.t_s);
  if (recording.endpoint) recording.endpoint->t_s = to(recording.endpoint->t_s);
}

std::optional<Changed> at_another_speed(const RandomAttempt& attempt, Draw& draw) {
  Changed changed{attempt, attempt, {0.02, 0.005, 0.25}};
  const double least = std::max(0.5, attempt.pose_hz / kMostHz), most = std::min(2.0, attempt.pose_hz / kLeastHz);
  const double factor = std::exp(draw.in(std::log(least), std::log(most)));
  each_time(changed.after.recording, [&](double t_s) { return t_s * factor; });
  for (auto& frame : changed.after.recording.frames)
    if (frame.beam) frame.beam->beam_s *= factor;
  return changed;
}

std::optional<Changed> in_another_frame(const RandomAttempt& attempt, Draw& draw) {
  const glm::dvec3 x = draw.direction();
  const glm::dvec3 y = glm::normalize(glm::cross(x, draw.direction()));
  const World world{glm::dmat3(x, y, glm::cross(x, y)), draw.direction() * draw.in(0.0, 200.0)};
  return Changed{attempt, moved_to(attempt, world), {1e-5, 1e-4, 1e-3}};
}

std::optional<Changed> mirrored(const RandomAttempt& attempt, Draw&) {
  World world;
  world.turn[0][0] = -1.0;
  return Changed{attempt, moved_to(attempt, world), {1e-7, 1e-7, 1e-6}};
}

std::optional<Changed> in_another_breath(const RandomAttempt& attempt, Draw& draw) {
  if (!attempt.setting.breathes) return std::nullopt;
  Changed changed{attempt, attempt, {0.01, 0.01, 0.25}};
  changed.before = changed.after = random_attempt_at_rest(attempt.seed);
  ride_on_breath(changed.after, draw.in(4.0, 14.0));
  return changed;
}

// Copies of the first or last row, as long as nothing is done; a fluoroscope's foot switch is not pressed.
void rest(cases::Recording& into, const cases::Recording& like, const cases::PoseSample& pose,
          const cases::FrameTruth* frame, double from_s, double to_s, double pose_hz) {
  const auto count = static_cast<int>(std::floor((to_s - from_s) * pose_hz - 1e-9));
  for (int i = 0; i <= count; ++i) {
    into.poses.push_back(pose);
    into.poses.back().t_s = from_s + i / pose_hz;
    if (like.forces.empty()) continue;
    into.forces.push_back(from_s > like.poses.front().t_s ? like.forces.back() : like.forces.front());
    into.forces.back().t_s = into.poses.back().t_s;
  }
  if (frame == nullptr) return;
  cases::FrameTruth same = *frame;
  if (same.beam) same.live = false;
  same.beam.reset();
  for (same.t_s = from_s + 0.013; same.t_s < to_s; same.t_s += 0.05) into.frames.push_back(same);
}

std::optional<Changed> idle_before(const RandomAttempt& attempt, Draw& draw) {
  Changed changed{attempt, attempt, {1e-3, 1e-6, 0.01}};
  const auto steps = static_cast<int>(draw.in(1.0, 4.0) * 100.0);
  const double idle_s = steps / 100.0;  // whole samples of the filtered way
  cases::Recording& after = changed.after.recording;
  const cases::Recording& before = attempt.recording;
  each_time(after, [&](double t_s) { return t_s + idle_s; });
  cases::Recording idle = after;
  idle.poses.clear(), idle.forces.clear(), idle.frames.clear();
  rest(idle, before, before.poses.front(), before.frames.empty() ? nullptr : &before.frames.front(), 0.0, idle_s,
       attempt.pose_hz);
  const auto put_first = [](auto& all, const auto& first) { all.insert(all.begin(), first.begin(), first.end()); };
  put_first(after.poses, idle.poses);
  put_first(after.forces, idle.forces);
  put_first(after.frames, idle.frames);
  return changed;
}

std::optional<Changed> idle_after(const RandomAttempt& attempt, Draw& draw) {
  if (attempt.recording.endpoint) return std::nullopt;
  Changed changed{attempt, attempt, {1e-3, 1e-6, 0.01}};
  cases::Recording& after = changed.after.recording;
  const double from_s = after.poses.back().t_s + 1.0 / attempt.pose_hz;
  rest(after, attempt.recording, attempt.recording.poses.back(),
       after.frames.empty() ? nullptr : &attempt.recording.frames.back(), from_s, from_s + draw.in(1.0, 4.0),
       attempt.pose_hz);
  return changed;
}

// The longest way of the tip in so long.
double longest_way_mm(const cases::Recording& recording, double seconds) {
  double longest_mm = 0.0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < recording.poses.size(); ++i) {
    while (recording.poses[i].t_s - recording.poses[from].t_s > seconds) ++from;
    if (recording.poses[i].t_s - recording.poses[from].t_s < 0.5 * seconds) continue;
    longest_mm = std::max(longest_mm, glm::distance(recording.poses[i].tip_at_rest_lps_mm(),
                                                    recording.poses[from].tip_at_rest_lps_mm()));
  }
  return longest_mm;
}

std::optional<Changed> one_dark_frame(const RandomAttempt& attempt, Draw& draw) {
  cases::Recording dark = attempt.recording;
  std::vector<std::size_t> live;
  for (std::size_t i = 0; i + 1 < dark.frames.size(); ++i)
    if (dark.frames[i].live && (dark.frames[i].needle_tip || dark.frames[i].target)) live.push_back(i);
  if (live.empty()) return std::nullopt;
  const std::size_t at = live[static_cast<std::size_t>(draw.from(0, static_cast<int>(live.size()) - 1))];
  cases::FrameTruth& frame = dark.frames[at];
  const double shown_s = dark.frames[at + 1].t_s - frame.t_s;
  frame.needle_tip = frame.target = false;
  frame.needle_length_mm = 0.0;
  if (frame.near_plane) frame.near_plane = cases::NearPlane{};
  Changed changed{attempt, attempt, {}};
  changed.after.recording = dark;
  const auto signals = attempt.signals();
  if (!signals) return changed;
  // Of the time with live pictures in tissue at least a second is asked for, of advance at least a millimetre.
  double seen_s = 0.0, advance_mm = 0.0;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < signals->poses.size(); ++i) {
    while (next < signals->frames.size() && signals->frames[next].t_s <= signals->poses[i].t_s) ++next;
    const bool seen = next > 0 && signals->frames[next - 1].live && signals->passages[i].in_body;
    if (seen && !signals->gap(i)) seen_s += signals->interval_s(i);
    advance_mm += signals->advance_mm[i];
  }
  const double of_time = shown_s / std::max(1.0, seen_s - 0.1);
  const double way_mm = longest_way_mm(dark, shown_s + 2.0 / attempt.pose_hz);
  const double of_way = way_mm / std::max(1.0, advance_mm);
  changed.slack = {0.0, 1.05 * std::max(of_time, of_way),
                   way_mm + attempt.recording.frames[at].needle_length_mm * of_time};
  return changed;
}

std::optional<Changed> samples_lost(const RandomAttempt& attempt, Draw& draw) {
  Changed changed{attempt, attempt, {}};
  auto& poses = changed.after.recording.poses;
  std::vector<cases::PoseSample> kept;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool fired = attempt.recording.endpoint && poses[i].t_s == attempt.recording.endpoint->t_s;
    if (i == 0 || i + 1 == poses.size() || fired || !draw.chance(0.01)) kept.push_back(poses[i]);
  }
  poses = kept;
  const double way_mm = longest_way_mm(attempt.recording, 2.0 / attempt.pose_hz);
  changed.slack = {0.01, 0.02, 0.02 + way_mm};
  return changed;
}

constexpr LawInfo kLaws[] = {
    {kAtAnySpeed, "at any speed", "speed",
     "2 %: the 10 Hz low-pass takes more off a quick turn than off a slow one; 0.25 mm: the trace's points are so "
     "far apart",
     &at_another_speed},
    {kInAnyFrame, "in any frame", "frame", "0.001 mm: the skin's vertices are floats, up to 700 mm from the origin",
     &in_another_frame},
    {kMirrored, "mirrored", "mirror", "rounding: a sign changes no digits", &mirrored},
    {kInAnyBreath, "in any breath", "breath",
     "1 % and 0.25 mm: what moves along turns the dead band of a hand at rest elsewhere", &in_another_breath},
    {kIdleBefore, "idle before", "before", "0.1 %: the low-pass begins in rest rather than with the first way",
     &idle_before},
    {kIdleAfter, "idle after", "after",
     "0.1 %: the low-pass ends its reflection in rest rather than at the end of the way", &idle_after},
    {kOneDarkFrame, "one dark frame", "dark",
     "what one picture stands for: its share of the time with pictures in tissue, and the way that went meanwhile",
     &one_dark_frame},
    {kLostSamples, "samples lost", "lost",
     "1 %, and the way between samples: what changes at a lost one is told at the next", &samples_lost},
};

glm::dmat4 moved(const glm::dmat4& voxel_from_lps, const World& world) {
  glm::dmat4 to_world(world.turn);
  to_world[3] = glm::dvec4(world.shift, 1.0);
  return voxel_from_lps * glm::inverse(to_world);
}

struct MoveShape {
  const World& world;
  cases::Shape operator()(cases::Sphere sphere) const {
    sphere.center_lps_mm = world.point(sphere.center_lps_mm);
    return sphere;
  }
  cases::Shape operator()(const cases::Ellipsoid&) const {
    throw std::logic_error("an ellipsoid's axes are those of LPS: it cannot be turned");
  }
  cases::Shape operator()(cases::Tube tube) const {
    for (glm::dvec3& point : tube.points_lps_mm) point = world.point(point);
    return tube;
  }
  cases::Shape operator()(cases::VoxelSet voxels) const {
    voxels.voxel_from_lps = moved(voxels.voxel_from_lps, world);
    return voxels;
  }
};

}  // namespace

double Slack::allowed(const MetricInfo& info, double value) const {
  const std::string unit = info.unit;
  if (unit == "count" || unit == "bool") return 0.0;
  if (unit == "share") return share;
  // Of a detour in percent, what counts is the way.
  if (unit == "%") return relative * (100.0 + value) + absolute;
  return relative * std::abs(value) + absolute * (unit == "mm²" ? 10.0 : 1.0);
}

std::span<const LawInfo> laws() {
  return kLaws;
}

RandomAttempt moved_to(const RandomAttempt& attempt, const World& world) {
  RandomAttempt there = attempt;
  auto mesh = std::make_shared<cases::Mesh>(*attempt.mesh);
  for (glm::vec3& vertex : mesh->vertices_lps_mm) vertex = glm::vec3(world.point(glm::dvec3(vertex)));
  if (world.mirrored())
    for (glm::uvec3& triangle : mesh->triangles) std::swap(triangle.x, triangle.y);
  there.skin = std::make_shared<cases::MeshIndex>(*mesh);
  there.mesh = std::move(mesh);
  if (there.setting.target) there.setting.target->center_lps_mm = world.point(there.setting.target->center_lps_mm);
  if (there.setting.plan) {
    there.setting.plan->entry_lps_mm = world.point(there.setting.plan->entry_lps_mm);
    there.setting.plan->direction = world.vector(there.setting.plan->direction);
  }
  for (cases::Structure& one : there.structures) one.shape = std::visit(MoveShape{world}, one.shape);
  for (cases::PoseSample& pose : there.recording.poses) {
    pose.tip_lps_mm = world.point(pose.tip_lps_mm);
    if (pose.rest_tip_lps_mm) pose.rest_tip_lps_mm = world.point(*pose.rest_tip_lps_mm);
    pose.probe_origin_lps_mm = world.point(pose.probe_origin_lps_mm);
    for (glm::dvec3* way : {&pose.needle_direction, &pose.probe_axial, &pose.probe_lateral})
      *way = world.vector(*way);
  }
  if (auto& end = there.recording.endpoint) {
    end->tip_lps_mm = world.point(end->tip_lps_mm);
    if (end->rest_tip_lps_mm) end->rest_tip_lps_mm = world.point(*end->rest_tip_lps_mm);
    end->direction = world.vector(end->direction);
  }
  const cases::PatientPosition position = attempt.setting.position;
  for (cases::FrameTruth& frame : there.recording.frames) {
    if (!frame.beam) continue;
    const glm::dvec3 ray = cases::beam_direction(frame.beam->lao_deg, frame.beam->cranial_deg, position);
    const cases::BeamAngles angles = cases::angles_of_beam(world.vector(ray), position);
    frame.beam->lao_deg = angles.lao_deg;
    frame.beam->cranial_deg = angles.cranial_deg;
  }
  return there;
}

}  // namespace seldinger::assessment
