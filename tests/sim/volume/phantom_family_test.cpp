// Tests of the family of built-in patients: each is whole and closed by skin, bodies differ by fat and size, and
// vessels of groin and neck lie to each other as they do in people.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "sim/base/hash.h"
#include "sim/volume/classes.h"
#include "sim/volume/phantom.h"

namespace seldinger::volume {
namespace {

PhantomOptions of(Region region, Body body = Body::adult, Posture posture = Posture::supine) {
  PhantomOptions options;
  options.noise_sd_hu = 0.0;
  options.region = region;
  options.body = body;
  options.posture = posture;
  return options;
}

std::vector<PhantomOptions> every_member() {
  std::vector<PhantomOptions> all;
  for (const auto& region : kRegionNames)
    for (const auto& body : kBodyNames)
      for (const auto& posture : kPostureNames) {
        all.push_back(of(region.value, body.value, posture.value));
        all.back().spacing_mm = (body.value == Body::child ? 0.7 : 1.0) * glm::dvec3(1.5, 1.5, 3.0);
      }
  return all;
}

std::string told(const PhantomOptions& options) {
  return std::string(base::name_of(kRegionNames, options.region)) + " " +
         std::string(base::name_of(kBodyNames, options.body)) + " " +
         std::string(base::name_of(kPostureNames, options.posture));
}

// Where the centre of a class's voxels in one slice and on one side lies, and how many they are.
struct Found {
  glm::dvec2 middle_mm{0.0}, low_mm{1e9}, high_mm{-1e9};
  double voxels = 0.0;
};

std::string name_at(const Phantom& phantom, const glm::ivec3& at) {
  return phantom.labels.names[phantom.labels.label[phantom.volume.index(at.x, at.y, at.z)]];
}

Found found_in_slice(const Phantom& phantom, const std::string& name, double z_mm, double side) {
  const Volume& volume = phantom.volume;
  const glm::dvec3 origin_mm(volume.lps_from_voxel[3]);
  const int k = static_cast<int>(std::lround((z_mm - origin_mm.z) / volume.spacing_mm.z));
  Found found;
  for (int j = 0; j < volume.size_voxels.y; ++j)
    for (int i = 0; i < volume.size_voxels.x; ++i) {
      const glm::dvec2 p_mm(origin_mm.x + i * volume.spacing_mm.x, origin_mm.y + j * volume.spacing_mm.y);
      if (side * p_mm.x <= 0.0 || name_at(phantom, {i, j, k}) != name) continue;
      found.middle_mm += p_mm;
      found.low_mm = glm::min(found.low_mm, p_mm);
      found.high_mm = glm::max(found.high_mm, p_mm);
      found.voxels += 1.0;
    }
  found.middle_mm /= found.voxels;
  return found;
}

// y of the foremost voxel of the body at (x, z).
double front_mm(const Phantom& phantom, double x_mm, double z_mm) {
  const Volume& volume = phantom.volume;
  const glm::dvec3 origin_mm(volume.lps_from_voxel[3]);
  const int i = static_cast<int>(std::lround((x_mm - origin_mm.x) / volume.spacing_mm.x)),
            k = static_cast<int>(std::lround((z_mm - origin_mm.z) / volume.spacing_mm.z));
  for (int j = 0; j < volume.size_voxels.y; ++j)
    if (name_at(phantom, {i, j, k}) != "none") return origin_mm.y + j * volume.spacing_mm.y;
  return std::nan("");
}

const Phantom& whole(Region region) {
  static std::map<Region, Phantom> made;
  const auto found = made.find(region);
  return found != made.end() ? found->second : made.emplace(region, make_phantom(of(region))).first->second;
}

// Of voxels with a scanner's noise and of labels, made on any machine by any compiler. They change where
// shapes do, and only there.
std::uint64_t digest(Phantom phantom) {
  const PhantomOptions usual;
  add_ct_noise(usual.noise_sd_hu, usual.seed, phantom);
  const std::span<const std::int16_t> hu(phantom.volume.hu);
  return base::hash_bytes(std::as_bytes(std::span(phantom.labels.label)), base::hash_bytes(std::as_bytes(hu)));
}
const std::map<std::string, std::uint64_t> kDigests = {
    {"torso adult supine", 0x72b3620f9daf7cbaULL}, {"torso adult prone", 0x242a5a8611a67a75ULL},
    {"torso lean supine", 0x027df090e9213836ULL},  {"torso lean prone", 0x2e56b313aac7a937ULL},
    {"torso obese supine", 0x8fc4ce8d0608ba8bULL}, {"torso obese prone", 0x1b4a259806250cb7ULL},
    {"torso child supine", 0xc445de5313b9018dULL}, {"torso child prone", 0x207fe1754d0fa3f3ULL},
    {"groin adult supine", 0xc07b36fb9cd1e10fULL}, {"groin adult prone", 0xc07b36fb9cd1e10fULL},
    {"groin lean supine", 0x74a9b088ac58cff8ULL},  {"groin lean prone", 0x74a9b088ac58cff8ULL},
    {"groin obese supine", 0x15e808a6cd166fbcULL}, {"groin obese prone", 0x15e808a6cd166fbcULL},
    {"groin child supine", 0x6e4397a74f68fd1aULL}, {"groin child prone", 0x6e4397a74f68fd1aULL},
    {"neck adult supine", 0x00a357e71488d32fULL},  {"neck adult prone", 0x00a357e71488d32fULL},
    {"neck lean supine", 0x95227d5c1866e4baULL},   {"neck lean prone", 0x95227d5c1866e4baULL},
    {"neck obese supine", 0x5e48864ecd6d7a98ULL},  {"neck obese prone", 0x5e48864ecd6d7a98ULL},
    {"neck child supine", 0x02febc072633e215ULL},  {"neck child prone", 0x02febc072633e215ULL},
};

TEST(PhantomFamily, EveryMemberIsClosedBySkinAndLiesInAirAndHasTheSameBitsEverywhere) {
  for (const PhantomOptions& options : every_member()) {
    SCOPED_TRACE(told(options));
    const Phantom phantom = make_phantom(options);
    const glm::ivec3 size = phantom.volume.size_voxels;
    std::size_t wrong = 0, body = 0, at_rim = 0;
    std::set<std::string> through;
    const auto look = [&](const glm::ivec3& from, const glm::ivec3& to) {
      const std::string a = name_at(phantom, from), b = name_at(phantom, to);
      if (a == "none" && b != "none" && b != "skin") {
        ++wrong;
        through.insert(b);
      }
    };
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const bool inside = name_at(phantom, {i, j, k}) != "none";
          body += inside ? 1 : 0;
          at_rim += inside && (i < 2 || j < 2 || i + 2 >= size.x || j + 2 >= size.y) ? 1 : 0;
          if (i > 0) look({i - 1, j, k}, {i, j, k});
          if (i + 1 < size.x) look({i + 1, j, k}, {i, j, k});
          if (j > 0) look({i, j - 1, k}, {i, j, k});
          if (j + 1 < size.y) look({i, j + 1, k}, {i, j, k});
        }
    EXPECT_EQ(wrong, 0U) << [&] {
      std::string all;
      for (const std::string& one : through) all += one + " ";
      return all;
    }();
    EXPECT_EQ(at_rim, 0U);
    EXPECT_GT(body, 10000U);
    const auto kept = kDigests.find(told(options));
    EXPECT_TRUE(kept != kDigests.end() && kept->second == digest(phantom)) << std::hex << digest(phantom);
  }
}

TEST(PhantomFamily, EveryNameMeansATissueClass) {
  for (const Region region : {Region::torso, Region::groin, Region::neck})
    for (const Shape& shape : phantom_shapes(of(region)).shapes)
      EXPECT_TRUE(tissue_of_name(shape.class_name).has_value()) << shape.class_name;
}

TEST(PhantomFamily, NothingIsPaintedOverAClassThatIsNotThere) {
  for (const Region region : {Region::torso, Region::groin, Region::neck}) {
    const AnalyticVolume analytic = phantom_shapes(of(region));
    std::set<std::string> names;
    for (const Shape& shape : analytic.shapes) names.insert(shape.class_name);
    for (const Shape& shape : analytic.shapes) {
      bool one = shape.over.empty();
      for (const std::string& name : shape.over) one = one || names.contains(name);
      EXPECT_TRUE(one) << shape.class_name;
    }
  }
}

TEST(PhantomFamily, BodiesDiffByFatAndSizeAlone) {
  const auto ml_of = [](const Phantom& phantom) {
    std::map<std::string, double> ml;
    const glm::dvec3 mm = phantom.volume.spacing_mm;
    for (const std::uint8_t label : phantom.labels.label)
      ml[phantom.labels.names[label]] += mm.x * mm.y * mm.z / 1000.0;
    return ml;
  };
  const std::map<Region, std::vector<std::string>> organs{{Region::torso, {"liver", "kidney", "spine"}},
                                                          {Region::groin, {"femur", "femoral_artery", "bladder"}},
                                                          {Region::neck, {"jugular_vein", "thyroid", "spine"}}};
  for (const auto& [region, names] : organs) {
    SCOPED_TRACE(std::string(base::name_of(kRegionNames, region)));
    std::map<Body, std::map<std::string, double>> ml;
    for (const auto& body : kBodyNames) {
      PhantomOptions options = of(region, body.value);
      options.spacing_mm = glm::dvec3(1.5, 1.5, 2.0);
      ml[body.value] = ml_of(make_phantom(options));
    }
    EXPECT_LT(ml[Body::lean]["fat"], 0.75 * ml[Body::adult]["fat"]);
    EXPECT_GT(ml[Body::obese]["fat"], 1.8 * ml[Body::adult]["fat"]);
    for (const std::string& organ : names) {
      EXPECT_NEAR(ml[Body::lean][organ] / ml[Body::adult][organ], 1.0, 0.03) << organ;
      EXPECT_NEAR(ml[Body::obese][organ] / ml[Body::adult][organ], 1.0, 0.03) << organ;
      EXPECT_NEAR(ml[Body::child][organ] / ml[Body::adult][organ], 0.7 * 0.7 * 0.7, 0.03) << organ;
    }
  }
}

TEST(PhantomFamily, GasRisesToTheBackOfThoseWhoLieProne) {
  const auto middle_y_mm = [](Posture posture) {
    PhantomOptions options = of(Region::torso, Body::adult, posture);
    options.spacing_mm = glm::dvec3(2.0, 2.0, 3.0);
    const Phantom phantom = make_phantom(options);
    double gas_mm = 0.0, gas = 0.0, content_mm = 0.0, content = 0.0;
    const glm::ivec3 size = phantom.volume.size_voxels;
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const std::string name = name_at(phantom, {i, j, k});
          if (name == "bowel_gas") gas_mm += j, gas += 1.0;
          if (name == "bowel_content") content_mm += j, content += 1.0;
        }
    return 2.0 * (gas_mm / gas - content_mm / content);
  };
  EXPECT_LT(middle_y_mm(Posture::supine), -10.0);
  EXPECT_GT(middle_y_mm(Posture::prone), 10.0);
}

