// Laws that every metric keeps, for attempts of every modality and approach.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "assessment/metrics/quality.h"
#include "assessment/registry.h"
#include "sim/base/rng.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

using Values = std::map<std::string, MetricValue>;

Values measured(const SampleAttempt& sample) {
  const auto signals = sample.signals();
  EXPECT_TRUE(signals.has_value()) << sample.name << ": " << (signals ? "" : signals.error().text);
  Values values;
  if (signals)
    for (const MetricValue& metric : measure_all(*signals)) values[metric.id] = metric;
  return values;
}

bool counted(const MetricValue& metric) {
  return metric.unit == "count" || metric.unit == "bool";
}

// Of a detour in percent, what counts is the way.
double magnitude(const MetricValue& metric) {
  return metric.unit == "%" ? 100.0 + *metric.value : 1.0 + std::abs(*metric.value);
}

void expect_same(const Values& here, const Values& there, double relative, const std::string& name,
                 const std::set<std::string>& but = {}) {
  ASSERT_EQ(here.size(), registry().size());
  ASSERT_EQ(there.size(), registry().size());
  for (const auto& [id, metric] : here) {
    if (but.contains(id)) continue;
    const MetricValue& other = there.at(id);
    ASSERT_EQ(metric.value.has_value(), other.value.has_value()) << name << ", " << id << ": " << other.reason;
    EXPECT_EQ(metric.reason, other.reason) << name << ", " << id;
    if (!metric.value) continue;
    if (counted(metric))
      EXPECT_EQ(*metric.value, *other.value) << name << ", " << id;
    else
      EXPECT_NEAR(*metric.value, *other.value, relative * magnitude(metric)) << name << ", " << id;
  }
}

TEST(EveryMetric, HasAValueInSomeOfTheseAttempts) {
  std::set<std::string> without;
  for (const MetricInfo& info : registry()) without.insert(info.id);
  for (const SampleKind& kind : kSampleKinds)
    for (const auto& [id, metric] : measured(sample_attempt(kind)))
      if (metric.value) without.erase(id);
  for (const std::string& id : without) ADD_FAILURE() << "the laws say nothing about " << id;
}

TEST(EveryMetric, IsTheSameInAnotherFrameOfReference) {
  // Turned by 90° about z and shifted: the skin's float vertices stay exact.
  World turned;
  turned.turn = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  turned.shift = {512, -1024, 256};
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    expect_same(measured(here), measured(sample_attempt(kind, {}, turned)), 1e-7, here.name);
  }
}

// What is met and reached lies in the tissue: a patient who breathes under the needle, which goes with him, changes
// nothing of it; how the hand went is another thing.
TEST(EveryMetric, OfTissueIsToldInThePatientAtRest) {
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    auto breathing = here;
    const auto moved = [](const glm::dvec3& p, double t_s) {
      return p + glm::dvec3(0.0, 2.0, 8.0) * std::sin(1.5 * t_s);
    };
    for (cases::PoseSample& pose : breathing.recording.poses) {
      pose.rest_tip_lps_mm = pose.tip_lps_mm;
      pose.tip_lps_mm = moved(pose.tip_lps_mm, pose.t_s);
    }
    cases::Endpoint& end = *breathing.recording.endpoint;
    end.rest_tip_lps_mm = end.tip_lps_mm;
    end.tip_lps_mm = moved(end.tip_lps_mm, end.t_s);
    const Values still = measured(here), moving = measured(breathing);
    std::set<std::string> of_the_hand;
    int of_tissue = 0;
    for (const MetricInfo& info : registry())
      if (info.group == Group::target || info.group == Group::safety)
        ++of_tissue;
      else
        of_the_hand.insert(info.id);
    EXPECT_GT(of_tissue, 15);
    expect_same(still, moving, 1e-12, here.name, of_the_hand);
    // The way is the tissue's: a hand that breathes along goes no further (in version 2 it did, by over 20 mm).
    EXPECT_NEAR(*moving.at("path_tip").value, *still.at("path_tip").value, 0.01 * *still.at("path_tip").value)
        << here.name;
  }
}

TEST(EveryMetric, OfAMirroredCaseIsTheSame) {
  World mirrored;
  mirrored.turn[0][0] = -1.0;
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    expect_same(measured(here), measured(sample_attempt(kind, {}, mirrored)), 1e-7, here.name);
  }
}

