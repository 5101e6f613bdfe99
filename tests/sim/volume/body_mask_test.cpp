// The body is the largest piece above the threshold, without couch or sheets, its air filled slice by slice.
#include "sim/volume/body/body_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace seldinger::volume {
namespace {

using Mask = std::vector<std::uint8_t>;

Volume empty_volume(glm::ivec3 size, glm::dvec3 spacing_mm = glm::dvec3(1.0)) {
  return make_volume(size, spacing_mm, glm::dmat3(1.0), glm::dvec3(0.0));
}

void paint(Volume& volume, glm::ivec3 low, glm::ivec3 high, std::int16_t hu) {
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) volume.hu[volume.index(i, j, k)] = hu;
}

// The definition again, by the slowest and plainest means: flood from every voxel, then from every slice's border.
Mask plain_mask(const Volume& v, int threshold) {
  const glm::ivec3 n = v.size_voxels;
  std::vector<int> piece(v.hu.size(), 0);
  std::vector<std::size_t> count = {0};
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        if (v.at(i, j, k) <= threshold || piece[v.index(i, j, k)] != 0) continue;
        const int id = static_cast<int>(count.size());
        count.push_back(0);
        std::vector<glm::ivec3> open = {{i, j, k}};
        piece[v.index(i, j, k)] = id;
        while (!open.empty()) {
          const glm::ivec3 p = open.back();
          open.pop_back();
          ++count.back();
          for (int side = 0; side < 6; ++side) {
            glm::ivec3 q = p;
            q[side / 2] += side % 2 == 0 ? 1 : -1;
            if (q.x < 0 || q.y < 0 || q.z < 0 || q.x >= n.x || q.y >= n.y || q.z >= n.z) continue;
            if (v.at(q.x, q.y, q.z) <= threshold || piece[v.index(q.x, q.y, q.z)] != 0) continue;
            piece[v.index(q.x, q.y, q.z)] = id;
            open.push_back(q);
          }
        }
      }
  const int largest = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  Mask mask(v.hu.size(), 1);
  for (int k = 0; k < n.z; ++k) {
    bool grown = true;
    const auto is_body = [&](int i, int j) { return largest > 0 && piece[v.index(i, j, k)] == largest; };
    while (grown) {  // the outside creeps in one voxel at a time
      grown = false;
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) {
          if (is_body(i, j) || mask[v.index(i, j, k)] == 0) continue;
          const bool border = i == 0 || j == 0 || i == n.x - 1 || j == n.y - 1;
          if (border || mask[v.index(i - 1, j, k)] == 0 || mask[v.index(i + 1, j, k)] == 0 ||
              mask[v.index(i, j - 1, k)] == 0 || mask[v.index(i, j + 1, k)] == 0) {
            mask[v.index(i, j, k)] = 0;
            grown = true;
          }
        }
    }
  }
  return mask;
}

TEST(BodyMask, AgreesWithThePlainDefinitionOnRandomVolumes) {
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    Volume v = empty_volume({1 + static_cast<int>(random() % 14), 1 + static_cast<int>(random() % 14),
                             1 + static_cast<int>(random() % 6)});
    for (std::int16_t& hu : v.hu) hu = random() % 100 < 25 + static_cast<unsigned>(round) ? 0 : -1000;
    const Mask mask = body_mask_by_rule_1(v), expected = plain_mask(v, kSkinHu);
    // Two pieces of the same size: either may be the body.
    if (std::count(mask.begin(), mask.end(), 1) == 0) continue;
    Volume chosen = v;
    if (mask != expected)
      for (std::size_t i = 0; i < mask.size(); ++i)
        if (expected[i] != 0 && mask[i] == 0) chosen.hu[i] = -1000;
    EXPECT_EQ(mask, plain_mask(chosen, kSkinHu)) << round;
  }
}

TEST(BodyMask, TheThresholdItselfIsOutside) {
  Volume v = empty_volume({3, 1, 1});
  v.hu = {-300, -299, -301};
  EXPECT_EQ(body_mask(v), (Mask{0, 1, 0}));
  v.hu = {-300, -1000, -301};
  EXPECT_EQ(body_mask(v), (Mask{0, 0, 0}));
}

