// A scene's view as a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/meta_image.h"
#include "app/scene.h"
#include "sim/imaging/mpr/visibility.h"

namespace seldinger::app {

struct ScenePicture {
  PicturePlane plane;
  std::vector<float> values;        // in `unit`, row-major
  std::vector<unsigned char> grey;  // what a person sees
  const char* unit = "";
  std::string backend;  // gpu, cpu or reference: what made it
  std::optional<imaging::Visible> visible;
};

// `scene.view` must be there. Refused as classes_of (a case's damaged assets). `backend`: gpu, cpu, reference, or
// empty: the faster of the machine. Throws base::Failure("gl") when gpu was asked for and cannot be had.
base::Result<ScenePicture> render_scene(const volume::Volume& volume, const Scene& scene,
                                        const std::string& library, const std::string& backend);

}  // namespace seldinger::app
