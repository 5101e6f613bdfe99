// Bad trajectories, one test each: a null with its reason or a clear error; never NaN, never 0
// for what is not known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "assessment/metrics/quality.h"
#include "assessment/registry.h"
#include "sim/base/rng.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const SampleKind kInPlane = kSampleKinds[2];  // ultrasound, access

struct Answer {
  std::map<std::string, MetricValue> values;
  std::string error;

  std::optional<double> operator[](const char* id) const { return values.at(id).value; }
  std::string reason(const char* id) const { return values.at(id).reason; }
  std::string not_graded() const {
    std::vector<MetricValue> metrics;
    for (const auto& [id, metric] : values) metrics.push_back(metric);
    return why_not_gradable(metrics);
  }
};

// Every value is finite, every null has a reason.
Answer measured(const SampleAttempt& sample) {
  Answer answer;
  const auto signals = sample.signals();
  if (!signals) {
    answer.error = signals.error().code;
    EXPECT_GT(signals.error().text.size(), 10U);
    return answer;
  }
  for (const MetricValue& metric : measure_all(*signals)) {
    if (metric.value) {
      EXPECT_TRUE(std::isfinite(*metric.value)) << metric.id;
    } else {
      EXPECT_GT(metric.reason.size(), 0U) << metric.id;
      EXPECT_NE(metric.reason, "not_finite") << metric.id;
    }
    answer.values[metric.id] = metric;
  }
  return answer;
}

SampleAttempt usual(const SampleKind& kind = kInPlane) {
  return sample_attempt(kind);
}

cases::Endpoint endpoint_of(const cases::PoseSample& pose) {
  return {pose.t_s, pose.tip_lps_mm, pose.needle_direction};
}

TEST(BadTrajectory, NoSampleIsAnError) {
  auto sample = usual();
  sample.recording.poses.clear();
  EXPECT_EQ(measured(sample).error, "bad_poses");
}

TEST(BadTrajectory, OneSample) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    sample.recording.poses.resize(1);
    sample.recording.endpoint = endpoint_of(sample.recording.poses[0]);
    const Answer answer = measured(sample);
    EXPECT_EQ(answer["path_tip"], 0.0) << "one place is no way";
    EXPECT_EQ(answer.reason("gap_share"), "too_short");
    EXPECT_EQ(answer.reason("sample_rate_p5"), "too_short");
    EXPECT_EQ(answer.reason("ldlj"), "no_movement");
    EXPECT_EQ(answer.not_graded(), "too_short");
  }
}

TEST(BadTrajectory, TwoSamples) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    sample.recording.poses = {sample.recording.poses[0], sample.recording.poses[1]};
    sample.recording.endpoint.reset();
    const Answer answer = measured(sample);
    EXPECT_NEAR(*answer["time_total"], 0.01, 1e-9);
    EXPECT_EQ(answer.reason("path_inefficiency"), "not_in_tissue_at_the_end");
  }
}

TEST(BadTrajectory, NotANumberOrInfiniteIsAnError) {
  for (const double bad : {kNan, kInf, -kInf}) {
    for (int what = 0; what < 6; ++what) {
      auto sample = usual();
      cases::PoseSample& pose = sample.recording.poses[300];
      (what == 0   ? pose.t_s
       : what == 1 ? pose.tip_lps_mm.y
       : what == 2 ? pose.needle_direction.x
       : what == 3 ? pose.probe_origin_lps_mm.z
       : what == 4 ? pose.probe_axial.y
                   : pose.probe_lateral.x) = bad;
      EXPECT_EQ(measured(sample).error, "bad_poses") << what;
    }
    auto sample = usual();
    sample.recording.frames[3].t_s = bad;
    EXPECT_EQ(measured(sample).error, "bad_frames");
    sample = usual();
    sample.recording.forces[7].needle_lateral_n = bad;
    EXPECT_EQ(measured(sample).error, "bad_forces");
    sample = usual();
    sample.recording.endpoint->tip_lps_mm.x = bad;
    EXPECT_EQ(measured(sample).error, "bad_poses");
    sample = usual();
    sample.setting.plan->entry_lps_mm.x = bad;
    EXPECT_EQ(measured(sample).error, "bad_plan");
  }
}

