// A scene's view as a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/pictures/meta_image.h"
#include "app/pictures/scene.h"
#include "sim/case/form/mesh_index.h"
#include "sim/imaging/mpr/visibility.h"
#include "sim/tissue/displacement.h"

namespace seldinger::app {

struct ScenePicture {
  PicturePlane plane;
  std::vector<float> values;          // in `unit`, row-major
  std::vector<unsigned char> grey;    // what a person sees
  std::vector<unsigned char> rgb;     // over it in colour, three bytes a pixel; empty: grey alone
  std::optional<double> colour_mm_s;  // colour Doppler: the speed at which it wraps
  const char* unit = "";
  std::string backend;  // gpu, cpu or reference: what made it
  std::optional<imaging::Visible> visible;
  std::optional<double> frame_rate_hz;  // ultrasound: what sound allows at this depth and number of beams
};

std::vector<std::byte> png_of(const ScenePicture& picture);

// Pictures of one volume: what they need of it beside its voxels is made once, when the first of them asks.
class ScenePainter {
 public:
  // The scene's volume. Refused as volume_of.
  static base::Result<ScenePainter> of(const Scene& scene, const std::string& library);

  // `scene` has a view, and the volume that the painter was made of. Refused as classes_of (a case's damaged
  // assets). `backend`: gpu, cpu, reference, or empty: the faster of the machine. Throws base::Failure("gl") when
  // gpu was asked for and cannot be had.
  base::Result<ScenePicture> paint(const Scene& scene, const std::string& backend);

 private:
  struct Tissue {
    std::vector<volume::TissueClass> classes;
    std::vector<std::uint8_t> echogenicity;
    std::optional<tissue::BreathRegion> trunk;  // nothing without a body
    cases::SightLaw law;
    std::optional<tissue::CavityWall> wall;  // where it is told
  };
  struct Skin {
    std::optional<cases::Mesh> mesh;  // nothing without a body: then all elements stand in air
    cases::MeshIndex index;
  };
  ScenePainter(volume::Volume volume, std::string library)
      : volume_(std::move(volume)), library_(std::move(library)) {}
  base::Result<void> find_tissue(const Scene& scene);
  tissue::Displacement displacement_of(const Scene& scene) const;
  void paint_ultrasound(const UltrasoundSceneView& scene, const imaging::Inserted& inserted,
                        const tissue::Displacement& displacement, ScenePicture& picture) const;
  void paint_colour(const UltrasoundSceneView& scene, const imaging::Inserted& inserted,
                    std::span<const cases::Structure> structures, double beat_s,
                    const tissue::Displacement& displacement, ScenePicture& picture) const;

  volume::Volume volume_;
  std::string library_;
  std::optional<Tissue> tissue_;  // for ultrasound, and for what moves; of the last scene's law
  std::optional<Skin> skin_;      // whatever the law
};

}  // namespace seldinger::app
