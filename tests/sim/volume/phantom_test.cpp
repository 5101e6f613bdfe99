// Tests of the built-in torso: its closed form, its organs' sizes and noise, and the paths its cases need.
#include "sim/volume/phantom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::volume {
namespace {

const Phantom& normal_phantom() {
  static const Phantom made = make_phantom();
  return made;
}

PhantomOptions quiet(Calyces calyces) {
  PhantomOptions options;
  options.calyces = calyces;
  options.noise_sd_hu = 0.0;
  return options;
}

const Phantom& quiet_phantom(Calyces calyces) {
  static std::map<Calyces, Phantom> made;
  const auto found = made.find(calyces);
  return found != made.end() ? found->second : made.emplace(calyces, make_phantom(quiet(calyces))).first->second;
}

glm::dvec3 center_of(const Volume& volume, std::size_t at) {
  const auto nx = static_cast<std::size_t>(volume.size_voxels.x),
             ny = static_cast<std::size_t>(volume.size_voxels.y);
  const glm::dvec4 index(static_cast<double>(at % nx), static_cast<double>(at / nx % ny),
                         static_cast<double>(at / nx / ny), 1.0);
  return glm::dvec3(volume.lps_from_voxel * index);
}

// The class at a point, from the nearest voxel; "outside" beyond the volume.
std::string class_at(const Phantom& phantom, const glm::dvec3& p_lps_mm) {
  const glm::dvec3 index(voxel_from_lps(phantom.volume) * glm::dvec4(p_lps_mm, 1.0));
  if (!inside(phantom.volume, index)) return "outside";
  const glm::ivec3 i(glm::floor(index + 0.5));
  return phantom.labels.names[phantom.labels.label[phantom.volume.index(i.x, i.y, i.z)]];
}

struct Crossing {
  std::string name;
  double length_mm;
};

// The classes along a straight path, in order, with the length in each.
std::vector<Crossing> crossings(const Phantom& phantom, const glm::dvec3& from_mm, const glm::dvec3& to_mm) {
  constexpr double kStep_mm = 0.1;
  const int steps = static_cast<int>(glm::distance(from_mm, to_mm) / kStep_mm);
  std::vector<Crossing> found;
  for (int n = 0; n <= steps; ++n) {
    const std::string name = class_at(phantom, from_mm + (to_mm - from_mm) * (static_cast<double>(n) / steps));
    if (found.empty() || found.back().name != name) found.push_back({name, 0.0});
    found.back().length_mm += kStep_mm;
  }
  return found;
}

std::set<std::string> names_of(const std::vector<Crossing>& path) {
  std::set<std::string> names;
  for (const Crossing& crossing : path) names.insert(crossing.name);
  return names;
}

double depth_below_skin(const Phantom& phantom, const glm::dvec3& p_mm, const glm::dvec3& outwards) {
  for (double t_mm = 0.0; t_mm < 300.0; t_mm += 0.1)
    if (class_at(phantom, p_mm + t_mm * outwards) == "none") return t_mm;
  return std::nan("");
}

TEST(Phantom, labels_and_hu_agree_with_its_shapes_closed_form) {
  const AnalyticVolume analytic = phantom_shapes(quiet(Calyces::normal));
  const Phantom& phantom = quiet_phantom(Calyces::normal);
  base::Rng rng(3);
  int wrong = 0, inside_body = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto at = static_cast<std::size_t>(rng.uniform() * static_cast<double>(phantom.volume.hu.size()));
    const glm::dvec3 p_mm = center_of(phantom.volume, at);
    double hu = analytic.background_hu;
    std::string name = "none";
    for (const Shape& shape : analytic.shapes)
      if (contains(shape.geometry, p_mm) &&
          (shape.over.empty() || std::find(shape.over.begin(), shape.over.end(), name) != shape.over.end())) {
        hu = shape.hu;
        name = shape.class_name;
      }
    wrong += phantom.volume.hu[at] != static_cast<std::int16_t>(hu) ? 1 : 0;
    wrong += phantom.labels.names[phantom.labels.label[at]] != name ? 1 : 0;
    inside_body += name != "none" ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside_body, 1000);
}