// Finite, but not their squares: a shape of these had no end.
TEST(BadTrajectory, PlacesAndTimesOutOfReachAreAnError) {
  for (const double bad : {1e160, -1e300, 2e7}) {
    auto sample = usual();
    sample.recording.poses[50].tip_lps_mm.x = bad;
    EXPECT_EQ(measured(sample).error, "bad_poses") << bad;
    sample = usual();
    sample.recording.poses[50].probe_origin_lps_mm.z = bad;
    EXPECT_EQ(measured(sample).error, "bad_poses") << bad;
    sample = usual();
    sample.recording.poses.back().t_s = bad;
    EXPECT_EQ(measured(sample).error, "bad_poses") << bad;
  }
}

TEST(BadTrajectory, NonUnitOrZeroDirectionIsAnError) {
  for (const double scale : {0.0, 0.5, 2.0}) {
    auto sample = usual();
    sample.recording.poses[10].needle_direction *= scale;
    EXPECT_EQ(measured(sample).error, "bad_poses");
    sample = usual();
    sample.recording.poses[10].probe_lateral *= scale;
    EXPECT_EQ(measured(sample).error, "bad_poses");
  }
}

// What a flipped quaternion is where axes are vectors: a needle that turns about from one pose to the next.
TEST(BadTrajectory, FlippedDirectionStaysFinite) {
  auto sample = usual();
  for (std::size_t i = 500; i < 600; ++i) sample.recording.poses[i].needle_direction *= -1.0;
  EXPECT_EQ(measured(sample).error, "");
}

TEST(BadTrajectory, BackwardsTimeIsAnErrorAndARepeatedOneIsNothing) {
  auto sample = usual();
  std::swap(sample.recording.poses[10].t_s, sample.recording.poses[11].t_s);
  EXPECT_EQ(measured(sample).error, "bad_poses");
  sample = usual();
  sample.recording.poses[11].t_s = sample.recording.poses[10].t_s;
  EXPECT_NEAR(*measured(sample)["path_tip"], *measured(usual())["path_tip"], 0.05);
}

TEST(BadTrajectory, FiveSecondGap) {
  auto sample = usual();
  std::erase_if(sample.recording.poses, [](const auto& pose) { return pose.t_s > 4.6 && pose.t_s < 9.6; });
  const Answer answer = measured(sample);
  EXPECT_NEAR(*answer["gap_share"], 5.0 / 13.5, 0.002);
  EXPECT_LT(*answer["path_tip"], *measured(usual())["path_tip"] - 40.0) << "it is not bridged";
  EXPECT_NEAR(*answer["time_in_tissue"], *measured(usual())["time_in_tissue"] - 5.0, 0.02);
  EXPECT_EQ(answer.not_graded(), "tracking_gaps");
}

TEST(BadTrajectory, DeviceUnpluggedMidTissue) {
  auto sample = usual();
  std::erase_if(sample.recording.poses, [](const auto& pose) { return pose.t_s > 5.0; });
  sample.recording.endpoint.reset();
  const Answer answer = measured(sample);
  for (const char* id :
       {"hit", "tip_target_dist", "first_pass_success", "time_puncture_to_target", "back_wall_dist"})
    EXPECT_EQ(answer.reason(id), "no_endpoint") << id;
  EXPECT_EQ(answer["skin_punctures"], 1.0);
}

TEST(BadTrajectory, BurstOfAKilohertzThenTenHertz) {
  auto sample = sample_attempt(kInPlane, {1000.0});
  std::vector<cases::PoseSample> kept;
  for (const cases::PoseSample& pose : sample.recording.poses)
    if (pose.t_s < 9.0 || kept.empty() || pose.t_s - kept.back().t_s > 0.0995) kept.push_back(pose);
  sample.recording.poses = kept;
  const Answer answer = measured(sample);
  EXPECT_NEAR(*answer["sample_rate_p5"], 10.0, 0.1) << "of the time, not of the samples";
  EXPECT_EQ(answer.not_graded(), "tracking_slow");
  EXPECT_NEAR(*answer["path_tip"], *measured(usual())["path_tip"], 2.0);
}

