// In a file of its own: inlined beside a use, g++ takes the pair new and free for a mistake.
#include "tests/sim/imaging/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> count{0};
}

void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace seldinger::imaging {

long allocations() noexcept {
  return count;
}

}  // namespace seldinger::imaging