TEST(Phantom, every_organ_is_there_and_has_a_plausible_volume) {
  // Adults' ranges in millilitres, judgement; organs that the volume cuts are given as cut.
  const std::map<std::string, std::pair<double, double>> expected_ml{{"skin", {400, 800}},
                                                                     {"fat", {3000, 7000}},
                                                                     {"muscle", {3000, 6000}},
                                                                     {"visceral_fat", {2500, 6000}},
                                                                     {"rib", {150, 400}},
                                                                     {"costal_cartilage", {15, 60}},
                                                                     {"spine", {350, 700}},
                                                                     {"disc", {40, 120}},
                                                                     {"spinal_canal", {30, 90}},
                                                                     {"pelvis", {50, 200}},
                                                                     {"liver", {1200, 1900}},
                                                                     {"portal_vein", {10, 40}},
                                                                     {"hepatic_vein", {5, 30}},
                                                                     {"gallbladder", {20, 60}},
                                                                     {"kidney", {220, 360}},
                                                                     {"renal_sinus", {15, 60}},
                                                                     {"collecting_system", {5, 25}},
                                                                     {"spleen", {90, 250}},
                                                                     {"pancreas", {40, 110}},
                                                                     {"adrenal", {0.3, 8}},
                                                                     {"aorta", {60, 130}},
                                                                     {"vena_cava", {60, 150}},
                                                                     {"artery", {8, 40}},
                                                                     {"vein", {15, 60}},
                                                                     {"heart", {150, 500}},
                                                                     {"lung", {1000, 2500}},
                                                                     {"pulmonary_vessel", {8, 60}},
                                                                     {"pleural_recess", {10, 100}},
                                                                     {"diaphragm", {80, 250}},
                                                                     {"intercostal_bundle", {15, 60}},
                                                                     {"stomach", {50, 200}},
                                                                     {"colon", {80, 300}},
                                                                     {"small_bowel", {120, 500}},
                                                                     {"bowel_content", {300, 1200}},
                                                                     {"bowel_gas", {60, 400}}};
  const Phantom& phantom = normal_phantom();
  std::map<std::string, double> ml;
  const glm::dvec3 spacing_mm = phantom.volume.spacing_mm;
  for (const std::uint8_t label : phantom.labels.label)
    ml[phantom.labels.names[label]] += spacing_mm.x * spacing_mm.y * spacing_mm.z / 1000.0;
  for (const auto& [name, range] : expected_ml) {
    EXPECT_TRUE(ml[name] >= range.first && ml[name] <= range.second) << name << " has " << ml[name] << " ml";
    ml.erase(name);
  }
  ml.erase("none");
  EXPECT_TRUE(ml.empty()) << ml.begin()->first << " is not expected";
}

TEST(Phantom, noise_has_the_given_mean_and_spread_in_every_organ) {
  const Phantom& noisy = normal_phantom();
  const Phantom& plain = quiet_phantom(Calyces::normal);
  ASSERT_EQ(noisy.labels.label, plain.labels.label);
  struct Sums {
    double n = 0.0, sum = 0.0, squares = 0.0;
  };
  std::vector<Sums> sums(noisy.labels.names.size());
  for (std::size_t at = 0; at < noisy.volume.hu.size(); ++at) {
    const double difference = noisy.volume.hu[at] - plain.volume.hu[at];
    Sums& s = sums[noisy.labels.label[at]];
    s.n += 1.0;
    s.sum += difference;
    s.squares += difference * difference;
  }
  for (std::size_t label = 0; label < sums.size(); ++label) {
    const Sums& s = sums[label];
    ASSERT_GT(s.n, 50.0) << noisy.labels.names[label];
    const double sd = label == 0 ? 6.0 : 12.0;
    const double rounded_sd = std::sqrt(sd * sd + 1.0 / 12.0);  // rounding to whole HU adds its own variance
    const double mean = s.sum / s.n, measured_sd = std::sqrt(s.squares / s.n - mean * mean);
    EXPECT_NEAR(mean, 0.0, 5.0 * rounded_sd / std::sqrt(s.n) + (label == 0 ? 1e-3 : 0.0))
        << noisy.labels.names[label];
    EXPECT_NEAR(measured_sd, rounded_sd, 5.0 * rounded_sd / std::sqrt(2.0 * s.n) + (label == 0 ? 1e-2 : 0.0))
        << noisy.labels.names[label];
  }
}