TEST(BodyMask, ALungOpenAtTheVolumesEndIsFilled) {
  Volume v = empty_volume({20, 20, 10});
  paint(v, {3, 3, 0}, {16, 16, 9}, 40);
  paint(v, {6, 6, 5}, {12, 12, 9}, -850);  // open upwards, closed in each slice
  const Mask mask = body_mask(v);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(mask[v.index(9, 9, k)], 1) << k;
  EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), 14 * 14 * 10);
}

TEST(BodyMask, AirOpenToTheSliceBorderStaysAir) {
  Volume v = empty_volume({20, 20, 4});
  paint(v, {3, 3, 0}, {16, 16, 3}, 40);
  paint(v, {8, 3, 0}, {9, 10, 3}, -1000);  // a cleft
  EXPECT_EQ(body_mask(v)[v.index(8, 8, 2)], 0);
  paint(v, {10, 12, 0}, {11, 13, 3}, -1000);
  paint(v, {9, 11, 0}, {9, 11, 3}, -1000);  // touches the cleft and the hole by corners only
  EXPECT_EQ(body_mask(v)[v.index(10, 12, 2)], 1);
}

TEST(BodyMask, ACouchApartIsDropped) {
  Volume v = empty_volume({60, 60, 8});
  paint(v, {20, 10, 0}, {40, 30, 7}, 40);
  paint(v, {0, 35, 0}, {59, 37, 7}, 150);
  const Mask mask = body_mask(v);
  EXPECT_EQ(mask[v.index(30, 36, 4)], 0);
  EXPECT_EQ(mask[v.index(30, 33, 4)], 0);
  EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), 21 * 21 * 8);
}

TEST(BodyMask, ACoverThatTouchesTheBackIsDroppedAndTheGapBetweenStaysAir) {
  Volume v = empty_volume({120, 60, 8}, {1.0, 1.0, 12.0});
  paint(v, {30, 10, 0}, {90, 40, 7}, 40);
  paint(v, {30, 38, 0}, {50, 40, 7}, -1000);  // a hollow of the back
  paint(v, {5, 41, 0}, {115, 42, 7}, 150);    // 2 mm thick, touching from 51 to 90
  const Mask mask = body_mask(v);
  EXPECT_EQ(mask[v.index(10, 41, 4)], 0);
  EXPECT_EQ(mask[v.index(110, 42, 4)], 0);
  EXPECT_EQ(mask[v.index(40, 39, 4)], 0);  // would be filled were the cover body
  for (int i = 55; i <= 85; ++i) EXPECT_EQ(mask[v.index(i, 40, 4)], 1) << i;
  // Away from where it touches nothing of it remains.
  for (int i = 0; i < 120; ++i)
    if (i < 47 || i > 94) {
      EXPECT_EQ(mask[v.index(i, 42, 4)], 0) << i;
    }
}

TEST(BodyMask, ShortThinPartsAndThinBodiesStay) {
  Volume v = empty_volume({100, 60, 8});
  paint(v, {30, 10, 0}, {70, 40, 7}, 40);
  paint(v, {71, 20, 0}, {95, 21, 7}, 40);  // an ear: 2 mm thick, 25 mm long
  EXPECT_EQ(body_mask(v)[v.index(90, 20, 4)], 1);
  Volume sheet = empty_volume({200, 20, 3});
  paint(sheet, {10, 5, 0}, {190, 6, 2}, 40);
  EXPECT_EQ(body_mask(sheet)[sheet.index(100, 5, 1)], 1);
}

TEST(BodyMask, FillingFollowsTheAxialAxisWhereverItIs) {
  // The third patient axis lies along the first voxel axis.
  const glm::dmat3 direction({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  Volume v = make_volume({10, 20, 20}, glm::dvec3(1.0), direction, glm::dvec3(0.0));
  paint(v, {0, 3, 3}, {9, 16, 16}, 40);
  paint(v, {5, 6, 6}, {9, 12, 12}, -850);
  const Mask mask = body_mask(v);
  EXPECT_EQ(mask[v.index(9, 9, 9)], 1);
}

}  // namespace
}  // namespace seldinger::volume