TEST(EveryMetric, IsTheSameAtAnotherTime) {
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    expect_same(measured(here), measured(sample_attempt(kind, {100.0, 86'390.0})), 1e-6, here.name);
  }
}

TEST(EveryMetric, DoesNotChangeWithRepeatedSamples) {
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    auto doubled = here;
    doubled.recording.poses.clear();
    for (const auto& pose : here.recording.poses)
      doubled.recording.poses.insert(doubled.recording.poses.end(), 2, pose);
    expect_same(measured(here), measured(doubled), 0.0, here.name);
  }
}

TEST(EveryMetric, BarelyChangesWithTheSamplingRate) {
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    for (const double rate_hz : {200.0, 1000.0})
      expect_same(measured(here), measured(sample_attempt(kind, {rate_hz})), 0.01,
                  here.name + " at " + std::to_string(rate_hz), {"sample_rate_p5"});
  }
}

// Anything that divides by time, or is one.
const std::set<std::string> kOfTime = {"time_total",
                                       "time_in_tissue",
                                       "time_puncture_to_target",
                                       "time_talk",
                                       "time_search",
                                       "time_needle",
                                       "nogo_time",
                                       "gap_share",
                                       "vis_joint",
                                       "vis_needle",
                                       "vis_shaft",
                                       "vis_target",
                                       "vis_joint_session",
                                       "vis_joint_2_mm",
                                       "vis_joint_5_mm",
                                       "visible_needle_length"};

TEST(EveryMetric, OfAnIdleSecondKnowsOnlyItsTime) {
  for (const SampleKind& kind : kSampleKinds) {
    const auto here = sample_attempt(kind);
    for (const double at_s : {0.0, kSampleRestS, kSampleDeepRestS, kSampleSeconds}) {
      const auto idle = measured(sample_attempt(kind, {100.0, 0.0, at_s}));
      expect_same(measured(here), idle, 1e-6, here.name + " idle at " + std::to_string(at_s), kOfTime);
      EXPECT_NEAR(*idle.at("time_total").value, kSampleSeconds + 1.0, 1e-9);
    }
  }
}

TEST(EveryMetric, BearsTheNoiseOfATracker) {
  for (const SampleKind& kind : kSampleKinds)
    for (const double rate_hz : {100.0, 1000.0})
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto here = sample_attempt(kind, {rate_hz});
        auto noisy = here;
        base::Rng rng(seed);
        for (auto& pose : noisy.recording.poses)
          for (glm::dvec3* point : {&pose.tip_lps_mm, &pose.probe_origin_lps_mm})
            *point += 0.05 * glm::dvec3(rng.normal(), rng.normal(), rng.normal());
        noisy.recording.endpoint->tip_lps_mm = noisy.recording.poses.back().tip_lps_mm;
        const Values clean = measured(here);
        for (const auto& [id, metric] : measured(noisy)) {
          const std::string where = here.name + ", " + id + ", seed " + std::to_string(seed);
          ASSERT_EQ(metric.value.has_value(), clean.at(id).value.has_value()) << where;
          if (!metric.value) continue;
          if (counted(metric)) {
            EXPECT_EQ(*metric.value, *clean.at(id).value) << where;
          }
          // A distance from a point by 0.2 mm, a way by 3 % (it is slow at its ends, too).
          if (metric.unit == "mm") {
            EXPECT_NEAR(*metric.value, *clean.at(id).value, std::max(0.2, 0.03 * *clean.at(id).value)) << where;
          }
        }
      }
}

// A null is for a need's reason, or for one that its definition names.
TEST(EveryMetric, DocumentsEveryReason) {
  std::set<std::string> of_needs = {"not_finite"};
  for (const NeedInfo& need : needs()) EXPECT_TRUE(of_needs.insert(need.reason).second) << need.reason;
  for (const SampleKind& kind : kSampleKinds) {
    std::vector<SampleAttempt> spoiled(9, sample_attempt(kind));
    spoiled[0].recording.endpoint.reset();
    spoiled[1].recording.frames.clear();
    spoiled[2].recording.poses.resize(1);
    spoiled[3].structures.clear();
    spoiled[4].setting.target.reset();
    spoiled[5].setting.plan.reset();
    spoiled[6].recording.forces.clear();
    spoiled[7].skin = cases::MeshIndex();
    for (auto& pose : spoiled[8].recording.poses) pose.tip_lps_mm.y = -50.0;
    spoiled[8].recording.endpoint->tip_lps_mm.y = -50.0;
    for (const SampleAttempt& sample : spoiled)
      for (const auto& [id, metric] : measured(sample)) {
        if (metric.value) {
          EXPECT_TRUE(std::isfinite(*metric.value)) << id;
          EXPECT_EQ(metric.reason, "") << id;
          continue;
        }
        const std::string definition = find_metric(id)->definition;
        const bool as_another = definition.find("Null: as ") != std::string::npos;
        EXPECT_TRUE(of_needs.contains(metric.reason) || as_another ||
                    definition.find(metric.reason) != std::string::npos)
            << id << ": " << metric.reason;
      }
  }
}