// Over the head of the femur: nerve, artery, vein from lateral to medial, the artery 20 to 45 mm deep and 7 to 11
// mm across, before the bone.
TEST(PhantomFamily, FemoralVesselsLieBeforeTheHeadOfTheFemur) {
  const Phantom& phantom = whole(Region::groin);
  for (const double side : {-1.0, 1.0}) {
    const Found nerve = found_in_slice(phantom, "nerve", -240.0, side),
                artery = found_in_slice(phantom, "femoral_artery", -240.0, side),
                vein = found_in_slice(phantom, "femoral_vein", -240.0, side),
                head = found_in_slice(phantom, "femur", -240.0, side);
    EXPECT_GT(side * nerve.middle_mm.x, side * artery.middle_mm.x + 8.0);
    EXPECT_GT(side * artery.middle_mm.x, side * vein.middle_mm.x + 8.0);
    EXPECT_GT(artery.high_mm.x - artery.low_mm.x, 6.5);
    EXPECT_LT(artery.high_mm.x - artery.low_mm.x, 11.0);
    EXPECT_LT(artery.high_mm.y, head.low_mm.y);
    const double deep_mm = artery.middle_mm.y - front_mm(phantom, artery.middle_mm.x, -240.0);
    EXPECT_GT(deep_mm, 20.0);
    EXPECT_LT(deep_mm, 45.0);
    // Below the fork the vein goes behind.
    EXPECT_GT(found_in_slice(phantom, "femoral_vein", -320.0, side).low_mm.y,
              found_in_slice(phantom, "femoral_artery", -320.0, side).low_mm.y + 4.0);
  }
}

