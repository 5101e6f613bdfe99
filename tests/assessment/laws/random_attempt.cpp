#include "tests/assessment/laws/random_attempt.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "tests/fixtures/meshes.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;
using Knots = std::vector<Knot>;

constexpr double kBodyMm = 150.0;  // the round body's radius

// On and off by turns, as something comes into sight and goes.
class Turns {
 public:
  Turns(Draw& draw, double end_s, double on_s, double off_s) {
    bool on = draw.chance(0.6);
    for (double t_s = 0.0; t_s < end_s; on = !on) {
      const double length_s = (on ? on_s : off_s) * draw.in(0.5, 1.6);
      if (on) on_.push_back({t_s, t_s + length_s});
      t_s += length_s;
    }
  }
  bool at(double t_s) const {
    return std::any_of(on_.begin(), on_.end(),
                       [&](const auto& one) { return t_s >= one.first && t_s < one.second; });
  }

 private:
  std::vector<std::pair<double, double>> on_;
};

cases::BeamTruth beam_at(const Knots& lao_deg, const Knots& cranial_deg, const Turns& hand, double t_s,
                         double pulse_hz) {
  cases::BeamTruth beam;
  beam.lao_deg = reach(lao_deg, t_s);
  beam.cranial_deg = reach(cranial_deg, t_s);
  beam.kv = 75.0;
  beam.ma = 20.0;
  beam.air_kerma_mgy = 0.02 + 0.01 * std::abs(std::sin(beam.lao_deg));
  beam.dap_mgy_cm2 = 150.0 * beam.air_kerma_mgy;
  beam.collimated_share = 0.3 + 0.2 * std::sin(0.4 * t_s);
  beam.beam_s = 1.0 / pulse_hz;
  const auto moves = [&](const Knots& knots) {
    return std::abs(reach(knots, t_s + 0.01) - reach(knots, t_s - 0.01)) > 1e-3;
  };
  beam.arm_moving = moves(lao_deg) || moves(cranial_deg);
  beam.hand_in_beam = hand.at(t_s);
  return beam;
}

double from_plane_mm(const cases::PoseSample& pose, const glm::dvec3& point) {
  return std::abs(glm::dot(glm::cross(pose.probe_axial, pose.probe_lateral), point - pose.probe_origin_lps_mm));
}

void add_frames(RandomAttempt& attempt, const Ways& ways, Draw& draw, bool in_plane) {
  const bool xray = attempt.setting.modality == cases::Modality::xray;
  const double end_s = ways.end_s, picture_hz = xray ? draw.in(3.0, 15.0) : draw.in(15.0, 30.0);
  const Turns live(draw, end_s, xray ? 1.5 : 6.0, xray ? 0.8 : 0.7), tip(draw, end_s, 3.0, 0.8);
  const Turns target(draw, end_s, 3.0, 0.8), hand(draw, end_s, 0.3, 2.0);
  Knots lao_deg = {{0.0, draw.in(-30.0, 30.0)}}, cranial_deg = {{0.0, draw.in(-15.0, 15.0)}};
  for (double t_s = draw.in(1.0, 3.0); t_s < end_s; t_s += draw.in(2.0, 5.0)) {
    lao_deg.push_back({t_s, lao_deg.back().value});
    lao_deg.push_back({t_s + 0.8, draw.in(-45.0, 45.0)});
    cranial_deg.push_back({t_s, cranial_deg.back().value});
    cranial_deg.push_back({t_s + 0.8, draw.in(-20.0, 20.0)});
  }
  const bool all_seen = draw.chance(0.3);  // as far as the plane has it
  const glm::dvec3 ball = attempt.setting.target ? attempt.setting.target->center_lps_mm : glm::dvec3(0, 40, 0);
  for (double t_s = draw.in(0.1, 0.9) / picture_hz; t_s < end_s; t_s += 1.0 / picture_hz) {
    const cases::PoseSample pose = pose_at(ways, t_s, in_plane);
    const double tip_mm = from_plane_mm(pose, pose.tip_lps_mm), ball_mm = from_plane_mm(pose, ball);
    cases::FrameTruth frame;
    frame.t_s = t_s;
    frame.live = live.at(t_s) || (all_seen && !xray);
    frame.needle_tip = (xray || tip_mm < 3.0) && (all_seen || tip.at(t_s)) && pose.tip_lps_mm.y > 0.0;
    frame.target = attempt.setting.target && (xray || ball_mm < 6.0) && (all_seen || target.at(t_s));
    frame.needle_length_mm = frame.needle_tip || tip.at(t_s + 0.4) ? std::max(0.0, 0.6 * pose.tip_lps_mm.y) : 0.0;
    if (xray && frame.live) frame.beam = beam_at(lao_deg, cranial_deg, hand, t_s, picture_hz);
    if (attempt.setting.modality == cases::Modality::ultrasound)
      frame.near_plane = cases::NearPlane{tip_mm < 2.0, ball_mm < 2.0, tip_mm < 5.0, ball_mm < 5.0};
    attempt.recording.frames.push_back(frame);
  }
}