TEST(BadTrajectory, Teleport) {
  auto sample = usual();
  for (std::size_t i = 400; i < 420; ++i) sample.recording.poses[i].tip_lps_mm += glm::dvec3(500.0, 0.0, 0.0);
  const Answer answer = measured(sample);
  EXPECT_EQ(answer["tracking_jumps"], 2.0);
  EXPECT_EQ(answer.not_graded(), "tracking_jumps");
  EXPECT_NEAR(*answer["path_tip"], *measured(usual())["path_tip"], 10.0) << "500 mm in 10 ms are no way";
}

TEST(BadTrajectory, NeedleNeverEnters) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    for (auto& pose : sample.recording.poses) pose.tip_lps_mm.y = -20.0 - pose.t_s;
    sample.recording.endpoint = endpoint_of(sample.recording.poses.back());
    const Answer answer = measured(sample);
    EXPECT_EQ(answer["skin_punctures"], 0.0);
    EXPECT_EQ(answer["time_in_tissue"], 0.0);
    EXPECT_EQ(answer["path_in_tissue"], 0.0);
    EXPECT_EQ(answer.reason("time_puncture_to_target"), "never_punctured");
    EXPECT_EQ(answer.reason("entry_angle_error"), "never_punctured");
    EXPECT_EQ(answer.reason("clearance_min"), "never_in_tissue");
    EXPECT_EQ(answer.reason("path_inefficiency"), "not_in_tissue_at_the_end");
    EXPECT_FALSE(answer["vis_target"].has_value());
  }
}

TEST(BadTrajectory, EntersAndExitsByAMicrometre) {
  auto sample = usual();
  for (auto& pose : sample.recording.poses) pose.tip_lps_mm.y = 0.001 * std::sin(40.0 * pose.t_s);
  sample.recording.endpoint = endpoint_of(sample.recording.poses.back());
  const Answer answer = measured(sample);
  EXPECT_EQ(answer["skin_punctures"], 0.0);
  EXPECT_EQ(answer["withdrawals_full"], 0.0);
  EXPECT_EQ(answer["withdrawals_partial"], 0.0);
  EXPECT_LT(*answer["blind_advance"], 0.2) << "it slides along the skin";
}

TEST(BadTrajectory, EndpointFiredOutsideTheBody) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    std::erase_if(sample.recording.poses, [](const auto& pose) { return pose.t_s > 1.0; });
    sample.recording.endpoint = endpoint_of(sample.recording.poses.back());
    const Answer answer = measured(sample);
    EXPECT_EQ(answer["hit"], 0.0);
    EXPECT_EQ(answer.reason("must_cross_length"), "not_in_tissue_at_the_end");
    EXPECT_EQ(answer.reason("back_wall_dist"), "not_in_target_structure");
    EXPECT_EQ(answer.reason("first_pass_success"), "never_punctured");
  }
}

// A recording has one endpoint; what comes after it is not looked at (the first row with a trigger counts:
// csv_test).
TEST(BadTrajectory, TwoEndpointsCountToTheFirst) {
  auto longer = usual();
  auto shorter = usual();
  longer.recording.endpoint = endpoint_of(longer.recording.poses[900]);
  shorter.recording.endpoint = longer.recording.endpoint;
  shorter.recording.poses.resize(901);
  std::erase_if(shorter.recording.frames, [&](const auto& f) { return f.t_s > shorter.recording.endpoint->t_s; });
  const Answer one = measured(longer), other = measured(shorter);
  for (const auto& [id, metric] : one.values) EXPECT_EQ(metric.value, other.values.at(id).value) << id;
}

TEST(BadTrajectory, EndpointBeforeTheFirstPoseIsAnError) {
  auto sample = usual();
  sample.recording.endpoint->t_s = -1.0;
  EXPECT_EQ(measured(sample).error, "bad_poses");
}

TEST(BadTrajectory, TargetOfZeroVolumeIsAnError) {
  for (const double radius_mm : {0.0, -1.0, kNan, kInf}) {
    auto sample = usual();
    sample.setting.target->radius_mm = radius_mm;
    EXPECT_EQ(measured(sample).error, "bad_target") << radius_mm;
  }
}

