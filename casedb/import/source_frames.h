// A source as it comes out of a jail.
#pragma once

#include "casedb/import/files/source.h"
#include "casedb/import/jail/jail.h"

namespace seldinger::casedb {

void put_source(Outlet& out, const base::Result<Source>& source);

// Believes nothing: sizes within what was announced, a sound geometry, HU in range, the allow-list's names. Throws
// JailBroken.
base::Result<Source> take_source(Inlet& in);

}  // namespace seldinger::casedb
