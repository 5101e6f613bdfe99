#include "casedb/import/source_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "casedb/import/dicom/allow_list.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kLongestText = 4000, kMostWarnings = 10'000, kMostDropped = 100'000;

// The library's own conditions on a volume (sim/volume/volume.h).
void make_sure(const volume::Volume& volume) {
  for (int axis = 0; axis < 3; ++axis) {
    const double length_mm = glm::length(glm::dvec3(volume.lps_from_voxel[axis]));
    const bool sound = length_mm >= volume::kMinSpacingMm && length_mm <= volume::kMaxSpacingMm &&
                       std::abs(length_mm - volume.spacing_mm[axis]) <= 1e-9 * length_mm &&
                       std::abs(volume.lps_from_voxel[3][axis]) < 1e7 && volume.lps_from_voxel[axis][3] == 0.0;
    if (!sound) throw JailBroken();
  }
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 a(volume.lps_from_voxel[axis]), b(volume.lps_from_voxel[(axis + 1) % 3]);
    if (!(std::abs(glm::dot(a, b)) <= 0.01 * glm::length(a) * glm::length(b))) throw JailBroken();
  }
  if (volume.lps_from_voxel[3][3] != 1.0) throw JailBroken();
}

void take_voxels(Inlet& in, volume::Volume& volume) {
  std::uint64_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (volume.size_voxels[axis] < 1) throw JailBroken();
    voxels *= static_cast<std::uint64_t>(volume.size_voxels[axis]);
    if (voxels > volume::kMaxVoxels) throw JailBroken();
  }
  if (voxels * sizeof(std::int16_t) > in.announced_bytes()) throw JailBroken();
  volume.hu.resize(static_cast<std::size_t>(voxels));
  in.take_bytes(std::as_writable_bytes(std::span(volume.hu)));
  if (*std::min_element(volume.hu.begin(), volume.hu.end()) < volume::kAirHu) throw JailBroken();
}

}  // namespace

void put_source(Outlet& out, const base::Result<Source>& source) {
  out.put(source.has_value());
  if (!source) return out.put_error(source.error());
  out.put<std::uint64_t>(source->attributes.size());
  for (const auto& [name, value] : source->attributes) {
    out.put_text(name);
    out.put_text(value);
  }
  out.put<std::uint64_t>(source->warnings.size());
  for (const base::Problem& warning : source->warnings) out.put_problem(warning);
  out.put<std::uint64_t>(source->dropped.size());
  for (const Dropped& one : source->dropped) {
    for (const std::string* text : {&one.tag, &one.keyword, &one.reason}) out.put_text(*text);
    out.put(one.count);
  }
  out.put(source->says_head);
  out.put(source->slices_used);
  const volume::Volume& volume = source->volume;
  for (int axis = 0; axis < 3; ++axis) out.put(volume.size_voxels[axis]);
  for (int axis = 0; axis < 3; ++axis) out.put(volume.spacing_mm[axis]);
  for (int i = 0; i < 16; ++i) out.put(volume.lps_from_voxel[i / 4][i % 4]);
  out.put_bytes(std::as_bytes(std::span(volume.hu)));
}

base::Result<Source> take_source(Inlet& in) {
  if (!in.take_flag()) return in.take_error();
  Source source;
  for (std::size_t count = in.take_count(kMostAttributes); count > 0; --count) {
    std::string name = in.take_text(kLongestText), value = in.take_text(kLongestText);
    const auto allowed = allow_list();
    if (std::none_of(allowed.begin(), allowed.end(), [&](const AllowedAttribute& one) { return one.name == name; }))
      throw JailBroken();
    source.attributes.emplace_back(std::move(name), std::move(value));
  }
  for (std::size_t count = in.take_count(kMostWarnings); count > 0; --count)
    source.warnings.push_back(in.take_problem());
  for (std::size_t count = in.take_count(kMostDropped); count > 0; --count) {
    Dropped one;
    for (std::string* text : {&one.tag, &one.keyword, &one.reason}) *text = in.take_text(kLongestText);
    one.count = in.take<std::int64_t>();
    source.dropped.push_back(std::move(one));
  }
  source.says_head = in.take_flag();
  source.slices_used = in.take<int>();
  volume::Volume& volume = source.volume;
  for (int axis = 0; axis < 3; ++axis) volume.size_voxels[axis] = in.take<int>();
  for (int axis = 0; axis < 3; ++axis) volume.spacing_mm[axis] = in.take<double>();
  for (int i = 0; i < 16; ++i) volume.lps_from_voxel[i / 4][i % 4] = in.take<double>();
  make_sure(volume);
  take_voxels(in, volume);
  return source;
}

}  // namespace seldinger::casedb