// A breath held now and then, said steps before the puncture, what hurt, and trouble.
std::vector<cases::Event> events_of(const RandomAttempt& attempt, const Ways& ways, Draw& draw) {
  std::vector<cases::Event> events;
  const auto say = [&](double t_s, EventKind kind) {
    if (t_s < ways.end_s) events.push_back({t_s, kind});
  };
  constexpr EventKind kBefore[] = {EventKind::sign_in,   EventKind::proceed,  EventKind::probe_checked,
                                   EventKind::note_plan, EventKind::aspirate, EventKind::anaesthetic,
                                   EventKind::nick};
  double t_s = 0.03;
  const double share = draw.in(0.3, 1.0);
  for (const EventKind kind : kBefore) {
    t_s += 0.04;
    if (draw.chance(share)) say(t_s, kind == EventKind::proceed && draw.chance(0.2) ? EventKind::defer : kind);
  }
  if (attempt.setting.subject == cases::Subject::patient) {
    if (draw.chance(0.4)) say(ways.puncture_s + 0.5, EventKind::pain_skin);
    if (draw.chance(0.2)) say(ways.puncture_s + 1.7, EventKind::pain_bone);
    constexpr EventKind kTroubles[] = {EventKind::cough, EventKind::bleeding, EventKind::pressure_drop};
    if (draw.chance(0.3)) say(draw.in(1.0, ways.end_s), kTroubles[draw.from(0, 2)]);
    for (double at_s = draw.in(0.5, 4.0); at_s + 3.0 < ways.end_s && draw.chance(0.7); at_s += draw.in(4.0, 8.0)) {
      say(at_s, EventKind::breath_hold_request);
      say(at_s + 0.5, EventKind::breath_held);
      const double held_s = draw.in(1.0, 4.0);
      say(at_s + 0.5 + held_s, draw.chance(0.3) ? EventKind::breath_lost : EventKind::breathe_again);
    }
  }
  if (draw.chance(0.3)) say(ways.end_s - 0.05, EventKind::sign_out);
  std::stable_sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.t_s < b.t_s; });
  return events;
}

cases::Shape random_shape(const glm::dvec3& center, Draw& draw) {
  const int kind = draw.from(0, 3);
  if (kind <= 1) return cases::Sphere{center, draw.in(3.0, 14.0)};
  if (kind == 2) {
    const glm::dvec3 along = draw.direction() * draw.in(10.0, 40.0);
    return cases::Tube{{center - along, center, center + along + draw.direction() * 5.0}, draw.in(1.5, 5.0)};
  }
  cases::VoxelSet voxels;
  voxels.size = {draw.from(2, 5), draw.from(2, 5), draw.from(2, 5)};
  const double edge_mm = draw.in(2.0, 5.0);
  voxels.spacing_mm = glm::dvec3(edge_mm);
  glm::dmat4 lps_from_voxel(edge_mm);
  lps_from_voxel[3] = glm::dvec4(center - 0.5 * edge_mm * glm::dvec3(voxels.size), 1.0);
  voxels.voxel_from_lps = glm::inverse(lps_from_voxel);
  voxels.member.resize(static_cast<std::size_t>(voxels.size.x * voxels.size.y * voxels.size.z));
  for (std::uint8_t& one : voxels.member) one = draw.chance(0.8) ? 1 : 0;
  return voxels;
}

