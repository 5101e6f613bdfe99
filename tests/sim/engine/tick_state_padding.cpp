// Compiled without GLM_FORCE_CTOR_INIT (CMakeLists.txt): with it a vector is not trivially copyable, and the
// builtin wants a type that is. The layout is the same, and no constructor is called here.
#include "tests/sim/engine/tick_state_padding.h"

#include "sim/engine/tick_state.h"

#if defined(__has_builtin)
#if __has_builtin(__builtin_clear_padding)
#define SELDINGER_TELLS_PADDING
#endif
#endif

namespace seldinger::engine {

std::vector<bool> padding_of_tick_state() {
  std::vector<bool> padding;
#ifdef SELDINGER_TELLS_PADDING
  alignas(TickState) unsigned char raw[sizeof(TickState)];
  for (unsigned char& byte : raw) byte = 0xff;
  __builtin_clear_padding(reinterpret_cast<TickState*>(raw));
  for (const unsigned char byte : raw) padding.push_back(byte == 0);
#endif
  return padding;
}

}  // namespace seldinger::engine
