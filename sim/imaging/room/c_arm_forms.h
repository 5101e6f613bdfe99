// The C-arm in the room: its isocentre at the origin, z along the beam from tube to detector, y to the patient's
// head at 0°, 0°.
#pragma once

#include "sim/case/fluoroscope.h"
#include "sim/imaging/room/room_mesh.h"

namespace seldinger::imaging {

RoomMesh c_arm_tube_form(const cases::Fluoroscope& fluoroscope);      // and the arc that carries it
RoomMesh c_arm_detector_form(const cases::Fluoroscope& fluoroscope);  // its face's middle at the origin, facing −z

}  // namespace seldinger::imaging
