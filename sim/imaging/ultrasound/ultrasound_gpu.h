// Ultrasound on the GPU (GL 4.3 compute): the envelope of ultrasound_polar, of the same numbers in float. Passes:
// what lies along the beams → scatterers or lattice → where sound of another speed shows them → pulse and echoes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/gpu/context.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

// Whether what pictures of a patient who moves need is made.
enum class TissueMoves { no, yes };

// Who walks along the beams (line.h): on llvmpipe the CPU's own walk of 1 to 3 ms is quicker than the shader's.
enum class LinesBy { machine, cpu, gpu };  // machine: the GPU where GL has hardware

// Holds the tissue, two bytes a voxel, as a stack of integer 2-D textures, and its buffers between pictures. On the
// context's thread; may outlive the context, not the tissue. Throws base::Failure("gl") when the volume exceeds the
// largest texture or memory. Same input, same bits.
class UltrasoundGpu {
 public:
  UltrasoundGpu(gpu::Context& context, const TissueVolume& tissue, LinesBy by = LinesBy::machine,
                TissueMoves moves = TissueMoves::no);
  ~UltrasoundGpu();

  // As ultrasound_polar. A displacement with sources only of tissue that moves (CHECKed).
  void polar(const UltrasoundView& view, const Inserted& inserted, std::span<const float> depth_below_skin_mm,
             PolarPicture& picture, const tissue::Displacement& displacement = {});

  // On the GPU: the buffers, which grow to what a picture needs, and the tissue.
  std::size_t buffer_bytes() const noexcept;
  std::size_t tissue_bytes() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::imaging
