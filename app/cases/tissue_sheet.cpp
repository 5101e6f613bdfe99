#include "app/cases/tissue_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "sim/base/check.h"

namespace seldinger::app {
namespace {

constexpr int kColumns = 5, kGap = 4, kLegendRow = 12, kLegendColumns = 5, kLegendWidth = 170;
constexpr double kPixelMm = 1.5, kLowestHu = -160.0, kHighestHu = 240.0;
constexpr Colour kInk{230, 230, 230};

// By number of the class, which are stored and stay.
constexpr std::array<Colour, volume::kTissueClasses> kClassColours{{
    {0, 0, 0},        // air
    {40, 80, 200},    // gas
    {60, 150, 230},   // lung
    {230, 210, 80},   // fat
    {0, 210, 210},    // fluid
    {0, 0, 0},        // soft tissue
    {200, 110, 50},   // liver
    {60, 200, 60},    // kidney
    {170, 90, 250},   // spleen
    {190, 80, 90},    // muscle
    {240, 190, 160},  // skin
    {150, 150, 220},  // connective
    {240, 40, 40},    // vessel
    {255, 190, 110},  // bone
    {255, 0, 255},    // metal
}};
constexpr std::array<Colour, volume::kFoundOrganNames.size()> kOrganColours{{{0, 0, 0},
                                                                             {255, 130, 40},   // liver
                                                                             {170, 80, 255},   // spleen
                                                                             {60, 220, 60},    // right kidney
                                                                             {60, 220, 160},   // left kidney
                                                                             {60, 120, 255},   // right lung
                                                                             {100, 200, 255},  // left lung
                                                                             {255, 255, 120},  // vertebrae
                                                                             {200, 160, 0},    // ribs
                                                                             {255, 0, 0},      // aorta
                                                                             {0, 0, 255},      // vena cava
                                                                             {0, 255, 255},    // bladder
                                                                             {180, 255, 0}}};  // gallbladder

bool is_black(const Colour& colour) {
  return colour.red == 0 && colour.green == 0 && colour.blue == 0;
}

Colour mixed(unsigned char grey, const Colour& tint) {
  if (is_black(tint)) return {grey, grey, grey};
  const auto half = [&](unsigned char one) { return static_cast<unsigned char>((grey + one) / 2); };
  return {half(tint.red), half(tint.green), half(tint.blue)};
}

}  // namespace

Colour colour_of(volume::TissueClass tissue) {
  return kClassColours[static_cast<std::size_t>(tissue)];
}

Colour colour_of(volume::FoundOrgan organ) {
  return kOrganColours[static_cast<std::size_t>(organ)];
}

Canvas tissue_sheet(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                    const volume::Organs& organs) {
  CHECK(classes.size() == volume.hu.size());
  const volume::Volume& grid = organs.grid;
  const glm::dvec3 extent_mm = glm::dvec3(grid.size_voxels) * grid.spacing_mm;
  const int width = std::max(1, static_cast<int>(extent_mm.x / kPixelMm)),
            height = std::max(1, static_cast<int>(extent_mm.y / kPixelMm)),
            slices = std::min(kSheetSlices, grid.size_voxels.z), rows = (slices + kColumns - 1) / kColumns;
  std::vector<std::pair<std::string, Colour>> legend;
  for (std::size_t at = 0; at < kClassColours.size(); ++at)
    if (!is_black(kClassColours[at]) &&
        std::find(classes.begin(), classes.end(), static_cast<volume::TissueClass>(at)) != classes.end())
      legend.emplace_back(volume::about(static_cast<volume::TissueClass>(at)).name, kClassColours[at]);
  for (const volume::OrganFound& one : organs.found)
    if (one.confidence >= volume::kOrganConfidence)
      legend.emplace_back(std::string("found: ") + std::string(base::name_of(volume::kFoundOrganNames, one.organ)) +
                              " " + std::to_string(std::lround(100.0 * one.confidence)) + " %",
                          colour_of(one.organ));
  const int legend_rows = (static_cast<int>(legend.size()) + kLegendColumns - 1) / kLegendColumns;
  const int all_wide = std::max(kColumns * (width + kGap), kLegendColumns * kLegendWidth),
            top = rows * (height + kGap);
  Canvas canvas(all_wide, top + legend_rows * kLegendRow + kGap, {0, 0, 0});
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  for (int slice = 0; slice < slices; ++slice) {
    const double k = (slices - slice - 0.5) * grid.size_voxels.z / slices - 0.5;
    const int left = slice % kColumns * (width + kGap), upper = slice / kColumns * (height + kGap);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const glm::dvec3 in_grid((x + 0.5) * kPixelMm / grid.spacing_mm.x - 0.5,
                                 (y + 0.5) * kPixelMm / grid.spacing_mm.y - 0.5, k);
        const glm::dvec4 lps = grid.lps_from_voxel * glm::dvec4(in_grid, 1.0);
        const glm::ivec3 at(glm::floor(glm::dvec3(voxel_from_lps * lps) + 0.5));
        if (at != glm::clamp(at, glm::ivec3(0), volume.size_voxels - 1)) continue;
        const std::size_t voxel = volume.index(at.x, at.y, at.z);
        const double shown = (volume.hu[voxel] - kLowestHu) / (kHighestHu - kLowestHu);
        const auto grey = static_cast<unsigned char>(std::lround(255.0 * std::clamp(shown, 0.0, 1.0)));
        const glm::ivec3 near = glm::clamp(glm::ivec3(glm::round(in_grid)), glm::ivec3(0), grid.size_voxels - 1);
        const volume::FoundOrgan organ = organs.at[grid.index(near.x, near.y, near.z)];
        const Colour tint = organ != volume::FoundOrgan::none ? colour_of(organ) : colour_of(classes[voxel]);
        canvas.fill({left + x, upper + y, 1, 1}, mixed(grey, tint));
      }
  }
  for (std::size_t at = 0; at < legend.size(); ++at) {
    const int left = static_cast<int>(at) % kLegendColumns * (all_wide / kLegendColumns),
              upper = top + static_cast<int>(at) / kLegendColumns * kLegendRow;
    canvas.fill({left, upper, 9, 9}, legend[at].second);
    canvas.text(left + 13, upper + 1, 1, legend[at].first, kInk);
  }
  return canvas;
}

}  // namespace seldinger::app
