#include "casedb/import/privacy/face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "casedb/import/privacy/head_slices.h"

namespace seldinger::casedb {
namespace {

// Of adults (Farkas, Anthropometry of the Head and Face, 1994): nasion to menton 106 to 129 mm, subnasale to menton
// 59 to 77 mm. The lowest slice with brain in it lies at the base of the nose or above; a chin on the chest lies
// lower still.
constexpr double kNoseToChinMm = 95.0;
constexpr double kLeastJawMm = 40.0;  // below that slice; less is a part of the jaws, or teeth
// Soft tissue over the frontal bone, the bone and a deep sinus stay below 30 mm; from the brain's front to the root
// of the nose it is 40 mm and more, to its tip 80.
constexpr double kFacialBlockMm = 35.0;
constexpr double kBlockHeightMm = 15.0, kBlockHeightOfHeadMm = 6.0;
// A mandible's body is about 30 mm high at the chin; what goes on above it is teeth and the upper jaw.
constexpr double kJawsHeightMm = 38.0, kJawsHeightOfHeadMm = 15.0;
constexpr double kGapMm = 12.0;  // an open mouth, fillings
// The chin is narrower than a jaw is taken for, and skin lies below the bone.
constexpr double kBelowChinMm = 15.0;
constexpr double kForeheadMm = 30.0;  // from the brow on up
constexpr double kDefacedMm = 60.0;   // nose, lips, eyes and the teeth in front lie less deep
constexpr double kLeastLeftMm = 10.0;

// The longest run of slices that fulfil something, with gaps; empty where there is none.
struct Run {
  int first = 0, last = -1;  // slices, upwards
  double height_mm(double spacing_mm) const { return last < first ? 0.0 : (last - first + 1) * spacing_mm; }
  bool empty() const noexcept { return last < first; }
};

template <typename Fulfils>
Run longest_run(int count, int gap, const Fulfils& fulfils) {
  Run longest, run;
  for (int k = 0; k < count; ++k) {
    if (!fulfils(k)) continue;
    if (run.empty() || k - run.last - 1 > gap) run = {k, k};
    run.last = k;
    if (run.last - run.first > longest.last - longest.first || longest.empty()) longest = run;
  }
  return longest;
}

// The direction in which most face lies over the run.
std::size_t front_of(const std::vector<HeadSlice>& slices, const Run& run) {
  std::array<double, kFronts> sum{};
  for (int k = run.first; k <= run.last; ++k)
    for (std::size_t i = 0; i < kFronts; ++i) sum[i] += slices[static_cast<std::size_t>(k)].block_mm[i];
  return static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
}

}  // namespace

FaceFinding find_face(const volume::Volume& volume, bool said_to_be_head) {
  const HeadSlices head = head_slices(volume);
  const auto& slices = head.slices;
  const int count = static_cast<int>(slices.size()), gap = static_cast<int>(std::lround(kGapMm / head.spacing_mm));
  const auto at = [&](int k) -> const HeadSlice& { return slices[static_cast<std::size_t>(k)]; };
  const Run block = longest_run(count, 1, [&](int k) {
    return at(k).brain && *std::max_element(at(k).block_mm.begin(), at(k).block_mm.end()) >= kFacialBlockMm;
  });
  const Run jaws = longest_run(count, gap, [&](int k) { return at(k).jaw; });
  const bool has_block =
      block.height_mm(head.spacing_mm) >= (said_to_be_head ? kBlockHeightOfHeadMm : kBlockHeightMm);
  const bool has_jaws = jaws.height_mm(head.spacing_mm) >= (said_to_be_head ? kJawsHeightOfHeadMm : kJawsHeightMm);
  FaceFinding face;
  face.found = has_block || has_jaws;
  if (!face.found) return face;

  const int nose = has_block ? block.first : jaws.first, top = has_block ? block.last : jaws.last;
  int lowest = nose;
  for (int k = nose - 1; k >= 0 && lowest - k <= gap + 1; --k)
    if (at(k).jaw) lowest = k;
  const bool chin_seen = !has_block || (nose - lowest) * head.spacing_mm >= kLeastJawMm;
  face.chin_lps_mm = chin_seen ? head.z_of(lowest) - kBelowChinMm : head.z_of(nose) - kNoseToChinMm;
  face.top_lps_mm = head.z_of(top);
  face.front = front_direction(has_block ? front_of(slices, block) : kFronts / 2);
  face.front_mm = head.foremost_mm(face.front, face.chin_lps_mm, face.top_lps_mm);
  return face;
}

namespace {

glm::dvec3 lps_of(const volume::Volume& volume, const glm::dvec3& index) {
  return glm::dvec3(volume.lps_from_voxel * glm::dvec4(index, 1.0));
}

// The axis of voxels nearest to the patient's feet-head axis.
int axis_to_head(const volume::Volume& volume) {
  int best = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(volume.lps_from_voxel[axis].z) / volume.spacing_mm[axis] >
        std::abs(volume.lps_from_voxel[best].z) / volume.spacing_mm[best])
      best = axis;
  return best;
}

// The part of the planes across `axis` that lies wholly below z.
bool keep_below(volume::Volume& volume, double z_lps_mm) {
  const int axis = axis_to_head(volume), other = (axis + 1) % 3, third = (axis + 2) % 3;
  const auto highest = [&](int plane) {
    double z = -std::numeric_limits<double>::infinity();
    for (const int u : {0, volume.size_voxels[other] - 1})
      for (const int v : {0, volume.size_voxels[third] - 1}) {
        glm::dvec3 index(0.0);
        index[axis] = plane;
        index[other] = u;
        index[third] = v;
        z = std::max(z, lps_of(volume, index).z);
      }
    return z;
  };
  int first = volume.size_voxels[axis], last = -1;
  for (int plane = 0; plane < volume.size_voxels[axis]; ++plane)
    if (highest(plane) < z_lps_mm) {
      first = std::min(first, plane);
      last = plane;
    }
  if (last < first || (last - first + 1) * volume.spacing_mm[axis] < kLeastLeftMm) return false;
  glm::ivec3 low(0), size = volume.size_voxels;
  low[axis] = first;
  size[axis] = last - first + 1;
  volume::Volume kept{size, volume.spacing_mm, volume.lps_from_voxel, {}};
  kept.lps_from_voxel[3] = glm::dvec4(lps_of(volume, glm::dvec3(low)), 1.0);
  kept.hu.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                  static_cast<std::size_t>(size.z));
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const auto row = volume.hu.begin() + static_cast<std::ptrdiff_t>(volume.index(low.x, low.y + j, low.z + k));
      kept.hu.insert(kept.hu.end(), row, row + size.x);
    }
  volume = std::move(kept);
  return true;
}

void take_front_away(volume::Volume& volume, const FaceFinding& face) {
  const double plane_mm = face.front_mm - kDefacedMm;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i) {
        const glm::dvec3 p = lps_of(volume, {i, j, k});
        if (p.z >= face.chin_lps_mm && p.z <= face.top_lps_mm + kForeheadMm && glm::dot(p, face.front) >= plane_mm)
          volume.hu[volume.index(i, j, k)] = volume::kAirHu;
      }
}

}  // namespace

base::Result<FaceState> settle_face(volume::Volume& volume, FaceChoice choice, bool said_to_be_head) {
  const FaceFinding face = find_face(volume, said_to_be_head);
  if (!face.found || choice == FaceChoice::overrule) return FaceState::none;
  if (choice == FaceChoice::refuse)
    return base::Error{"face",
                       "the volume shows a face, which can identify: crop it below the chin or deface it (--face)"};
  if (choice == FaceChoice::deface) {
    take_front_away(volume, face);
    return FaceState::defaced;
  }
  if (!keep_below(volume, face.chin_lps_mm) || find_face(volume, said_to_be_head).found)
    return base::Error{"face_only", "below the chin nothing of the volume is left that is no face"};
  return FaceState::cropped;
}

}  // namespace seldinger::casedb
