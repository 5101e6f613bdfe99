#include "tests/casedb/faults/faults.h"

#include <fcntl.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstring>

namespace seldinger::faults {
namespace {

Plan plan;
std::atomic<long> counted[6];
std::atomic<bool> network{false};

enum class Strike { no, fail, no_space, die };

// Whether the plan strikes this operation.
Strike strike(bool is_sync) {
  const long all = ++counted[static_cast<int>(Kind::kill)];
  const long own = ++counted[static_cast<int>(is_sync ? Kind::sync : Kind::write)];
  const auto hit = [&](long number) { return plan.once ? number == plan.at : number >= plan.at; };
  switch (plan.kind) {
    case Kind::kill:
      return all == plan.at ? Strike::die : Strike::no;
    case Kind::write:
      return !is_sync && hit(own) ? Strike::fail : Strike::no;
    case Kind::sync:
      return is_sync && hit(own) ? Strike::fail : Strike::no;
    case Kind::full:
      return !is_sync && own >= plan.at ? Strike::no_space : Strike::no;
    case Kind::none:
    case Kind::read_only:
      break;
  }
  return Strike::no;
}

[[noreturn]] void die() {
  ::kill(::getpid(), SIGKILL);
  for (;;) ::pause();
}

// --- SQLite's files
struct File {
  sqlite3_file base;
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};
File* of(sqlite3_file* file) {
  return reinterpret_cast<File*>(file);
}
sqlite3_file* real(sqlite3_file* file) {
  return of(file)->real();
}
sqlite3_vfs* real_vfs(sqlite3_vfs* vfs) {
  return static_cast<sqlite3_vfs*>(vfs->pAppData);
}

int x_close(sqlite3_file* f) {
  return real(f)->pMethods->xClose(real(f));
}
int x_read(sqlite3_file* f, void* to, int count, sqlite3_int64 at) {
  return real(f)->pMethods->xRead(real(f), to, count, at);
}
int x_write(sqlite3_file* f, const void* from, int count, sqlite3_int64 at) {
  const Strike struck = strike(false);
  if (struck != Strike::no) {
    real(f)->pMethods->xWrite(real(f), from, count / 2, at);
    if (struck == Strike::die) die();
    return struck == Strike::no_space ? SQLITE_FULL : SQLITE_IOERR_WRITE;
  }
  return real(f)->pMethods->xWrite(real(f), from, count, at);
}
int x_truncate(sqlite3_file* f, sqlite3_int64 size) {
  const Strike struck = strike(false);
  if (struck == Strike::die) die();
  if (struck == Strike::fail) return SQLITE_IOERR_TRUNCATE;
  return real(f)->pMethods->xTruncate(real(f), size);
}
// What a process wrote outlives its kill; only a loss of power, which is not tried here, asks for more. So the
// tests need not wait for the disk.
int x_sync(sqlite3_file*, int) {
  const Strike struck = strike(true);
  if (struck == Strike::die) die();
  if (struck == Strike::fail) return SQLITE_IOERR_FSYNC;
  return SQLITE_OK;
}
int x_file_size(sqlite3_file* f, sqlite3_int64* size) {
  return real(f)->pMethods->xFileSize(real(f), size);
}
int x_lock(sqlite3_file* f, int lock) {
  return real(f)->pMethods->xLock(real(f), lock);
}
int x_unlock(sqlite3_file* f, int lock) {
  return real(f)->pMethods->xUnlock(real(f), lock);
}
int x_check_lock(sqlite3_file* f, int* out) {
  return real(f)->pMethods->xCheckReservedLock(real(f), out);
}
int x_control(sqlite3_file* f, int operation, void* argument) {
  return real(f)->pMethods->xFileControl(real(f), operation, argument);
}
int x_sector(sqlite3_file* f) {
  return real(f)->pMethods->xSectorSize(real(f));
}
int x_device(sqlite3_file* f) {
  return real(f)->pMethods->xDeviceCharacteristics(real(f));
}
int x_shm_map(sqlite3_file* f, int region, int size, int extend, void volatile** out) {
  return real(f)->pMethods->xShmMap(real(f), region, size, extend, out);
}
int x_shm_lock(sqlite3_file* f, int offset, int count, int flags) {
  return real(f)->pMethods->xShmLock(real(f), offset, count, flags);
}
void x_shm_barrier(sqlite3_file* f) {
  real(f)->pMethods->xShmBarrier(real(f));
}
int x_shm_unmap(sqlite3_file* f, int remove) {
  return real(f)->pMethods->xShmUnmap(real(f), remove);
}

const sqlite3_io_methods kMethods = {2,           x_close,   x_read,     x_write,       x_truncate,  x_sync,
                                     x_file_size, x_lock,    x_unlock,   x_check_lock,  x_control,   x_sector,
                                     x_device,    x_shm_map, x_shm_lock, x_shm_barrier, x_shm_unmap, nullptr,
                                     nullptr};

int x_open(sqlite3_vfs* vfs, const char* name, sqlite3_file* f, int flags, int* flags_out) {
  f->pMethods = nullptr;
  if (plan.kind == Kind::read_only && (flags & SQLITE_OPEN_READWRITE) != 0) {
    // As the unix VFS does on EROFS: what is there is opened for reading, the rest is not made.
    if ((flags & SQLITE_OPEN_MAIN_DB) == 0 || (flags & SQLITE_OPEN_CREATE) != 0) return SQLITE_CANTOPEN;
    flags = (flags & ~SQLITE_OPEN_READWRITE) | SQLITE_OPEN_READONLY;
  }
  const int code = real_vfs(vfs)->xOpen(real_vfs(vfs), name, of(f)->real(), flags, flags_out);
  if (of(f)->real()->pMethods != nullptr) f->pMethods = &kMethods;
  return code;
}

int x_delete(sqlite3_vfs* vfs, const char* name, int sync) {
  const Strike struck = strike(false);
  if (struck == Strike::die) die();
  if (struck == Strike::fail) return SQLITE_IOERR_DELETE;
  return real_vfs(vfs)->xDelete(real_vfs(vfs), name, sync);
}

// Before the first database is opened.
const bool kRegistered = [] {
  static sqlite3_vfs shim;
  sqlite3_vfs* found = sqlite3_vfs_find(nullptr);
  shim = *found;
  shim.zName = "faults";
  shim.szOsFile = static_cast<int>(sizeof(File)) + found->szOsFile;
  shim.pAppData = found;
  shim.pNext = nullptr;
  shim.xOpen = x_open;
  shim.xDelete = x_delete;
  return sqlite3_vfs_register(&shim, 1) == SQLITE_OK;
}();

}  // namespace

void set(const Plan& wanted) {
  plan = wanted;
  for (auto& count : counted) count = 0;
}

long operations(Kind kind) {
  return counted[static_cast<int>(kind == Kind::full ? Kind::write : kind)];
}

void call_all_file_systems_network(bool on) {
  network = on;
}

}  // namespace seldinger::faults

