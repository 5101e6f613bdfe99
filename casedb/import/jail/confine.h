// What a process gives up for good before it looks at a file from outside.
#pragma once

#include <cstdint>
#include <vector>

namespace seldinger::casedb {

// A sanitizer keeps terabytes of addresses and must be able to report: there is no confinement beside it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kConfines = false;
#else
constexpr bool kConfines = true;
#endif

constexpr std::uint64_t kJailSpareBytes = std::uint64_t{64} << 20;
constexpr std::uint64_t kJailSpareSeconds = 60;
constexpr std::uint64_t kSlowestBytesPerSecond = std::uint64_t{2}
                                                 << 20;  // of processor time: JPEG 2000 makes 10 MB
constexpr std::uint64_t kMostJailSeconds = 4 * 3600;     // whatever it says that it has to do

// Closes every descriptor but `kept` (standard input, output and error lead nowhere); limits address space to what
// is mapped now, 64 MiB and twice `bytes`, processor time to what `work_bytes` need, files written and core dumps
// to nothing; and, where the kernel has seccomp, leaves only the system calls in which memory is taken and open
// descriptors are read and written: no file, socket, process, thread or executable page can be made. Everything
// else fails with EPERM. False: the kernel refused seccomp, the rest holds.
bool confine(std::vector<int> kept, std::uint64_t bytes, std::uint64_t work_bytes);

// Gives a confined child of this process room for so many more bytes.
void widen(int child, std::uint64_t bytes);
// Its processor time from now on: what so many bytes, all that it goes through, need.
void allow_work(int child, std::uint64_t work_bytes);

}  // namespace seldinger::casedb