// At the cricoid: the vein lateral of the carotid, nearer to the skin and in part before it; the thyroid
// between carotid and airway.
TEST(PhantomFamily, TheJugularLiesLateralOfTheCarotidAndNearerToTheSkin) {
  const Phantom& phantom = whole(Region::neck);
  for (const double side : {-1.0, 1.0})
    for (const double z_mm : {325.0, 335.0, 345.0}) {
      SCOPED_TRACE(z_mm);
      const Found vein = found_in_slice(phantom, "jugular_vein", z_mm, side),
                  artery = found_in_slice(phantom, "carotid_artery", z_mm, side),
                  thyroid = found_in_slice(phantom, "thyroid", z_mm, side);
      EXPECT_GT(side * vein.middle_mm.x, side * artery.middle_mm.x + 4.0);
      EXPECT_LT(vein.middle_mm.y, artery.middle_mm.y - 4.0);
      // As a probe sees them that stands before the neck and a little beside it, by 20°.
      const double from_middle_mm = glm::dot(artery.middle_mm - vein.middle_mm, glm::dvec2(-side * 0.940, -0.342));
      EXPECT_GT(from_middle_mm, 2.0);
      EXPECT_LT(from_middle_mm, 0.5 * (vein.high_mm.x - vein.low_mm.x + artery.high_mm.x - artery.low_mm.x));
      EXPECT_GT(vein.voxels, artery.voxels);
      EXPECT_LT(side * thyroid.middle_mm.x, side * artery.middle_mm.x);
      const double deep_mm = vein.middle_mm.y - front_mm(phantom, vein.middle_mm.x, z_mm);
      EXPECT_GT(deep_mm, 15.0);
      EXPECT_LT(deep_mm, 30.0);
    }
}

