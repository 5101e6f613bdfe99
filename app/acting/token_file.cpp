#include "app/acting/token_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <span>
#include <string_view>
#include <system_error>

#include "app/cli/state_folder.h"
#include "casedb/database/credentials.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTokenDigits = 64;

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

fs::path token_file_of(const fs::path& library) {
  std::error_code none;
  const fs::path real = fs::weakly_canonical(library, none);
  const std::string text = (none ? fs::absolute(library) : real).string();
  return state_folder() / ("session-" + casedb::sha256_hex(std::as_bytes(std::span(text))).substr(0, 16));
}

void write_token(const fs::path& file, const std::string& token) {
  const base::Failure failed("disk", "the session file cannot be written");
  std::error_code none;
  if (file.has_parent_path()) {
    fs::create_directories(file.parent_path().parent_path(), none);
    ::mkdir(file.parent_path().c_str(), 0700);
  }
  const fs::path temporary = file.string() + ".tmp-" + std::to_string(::getpid());
  ::unlink(temporary.c_str());
  {
    const Descriptor out{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600)};
    if (out.number < 0) throw failed;
    const bool whole = ::fchmod(out.number, 0600) == 0 &&
                       ::write(out.number, token.data(), token.size()) == static_cast<ssize_t>(token.size()) &&
                       ::write(out.number, "\n", 1) == 1;
    if (!whole) {
      ::unlink(temporary.c_str());
      throw failed;
    }
  }
  if (::rename(temporary.c_str(), file.c_str()) != 0) {
    ::unlink(temporary.c_str());
    throw failed;
  }
}

base::Result<std::optional<std::string>> read_token(const fs::path& file) {
  const base::Error bad{"bad_token_file", "the session file is not one, or is not its owner's alone"};
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
  if (in.number < 0) {
    if (errno == ENOENT || errno == ENOTDIR || errno == EACCES) return std::optional<std::string>();
    return bad;
  }
  struct stat about {};
  if (::fstat(in.number, &about) != 0 || !S_ISREG(about.st_mode) || (about.st_mode & 077U) != 0 ||
      about.st_uid != ::geteuid())
    return bad;
  std::array<char, kTokenDigits + 2> bytes{};
  const ssize_t size = ::read(in.number, bytes.data(), bytes.size());
  std::optional<std::string> token(std::string(bytes.data(), kTokenDigits));
  casedb::wipe(bytes);
  if (size != static_cast<ssize_t>(kTokenDigits) + 1 ||
      token->find_first_not_of("0123456789abcdef") != std::string::npos) {
    casedb::wipe(*token);
    return bad;
  }
  return token;
}

}  // namespace seldinger::app
