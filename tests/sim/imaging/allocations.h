// How often this program has allocated: operator new and delete of the test binary count.
#pragma once

namespace seldinger::imaging {

long allocations() noexcept;

}  // namespace seldinger::imaging
