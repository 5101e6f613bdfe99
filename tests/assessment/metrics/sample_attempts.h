// Attempts as people make them, from formulas: any sampling rate, any frame of reference, mirrored, with a pause
// where the needle rests. Every modality and approach, structures of every rule, forces and a plan.
#pragma once

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "assessment/signals/signals.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::assessment {

// p → turn · p + shift.
struct World {
  glm::dmat3 turn{1.0};
  glm::dvec3 shift{0.0};
  glm::dvec3 point(const glm::dvec3& p) const { return turn * p + shift; }
  glm::dvec3 vector(const glm::dvec3& v) const { return turn * v; }
  bool mirrored() const { return glm::determinant(turn) < 0.0; }
};

struct Sampling {
  double rate_hz = 100.0;
  double start_s = 0.0;
  double pause_at_s = -1.0;  // a second in which nothing moves is put here
};

struct SampleAttempt {
  std::string name;
  AttemptSetting setting;
  cases::Recording recording;
  // What the setting points to.
  cases::MeshIndex skin;
  std::vector<cases::Structure> structures;

  base::Result<Signals> signals() const {
    AttemptSetting here = setting;
    here.skin = &skin;
    here.structures = structures;
    return make_signals(here, recording);
  }
};

struct SampleKind {
  cases::Modality modality;
  cases::Approach approach;
  cases::InstrumentKind instrument;
};
constexpr SampleKind kSampleKinds[] = {
    {cases::Modality::mpr, cases::Approach::in_plane, cases::InstrumentKind::access},
    {cases::Modality::mpr, cases::Approach::out_of_plane, cases::InstrumentKind::core},
    {cases::Modality::ultrasound, cases::Approach::in_plane, cases::InstrumentKind::access},
    {cases::Modality::ultrasound, cases::Approach::in_plane, cases::InstrumentKind::core},
    {cases::Modality::ultrasound, cases::Approach::out_of_plane, cases::InstrumentKind::access},
    {cases::Modality::xray, cases::Approach::in_plane, cases::InstrumentKind::access},
    {cases::Modality::xray, cases::Approach::out_of_plane, cases::InstrumentKind::core},
};

// Resting places and minimum-jerk reaches between them.
struct Knot {
  double t_s, value;
};
inline double reach(const std::vector<Knot>& knots, double t_s) {
  if (t_s <= knots.front().t_s) return knots.front().value;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const Knot &a = knots[i], &b = knots[i + 1];
    if (t_s > b.t_s) continue;
    const double s = (t_s - a.t_s) / (b.t_s - a.t_s);
    return a.value + (b.value - a.value) * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  }
  return knots.back().value;
}

// Straight down (−y) at these depths below the skin of a block at y = 0, fired at the end: 100 poses and 25 frames
// a second, in which nothing is seen; the target 60 mm deep.
struct StraightDown {
  AttemptSetting setting;
  cases::Recording recording;

  Signals signals() const { return make_signals(setting, recording).value(); }
};
inline StraightDown straight_down(const std::vector<Knot>& depth_mm, double seconds) {
  static const cases::MeshIndex skin(fixtures::box_mesh({-100.0, -100.0, -100.0}, {100.0, 0.0, 100.0}));
  StraightDown made;
  made.setting.skin = &skin;
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.target = cases::Lesion{{0.0, -60.0, 0.0}, 5.0, 20.0};
  for (int i = 0; i <= std::lround(100.0 * seconds); ++i) {
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = {0.0, -reach(depth_mm, pose.t_s), 0.0};
    pose.needle_direction = {0.0, -1.0, 0.0};
    pose.probe_axial = {0.0, -1.0, 0.0};
    made.recording.poses.push_back(pose);
    if (i % 4 == 0) made.recording.frames.emplace_back().t_s = pose.t_s;
  }
  made.recording.endpoint = cases::Endpoint{seconds, made.recording.poses.back().tip_lps_mm, {0.0, -1.0, 0.0}};
  return made;
}

