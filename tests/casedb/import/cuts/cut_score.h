// How the skin of a cropped CT compares with that of the whole patient.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/case/form/mesh_index.h"
#include "sim/volume/volume.h"
#include "tests/casedb/import/cuts/cropped.h"

namespace seldinger::casedb {

constexpr int kSides = 4000;

struct CutScore {
  std::size_t triangles = 0;
  double skin_mm2 = 0.0, cut_mm2 = 0.0;
  double false_skin_mm2 = 0.0;  // called skin, and farther than a voxel from the whole patient's
  double farthest_mm = 0.0;     // of what is called skin from the whole patient's
  int wrong_sides = 0;          // of kSides places, taken for inside or outside the mesh and are not
  double lost_share = 0.0;      // of the whole patient's skin within the field, 10 mm and 4 voxels off its edge
};

int wrong_sides(const cases::MeshIndex& skin, const volume::Volume& field);

// A CT before it is cropped: what its crops are held against.
class WholePatient {
 public:
  explicit WholePatient(const volume::Volume& volume);
  // Of a crop; beyond what was measured it holds `fill`.
  CutScore score(const cases::Mesh& skin, const volume::Volume& field, std::int16_t fill) const;
  const volume::Volume& volume() const { return volume_; }
  const std::vector<std::uint8_t>& body() const { return body_; }

 private:
  volume::Volume volume_;
  std::vector<std::uint8_t> body_;
  cases::Mesh skin_;
  cases::MeshIndex index_;
};

// A test's: none of what is called skin lies off the whole patient's, and no more than this share of that is lost.
CutScore expect_true_skin(const WholePatient& whole, const volume::Crop& crop, double most_lost_share = 0.01,
                          std::int16_t fill = volume::kAirHu);

}  // namespace seldinger::casedb