// Beside the needle's way, or across it.
void add_structures(RandomAttempt& attempt, const Ways& ways, Draw& draw) {
  using enum cases::StructureRule;
  const glm::dvec3 way = needle_direction(ways, ways.end_s);
  for (const auto rule : {advisory, major, critical, must_cross, organ, target}) {
    const bool lumen = rule == target;
    if (!draw.chance(lumen ? 0.3 : 0.55)) continue;
    cases::Structure one;
    one.name = std::string(cases::name_of(rule));
    one.rule = rule;
    const glm::dvec3 ball = attempt.setting.target ? attempt.setting.target->center_lps_mm : way * 40.0;
    const bool on_ball = lumen || rule == organ;
    const glm::dvec3 center = on_ball ? ball : way * draw.in(15.0, 60.0) + draw.direction() * draw.in(0.0, 12.0);
    if (lumen && draw.chance(0.5))
      one.shape = cases::Tube{{center - draw.direction() * 20.0, center, center + draw.direction() * 20.0},
                              draw.in(4.0, 9.0)};
    else if (on_ball)
      one.shape = cases::Sphere{center, lumen ? draw.in(4.0, 9.0) : draw.in(15.0, 30.0)};
    else
      one.shape = random_shape(center, draw);
    attempt.structures.push_back(std::move(one));
  }
}

void add_skin(RandomAttempt& attempt, Draw& draw) {
  auto mesh = std::make_shared<cases::Mesh>();
  if (draw.chance(0.4))
    *mesh = fixtures::box_mesh({-256, 0, -256}, {256, 256, 256});
  else
    *mesh = fixtures::sphere_mesh({0, kBodyMm, 0}, kBodyMm, 3);
  attempt.skin = std::make_shared<cases::MeshIndex>(*mesh);
  attempt.mesh = std::move(mesh);
}

void add_setting(RandomAttempt& attempt, const Ways& ways, Draw& draw) {
  AttemptSetting& setting = attempt.setting;
  setting.instrument.throw_mm = draw.in(10.0, 22.0);
  setting.instrument.notch_mm = setting.instrument.throw_mm - draw.in(2.0, 4.0);
  setting.instrument.dead_tip_mm = 1.0;
  const glm::dvec3 end = tip_at(ways, ways.end_s), way = needle_direction(ways, ways.end_s);
  const bool core = setting.instrument.kind == cases::InstrumentKind::core;
  if (draw.chance(0.92)) {
    const double beyond_mm = core ? 0.5 * setting.instrument.throw_mm : 0.0;
    const double off_mm = draw.chance(0.6) ? draw.in(0.0, 5.0) : draw.in(5.0, 25.0);
    setting.target = cases::Lesion{end + way * beyond_mm + draw.direction() * off_mm, draw.in(4.0, 12.0), 20.0};
  }
  if (draw.chance(0.85))
    setting.plan = PlannedEntry{{draw.in(-4.0, 4.0), 0.0, draw.in(-4.0, 4.0)},
                                glm::normalize(needle_direction(ways, 0.0) + 0.1 * draw.direction())};
  setting.subject = draw.chance(0.85) ? cases::Subject::patient : cases::Subject::phantom;
  setting.position = draw.chance(0.7) ? cases::PatientPosition::supine : cases::PatientPosition::prone;
  if (draw.chance(0.7)) setting.defer_is_right = draw.chance(0.25);
  setting.breathes = setting.subject == cases::Subject::patient && draw.chance(0.65);
  setting.yields = draw.chance(0.5);
}

