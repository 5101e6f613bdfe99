// One beam: the tissue along it, what sound loses on the way, and the echoes of what is not speckle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "shaders/shared/ultrasound_line.glsl.h"
#include "sim/imaging/ultrasound/needle_echo.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/motion.h"

namespace seldinger::imaging {

using shaders::kUsInterfaceConeRad, shaders::kUsInterfaceDb, shaders::kUsInterfaceRoughDb, shaders::kUsLensDb,
    shaders::kUsLensDbPerLine, shaders::kUsLensMm, shaders::kUsRepeatDb;

// Of a needle (needle_echo.h), two-way, right behind it. A half space of steel would take 17.6; walls of 0.2 mm
// leak (design).
constexpr double kNeedleShadowDb = 10.0;
constexpr double kTailDbPerLine = 5.0;  // of a comet tail (design, 4 to 6)
// Of a lumen's, which are a millimetre apart: as many as are told apart in pictures (Reusz et al., Br. J. Anaesth.
// 112 (2014) 794) rise above liver, and none ends before clutter hides it (design).
constexpr double kLumenDbPerLine = 8.0, kLeastTailDb = -30.0;

constexpr bool is_gas(volume::TissueClass tissue) noexcept {
  return tissue == volume::TissueClass::air || tissue == volume::TissueClass::gas;
}

struct LineEcho {
  double depth_mm;              // as it shows
  double amplitude;             // of the envelope's peak, loss included
  double parting_per_mm = 0.0;  // of rays behind it: us_parting_per_mm
};

struct Line {
  std::vector<volume::TissueClass> tissue;  // at each sample
  std::vector<float> loss_db;               // two-way, down to each sample
  std::vector<float> shift_mm;              // how much deeper than it lies each sample shows; empty: nowhere
  std::vector<LineEcho> echoes;
  bool contact = true;
};

// A needle on a beam.
struct NeedleLine {
  struct Echo {
    double depth_mm, amplitude;  // without the loss down to
    double loss_at_mm;
  };
  double depth_mm = -1.0;  // of the shaft's near side; < 0: none
  double shadow_db = 0.0;
  std::vector<Echo> echoes;
};
constexpr int kMostTailLines = 8, kMostNeedleEchoes = 2 + kMostTailLines;

class LineWalker {
 public:
  // What it is given outlives it. `motion`: of tissue that moves; else null.
  LineWalker(const UltrasoundView& view, const TissueAt& tissue_at, const volume::Volume& volume,
             const Inserted& inserted, const PictureMotion* motion = nullptr);
  void walk(int beam, bool contact, Line& line) const;
  // Tissue and loss alone, of so many samples from the face down, or a few more: the same bits as of all.
  void walk_down(int beam, bool contact, std::size_t samples, Line& line) const;

  // What a walk elsewhere (ultrasound_gpu) needs.
  struct Neighbour {
    glm::ivec3 offset;  // voxels
    glm::dvec3 offset_mm;
    double weight;
  };
  std::span<const Neighbour> around() const noexcept { return around_; }  // for an interface's normal
  std::span<const Neighbour> close() const noexcept { return close_; }    // for its place
  double most_shift_mm() const noexcept { return most_shift_mm_; }
  double least_side_mm() const noexcept { return least_side_mm_; }
  struct OfClass {
    double impedance_mrayl, loss_db_mm, shift_per_mm;
  };
  OfClass of_class(std::size_t tissue) const noexcept {
    return {table_[tissue].impedance_mrayl, loss_db_mm_[tissue], shift_per_mm_[tissue]};
  }
  NeedleLine needle_line(int beam) const;

 private:
  enum class Echoes { found, left_out };
  void walk(int beam, bool contact, std::size_t count, Line& line, Echoes echoes) const;
  struct Plane {
    bool is_told = false;
    glm::dvec3 normal{0.0};  // towards what comes after
    bool has_place = false;
    double off_mm = 0.0;  // along the normal, from the point asked
  };
  static std::vector<Neighbour> neighbours(const volume::Volume& volume, double radius_voxels);
  Plane plane_at(const glm::dvec3& p_lps_mm, double before_mrayl, double after_mrayl) const;
  // The round body that a beam leaves.
  struct Lens {
    double chord_mm, shift_inside, shift_outside;
    std::size_t entered;  // the first sample in it
    volume::TissueClass inside;
  };
  void add_interface(const BeamPath& path, int sample, double before_mrayl, double after_mrayl, double loss_db,
                     const std::optional<Lens>& lens, Line& line) const;
  // Of a body that is left above sample `left` by a plane; cosine: to that plane.
  double parting_per_mm(const BeamPath& path, const Lens& lens, int left, double cosine, double depth_mm) const;
  // From a place in a body to its end.
  double reach_mm(const glm::dvec3& from_lps_mm, const glm::dvec3& way, volume::TissueClass inside) const;
  double border_mm(const BeamPath& path, std::size_t sample, const Line& line) const;
  struct NeedleCrossing;
  NeedleCrossing crossing(const glm::dvec3& start, const glm::dvec3& direction) const;
  void shift(std::size_t first, Line& line) const;

  const UltrasoundView& view_;
  Fan fan_;
  const TissueAt& tissue_at_;
  std::vector<Neighbour> around_, close_;
  glm::dmat4 voxel_from_lps_, lps_from_voxel_;
  double most_shift_mm_;
  double least_side_mm_ = 0.0;  // of the sum of sides that tells a normal
  AcousticTable table_;
  std::array<double, volume::kTissueClasses> loss_db_mm_, shift_per_mm_;
  const NeedlePose* needle_;
  const PictureMotion* motion_;
  double frequency_mhz_;
  std::vector<double> depths_mm_;  // of the samples
};

}  // namespace seldinger::imaging
