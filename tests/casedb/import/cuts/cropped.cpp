#include "tests/casedb/import/cuts/cropped.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <utility>

#include "sim/base/check.h"

namespace seldinger::volume {
namespace {

struct VoxelBox {
  glm::ivec3 low{0}, high{0};  // both inclusive
};

VoxelBox box_of(const Volume& volume, const std::vector<std::uint8_t>& body) {
  VoxelBox box{volume.size_voxels, glm::ivec3(-1)};
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i)
        if (body[volume.index(i, j, k)] != 0) {
          box.low = glm::min(box.low, glm::ivec3(i, j, k));
          box.high = glm::max(box.high, glm::ivec3(i, j, k));
        }
  return box;
}

}  // namespace

std::vector<Crop> crops() {
  std::vector<Crop> made{
      {"whole", {}},
      {"left", {0, .2, 0, 0, 0, 0}},
      {"right", {.2, 0, 0, 0, 0, 0}},
      {"left deep", {0, .35, 0, 0, 0, 0}},
      {"right deep", {.35, 0, 0, 0, 0, 0}},
      {"front", {0, 0, .15, 0, 0, 0}},
      {"front deep", {0, 0, .35, 0, 0, 0}},
      {"back", {0, 0, 0, .15, 0, 0}},
      {"back deep", {0, 0, 0, .35, 0, 0}},
      {"head", {0, 0, 0, 0, 0, .3}},
      {"feet", {0, 0, 0, 0, .3, 0}},
      {"both sides", {.15, .15, 0, 0, 0, 0}},
      {"both sides deep", {.28, .28, 0, 0, 0, 0}},
      {"front and left", {0, .25, .2, 0, 0, 0}},
      {"front and right", {.25, 0, .2, 0, 0, 0}},
      {"back and left", {0, .25, 0, .2, 0, 0}},
      {"back and right", {.25, 0, 0, .2, 0, 0}},
      {"front and back", {0, 0, .2, .2, 0, 0}},
      {"sides and back", {.2, .2, 0, .2, 0, 0}},
      {"sides and front", {.2, .2, .2, 0, 0, 0}},
      {"right half", {0, .5, 0, 0, 0, 0}},
      {"left half", {.5, 0, 0, 0, 0, 0}},
      {"five faces", {.2, 0, .2, .2, .2, .2}},
      {"sides and ends", {.25, .25, 0, 0, .2, .2}},
  };
  for (Crop crop : std::initializer_list<Crop>{
           {"left a little", {0, .08, 0, 0, 0, 0}},
           {"front a little", {0, 0, .06, 0, 0, 0}},
           {"back a little", {0, 0, 0, .06, 0, 0}},
           {"head deep", {0, 0, 0, 0, 0, .6}},
           {"feet deep", {0, 0, 0, 0, .6, 0}},
           {"both ends", {0, 0, 0, 0, .3, .3}},
           {"a slab of lung", {0, .3, 0, 0, .75, 0}},
           {"a slab of bowel", {0, 0, .25, 0, 0, .75}},
           {"front and head", {0, 0, .2, 0, 0, .3}},
           {"back and feet", {0, 0, 0, .2, .3, 0}},
           {"left and head", {0, .3, 0, 0, 0, .4}},
           {"right and feet", {.3, 0, 0, 0, .4, 0}},
           {"front, left and head", {0, .2, .15, 0, 0, .3}},
           {"back, right and feet", {.2, 0, 0, .15, .3, 0}},
           {"sides and head", {.25, .25, 0, 0, 0, .3}},
           {"front, back and feet", {0, 0, .15, .15, .3, 0}},
           {"front, back and left", {0, .25, .15, .15, 0, 0}},
           {"four sides", {.12, .12, .12, .12, 0, 0}},
           {"all but left", {.2, 0, .15, .15, .2, .2}},
           {"all but right", {0, .2, .15, .15, .2, .2}},
           {"all but back", {.15, .15, .15, 0, .2, .2}},
           {"left of the spine", {.55, 0, 0, .1, 0, .2}},
       })
    made.push_back(std::move(crop));
  made.push_back({"circle wide", {}, 0.95});
  made.push_back({"circle", {}, 0.85});
  made.push_back({"circle narrow", {}, 0.7});
  made.push_back({"circle and left", {0, .3, 0, 0, 0, 0}, 0.9});
  made.push_back({"oblique left front", {}, {}, glm::dvec3(1, -1, 0.2), 0.55});
  made.push_back({"oblique right back", {}, {}, glm::dvec3(-1, 1, 0), 0.55});
  made.push_back({"oblique front", {}, {}, glm::dvec3(0, -1, 0.6), 0.5});
  made.push_back({"oblique right", {}, {}, glm::dvec3(-1, 0, 0.4), 0.6});
  made.push_back({"circle and head", {0, 0, 0, 0, 0, .4}, 0.8});
  made.push_back({"circle and front", {0, 0, .2, 0, 0, 0}, 0.9});
  made.push_back({"oblique left back", {}, {}, glm::dvec3(1, 0.7, -0.3), 0.55});
  made.push_back({"oblique front, flat", {}, {}, glm::dvec3(0.1, -1, 0.15), 0.6});
  made.push_back({"oblique head", {}, {}, glm::dvec3(0.4, 0.2, 1), 0.4});
  made.push_back({"oblique and right", {.25, 0, 0, 0, 0, 0}, {}, glm::dvec3(0.6, -1, 0), 0.6});
  return made;
}