TEST(BadTrajectory, TargetTouchingTheSkin) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    sample.setting.target = cases::Lesion{{0.0, 4.0, 0.0}, 5.0, 20.0};
    std::erase_if(sample.structures, [](const auto& one) { return one.rule == cases::StructureRule::target; });
    const Answer answer = measured(sample);
    EXPECT_EQ(answer["hit"], 0.0);
    EXPECT_LT(*answer["closest_approach"], 2.0);
  }
}

TEST(BadTrajectory, OverlappingNoGoAndTarget) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    sample.structures = {sample.structures.back(), sample.structures.back()};
    sample.structures[0].rule = cases::StructureRule::critical;
    const Answer answer = measured(sample);
    EXPECT_GE(*answer["nogo_contacts"], 1.0) << "a hit does not excuse it";
    EXPECT_EQ(answer["back_wall_dist"].has_value(), true);
  }
}

TEST(BadTrajectory, EmptyStructuresAreFarAway) {
  auto sample = usual();
  for (cases::Structure& structure : sample.structures) structure.shape = cases::VoxelSet{};
  const Answer answer = measured(sample);
  EXPECT_EQ(answer["nogo_contacts"], 0.0);
  EXPECT_EQ(answer["clearance_min"], 20.0);
  EXPECT_EQ(answer.reason("back_wall_dist"), "not_in_target_structure");
}

TEST(BadTrajectory, InsideOutSkinIsAnError) {
  auto mesh = fixtures::box_mesh({-256, 0, -256}, {256, 256, 256});
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.x, triangle.y);
  auto sample = usual();
  sample.skin = cases::MeshIndex(mesh);
  EXPECT_EQ(measured(sample).error, "bad_skin");
}

TEST(BadTrajectory, UnclosedAndNonManifoldSkinStayFinite) {
  auto open = fixtures::box_mesh({-256, 0, -256}, {256, 256, 256});
  open.triangles.resize(10);
  open.cut.resize(10);
  auto doubled = fixtures::box_mesh({-256, 0, -256}, {256, 256, 256});
  doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(), doubled.triangles.begin() + 5);
  doubled.triangles.push_back({0, 0, 3});
  doubled.cut.resize(doubled.triangles.size(), 0);
  for (const auto& mesh : {open, doubled}) {
    auto sample = usual();
    sample.skin = cases::MeshIndex(mesh);
    const Answer answer = measured(sample);
    EXPECT_EQ(answer.error, "");
    EXPECT_EQ(answer["hit"], 1.0) << "the target is where it is, whatever the skin";
    EXPECT_GT(answer["path_tip"].value_or(0.0), 10.0);
  }
}

// Nobody can tell metres from millimetres by looking; nothing of it is a hit, and what needs a puncture is null.
TEST(BadTrajectory, MetresForMillimetres) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    for (auto& pose : sample.recording.poses) {
      pose.tip_lps_mm /= 1000.0;
      pose.probe_origin_lps_mm /= 1000.0;
    }
    sample.recording.endpoint->tip_lps_mm /= 1000.0;
    const Answer answer = measured(sample);
    EXPECT_EQ(answer["hit"], 0.0);
    EXPECT_EQ(answer.reason("time_puncture_to_target"), "never_punctured");
    EXPECT_EQ(answer.reason("path_inefficiency"), "under_5_mm_from_the_skin");
    EXPECT_EQ(answer.reason("ldlj"), "no_movement");
  }
}

TEST(BadTrajectory, LpsForRas) {
  for (const SampleKind& kind : kSampleKinds) {
    auto sample = usual(kind);
    const glm::dvec3 flip(-1.0, -1.0, 1.0);
    for (auto& pose : sample.recording.poses) {
      pose.tip_lps_mm *= flip;
      pose.needle_direction *= flip;
      pose.probe_origin_lps_mm *= flip;
    }
    sample.recording.endpoint = endpoint_of(sample.recording.poses.back());
    const Answer answer = measured(sample);
    EXPECT_EQ(answer["hit"], 0.0);
    EXPECT_GT(*answer["tip_target_dist"], 50.0);
  }
}