// Of what cannot be known nothing is told: without skin, target, structures or a device, no metric of theirs is 0.
TEST(EveryMetric, IsNullWithoutWhatItNeeds) {
  for (const SampleKind& kind : kSampleKinds) {
    auto bare = sample_attempt(kind);
    bare.recording.endpoint.reset();
    bare.recording.frames.clear();
    bare.structures.clear();
    bare.recording.forces.clear();
    bare.recording.events.reset();
    bare.setting.defer_is_right.reset();
    bare.setting.target.reset();
    bare.setting.plan.reset();
    bare.skin = cases::MeshIndex();
    const Values values = measured(bare);
    for (const MetricInfo& info : registry()) {
      const bool needs_nothing = (info.needs & ~(kMotion | kXray | kBeam | kPicturePlane)) == 0;
      if (!needs_nothing) {
        EXPECT_FALSE(values.at(info.id).value.has_value()) << bare.name << ", " << info.id;
      }
    }
  }
}

TEST(EveryMetric, SaysWithItsNeedsWhereItApplies) {
  for (const SampleKind& kind : kSampleKinds) {
    const auto sample = sample_attempt(kind);
    for (const auto& [id, metric] : measured(sample)) {
      if (metric.value) {
        EXPECT_TRUE(applies(metric, manner_of(sample.setting))) << sample.name << ", " << id;
      }
      if (!applies(metric, manner_of(sample.setting))) {
        EXPECT_EQ(metric.reason.rfind("not_", 0), 0U) << id << ": " << metric.reason;
      }
    }
  }
  EXPECT_TRUE(applies({"gone", 1, std::nullopt, "mm", "whatever"}, {})) << "what nobody knows any more is shown";
}

TEST(Registry, IdsAreUniqueAndEveryRowIsComplete) {
  std::set<std::string> ids, labels;
  for (const MetricInfo& info : registry()) {
    EXPECT_TRUE(ids.insert(info.id).second) << info.id;
    EXPECT_TRUE(labels.insert(info.label).second) << info.label;
    EXPECT_GE(info.version, 1);
    EXPECT_NE(info.measure, nullptr);
    for (const char* text : {info.unit, info.label, info.definition, info.source})
      EXPECT_GT(std::string(text).size(), 0U) << info.id;
    const std::string label = info.label;
    EXPECT_LE(std::count(label.begin(), label.end(), ' '), 3) << label << ": at most four words";
    EXPECT_EQ(find_metric(info.id), &info);
  }
  EXPECT_EQ(find_metric("nothing"), nullptr);
}

TEST(Quality, GatesWhatIsGraded) {
  const auto gate = [](const std::function<void(cases::Recording&)>& spoil) {
    auto sample = sample_attempt(kSampleKinds[0]);
    spoil(sample.recording);
    std::vector<MetricValue> metrics;
    for (const auto& [id, metric] : measured(sample)) metrics.push_back(metric);
    return why_not_gradable(metrics);
  };
  const auto keep = [](int every) {
    return [every](cases::Recording& recording) {
      std::vector<cases::PoseSample> kept;
      for (std::size_t i = 0; i < recording.poses.size(); i += static_cast<std::size_t>(every))
        kept.push_back(recording.poses[i]);
      recording.poses = kept;
    };
  };
  const auto silent = [](double seconds) {
    return [seconds](cases::Recording& recording) {
      std::erase_if(recording.poses,
                    [&](const auto& pose) { return pose.t_s > 5.0 && pose.t_s < 5.0 + seconds - 0.005; });
    };
  };
  EXPECT_EQ(gate([](auto&) {}), "");
  EXPECT_EQ(gate(keep(2)), "tracking_slow");
  EXPECT_EQ(gate(silent(0.6)), "") << "4.4 % of 13.5 s";
  EXPECT_EQ(gate(silent(0.8)), "tracking_gaps") << "5.9 %";
  EXPECT_EQ(gate([](auto& r) { r.poses.resize(1), r.endpoint.reset(); }), "too_short");
  // One pose far away is repaired; a leap that stays is not.
  EXPECT_EQ(gate([](auto& r) { r.poses[700].tip_lps_mm.x += 500.0; }), "");
  EXPECT_EQ(gate([](auto& r) {
              for (std::size_t i = 700; i < r.poses.size(); ++i) r.poses[i].tip_lps_mm.x += 500.0;
            }),
            "tracking_jumps");
  EXPECT_EQ(why_not_gradable({}), "quality_not_measured");
}

}  // namespace
}  // namespace seldinger::assessment
