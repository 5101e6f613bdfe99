// How much memory a piece of a test has held at its most, as the kernel counts it.
#pragma once

#include <malloc.h>

#include <cstddef>
#include <fstream>
#include <string>

namespace seldinger::casedb {

class PeakMemory {
 public:
  PeakMemory() {
    ::malloc_trim(0);                               // what was freed before is not to be used unseen
    std::ofstream("/proc/self/clear_refs") << "5";  // proc(5): the high-water mark becomes what is held now
    begin_bytes_ = line_bytes("VmHWM:");
  }
  // Beyond what was held at the beginning.
  std::size_t bytes() const {
    const std::size_t now = line_bytes("VmHWM:");
    return now > begin_bytes_ ? now - begin_bytes_ : 0;
  }

 private:
  static std::size_t line_bytes(const std::string& name) {
    std::ifstream in("/proc/self/status");
    for (std::string word; in >> word;)
      if (std::size_t kib = 0; word == name && in >> kib) return kib * 1024;
    return 0;
  }
  std::size_t begin_bytes_ = 0;
};

// Under the address sanitizer freed memory stays in a quarantine (256 MB) and shadow is held beside.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kSanitizerBytes = std::size_t{512} << 20;
#else
constexpr std::size_t kSanitizerBytes = 0;
#endif

// What reading may hold: twice what there honestly is, and 64 MB.
constexpr std::size_t allowed_bytes(std::size_t honest_bytes) {
  return 2 * honest_bytes + (std::size_t{64} << 20) + kSanitizerBytes;
}

}  // namespace seldinger::casedb