TEST(Phantom, neighbouring_voxels_noise_is_uncorrelated) {
  const Phantom& noisy = normal_phantom();
  const Phantom& plain = quiet_phantom(Calyces::normal);
  double sum = 0.0, n = 0.0;
  for (std::size_t at = 1; at < noisy.volume.hu.size(); ++at) {
    if (noisy.labels.label[at] == 0 || noisy.labels.label[at - 1] == 0) continue;
    sum += (noisy.volume.hu[at] - plain.volume.hu[at]) * (noisy.volume.hu[at - 1] - plain.volume.hu[at - 1]);
    n += 1.0;
  }
  EXPECT_NEAR(sum / n / 144.0, 0.0, 5.0 / std::sqrt(n));
}

TEST(Phantom, the_same_options_give_the_same_bits_and_another_seed_does_not) {
  const auto hash = [](const Volume& volume) { return base::hash_bytes(std::as_bytes(std::span(volume.hu))); };
  const Phantom again = make_phantom();
  EXPECT_EQ(hash(again.volume), hash(normal_phantom().volume));
  EXPECT_EQ(again.labels.label, normal_phantom().labels.label);
  PhantomOptions options;
  options.seed = 2;
  EXPECT_NE(hash(make_phantom(options).volume), hash(normal_phantom().volume));
}

TEST(Phantom, no_voxel_lies_below_air) {
  PhantomOptions options;
  options.noise_sd_hu = 60.0;
  const Phantom phantom = make_phantom(options);
  EXPECT_GE(*std::min_element(phantom.volume.hu.begin(), phantom.volume.hu.end()), kAirHu);
}