// Depth along the needle: in, back by more than a fifth, redirected, in with a jiggle, a touch too far, and rest.
inline const std::vector<Knot>& sample_depth_mm() {
  static const std::vector<Knot> kDepth = {{0.5, -25.0}, {2.0, 10.0},  {2.5, 10.0}, {4.5, 41.0}, {5.0, 41.0},
                                           {6.0, 29.0},  {7.5, 29.0},  {9.5, 62.0}, {9.9, 60.0}, {10.3, 62.0},
                                           {11.3, 70.0}, {12.3, 61.0}, {13.5, 61.0}};
  return kDepth;
}
constexpr double kSampleSeconds = 13.5, kSampleRestS = 7.3, kSampleDeepRestS = 13.0;

inline SampleAttempt sample_attempt(const SampleKind& kind, const Sampling& sampling = {},
                                    const World& world = {}) {
  SampleAttempt sample;
  const bool xray = kind.modality == cases::Modality::xray;
  const bool in_plane = xray || kind.approach == cases::Approach::in_plane;
  sample.name = std::string(xray                                           ? "xray"
                            : kind.modality == cases::Modality::ultrasound ? "ultrasound"
                                                                           : "mpr") +
                (kind.approach == cases::Approach::in_plane ? " in plane" : " out of plane") +
                (kind.instrument == cases::InstrumentKind::core ? " core" : " access");

  auto mesh = fixtures::box_mesh({-256, 0, -256}, {256, 256, 256});
  for (glm::vec3& vertex : mesh.vertices_lps_mm) vertex = glm::vec3(world.point(glm::dvec3(vertex)));
  if (world.mirrored())
    for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.x, triangle.y);
  sample.skin = cases::MeshIndex(mesh);

  // The needle turns about its entry, (0, 0, 0), while it rests at 29 mm.
  const double tilt = in_plane ? 0.1 : 0.45;
  const std::vector<Knot> turn = {{6.0, tilt}, {7.0, tilt + 0.12}};
  const auto direction = [&](double t_s) {
    const double angle = reach(turn, t_s);
    return glm::normalize(glm::dvec3(std::sin(angle), std::cos(angle), 0.06 + 0.02 * std::sin(1.3 * angle)));
  };
  const auto tip = [&](double t_s) { return direction(t_s) * reach(sample_depth_mm(), t_s); };
  const glm::dvec3 way = direction(20.0);

  AttemptSetting& setting = sample.setting;
  setting.modality = kind.modality;
  setting.approach = kind.approach;
  setting.probe_suits = cases::DepthRange{0.0, 50.0};
  setting.instrument.kind = kind.instrument;
  setting.instrument.throw_mm = 10.0;
  setting.instrument.notch_mm = 8.0;
  setting.instrument.dead_tip_mm = 1.0;
  setting.target = cases::Lesion{world.point(way * 62.0), 6.0, 20.0};
  setting.plan =
      PlannedEntry{world.point({1.5, 0.0, -2.0}), world.vector(glm::normalize(glm::dvec3(tilt, 1.0, 0.0)))};

  const auto add = [&](const char* name, cases::StructureRule rule, cases::Shape shape) {
    cases::Structure structure;
    structure.name = name;
    structure.rule = rule;
    structure.shape = std::move(shape);
    sample.structures.push_back(std::move(structure));
  };
  using cases::StructureRule;
  const auto sphere = [&](const glm::dvec3& center, double radius) {
    return cases::Sphere{world.point(center), radius};
  };
  add("vessel", StructureRule::critical,
      cases::Tube{
          {world.point(way * 36.0 + glm::dvec3(-1, 0, -30)), world.point(way * 36.0 + glm::dvec3(-1, 0, 30))},
          2.0});
  add("muscle", StructureRule::advisory,
      cases::Ellipsoid{world.point({0, 8, 0}), glm::abs(world.vector({40, 4, 30}))});
  cases::VoxelSet bowel;
  bowel.size = {4, 3, 5};
  bowel.spacing_mm = glm::dvec3(4.0);
  glm::dmat4 lps_from_voxel(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 one(0.0);
    one[axis] = 4.0;
    lps_from_voxel[axis] = glm::dvec4(world.vector(one), 0.0);
  }
  lps_from_voxel[3] = glm::dvec4(world.point(way * 50.0 + glm::dvec3(1.2, -4.2, -8.4)), 1.0);
  bowel.voxel_from_lps = glm::inverse(lps_from_voxel);
  bowel.member.assign(60, 1);
  add("bowel", StructureRule::major, bowel);
  add("parenchyma", StructureRule::must_cross, sphere(way * 40.0, 14.0));
  add("kidney", StructureRule::organ, sphere(way * 60.0, 27.0));
  add("calyx", StructureRule::target, sphere(way * 62.0, 6.0));

  const auto now = [&](double t_s) {
    return sampling.start_s + t_s + (sampling.pause_at_s >= 0.0 && t_s > sampling.pause_at_s ? 1.0 : 0.0);
  };
  const double pause_s = sampling.pause_at_s >= 0.0 ? 1.0 : 0.0;
  const auto attempt_time = [&](double t_s) {  // of a time since the start
    return pause_s == 0.0 || t_s <= sampling.pause_at_s ? t_s
           : t_s <= sampling.pause_at_s + 1.0           ? sampling.pause_at_s
                                                        : t_s - 1.0;
  };
  const std::vector<Knot> drift = {{3.0, 0.0}, {4.2, 6.0}, {8.0, 6.0}, {9.0, 9.0}};
  const int rows = static_cast<int>(std::lround((kSampleSeconds + pause_s) * sampling.rate_hz));
  for (int i = 0; i <= rows; ++i) {
    const double since_s = i / sampling.rate_hz, t_s = attempt_time(since_s);
    cases::PoseSample pose;
    pose.t_s = sampling.start_s + since_s;
    pose.tip_lps_mm = world.point(tip(t_s));
    pose.needle_direction = world.vector(direction(t_s));
    const double x_mm = (in_plane ? 30.0 : 24.0) + (in_plane ? reach(drift, t_s) : 0.0);
    pose.probe_origin_lps_mm = world.point({x_mm, 0.0, 0.0});
    pose.probe_axial = world.vector({0.0, 1.0, 0.0});
    pose.probe_lateral = world.vector(in_plane ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
    sample.recording.poses.push_back(pose);
    sample.recording.forces.push_back(
        {pose.t_s, 1.5 * std::sin(0.3 * t_s), 0.4 * std::abs(std::cos(0.7 * t_s)), 1.0});
  }
  const cases::PoseSample& last = sample.recording.poses.back();
  sample.recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, last.needle_direction};

  const double picture_hz = xray ? 7.5 : 30.0;
  for (int i = 0; i < static_cast<int>(kSampleSeconds * picture_hz); ++i) {
    const double t_s = i / picture_hz;
    cases::FrameTruth frame;
    frame.t_s = now(t_s);
    frame.live = xray ? std::sin(1.1 * t_s) > -0.2 : t_s < 8.1 || t_s > 8.9;
    frame.needle_tip = std::sin(1.7 * t_s) > -0.4;
    frame.target = std::sin(0.9 * t_s + 1.0) > -0.5;
    frame.needle_length_mm = std::max(0.0, 20.0 * std::sin(0.8 * t_s) + 5.0);
    if (xray && frame.live) {
      const double lao_deg = t_s < 5.0 ? 5.0 : t_s < 6.0 ? 5.0 + 35.0 * (t_s - 5.0) : 40.0;
      frame.beam = cases::BeamTruth{
          world.mirrored() ? -lao_deg : lao_deg,         3.0, 75.0, 20.0, 0.02, 4.0, 0.4, 1.0 / picture_hz,
          t_s > 5.0 && t_s<6.0, std::sin(2.0 * t_s)> 0.8};
    }
    if (kind.modality == cases::Modality::ultrasound)
      frame.near_plane = cases::NearPlane{t_s > 3.0, t_s<9.0, t_s> 1.0, true};
    sample.recording.frames.push_back(frame);
  }
  using enum cases::EventKind;
  const std::pair<double, cases::EventKind> said[] = {
      {0.1, sign_in},     {0.15, proceed},  {0.2, note_plan}, {0.3, aspirate},
      {0.4, anaesthetic}, {0.45, nick},     {1.6, pain_skin}, {8.0, breath_hold_request},
      {8.6, breath_held}, {9.6, pain_bone}, {10.5, cough},    {10.6, breath_lost}};
  for (const auto& [t_s, event] : said) {
    if (!sample.recording.events) sample.recording.events.emplace();
    sample.recording.events->push_back({now(t_s), event});
  }
  setting.defer_is_right = false;
  setting.breathes = setting.yields = true;
  return sample;
}

}  // namespace seldinger::assessment
