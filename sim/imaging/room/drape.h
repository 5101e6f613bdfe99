// A cloth over what lies beyond the CT's end: nobody sees what nobody scanned.
#pragma once

#include "sim/case/form/mesh.h"
#include "sim/imaging/room/room_mesh.h"

namespace seldinger::imaging {

struct RoomFrame;

// `end` 1: towards the head, −1: towards the feet. From a little inside the end over the table, as high as the body
// is where it ends. Nothing where the body ends by itself.
RoomMesh drape_over(const cases::Mesh& skin, const RoomFrame& frame, double end);

}  // namespace seldinger::imaging