// --- our own calls
using seldinger::faults::Kind;
extern "C" {
ssize_t __real_write(int descriptor, const void* bytes, size_t count);
int __real_rename(const char* from, const char* to);
int __real_open(const char* path, int flags, ...);
int __real_statfs(const char* path, struct statfs* about);

ssize_t __wrap_write(int descriptor, const void* bytes, size_t count) {
  switch (seldinger::faults::strike(false)) {
    case seldinger::faults::Strike::no:
      return __real_write(descriptor, bytes, count);
    case seldinger::faults::Strike::die:
      __real_write(descriptor, bytes, count / 2);
      seldinger::faults::die();
    case seldinger::faults::Strike::fail:
      __real_write(descriptor, bytes, count / 2);
      errno = EIO;
      return -1;
    case seldinger::faults::Strike::no_space:
      __real_write(descriptor, bytes, count / 2);
      errno = ENOSPC;
      return -1;
  }
  return -1;
}

int __wrap_fsync(int) {
  switch (seldinger::faults::strike(true)) {
    case seldinger::faults::Strike::die:
      seldinger::faults::die();
    case seldinger::faults::Strike::no:
      return 0;  // as x_sync
    default:
      errno = EIO;
      return -1;
  }
}

int __wrap_rename(const char* from, const char* to) {
  switch (seldinger::faults::strike(false)) {
    case seldinger::faults::Strike::die:
      seldinger::faults::die();
    case seldinger::faults::Strike::no:
      return __real_rename(from, to);
    case seldinger::faults::Strike::no_space:
      errno = ENOSPC;
      return -1;
    default:
      errno = EIO;
      return -1;
  }
}

int __wrap_open(const char* path, int flags, ...) {
  if (seldinger::faults::plan.kind == Kind::read_only && (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0) {
    errno = EROFS;
    return -1;
  }
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(rest, unsigned)) : 0;
  va_end(rest);
  return __real_open(path, flags, mode);
}

int __wrap_statfs(const char* path, struct statfs* about) {
  const int result = __real_statfs(path, about);
  if (result == 0 && seldinger::faults::network) about->f_type = 0x6969;  // NFS (linux/magic.h)
  return result;
}
}

long seldinger::faults::real_write(int descriptor, const void* bytes, std::uint64_t count) {
  return __real_write(descriptor, bytes, count);
}
