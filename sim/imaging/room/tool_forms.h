// What hands hold: forms of needles and probes.
#pragma once

#include "sim/case/case.h"
#include "sim/imaging/probe.h"
#include "sim/imaging/room/room_mesh.h"

namespace seldinger::imaging {

// Tip at the origin, hub → tip along z; x and y in radii of the needle, z in mm. A dark mark each 10 mm from the
// tip, a wide one each 50 mm.
RoomMesh shaft_form(const cases::Instrument& instrument);

// What the hand holds, behind the shaft (z < −length): a hub in the colour of its gauge (ISO 6009:2016), or the
// handle of a core device.
RoomMesh hub_form(const cases::Instrument& instrument);
// Of the gauge whose outer diameter is nearest.
RoomColour gauge_colour(double radius_mm) noexcept;

// The middle of the face at the origin, x lateral, z axial (into the body): face, case, a mark on the side −x, and
// the beginning of its cable.
RoomMesh probe_form(const Probe& probe);

}  // namespace seldinger::imaging
