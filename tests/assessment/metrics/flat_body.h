// A body that fills y ≥ 0: a needle that comes from −y is as deep as its y.
#pragma once

#include "sim/case/form/mesh_index.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::assessment {

inline const cases::MeshIndex& body() {
  static const cases::MeshIndex kIndex(fixtures::box_mesh({-200, 0, -200}, {200, 200, 200}));
  return kIndex;
}

}  // namespace seldinger::assessment