TEST(Phantom, opacified_calyces_change_hu_in_the_collecting_system_and_nothing_else) {
  const Phantom& normal = quiet_phantom(Calyces::normal);
  const Phantom& opacified = quiet_phantom(Calyces::opacified);
  EXPECT_EQ(opacified.labels.names, normal.labels.names);
  EXPECT_EQ(opacified.labels.label, normal.labels.label);
  std::size_t wrong = 0, changed = 0;
  for (std::size_t at = 0; at < normal.volume.hu.size(); ++at) {
    const bool urine = normal.labels.names[normal.labels.label[at]] == "collecting_system";
    const int expected = urine ? 600 : normal.volume.hu[at];
    wrong += opacified.volume.hu[at] != expected ? 1 : 0;
    changed += urine ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(changed, 500U);
}

TEST(Phantom, dilated_calyces_change_two_balls_of_15_mm_and_nothing_else) {
  const Phantom& normal = quiet_phantom(Calyces::normal);
  const Phantom& dilated = quiet_phantom(Calyces::dilated);
  EXPECT_EQ(dilated.labels.names, normal.labels.names);
  const glm::dvec3 lower_mm[] = {{-68.0, 40.0, -50.0}, {68.0, 40.0, -34.0}};
  std::size_t wrong = 0, changed[2] = {};
  for (std::size_t at = 0; at < normal.volume.hu.size(); ++at) {
    const glm::dvec3 p_mm = center_of(normal.volume, at);
    const int side = p_mm.x < 0.0 ? 0 : 1;
    const bool in_ball = glm::distance(p_mm, lower_mm[side]) <= 7.5;
    if (in_ball && dilated.labels.names[dilated.labels.label[at]] != "collecting_system") ++wrong;
    if (dilated.volume.hu[at] == normal.volume.hu[at] && dilated.labels.label[at] == normal.labels.label[at])
      continue;
    ++changed[side];
    if (!in_ball) ++wrong;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(changed[0], 100U);
  EXPECT_GT(changed[1], 100U);
}

TEST(Phantom, air_surrounds_the_body_by_ten_millimetres_and_the_body_runs_through_both_ends) {
  const Phantom& phantom = normal_phantom();
  const Volume& volume = phantom.volume;
  glm::dvec3 low_mm(1e9), high_mm(-1e9);
  for (std::size_t at = 0; at < phantom.labels.label.size(); ++at) {
    if (phantom.labels.label[at] == 0) continue;
    low_mm = glm::min(low_mm, center_of(volume, at));
    high_mm = glm::max(high_mm, center_of(volume, at));
  }
  const glm::dvec3 first_mm = center_of(volume, 0), last_mm = center_of(volume, volume.hu.size() - 1);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_GE(low_mm[axis] - first_mm[axis], 10.0);
    EXPECT_GE(last_mm[axis] - high_mm[axis], 10.0);
  }
  EXPECT_NEAR(high_mm.x - low_mm.x, 336.0, 3.0);
  EXPECT_NEAR(high_mm.y - low_mm.y, 228.0, 3.0);
  EXPECT_EQ(low_mm.z, first_mm.z);
  EXPECT_EQ(high_mm.z, last_mm.z);
}

TEST(Phantom, every_row_from_air_to_the_body_enters_through_skin) {
  const Phantom& phantom = normal_phantom();
  const glm::ivec3 size = phantom.volume.size_voxels;
  for (int k = 0; k < size.z; k += 5)
    for (int j = 0; j < size.y; ++j)
      for (int i = 1; i < size.x; ++i) {
        const auto& name = [&](int x) -> const std::string& {
          return phantom.labels.names[phantom.labels.label[phantom.volume.index(x, j, k)]];
        };
        const bool enters = name(i - 1) == "none" && name(i) != "none";
        const bool leaves = name(i - 1) != "none" && name(i) == "none";
        EXPECT_TRUE(!enters || name(i) == "skin");
        EXPECT_TRUE(!leaves || name(i - 1) == "skin");
      }
}

TEST(Phantom, another_spacing_covers_the_same_body) {
  PhantomOptions options = quiet(Calyces::normal);
  options.spacing_mm = {3.0, 3.0, 5.0};
  const Phantom coarse = make_phantom(options);
  const auto ml = [](const Phantom& phantom, const std::string& of) {
    double count = 0.0;
    for (const std::uint8_t label : phantom.labels.label) count += phantom.labels.names[label] == of ? 1.0 : 0.0;
    const glm::dvec3 spacing_mm = phantom.volume.spacing_mm;
    return count * spacing_mm.x * spacing_mm.y * spacing_mm.z / 1000.0;
  };
  for (const char* organ : {"liver", "kidney", "spleen", "lung"})
    EXPECT_NEAR(ml(coarse, organ) / ml(quiet_phantom(Calyces::normal), organ), 1.0, 0.06) << organ;
}

// docs/clinical.md, case 1: 25 mm lesion, 60 mm deep, subcostal.
TEST(Phantom, a_25_mm_lesion_60_mm_deep_in_the_liver_is_reached_below_the_ribs) {
  const Phantom& phantom = quiet_phantom(Calyces::normal);
  const glm::dvec3 lesion_mm(-91.0, -36.0, 3.0);
  const double up = 20.0 * 3.14159265358979 / 180.0, medial = 10.0 * 3.14159265358979 / 180.0;
  const glm::dvec3 needle(std::sin(medial) * std::cos(up), std::cos(medial) * std::cos(up), std::sin(up));
  EXPECT_NEAR(depth_below_skin(phantom, lesion_mm, -needle), 60.0, 2.0);
  // The lesion with 2 mm around it is liver alone, and so is all that the throw of 22 mm can reach.
  base::Rng rng(9);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 p(2.0 * rng.uniform() - 1.0, 2.0 * rng.uniform() - 1.0, 2.0 * rng.uniform() - 1.0);
    EXPECT_TRUE(glm::length(p) > 1.0 || class_at(phantom, lesion_mm + 14.5 * p) == "liver");
  }
  EXPECT_EQ(names_of(crossings(phantom, lesion_mm - 12.5 * needle, lesion_mm + 22.0 * needle)),
            (std::set<std::string>{"liver"}));
  // Paths beside it, 5 mm off: nothing critical on the way, and one capsule.
  const glm::dvec3 side(std::cos(medial), -std::sin(medial), 0.0), over = glm::cross(side, needle);
  for (const glm::dvec3& off : {glm::dvec3(0.0), 5.0 * side, -5.0 * side, 5.0 * over, -5.0 * over}) {
    const auto path = crossings(phantom, lesion_mm + off - 75.0 * needle, lesion_mm + off + 10.0 * needle);
    int capsules = 0;
    for (const Crossing& crossing : path) {
      EXPECT_TRUE(
          (std::set<std::string>{"none", "skin", "fat", "muscle", "visceral_fat", "liver"}).count(crossing.name))
          << crossing.name;
      capsules += crossing.name == "liver" ? 1 : 0;
    }
    EXPECT_EQ(capsules, 1);
  }
}