std::vector<Crop> crops(const std::vector<std::string>& names) {
  std::vector<Crop> chosen;
  for (const std::string& name : names) {
    const std::vector<Crop> all = crops();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Crop& crop) { return crop.name == name; });
    CHECK(found != all.end());
    chosen.push_back(*found);
  }
  return chosen;
}

Volume cropped(const Volume& whole, const std::vector<std::uint8_t>& body, const Crop& crop, std::int16_t fill) {
  const VoxelBox box = box_of(whole, body);
  const glm::dvec3 extent(box.high - box.low + 1);
  glm::ivec3 low(0), high = whole.size_voxels - 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = crop.faces[static_cast<std::size_t>(2 * axis)],
                 above = crop.faces[static_cast<std::size_t>(2 * axis + 1)];
    if (below > 0.0) low[axis] = box.low[axis] + static_cast<int>(std::lround(below * extent[axis]));
    if (above > 0.0) high[axis] = box.high[axis] - static_cast<int>(std::lround(above * extent[axis]));
  }
  const glm::dvec3 origin_mm(whole.lps_from_voxel * glm::dvec4(low, 1.0));
  Volume made{high - low + 1, whole.spacing_mm, whole.lps_from_voxel, {}};
  made.lps_from_voxel[3] = glm::dvec4(origin_mm, 1.0);
  made.hu.resize(static_cast<std::size_t>(made.size_voxels.x) * static_cast<std::size_t>(made.size_voxels.y) *
                 static_cast<std::size_t>(made.size_voxels.z));
  const glm::dvec3 middle = glm::dvec3(box.low + box.high) / 2.0, half_mm = extent / 2.0 * whole.spacing_mm;
  const double radius_mm = crop.circle ? *crop.circle * std::max(half_mm.x, half_mm.y) : 0.0;
  const glm::dvec3 way = crop.beyond ? glm::normalize(*crop.beyond) : glm::dvec3(0.0);
  const double reach_mm = crop.beyond ? crop.beyond_from * glm::length(way * half_mm) : 0.0;
  for (int k = 0; k < made.size_voxels.z; ++k)
    for (int j = 0; j < made.size_voxels.y; ++j)
      for (int i = 0; i < made.size_voxels.x; ++i) {
        const glm::ivec3 from = low + glm::ivec3(i, j, k);
        const glm::dvec3 off_mm = (glm::dvec3(from) - middle) * whole.spacing_mm;
        const bool out = (crop.circle && std::hypot(off_mm.x, off_mm.y) > radius_mm) ||
                         (crop.beyond && glm::dot(off_mm, way) > reach_mm);
        made.hu[made.index(i, j, k)] = out ? fill : whole.at(from.x, from.y, from.z);
      }
  return made;
}

Volume coarser(const Volume& volume, double spacing_mm) {
  const glm::ivec3 by = glm::max(glm::ivec3(1), glm::ivec3(glm::round(spacing_mm / volume.spacing_mm)));
  const glm::ivec3 n = volume.size_voxels / by;
  Volume made{n, volume.spacing_mm * glm::dvec3(by), volume.lps_from_voxel, {}};
  for (int axis = 0; axis < 3; ++axis) made.lps_from_voxel[axis] *= by[axis];
  made.lps_from_voxel[3] = volume.lps_from_voxel * glm::dvec4(glm::dvec3(by - 1) / 2.0, 1.0);
  made.hu.resize(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z));
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        double sum = 0.0;
        for (int z = 0; z < by.z; ++z)
          for (int y = 0; y < by.y; ++y)
            for (int x = 0; x < by.x; ++x) sum += volume.at(i * by.x + x, j * by.y + y, k * by.z + z);
        made.hu[made.index(i, j, k)] = static_cast<std::int16_t>(std::lround(sum / (by.x * by.y * by.z)));
      }
  return made;
}

}  // namespace seldinger::volume
