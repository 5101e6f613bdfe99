// How a CT is prepared before it becomes a case's volume and skin (docs/decisions/0080): one row each. Options of
// import, fields of the case editor, JSON, `case show` and store loop over these rows.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// In the order in which they are applied. As it is, the CT stays as it came, with the skin that import always made.
struct Preparation {
  double clamp_low_hu = -1024.0, clamp_high_hu = 32767.0;
  double denoise = 0.0;                                   // iterations of anisotropic diffusion
  double shrink_i = 1.0, shrink_j = 1.0, shrink_k = 1.0;  // voxels of the CT averaged into one, along its axes
  double skin_hu = -300.0;
  double skin_grid_mm = 1.8;
  double skin_smooth = 15.0;   // terms of a windowed sinc
  double skin_decimate = 0.7;  // share of the triangles taken away
  bool operator==(const Preparation&) const = default;

  bool shrinks() const noexcept { return shrink_i > 1.0 || shrink_j > 1.0 || shrink_k > 1.0; }
  bool changes_volume() const noexcept;  // else the skin alone, or nothing
};

struct PreparationRow {
  double Preparation::*value;
  const char* name;    // column and JSON key
  const char* option;  // of import
  const char* what;    // follows the option, as the help shows it
  const char* help;
  const char* words;  // in the editor
  double least, most, step;
  int digits = 0;  // after the point; 0: a whole number
};

inline constexpr auto kPreparationRows = std::to_array<PreparationRow>({
    {&Preparation::clamp_low_hu, "clamp_low_hu", "--clamp-low", "HU",
     "lower values become this, except -1024, where nothing was measured; default -1024", "clamp from HU", -1024.0,
     -500.0, 10.0},
    {&Preparation::clamp_high_hu, "clamp_high_hu", "--clamp-high", "HU", "higher values become this; default 32767",
     "clamp to HU", 500.0, 32767.0, 100.0},
    {&Preparation::denoise, "denoise", "--denoise", "N",
     "how many times noise is smoothed by diffusion, which keeps edges; default 0, 5 for a noisy CT",
     "denoise, times", 0.0, 30.0, 1.0},
    {&Preparation::shrink_i, "shrink_i", "--shrink-i", "N", "voxels of a row averaged into one; default 1",
     "shrink rows by", 1.0, 8.0, 1.0},
    {&Preparation::shrink_j, "shrink_j", "--shrink-j", "N", "voxels of a column averaged into one; default 1",
     "shrink columns by", 1.0, 8.0, 1.0},
    {&Preparation::shrink_k, "shrink_k", "--shrink-k", "N", "slices averaged into one; default 1",
     "shrink slices by", 1.0, 8.0, 1.0},
    {&Preparation::skin_hu, "skin_hu", "--skin-hu", "HU", "where the skin is: its iso-value; default -300",
     "skin at HU", -900.0, -50.0, 10.0},
    {&Preparation::skin_grid_mm, "skin_grid_mm", "--skin-grid-mm", "MM",
     "grid of the skin: voxels are averaged up to about this; default 1.8", "skin's grid mm", 0.5, 10.0, 0.1, 1},
    {&Preparation::skin_smooth, "skin_smooth", "--skin-smooth", "N",
     "terms of the filter that smooths the skin; default 15; 0: not smoothed", "smooth the skin", 0.0, 100.0, 5.0},
    {&Preparation::skin_decimate, "skin_decimate", "--skin-decimate", "SHARE",
     "share of the skin's triangles that is removed; default 0.7", "take triangles away", 0.0, 0.98, 0.05, 2},
});

// `bad_preparation` with every value that is out of its bounds, not whole where it must be, or NaN; or where the
// skin does not lie above the lower clamp.
base::Result<void> check_preparation(const Preparation& preparation);

// "denoise 5, shrink_k 2": what is other than usual; empty: nothing.
std::string text_of(const Preparation& preparation);

// What is stored of a case that was prepared.
struct StoredPreparation {
  Preparation settings;
  std::string original_sha256;  // the volume before
};
std::optional<StoredPreparation> find_preparation(Sqlite& database, const std::string& case_id);
void add_preparation(Sqlite& database, const std::string& case_id, const StoredPreparation& stored);

}  // namespace seldinger::casedb
