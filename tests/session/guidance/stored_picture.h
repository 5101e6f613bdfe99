// The picture that is kept with an attempt.
#pragma once

#include <cstddef>
#include <vector>

#include "app/attempts/this_program.h"
#include "session/attempt/endpoint_picture.h"

namespace seldinger::session {

inline std::vector<std::byte> stored_picture(const cases::Case& scene, const cases::Recording& recording) {
  return app::this_program().file_of(picture_at_endpoint(scene, recording));
}

}  // namespace seldinger::session
