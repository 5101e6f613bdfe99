// One beam: the tissue along it, what sound loses on the way, and the echoes of what is not speckle.
#pragma once

#include <span>
#include <vector>

#include "sim/imaging/ultrasound/fan.h"
#include "sim/imaging/ultrasound/needle_echo.h"

namespace seldinger::imaging {

// Level of the echo of a mirror across a thick interface, at normal incidence without loss, above liver's speckle.
// A mirror would be 61 dB above it: backscatter 3.7e-6·f^1.4 /mm/sr (calf liver), pulse 0.3 mm, F/2 by h/z; the
// interfaces of organs are rough and give 40 (design).
constexpr double kInterfaceDb = 40.0;
constexpr double kInterfaceConeRad = 0.2618;  // 15°: how far off the normal such an interface still shines (design)
constexpr double kInterfaceRoughDb = -26.0;   // of its part that goes everywhere, as the cosine (design)

// Of a needle (needle_echo.h), two-way, right behind it. A half space of steel would take 17.6; walls of 0.2 mm
// leak (design).
constexpr double kNeedleShadowDb = 10.0;
constexpr double kTailDbPerLine = 5.0;  // of a comet tail (design, 4 to 6)

// Echoes of strong reflectors come again from between them and the face, so much weaker each time (design, 10 to
// 15).
constexpr double kRepeatDb = 12.0;
constexpr double kRepeatsFrom = 0.9;  // |R|: gas
// A face in air shows its own lens: a line every 1.5 mm, half each time (design).
constexpr double kLensMm = 1.5, kLensDb = 40.0, kLensDbPerLine = 6.0;

// Air down to here under an element in contact is a CT's blurred skin, and coupled by gel.
constexpr double kGelMm = 3.0;
constexpr double kMatchedMrayl = 1.65;  // gel and lens
constexpr double kDeadDb = 400.0;       // nothing comes back; keeps sums finite
constexpr bool is_gas(volume::TissueClass tissue) noexcept {
  return tissue == volume::TissueClass::air || tissue == volume::TissueClass::gas;
}

struct LineEcho {
  double depth_mm;   // as it shows
  double amplitude;  // of the envelope's peak, loss included
};

struct Line {
  std::vector<volume::TissueClass> tissue;  // at each sample
  std::vector<float> loss_db;               // two-way, down to each sample
  std::vector<float> shift_mm;              // how much deeper than it lies each sample shows; empty: nowhere
  std::vector<LineEcho> echoes;
  bool contact = true;
};

class LineWalker {
 public:
  LineWalker(const UltrasoundView& view, const TissueAt& tissue_at, const volume::Volume& volume,
             const Inserted& inserted);
  void walk(int beam, bool contact, Line& line) const;

 private:
  struct Neighbour {
    glm::dvec3 offset_mm;
    double weight;
  };
  struct Plane {
    glm::dvec3 normal{0.0};  // towards what comes after
    bool has_place = false;
    double off_mm = 0.0;  // along the normal, from the point asked
  };
  static std::vector<Neighbour> neighbours(const volume::Volume& volume, double radius_voxels);
  Plane plane_at(const glm::dvec3& p_lps_mm, double before_mrayl, double after_mrayl) const;
  void add_interface(const glm::dvec3& start, const glm::dvec3& direction, int sample, double before_mrayl,
                     double after_mrayl, double loss_db, Line& line) const;
  double border_mm(const glm::dvec3& start, const glm::dvec3& direction, std::size_t sample, const Line& line) const;
  struct NeedleCrossing;
  NeedleCrossing crossing(const glm::dvec3& start, const glm::dvec3& direction) const;
  void add_needle(const NeedleCrossing& at, Line& line) const;
  void shift(std::size_t first, Line& line) const;

  const UltrasoundView& view_;
  Fan fan_;
  const TissueAt& tissue_at_;
  std::vector<Neighbour> around_, close_;
  glm::dmat4 voxel_from_lps_, lps_from_voxel_;
  double most_shift_mm_;
  AcousticTable table_;
  std::array<double, volume::kTissueClasses> loss_db_mm_, shift_per_mm_;
  const NeedlePose* needle_;
  double frequency_mhz_;
};

}  // namespace seldinger::imaging