void add_poses(RandomAttempt& attempt, const Ways& ways, Draw& draw, bool in_plane) {
  cases::Recording& recording = attempt.recording;
  const bool forces = draw.chance(0.6), silent = draw.chance(0.1);
  const double silence_s = draw.in(1.0, ways.end_s - 1.0), phase = draw.in(0.0, 6.0);
  const auto count = static_cast<int>(std::floor(ways.end_s * attempt.pose_hz));
  for (int i = 0; i <= count; ++i) {
    const double t_s = i / attempt.pose_hz;
    if (silent && t_s > silence_s && t_s < silence_s + 0.6) continue;  // a gap at any speed
    recording.poses.push_back(pose_at(ways, t_s, in_plane));
    const double depth_mm = std::max(0.0, reach(ways.depth_mm, t_s));
    if (forces)
      recording.forces.push_back({t_s, 0.03 * depth_mm * (1.0 + 0.3 * std::sin(2.0 * t_s + phase)),
                                  0.01 * depth_mm * std::abs(std::cos(0.7 * t_s + phase)), 1.0});
  }
  if (!draw.chance(0.75)) return;
  const cases::PoseSample& last = recording.poses.back();
  recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, last.needle_direction};
  if (!draw.chance(0.5)) return;
  for (int i = 1; i <= 60; ++i) {  // and out again
    recording.poses.push_back(pose_at(ways, ways.end_s, in_plane));
    recording.poses.back().t_s = recording.endpoint->t_s + i / attempt.pose_hz;
    recording.poses.back().tip_lps_mm -= recording.endpoint->direction * (1.6 * i);
  }
}

RandomAttempt begun(std::uint64_t seed, Draw& draw) {
  RandomAttempt attempt;
  attempt.seed = seed;
  constexpr double kRates[] = {100.0, 125.0, 160.0, 190.0};
  attempt.pose_hz = kRates[draw.from(0, 3)];
  constexpr cases::Modality kModalities[] = {cases::Modality::mpr, cases::Modality::ultrasound,
                                             cases::Modality::ultrasound, cases::Modality::xray};
  attempt.setting.modality = kModalities[draw.from(0, 3)];
  attempt.setting.probe_suits = cases::DepthRange{0.0, 50.0};
  attempt.setting.approach = draw.chance(0.65) ? cases::Approach::in_plane : cases::Approach::out_of_plane;
  attempt.setting.instrument.kind = draw.chance(0.6) ? cases::InstrumentKind::access : cases::InstrumentKind::core;
  return attempt;
}

bool in_plane(const RandomAttempt& attempt) {
  return attempt.setting.modality == cases::Modality::xray || attempt.setting.approach == cases::Approach::in_plane;
}

// One per pose: 0 breathed out to 1 breathed in; a held breath stays.
std::vector<double> breath_of(const cases::Recording& recording) {
  constexpr double kPeriodS = 3.7;
  std::vector<double> level;
  double phase_s = 0.0, before_s = 0.0;
  for (const cases::PoseSample& pose : recording.poses) {
    bool held = false;
    for (const cases::Event& one : recording.events.value_or(std::vector<cases::Event>{})) {
      if (one.t_s > pose.t_s) break;
      if (one.kind == EventKind::breath_held) held = true;
      if (one.kind == EventKind::breath_lost || one.kind == EventKind::breathe_again) held = false;
    }
    if (!held) phase_s += pose.t_s - before_s;
    before_s = pose.t_s;
    level.push_back(0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * phase_s / kPeriodS));
  }
  return level;
}

const glm::dvec3 kBreathWay = glm::normalize(glm::dvec3(0.0, 0.35, 1.0));