// docs/clinical.md, case 5: dilated lower calyx, prone posterolateral, through at least 10 mm of parenchyma.
TEST(Phantom, the_dilated_lower_calyx_is_reached_from_behind_through_parenchyma) {
  const Phantom& phantom = quiet_phantom(Calyces::dilated);
  for (const glm::dvec3& calyx_mm : {glm::dvec3(-68.0, 40.0, -50.0), glm::dvec3(68.0, 40.0, -34.0)})
    for (const double lateral_deg : {20.0, 30.0, 40.0}) {
      const double lateral = lateral_deg * 3.14159265358979 / 180.0;
      const glm::dvec3 outwards(std::copysign(std::sin(lateral), calyx_mm.x), std::cos(lateral), 0.0);
      const auto path = crossings(phantom, calyx_mm + 90.0 * outwards, calyx_mm);
      double parenchyma_mm = 0.0;
      for (const Crossing& crossing : path) {
        EXPECT_TRUE(
            (std::set<std::string>{"none", "skin", "fat", "muscle", "visceral_fat", "kidney", "collecting_system"})
                .count(crossing.name))
            << crossing.name;
        if (crossing.name == "kidney") parenchyma_mm += crossing.length_mm;
      }
      EXPECT_EQ(path.back().name, "collecting_system");
      EXPECT_GE(parenchyma_mm, 10.0);
      EXPECT_NEAR(path.back().length_mm, 7.5, 1.5);
    }
}

TEST(Phantom, the_pleural_recess_lies_between_ribs_and_liver_below_the_lung) {
  const Phantom& phantom = quiet_phantom(Calyces::normal);
  // From the right flank inwards.
  const auto at_lung = names_of(crossings(phantom, {-180.0, 0.0, 75.0}, {-80.0, 0.0, 75.0}));
  const auto at_recess = names_of(crossings(phantom, {-180.0, 0.0, 48.0}, {-80.0, 0.0, 48.0}));
  const auto below = names_of(crossings(phantom, {-180.0, 0.0, -10.0}, {-80.0, 0.0, -10.0}));
  EXPECT_TRUE(at_lung.count("lung") == 1 && at_lung.count("liver") == 1 && at_lung.count("diaphragm") == 1);
  EXPECT_TRUE(at_recess.count("pleural_recess") == 1 && at_recess.count("liver") == 1);
  EXPECT_EQ(at_recess.count("lung"), 0U);
  EXPECT_TRUE(below.count("pleural_recess") == 0 && below.count("lung") == 0 && below.count("liver") == 1);
}

TEST(Phantom, a_bundle_runs_under_each_ribs_lower_border) {
  const Phantom& phantom = quiet_phantom(Calyces::normal);
  const Volume& volume = phantom.volume;
  const auto name = [&](int i, int j, int k) -> const std::string& {
    return phantom.labels.names[phantom.labels.label[volume.index(i, j, k)]];
  };
  std::size_t bundles = 0, rib_above = 0, rib_below = 0;
  for (int k = 3; k + 3 < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i) {
        if (name(i, j, k) != "intercostal_bundle") continue;
        ++bundles;
        rib_above += name(i, j, k + 1) == "rib" || name(i, j, k + 2) == "rib" ? 1 : 0;
        rib_below += name(i, j, k - 1) == "rib" || name(i, j, k - 2) == "rib" ? 1 : 0;
      }
  EXPECT_GT(bundles, 1000U);
  EXPECT_GT(static_cast<double>(rib_above), 0.8 * static_cast<double>(bundles));
  EXPECT_LT(static_cast<double>(rib_below), 0.1 * static_cast<double>(bundles));
}

TEST(Phantom, gas_lies_in_front_of_content) {
  const Phantom& phantom = quiet_phantom(Calyces::normal);
  const auto stomach = crossings(phantom, {50.0, -90.0, 15.0}, {50.0, 0.0, 15.0});
  std::string order;
  for (const Crossing& crossing : stomach)
    if (crossing.name.rfind("bowel_", 0) == 0) order += crossing.name + " ";
  EXPECT_EQ(order, "bowel_gas bowel_content ");
}

}  // namespace
}  // namespace seldinger::volume
