#include "casedb/import/dicom/dicom_volume.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "casedb/import/dicom/frame_pixels.h"
#include "casedb/import/dicom/resample.h"
#include "casedb/import/dicom/slice_stack.h"
#include "casedb/import/files/number_text.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/jail/unpacking.h"

namespace seldinger::casedb {
namespace {

using Slices = std::vector<DicomSlice>;
using Warnings = std::vector<base::Problem>;

constexpr std::size_t kMostSlices = 4096;
constexpr double kMostGrowth = 2.0, kFreeGrowthBytes = 64.0 * 1024 * 1024;  // of resampled voxels
constexpr double kSparse = 1.5;    // gaps in thicknesses: overlapping or touching slices are 1 at most
constexpr double kCoarseHu = 8.0;  // a step of a stored value that is no longer below a CT's noise

std::size_t pixels_of(const DicomSlice& slice) {
  return static_cast<std::size_t>(slice.size_px.x) * static_cast<std::size_t>(slice.size_px.y);
}

std::size_t count_of(const Slices& slices, bool DicomSlice::*flag) {
  return static_cast<std::size_t>(
      std::count_if(slices.begin(), slices.end(), [&](const DicomSlice& slice) { return slice.*flag; }));
}

std::string slice_name(std::size_t index, std::size_t count) {
  return "slice " + std::to_string(index + 1) + " of " + std::to_string(count) + " (ordered by position) ";
}

void judge_lossy(const Slices& slices, Problems& problems, Warnings& warnings) {
  double most = 0.0;
  for (const DicomSlice& slice : slices) {
    if (!slice.lossy) continue;
    most = std::max(most, slice.lossy_ratio);
    if (slice.pixels.encapsulated)
      most = std::max(most, static_cast<double>(pixels_of(slice)) * slice.bits_allocated / 8.0 /
                                static_cast<double>(std::max<std::size_t>(slice.pixels.bytes(), 1)));
  }
  const std::size_t count = count_of(slices, &DicomSlice::lossy);
  if (count == 0) return;
  const std::string text = "of " + count_text(slices.size(), "slice") + " " + std::to_string(count) +
                           (count == 1 ? " was" : " were") + " compressed with loss, " +
                           (most > 0.0 ? "up to " + number_text(most) + ":1" : "nobody says how much");
  if (most > kMostLossyRatio)
    problems.add("lossy", text + "; above " + number_text(kMostLossyRatio) + ":1 the HU are not kept well enough");
  else
    warnings.push_back({"lossy", text + ": HU are close to the scanner's, not the same"});
}

// Where only some slices lack a rescale, the others show that the 1 and 0 taken for them are wrong.
void judge_rescale(const Slices& slices, Problems& problems) {
  const std::size_t lack = count_of(slices, &DicomSlice::no_rescale);
  const bool others = std::any_of(slices.begin(), slices.end(), [](const DicomSlice& slice) {
    return !slice.no_rescale && (slice.slope != 1.0 || slice.intercept != 0.0);
  });
  if (lack > 0 && others)
    problems.add("no_rescale", "rescale slope or intercept is missing in " + std::to_string(lack) + " of " +
                                   count_text(slices.size(), "slice") + ": their values are not the others' HU");
}

void judge_values(const Slices& slices, Warnings& warnings) {
  const auto say = [&](bool DicomSlice::*flag, const char* code, const std::string& text) {
    if (const std::size_t count = count_of(slices, flag); count > 0)
      warnings.push_back(
          {code, text + " (" + std::to_string(count) + " of " + std::to_string(slices.size()) + ")"});
  };
  say(&DicomSlice::no_rescale, "no_rescale", "rescale slope or intercept is missing: 1 and 0 are taken");
  say(&DicomSlice::not_hu, "not_hu", "the values are not said to be HU");
  say(&DicomSlice::is_virtual, "virtual_image",
      "virtual pictures, computed for one energy or without a material: HU are not those of the scan");
  say(&DicomSlice::described, "virtual_image",
      "the series' description names iodine or virtual pictures: look whether these are HU of the scan");
  say(&DicomSlice::secondary, "secondary", "derived pictures: look whether text is burned into them");
  say(&DicomSlice::monochrome1, "monochrome1",
      "low values are meant to be shown bright: HU stay as they are stored");
  say(&DicomSlice::wrong_syntax, "wrong_syntax", "the data set is not written in the syntax it names");
  double coarsest = 0.0;
  for (const DicomSlice& slice : slices) coarsest = std::max(coarsest, std::abs(slice.slope));
  if (coarsest > kCoarseHu)
    warnings.push_back({"coarse_hu", "a step of a stored value is " + number_text(coarsest) + " HU"});
}

// Drops all but one of slices with the same pixels at one place.
void drop_duplicates(Slices& slices, SliceReader& reader, Problems& problems, Warnings& warnings) {
  Slices kept;
  std::vector<std::int16_t> first, other;
  std::size_t dropped = 0, different = 0, most_hu = 0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (kept.empty() || !at_one_height(kept.back(), slices[i])) {
      first.clear();
      kept.push_back(std::move(slices[i]));
      continue;
    }
    const bool aside = glm::length(kept.back().position_lps_mm - slices[i].position_lps_mm) > 2.0 * kSamePlaceMm;
    other.resize(pixels_of(slices[i]));
    bool good = true;
    if (first.empty()) {
      first.resize(pixels_of(kept.back()));
      good = reader.read(kept.back(), first).has_value();
    }
    if (!good || !reader.read(slices[i], other)) {
      problems.add("damaged", "a slice that lies at the place of another cannot be decoded");
      return;
    }
    if (!aside && first == other) {
      ++dropped;
      continue;
    }
    ++different;
    for (std::size_t p = 0; p < first.size(); ++p)
      most_hu = std::max(most_hu, static_cast<std::size_t>(std::abs(first[p] - other[p])));
  }
  if (different > 0)
    problems.add("duplicate_slices", count_text(different, "slice") + " of " + std::to_string(slices.size()) +
                                         " with other pixels at the place of another, differing by up to " +
                                         std::to_string(most_hu) + " HU: several series or times in one");
  if (dropped > 0)
    warnings.push_back({"duplicate_slices",
                        "dropped as copies, with the same pixels at the same place: " + std::to_string(dropped) +
                            " of " + count_text(slices.size(), "slice")});
  slices = std::move(kept);
}

void judge_size(const Slices& slices, const Stack& stack, Problems& problems) {
  double voxels = 1.0, packed = 0.0, unpacked = 0.0, given = 0.0;
  for (int axis = 0; axis < 3; ++axis) voxels *= stack.size_voxels[axis];
  if (voxels > static_cast<double>(volume::kMaxVoxels))
    problems.add("bad_size", "the series has more voxels than can be held");
  for (const DicomSlice& slice : slices) {
    given += static_cast<double>(pixels_of(slice));
    if (!slice.pixels.encapsulated) continue;
    packed += static_cast<double>(slice.pixels.bytes());
    unpacked += static_cast<double>(pixels_of(slice)) * 2.0;
  }
  if (2.0 * voxels > 2.0 * kMostGrowth * given + kFreeGrowthBytes)
    problems.add("bad_size", "the slices stand so far aside of each other that the volume would be " +
                                 number_text(voxels / given) + " times as large as they are");
  if (unpacks_too_far(kDicomPixels, static_cast<std::uint64_t>(packed), static_cast<std::uint64_t>(unpacked)))
    problems.add("bad_size", "the pixels are " + number_text(unpacked / std::max(packed, 1.0)) +
                                 " times as large as they are packed: no CT is");
}

void judge_spacing(const Slices& slices, double step_mm, Warnings& warnings) {
  double thinnest_mm = 0.0;
  for (const DicomSlice& slice : slices)
    if (slice.thickness_mm > 0.0 && (thinnest_mm == 0.0 || slice.thickness_mm < thinnest_mm))
      thinnest_mm = slice.thickness_mm;
  if (slices.size() > 1 && thinnest_mm > 0.0 && step_mm > kSparse * thinnest_mm)
    warnings.push_back({"sparse_slices", "the slices are " + number_text(thinnest_mm) + " mm thick and " +
                                             number_text(step_mm) +
                                             " mm apart: what lies between them was not scanned"});
}

// Reads every slice once, in order, so that no more than two lie in memory beside the volume.
void fill(const Slices& slices, const Stack& stack, SliceReader& reader, Problems& problems,
          volume::Volume& volume) {
  const glm::ivec2 slice_px = slices.front().size_px, layer_px(volume.size_voxels);
  const std::size_t layer_voxels = static_cast<std::size_t>(layer_px.x) * static_cast<std::size_t>(layer_px.y);
  const auto layer = [&](int k) {
    return std::span<std::int16_t>(volume.hu).subspan(static_cast<std::size_t>(k) * layer_voxels, layer_voxels);
  };
  const auto read = [&](std::size_t i, std::span<std::int16_t> hu) {
    if (const auto good = reader.read(slices[i], hu); !good)
      problems.add(good.error().code, slice_name(i, slices.size()) + good.error().text);
  };
  if (stack.as_is) {
    for (std::size_t i = 0; i < slices.size(); ++i) read(i, layer(static_cast<int>(i)));
    return;
  }
  std::vector<std::int16_t> below(pixels_of(slices.front())), above(below.size());
  read(0, above);
  int k = 0;
  for (std::size_t i = 1; i < slices.size(); ++i) {
    std::swap(below, above);
    read(i, above);
    const double from = stack.place[i - 1], to = stack.place[i];
    const bool last = i + 1 == slices.size();
    for (; k < volume.size_voxels.z && (k < to || last); ++k)
      blend_layer({below, stack.shift_px[i - 1]}, {above, stack.shift_px[i]},
                  std::clamp((k - from) / (to - from), 0.0, 1.0), slice_px, layer_px, layer(k));
  }
}

}  // namespace

