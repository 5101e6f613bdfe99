// The volume as its tissue is displaced in one moment, for projectors that know of voxels only. Asked for pulse by
// pulse: resampled where the beam is, and kept while neither displacement nor beam change, as in a held breath.
// What a picture and its truth are told from is then one and the same volume (docs/decisions/0031).
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "sim/imaging/xray/projection/projection.h"
#include "sim/tissue/displacement.h"

namespace seldinger::imaging {

// The oracle: what a ray crosses of the displaced tissue, from places `step_mm` apart, each asked on its own where
// it is at rest, and nearest voxels there (as the exact method).
RayLengths displaced_lengths_between(const volume::Volume& rest, const tissue::Displacement& displacement,
                                     const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm,
                                     double step_mm = 0.25);

struct MovedVolumeGrid {
  double voxel_mm = 2.0;  // voxels are joined, a whole number along each axis, up to this
  double node_mm = 12.0;  // where the way back is asked for; straight between
};

// How many voxels at rest are joined to one, along each axis.
glm::ivec3 joined_voxels(const volume::Volume& rest, const MovedVolumeGrid& grid);

class MovedVolume {
 public:
  // `rest` must outlive it.
  explicit MovedVolume(const volume::Volume& rest, const MovedVolumeGrid& grid = {});

  // Makes volume() the tissue within the beam of `geometry` (in order, check_geometry) as `displacement` has it.
  // Whether anything had to be done for that.
  bool move(const tissue::Displacement& displacement, const XrayGeometry& geometry);

  // After the first move. Beyond the beam it is not filled; nothing is there either that left the CT's own faces.
  const volume::Volume& volume() const noexcept { return moved_; }
  const XrayCpu& projector() const noexcept { return *projector_; }

 private:
  struct Box {  // of the moved volume's voxels, each `joined_` of those at rest from `low` on
    glm::ivec3 low{0}, size{0};
    bool operator==(const Box&) const = default;
  };
  Box box_of(const XrayGeometry& geometry, double reach_mm) const;
  void find_nodes(const Box& box);
  void resample(const Box& box);

  const volume::Volume& rest_;
  MovedVolumeGrid grid_;
  glm::dmat4 voxel_from_lps_;
  glm::ivec3 joined_{1};
  glm::ivec3 cell_{1};            // moved voxels between two nodes
  glm::ivec3 cells_{0};           // of the grid
  std::vector<glm::vec3> nodes_;  // rest index − index, row by row
  tissue::Displacement displacement_{};
  Box box_;
  volume::Volume moved_;
  std::optional<XrayCpu> projector_;
};

}  // namespace seldinger::imaging
