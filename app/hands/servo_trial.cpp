#include "app/hands/servo_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assessment/operators/lesion_site.h"
#include "casedb/import/skin/surface.h"
#include "sim/base/vectors.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::app {
namespace {

// How hands move here (design): up to some 40 mm/s, and long enough to pass every layer.
constexpr double kNeedlePeriodS = 6.0, kNeedleOutsideMm = 10.0, kSwayPeriodS = 0.9, kSwayMm = 1.0;
constexpr double kPressPeriodS = 2.5, kLiftMm = 3.0, kPressMm = 6.0, kSlidePeriodS = 5.0, kSlideMm = 6.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// 0 to 1 and back.
double there_and_back(double t_s, double period_s) {
  return 0.5 - 0.5 * std::cos(kTwoPi * t_s / period_s);
}

}  // namespace

base::Result<ServoCase> torso_under_hands(double decimate_share) {
  ServoCase made;
  cases::Case& scene = made.scene;
  volume::Phantom phantom = volume::make_phantom();
  scene.classes = volume::tissue_classes(phantom.volume, &phantom.labels);
  scene.volume = std::move(phantom.volume);
  casedb::SurfaceOptions options;
  options.decimate_share = decimate_share;
  auto skin = casedb::skin_surface(scene.volume, options);
  if (!skin) return skin.error();
  scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  auto site = assessment::find_lesion_site(scene.volume, scene.skin_index);
  if (!site) return site.error();
  scene.lesions.push_back(site->lesion);
  made.plan = site->plan;
  return made;
}

void refine(cases::Case& scene, int size) {
  const volume::Volume& coarse = scene.volume;
  volume::Volume fine;
  fine.size_voxels = glm::ivec3(size);
  const glm::dvec3 share = glm::dvec3(coarse.size_voxels) / static_cast<double>(size);
  fine.spacing_mm = coarse.spacing_mm * share;
  fine.lps_from_voxel = coarse.lps_from_voxel;
  for (int axis = 0; axis < 3; ++axis) fine.lps_from_voxel[axis] *= share[axis];
  // The first voxel's centre, from the common corner.
  fine.lps_from_voxel[3] = coarse.lps_from_voxel * glm::dvec4(0.5 * share - 0.5, 1.0);
  const auto n = static_cast<std::size_t>(size);
  fine.hu.reserve(n * n * n);
  std::vector<volume::TissueClass> classes;
  classes.reserve(n * n * n);
  const auto from = [&](int at, int axis) {
    return std::min(static_cast<int>((at + 0.5) * share[axis]), coarse.size_voxels[axis] - 1);
  };
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        const std::size_t voxel = coarse.index(from(i, 0), from(j, 1), from(k, 2));
        fine.hu.push_back(coarse.hu[voxel]);
        classes.push_back(scene.classes[voxel]);
      }
  scene.volume = std::move(fine);
  scene.classes = std::move(classes);
}

HandsAtWork::HandsAtWork(const assessment::PuncturePlan& plan, haptics::Handedness handedness,
                         std::array<haptics::Tool, 2> tools)
    : plan_(plan), handedness_(handedness), tools_(tools) {}

haptics::HandInputs HandsAtWork::next() noexcept {
  const double t_s = haptics::kTickS * static_cast<double>(tick_++);
  haptics::HandInput needle, probe;
  needle.tool = tools_[0];
  const auto [across, other] = base::perpendiculars(plan_.direction);
  const double along_mm =
      (kNeedleOutsideMm + plan_.depth_mm) * there_and_back(t_s, kNeedlePeriodS) - kNeedleOutsideMm;
  cases::ToolPose hand;
  hand.position_lps_mm =
      plan_.entry_lps_mm + along_mm * plan_.direction + kSwayMm * std::sin(kTwoPi * t_s / kSwayPeriodS) * across;
  hand.axis = plan_.direction;
  hand.side = other;
  needle.pose = needle_arm_.advance(hand, haptics::kTickS);

  probe.tool = tools_[1];
  hand = plan_.probe;
  hand.position_lps_mm += ((kLiftMm + kPressMm) * there_and_back(t_s, kPressPeriodS) - kLiftMm) * hand.axis +
                          kSlideMm * std::sin(kTwoPi * t_s / kSlidePeriodS) * hand.side;
  probe.pose = probe_arm_.advance(hand, haptics::kTickS);

  haptics::HandInputs inputs;
  for (const haptics::Side side : {haptics::Side::left, haptics::Side::right})
    inputs[static_cast<std::size_t>(side)] =
        haptics::tool_of(handedness_, side) == haptics::Tool::needle ? needle : probe;
  return inputs;
}

}  // namespace seldinger::app
