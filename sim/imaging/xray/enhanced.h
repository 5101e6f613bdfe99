// The contrast medium that a CT was taken with. HU of enhanced vessels, fluids and organs, by class, in excess of
// what they have without it are iodine's, not bone mineral's (docs/decisions/0098). A volume of its own tells how
// many: −1000 HU and what iodine adds, so that a projector's lengths of it are millimetres of 1000 HU more. They
// are taken from the patient's mineral and put to the contrast medium: at the CT's own energy nothing changes by
// that.
#pragma once

#include <optional>
#include <vector>

#include "sim/case/case.h"
#include "sim/imaging/inserted.h"
#include "sim/imaging/xray/projection/moved_volume.h"
#include "sim/imaging/xray/projection/projection.h"
#include "sim/tissue/displacement.h"

namespace seldinger::imaging {

// The highest CT number that iodine makes of a class, of a CT whose numbers are true at this energy; beyond is
// calcified plaque, stone or metal, which has displaced what is enhanced. Nothing: of this class nothing is
// enhanced.
std::optional<double> most_enhanced_hu(volume::TissueClass tissue, double ct_kev);

constexpr double kNotEnhancedHu = -1000.0;  // in a volume of iodine

// Where tissue has it in one moment, as projectors and instruments take it; as long as the Enhancement is there and
// moves no more.
struct EnhancedTissue {
  const volume::Volume* volume;
  const XrayCpu* projector;
  const std::vector<double>* lesions_hu;  // a drawn lesion's in that volume, in the case's order
  double contrast_mm;                     // of contrast medium in a millimetre of 1000 HU more

  // What lies in this volume where `inserted` (the case's lesions, or none) lies in the patient's.
  Inserted inserted_here(const Inserted& inserted) const;
  PathLengths project(const XrayGeometry& geometry, const CpuOptions& options) const;
};

// `lengths` as the patient's volume and `inserted` gave them; `enhanced` as project() did in the same geometry.
void tell_iodine(const EnhancedTissue& tissue, const XrayGeometry& geometry, const Inserted& inserted,
                 PathLengths enhanced, PathLengths& lengths);

class Enhancement {
 public:
  // Of the case's volume by its classes and what it knows of its CT. Without classes there is none.
  explicit Enhancement(const cases::Case& scene);
  Enhancement(const Enhancement&) = delete;
  Enhancement& operator=(const Enhancement&) = delete;

  bool any() const noexcept { return projector_.has_value(); }
  // Only where there is any.
  EnhancedTissue at_rest() const;
  EnhancedTissue moved(const tissue::Displacement& displacement, const XrayGeometry& geometry);

 private:
  void lay(const cases::Case& scene, double ct_kev);
  double ct_kev_;
  volume::Volume volume_;  // at rest: the box around what there is
  std::vector<double> lesions_hu_;
  std::optional<XrayCpu> projector_;
  std::optional<MovedVolume> moved_;
};

}  // namespace seldinger::imaging
