// Faults of the disk at a chosen moment, for this test binary: our own write, fsync and rename calls go through the
// linker's --wrap, SQLite's through a VFS (file system layer) around its own.
#pragma once

#include <cstdint>

namespace seldinger::faults {

enum class Kind {
  none,
  kill,       // SIGKILL in the middle of an operation: half of a write is done
  write,      // a write, or a rename, fails with EIO
  sync,       // an fsync fails with EIO
  full,       // from here on writes find no space
  read_only,  // no file can be opened for writing or made
};

struct Plan {
  Kind kind = Kind::none;
  long at = 0;        // which operation of that kind, from 1
  bool once = false;  // later ones work again
};

void set(const Plan& plan);
long operations(Kind kind);  // how many of that kind there were since set()
void call_all_file_systems_network(bool on);

// write(2) as it is, for what the test itself has to say.
long real_write(int descriptor, const void* bytes, std::uint64_t count);

}  // namespace seldinger::faults