namespace {

void tell_privacy(const Slices& slices, Source& source) {
  DroppedCount dropped;
  for (const DicomSlice& slice : slices) {
    dropped.add(slice.dropped);
    source.says_head = source.says_head || slice.says_head;
  }
  source.dropped = dropped.counts();
}

}  // namespace

base::Result<Source> volume_of(Slices slices, Problems problems, Warnings warnings) {
  if (slices.size() > kMostSlices) {
    problems.add("too_many_slices", "the series has " + std::to_string(slices.size()) + " slices, more than 4096");
    return problems.error();
  }
  judge_identity(slices, problems);
  order_slices(slices, problems, warnings);
  judge_lossy(slices, problems, warnings);
  judge_rescale(slices, problems);
  judge_values(slices, warnings);
  if (!problems.empty()) return problems.error();
  SliceReader reader;
  drop_duplicates(slices, reader, problems, warnings);
  if (!problems.empty()) return problems.error();
  const Stack stack = stack_of(slices, problems, warnings);
  judge_size(slices, stack, problems);
  if (!problems.empty()) return problems.error();

  Source source;
  source.slices_used = static_cast<int>(slices.size());
  source.attributes = slices.front().attributes;
  tell_privacy(slices, source);
  volume::Volume& volume = source.volume;
  volume.size_voxels = stack.size_voxels;
  volume.lps_from_voxel = stack.lps_from_voxel;
  for (int axis = 0; axis < 3; ++axis)
    volume.spacing_mm[axis] = glm::length(glm::dvec3(volume.lps_from_voxel[axis]));
  judge_spacing(slices, volume.spacing_mm.z, warnings);
  if (slices.size() == 1) warnings.push_back({"single_slice", "the case is one slice"});
  const std::size_t voxels = static_cast<std::size_t>(volume.size_voxels.x) *
                             static_cast<std::size_t>(volume.size_voxels.y) *
                             static_cast<std::size_t>(volume.size_voxels.z);
  announce_bytes(voxels * sizeof(std::int16_t));
  volume.hu.resize(voxels);
  fill(slices, stack, reader, problems, volume);
  if (!problems.empty()) return problems.error();
  source.warnings = std::move(warnings);
  return source;
}

}  // namespace seldinger::casedb