TEST(PhantomFamily, VeinsHaveValvesAndArteriesNone) {
  for (const Region region : {Region::groin, Region::neck}) {
    const Phantom& phantom = whole(region);
    const glm::ivec3 size = phantom.volume.size_voxels;
    std::map<std::string, int> beside;
    for (int k = 1; k + 1 < size.z; ++k)
      for (int j = 1; j + 1 < size.y; ++j)
        for (int i = 1; i + 1 < size.x; ++i)
          if (name_at(phantom, {i, j, k}) == "venous_valve")
            for (const int step : {-1, 1}) {
              ++beside[name_at(phantom, {i + step, j, k})];
              ++beside[name_at(phantom, {i, j + step, k})];
              ++beside[name_at(phantom, {i, j, k + step})];
            }
    EXPECT_GT(beside["venous_valve"], 40);
    EXPECT_GT(beside[region == Region::groin ? "femoral_vein" : "jugular_vein"], 40);
    EXPECT_EQ(beside["femoral_artery"] + beside["carotid_artery"], 0);
  }
}

TEST(PhantomFamily, TheAirwayIsOpenFromTopToBottom) {
  const Phantom& phantom = whole(Region::neck);
  const glm::ivec3 size = phantom.volume.size_voxels;
  for (int k = 0; k < size.z; ++k) {
    int air = 0;
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) air += name_at(phantom, {i, j, k}) == "airway" ? 1 : 0;
    EXPECT_GT(air * phantom.volume.spacing_mm.x * phantom.volume.spacing_mm.y, 80.0) << k;
  }
}

}  // namespace
}  // namespace seldinger::volume