void keep_endpoint(cases::Recording& recording) {
  if (!recording.endpoint) return;
  for (const cases::PoseSample& pose : recording.poses)
    if (pose.t_s == recording.endpoint->t_s) {
      recording.endpoint->tip_lps_mm = pose.tip_lps_mm;
      recording.endpoint->rest_tip_lps_mm = pose.rest_tip_lps_mm;
    }
}

}  // namespace

base::Result<Signals> RandomAttempt::signals() const {
  AttemptSetting here = setting;
  here.skin = skin.get();
  here.structures = structures;
  return make_signals(here, recording);
}

std::string RandomAttempt::words() const {
  return "seed " + std::to_string(seed) + ": " +
         std::string(base::name_of(cases::kModalityNames, setting.modality)) + " " +
         std::string(base::name_of(cases::kApproachNames, setting.approach)) + ", " +
         std::string(base::name_of(cases::kInstrumentKindNames, setting.instrument.kind)) + " needle" +
         (setting.breathes ? ", breathing" : "");
}

RandomAttempt random_attempt_at_rest(std::uint64_t seed) {
  Draw draw(seed);
  RandomAttempt attempt = begun(seed, draw);
  const bool along = in_plane(attempt);
  const Ways ways = random_ways(draw, along);
  add_skin(attempt, draw);
  add_setting(attempt, ways, draw);
  add_structures(attempt, ways, draw);
  add_poses(attempt, ways, draw, along);
  add_frames(attempt, ways, draw, along);
  if (draw.chance(0.93)) attempt.recording.events = events_of(attempt, ways, draw);
  return attempt;
}

RandomAttempt random_attempt(std::uint64_t seed) {
  RandomAttempt attempt = random_attempt_at_rest(seed);
  Draw draw(~seed);
  if (attempt.setting.breathes) ride_on_breath(attempt, draw.in(4.0, 14.0));
  return attempt;
}

RandomAttempt nothing_done(std::uint64_t seed) {
  RandomAttempt attempt = random_attempt_at_rest(seed);
  cases::Recording& recording = attempt.recording;
  recording.endpoint.reset();
  const cases::PoseSample rest = recording.poses.front();
  for (cases::PoseSample& pose : recording.poses) {
    const double t_s = pose.t_s;
    pose = rest;
    pose.t_s = t_s;
  }
  for (cases::ForceSample& force : recording.forces) force = {force.t_s, 0.0, 0.0, 0.0};
  for (cases::FrameTruth& frame : recording.frames) {
    frame.needle_tip = false;
    frame.needle_length_mm = 0.0;
    if (!frame.beam) continue;
    frame.beam.reset();
    frame.live = false;
  }
  recording.events.emplace();
  return attempt;
}

void ride_on_breath(RandomAttempt& attempt, double amplitude_mm) {
  const std::vector<double> level = breath_of(attempt.recording);
  for (std::size_t i = 0; i < level.size(); ++i) {
    cases::PoseSample& pose = attempt.recording.poses[i];
    const glm::dvec3 moved = kBreathWay * (amplitude_mm * level[i]);
    pose.rest_tip_lps_mm = pose.tip_lps_mm;
    pose.tip_lps_mm += moved;
    pose.probe_origin_lps_mm += moved;
  }
  keep_endpoint(attempt.recording);
}

void slide_under_hands(RandomAttempt& attempt, double amplitude_mm) {
  const std::vector<double> level = breath_of(attempt.recording);
  for (std::size_t i = 0; i < level.size(); ++i) {
    cases::PoseSample& pose = attempt.recording.poses[i];
    const double depth = std::clamp(pose.tip_lps_mm.y / 20.0, 0.0, 1.0);
    const double share = depth * depth * (3.0 - 2.0 * depth);
    pose.rest_tip_lps_mm = pose.tip_lps_mm - pose.needle_direction * (amplitude_mm * level[i] * share);
  }
  keep_endpoint(attempt.recording);
}

}  // namespace seldinger::assessment
