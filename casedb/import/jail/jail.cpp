#include "casedb/import/jail/jail.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>

#include "casedb/import/jail/confine.h"
#include "casedb/import/jail/input.h"
#include "sim/base/failure.h"

namespace seldinger::casedb {
namespace {

// A frame: its kind, how long it is, its bytes.
constexpr char kData = 'd', kOpen = 'o', kAnnounce = 'a', kWork = 'w', kEnd = 'e';
constexpr std::size_t kHeadBytes = 9, kLongestRequest = 1 << 16, kBuffered = 1 << 16;
constexpr std::uint64_t kMostAnnounced = std::uint64_t{16} << 30, kMostWork = std::uint64_t{1} << 60;

void send_all(int socket, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    iovec piece{const_cast<std::byte*>(bytes.data()), bytes.size()};
    msghdr message{};
    message.msg_iov = &piece;
    message.msg_iovlen = 1;
    const ssize_t sent = ::sendmsg(socket, &message, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw JailBroken();
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void send_descriptor(int socket, int descriptor) {
  char found = descriptor >= 0 ? 1 : 0;
  iovec piece{&found, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> room{};
  msghdr message{};
  message.msg_iov = &piece;
  message.msg_iovlen = 1;
  if (descriptor >= 0) {
    message.msg_control = room.data();
    message.msg_controllen = room.size();
    cmsghdr* head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(head), &descriptor, sizeof(int));
  }
  if (::sendmsg(socket, &message, MSG_NOSIGNAL) != 1) throw JailBroken();
}

int receive_descriptor(int socket) {
  char found = 0;
  iovec piece{&found, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> room{};
  msghdr message{};
  message.msg_iov = &piece;
  message.msg_iovlen = 1;
  message.msg_control = room.data();
  message.msg_controllen = room.size();
  ssize_t got = 0;
  do got = ::recvmsg(socket, &message, 0);
  while (got < 0 && errno == EINTR);
  if (got != 1) throw JailBroken();
  const cmsghdr* head = CMSG_FIRSTHDR(&message);
  if (found != 1 || head == nullptr || head->cmsg_type != SCM_RIGHTS) return -1;
  int descriptor = -1;
  std::memcpy(&descriptor, CMSG_DATA(head), sizeof(int));
  return descriptor;
}

// What of the child's is text is printed by us: nothing in it may steer a terminal, neither in UTF-8 nor in the
// eight bits of older ones (ISO 6429: C0, DEL, C1).
std::string printable(std::string text) {
  std::size_t follow = 0;  // bytes that go on the character under way
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool follows = byte >= 0x80 && byte < 0xC0 && follow > 0;
    if (follows) {
      --follow;
      continue;
    }
    follow = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : byte >= 0xC2 ? 1 : 0;
    const bool c1 = byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (byte < 0x20 || (byte >= 0x7F && byte < 0xA0) || c1) text[i] = '?';
    if (c1) follow = 0;  // so that its second byte is none of a character either
  }
  return text;
}

bool is_code(const std::string& text) {
  return !text.empty() && text.size() <= 64 &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

Outlet* outlet_of_this_jail = nullptr;

// Readers ask several times in a row for the same file.
int open_from_outside(const std::filesystem::path& file, Links links) {
  static std::filesystem::path last;
  static Links last_links = Links::followed;
  static int descriptor = -1;
  if (descriptor < 0 || file != last || links != last_links) {
    if (descriptor >= 0) ::close(descriptor);
    descriptor = outlet_of_this_jail->open(file, links == Links::followed);
    last = file;
    last_links = links;
  }
  return descriptor < 0 ? -1 : ::dup(descriptor);
}

[[noreturn]] void be_the_reader(int given, pid_t parent, const JailInputs& inputs,
                                const std::function<void(Outlet&)>& reads) {
  int status = 1;
  try {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
    const int socket = ::fcntl(given, F_DUPFD_CLOEXEC, 3);  // clear of standard input, output and error
    if (::getppid() != parent || socket < 0) ::_exit(1);
    std::vector<int> kept = inputs.descriptors;
    kept.push_back(socket);
    static_cast<void>(confine(std::move(kept), inputs.bytes, inputs.bytes + inputs.work_bytes));
    Outlet outlet(socket);
    outlet_of_this_jail = &outlet;
    open_inputs_by(&open_from_outside);
    reads(outlet);
    outlet.end();
    status = 0;
  } catch (...) {  // whatever it was, out of memory too: the parent hears that it failed
  }
  ::_exit(status);
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int number() const noexcept { return number_; }
  void close() noexcept {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

thread_local JailUse last_use;

// What a child begins with: its parent's pages but for those of files.
std::size_t inherited_bytes() {
  unsigned long long all = 0, resident = 0, of_files = 0;
  if (std::FILE* statm = std::fopen("/proc/self/statm", "re")) {  // proc(5)
    if (std::fscanf(statm, "%llu %llu %llu", &all, &resident, &of_files) != 3) resident = of_files = 0;
    std::fclose(statm);
  }
  return static_cast<std::size_t>(resident - of_files) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Never left behind, and never waited for longer than it is needed.
class Child {
 public:
  Child(pid_t id, std::size_t began_bytes) : id_(id), began_bytes_(began_bytes) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::kill(id_, SIGKILL);
    rusage use{};
    while (::wait4(id_, nullptr, 0, &use) < 0 && errno == EINTR) {
    }
    const std::size_t peak = static_cast<std::size_t>(use.ru_maxrss) * 1024;
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    last_use.peak_bytes = peak > began_bytes_ ? peak - began_bytes_ : 0;
    last_use.cpu_s = seconds(use.ru_utime) + seconds(use.ru_stime);
  }

 private:
  pid_t id_;
  std::size_t began_bytes_;
};

}  // namespace

void Outlet::frame(char kind, std::span<const std::byte> bytes) {
  std::array<std::byte, kHeadBytes> head;
  head[0] = static_cast<std::byte>(kind);
  const std::uint64_t size = bytes.size();
  std::memcpy(head.data() + 1, &size, sizeof size);
  send_all(socket_, head);
  send_all(socket_, bytes);
}

void Outlet::flush() {
  if (!waiting_.empty()) frame(kData, waiting_);
  waiting_.clear();
}

void Outlet::put_bytes(std::span<const std::byte> bytes) {
  if (waiting_.size() + bytes.size() > kBuffered) flush();
  if (bytes.size() > kBuffered)
    frame(kData, bytes);
  else
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

void Outlet::put_text(std::string_view text) {
  put<std::uint64_t>(text.size());
  put_bytes(std::as_bytes(std::span(text)));
}

void Outlet::put_problem(const base::Problem& problem) {
  put_text(problem.code);
  put_text(problem.text);
}

void Outlet::put_error(const base::Error& error) {
  put_problem({error.code, error.text});
  put<std::uint64_t>(error.findings.size());
  for (const base::Problem& finding : error.findings) put_problem(finding);
}

void Outlet::announce(std::uint64_t bytes) {
  announce(kAnnounce, bytes);
}

void Outlet::announce_work(std::uint64_t bytes) {
  announce(kWork, bytes);
}

void Outlet::announce(char kind, std::uint64_t bytes) {
  flush();
  frame(kind, std::as_bytes(std::span(&bytes, 1)));
  static_cast<void>(receive_descriptor(socket_));
}

int Outlet::open(const std::filesystem::path& file, bool links) {
  flush();
  const std::string request = (links ? 'f' : 'n') + file.string();
  frame(kOpen, std::as_bytes(std::span(request)));
  return receive_descriptor(socket_);
}

void Outlet::end() {
  flush();
  frame(kEnd, {});
}

void announce_bytes(std::uint64_t bytes) {
  if (outlet_of_this_jail != nullptr) outlet_of_this_jail->announce(bytes);
}

void announce_largest(std::uint64_t bytes) {
  static std::uint64_t largest = 0;
  if (bytes <= largest) return;
  announce_bytes(bytes - largest);
  largest = bytes;
}

void announce_work(std::uint64_t bytes) {
  if (outlet_of_this_jail != nullptr) outlet_of_this_jail->announce_work(bytes);
}

bool jail_filters_calls() {
  bool filtered = false;
  const auto asked = read_in_jail(
      {}, [](Outlet& out) { out.put(::syscall(SYS_getppid) < 0); },  // which never fails otherwise
      [&](Inlet& in) { filtered = in.take_flag(); });
  return asked && filtered;
}

JailUse last_jail_use() noexcept {
  return last_use;
}

Inlet::Inlet(int socket, int child, const JailInputs& inputs)
    : socket_(socket), child_(child), inputs_(inputs), work_bytes_(inputs.bytes + inputs.work_bytes) {}

void Inlet::receive(std::span<std::byte> into) {
  while (!into.empty()) {
    pollfd waits{socket_, POLLIN, 0};
    const int ready = ::poll(&waits, 1, static_cast<int>(inputs_.longest_silence.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) throw JailBroken();
    const ssize_t got = ::recv(socket_, into.data(), into.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw JailBroken();
    into = into.subspan(static_cast<std::size_t>(got));
  }
}

void Inlet::answer_open(std::size_t size) {
  if (size < 2 || size > kLongestRequest) throw JailBroken();
  std::string request(size, '\0');
  receive(std::as_writable_bytes(std::span(request)));
  const std::filesystem::path file = request.substr(1);
  const bool listed = inputs_.files.contains(file);
  const bool beside = inputs_.beside && file.has_filename() && file.filename() != ".." &&
                      request.find('\0') == std::string::npos && file == *inputs_.beside / file.filename();
  const Descriptor opened(
      !listed && !beside ? -1 : open_regular(file, listed && request[0] == 'f' ? Links::followed : Links::refused));
  send_descriptor(socket_, opened.number());
}

void Inlet::answer_announced(std::size_t size, bool is_work) {
  std::uint64_t bytes = 0;
  if (size != sizeof bytes) throw JailBroken();
  receive(std::as_writable_bytes(std::span(&bytes, 1)));
  if (!is_work) {
    if (bytes > kMostAnnounced - announced_bytes_) throw JailBroken();
    announced_bytes_ += bytes;
    last_use.announced_bytes += bytes;
    widen(child_, bytes);
  }
  if (bytes > kMostWork - work_bytes_) throw JailBroken();
  work_bytes_ += bytes;
  last_use.work_bytes = work_bytes_;
  allow_work(child_, work_bytes_);
  send_descriptor(socket_, -1);
}

// Up to the next frame of data, or the end.
void Inlet::next_frame() {
  while (left_ == 0 && !ended_) {
    std::array<std::byte, kHeadBytes> head;
    receive(head);
    std::uint64_t size = 0;
    std::memcpy(&size, head.data() + 1, sizeof size);
    switch (static_cast<char>(head[0])) {
      case kData:
        left_ = size;
        break;
      case kOpen:
        answer_open(size);
        break;
      case kAnnounce:
      case kWork:
        answer_announced(size, static_cast<char>(head[0]) == kWork);
        break;
      case kEnd:
        if (size != 0) throw JailBroken();
        ended_ = true;
        break;
      default:
        throw JailBroken();
    }
  }
}

void Inlet::take_bytes(std::span<std::byte> into) {
  while (!into.empty()) {
    next_frame();
    if (ended_) throw JailBroken();
    const auto piece = into.first(static_cast<std::size_t>(std::min<std::uint64_t>(left_, into.size())));
    receive(piece);
    left_ -= piece.size();
    into = into.subspan(piece.size());
  }
}

std::size_t Inlet::take_count(std::size_t most) {
  const auto count = take<std::uint64_t>();
  if (count > most) throw JailBroken();
  return static_cast<std::size_t>(count);
}

std::string Inlet::take_text(std::size_t longest) {
  std::string text(take_count(longest), '\0');
  take_bytes(std::as_writable_bytes(std::span(text)));
  return printable(std::move(text));
}

base::Problem Inlet::take_problem() {
  constexpr std::size_t kLongestText = 4000;
  base::Problem problem;
  problem.code = take_text(kLongestText);
  if (!is_code(problem.code)) throw JailBroken();
  problem.text = take_text(kLongestText);
  return problem;
}

base::Error Inlet::take_error() {
  constexpr std::size_t kMostFindings = 100'000;
  const base::Problem first = take_problem();
  base::Error error{first.code, first.text};
  for (std::size_t count = take_count(kMostFindings); count > 0; --count) error.findings.push_back(take_problem());
  return error;
}

void Inlet::end() {
  next_frame();
  if (!ended_) throw JailBroken();
}

base::Result<void> read_in_jail(const JailInputs& inputs, const std::function<void(Outlet&)>& reads,
                                const std::function<void(Inlet&)>& takes) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw base::Failure("no_reader", "no process that reads files can be started");
  Descriptor ours(ends[0]), theirs(ends[1]);
  const pid_t parent = ::getpid();
  const std::size_t began_bytes = inherited_bytes();
  const pid_t id = ::fork();
  if (id < 0) throw base::Failure("no_reader", "no process that reads files can be started");
  if (id == 0) be_the_reader(theirs.number(), parent, inputs, reads);
  theirs.close();
  const Child child(id, began_bytes);
  last_use.announced_bytes = inputs.bytes;
  last_use.work_bytes = inputs.bytes + inputs.work_bytes;
  try {
    Inlet inlet(ours.number(), id, inputs);
    takes(inlet);
    inlet.end();  // all of it came, whatever becomes of the child
    return {};
  } catch (const JailBroken&) {
  }
  return base::Error{"reader_died", "the file stopped the process that read it, so nothing of it was taken"};
}

}  // namespace seldinger::casedb
