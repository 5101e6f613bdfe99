// The picture that an attempt is remembered by.
#pragma once

#include "session/guidance/grey_picture.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"

namespace seldinger::session {

// The picture when the trigger fell (or last): what lay under the probe, or the fluoroscope's last image. Without
// pixels where there is none.
GreyPicture picture_at_endpoint(const cases::Case& scene, const cases::Recording& recording);

}  // namespace seldinger::session
