// The jail: files from outside are read in a child of this process that has nothing but the files it may ask for
// and one socket to us, over which it sends what it read. It ends without a word to anybody else; what it sends is
// checked as any other outside data (docs/decisions/0047).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::casedb {

// What the child may have.
struct JailInputs {
  std::set<std::filesystem::path> files;        // by just these names
  std::optional<std::filesystem::path> beside;  // besides any regular file of this folder that is no link
  std::vector<int> descriptors;                 // open already, to go on reading from
  std::uint64_t bytes = 0;                      // what of them must lie in memory at once
  std::uint64_t work_bytes = 0;                 // what is gone through besides, one after the other
  std::chrono::milliseconds longest_silence = std::chrono::minutes(10);  // a reader silent for longer is given up
};

// The child's end. `open`, `announce` and `announce_work` wait for the parent.
class Outlet {
 public:
  explicit Outlet(int socket) : socket_(socket) {}
  void put_bytes(std::span<const std::byte> bytes);
  template <typename T>
  void put(const T& number) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(std::as_bytes(std::span(&number, 1)));
  }
  void put_text(std::string_view text);
  void put_problem(const base::Problem& problem);
  void put_error(const base::Error& error);
  void announce(std::uint64_t bytes);
  void announce_work(std::uint64_t bytes);
  int open(const std::filesystem::path& file, bool links);
  void end();

 private:
  void announce(char kind, std::uint64_t bytes);
  void frame(char kind, std::span<const std::byte> bytes);
  void flush();
  int socket_;
  std::vector<std::byte> waiting_;
};

// The parent's end. Each call throws JailBroken when the child is gone or says what it must not.
class JailBroken {};
class Inlet {
 public:
  Inlet(int socket, int child, const JailInputs& inputs);
  void take_bytes(std::span<std::byte> into);
  template <typename T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T number{};
    take_bytes(std::as_writable_bytes(std::span(&number, 1)));
    return number;
  }
  std::string take_text(std::size_t longest);  // as it was put; printable, whatever the child says
  std::size_t take_count(std::size_t most);
  bool take_flag() { return take<std::uint8_t>() != 0; }
  base::Problem take_problem();
  base::Error take_error();
  std::uint64_t announced_bytes() const noexcept { return announced_bytes_; }
  void end();  // nothing may follow

 private:
  void next_frame();
  void answer_open(std::size_t size);
  void answer_announced(std::size_t size, bool is_work);
  void receive(std::span<std::byte> into);
  int socket_, child_;
  const JailInputs& inputs_;
  std::uint64_t left_ = 0;  // of the frame of data that is under way
  std::uint64_t announced_bytes_ = 0, work_bytes_;
  bool ended_ = false;
};

// In the child, before memory is taken: tells the parent, which gives room for twice as much. Of what lies in
// memory one at a time only the largest counts. Nothing outside a jail.
void announce_bytes(std::uint64_t bytes);
void announce_largest(std::uint64_t bytes);
// Before bytes are gone through, packed and unpacked: processor time for all that was told so far, and a sign of
// life. What is announced above is such work already.
void announce_work(std::uint64_t bytes);

// Runs `reads` in a child and `takes` here, at the same time; `takes` takes all that `reads` puts. Refused:
// `reader_died` (by a signal, a limit, or because it said what it must not). Throws base::Failure("no_reader") when
// no child can be made. Called where no other thread holds a lock that reading needs (glibc's own are safe).
base::Result<void> read_in_jail(const JailInputs& inputs, const std::function<void(Outlet&)>& reads,
                                const std::function<void(Inlet&)>& takes);

// Whether this kernel filters a jail's system calls; elsewhere limits and closed descriptors are all. Makes a jail
// to find out.
bool jail_filters_calls();

// What the last jail of this thread took: memory beyond what this process held when it began, what it had announced
// (with JailInputs::bytes), also as work, processor time.
struct JailUse {
  std::size_t peak_bytes = 0;
  std::uint64_t announced_bytes = 0, work_bytes = 0;
  double cpu_s = 0.0;
};
JailUse last_jail_use() noexcept;

}  // namespace seldinger::casedb