TEST(BadTrajectory, LeftHandedOrDegenerateProbeAxes) {
  auto sample = usual();
  const Answer right = measured(sample);
  for (auto& pose : sample.recording.poses) pose.probe_lateral *= -1.0;
  const Answer left = measured(sample);
  EXPECT_NEAR(*left["plane_angle_mean"], *right["plane_angle_mean"], 1e-9) << "a plane has no hand";
  for (auto& pose : sample.recording.poses) pose.probe_lateral = pose.probe_axial;
  EXPECT_EQ(measured(sample).reason("plane_angle_mean"), "no_picture_plane");
  auto across = usual(kSampleKinds[4]);
  for (auto& pose : across.recording.poses) pose.probe_lateral = pose.probe_axial;
  EXPECT_EQ(measured(across).reason("advance_beyond_plane"), "no_picture_plane");
}

TEST(BadTrajectory, ClocksThatDriftByOnePercent) {
  auto sample = usual();
  const Answer right = measured(sample);
  for (auto& frame : sample.recording.frames) frame.t_s *= 1.01;
  const Answer drifted = measured(sample);
  EXPECT_NEAR(*drifted["vis_needle"], *right["vis_needle"], 0.03);
  EXPECT_NEAR(*drifted["blind_advance"], *right["blind_advance"], 6.0);
}

// Times are seconds of a session's own clock: midnight, a change to summer time or a leap second are no time in it.
TEST(BadTrajectory, SessionOverMidnight) {
  const Answer day = measured(usual()), night = measured(sample_attempt(kInPlane, {100.0, 86'395.0}));
  for (const auto& [id, metric] : day.values) {
    ASSERT_EQ(metric.value.has_value(), night.values.at(id).value.has_value()) << id;
    if (metric.value) {
      EXPECT_NEAR(*metric.value, *night[id.c_str()], 1e-6 * (1.0 + std::abs(*metric.value))) << id;
    }
  }
}

// Whatever comes: jumps, rests, gaps, any direction, structures anywhere. measured() asserts.
TEST(BadTrajectory, AnyWayStaysFinite) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    base::Rng rng(seed);
    const auto anywhere = [&](double mm) {
      return mm * glm::dvec3(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5);
    };
    const auto direction = [&] {
      const glm::dvec3 v = anywhere(2.0);
      return glm::length(v) > 1e-3 ? glm::normalize(v) : glm::dvec3(1, 0, 0);
    };
    auto sample = usual(kSampleKinds[seed % std::size(kSampleKinds)]);
    for (cases::Structure& structure : sample.structures)
      structure.shape = cases::Sphere{anywhere(100.0), 20.0 * rng.uniform() + 1e-9};
    sample.setting.target->center_lps_mm = anywhere(100.0);
    sample.recording.poses.resize(1 + static_cast<std::size_t>(rng.uniform() * 400.0));
    glm::dvec3 tip = anywhere(100.0);
    double t_s = 0.0;
    for (auto& pose : sample.recording.poses) {
      t_s += rng.uniform() < 0.02 ? rng.uniform() : 0.001 + 0.02 * rng.uniform();
      if (rng.uniform() < 0.05) tip = anywhere(rng.uniform() < 0.5 ? 100.0 : 1e4);
      if (rng.uniform() < 0.7) tip += anywhere(2.0);
      pose = {t_s, tip, direction(), anywhere(100.0), direction(), direction()};
    }
    sample.recording.endpoint = endpoint_of(sample.recording.poses.back());
    if (rng.uniform() < 0.3) sample.recording.endpoint.reset();
    EXPECT_EQ(measured(sample).error, "") << seed;
  }
}

TEST(BadTrajectory, SystemClockSetBackIsAnError) {
  auto sample = usual();
  for (std::size_t i = 600; i < sample.recording.poses.size(); ++i) sample.recording.poses[i].t_s -= 3600.0;
  EXPECT_EQ(measured(sample).error, "bad_poses");
}

}  // namespace
}  // namespace seldinger::assessment
