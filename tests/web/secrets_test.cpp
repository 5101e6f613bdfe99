// What a log-in leaves in the server's memory. The client is another process, so that what it knows is not found
// here; what is looked for is kept disguised.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <thread>

#include "tests/fixtures/folders.h"
#include "tests/web/fake_site.h"
#include "tests/web/raw_client.h"
#include "web/library_questions.h"

namespace seldinger::web {
namespace {

constexpr char kDisguise = 0x5A;

std::string disguised(std::string text) {
  for (char& c : text) c = static_cast<char>(c ^ kDisguise);
  return text;
}

// How often the text stands in what this process can write to.
int count_in_memory(const std::string& disguised_text) {
  std::ifstream maps("/proc/self/maps"), memory("/proc/self/mem", std::ios::binary);
  int found = 0;
  for (std::string line; std::getline(maps, line);) {
    std::size_t end_at = 0;
    const std::uint64_t from = std::stoull(line, &end_at, 16),
                        to = std::stoull(line.substr(end_at + 1), &end_at, 16);
    if (line.find(" rw") == line.npos || line.find("[v") != line.npos) continue;
    if (to - from > (std::uint64_t{1} << 32)) continue;  // a sanitizer's notes
    std::array<char, 4096> page{};
    std::size_t at = 0;
    for (std::uint64_t place = from; place < to; place += page.size()) {
      memory.clear();
      memory.seekg(static_cast<std::streamoff>(place));
      if (!memory.read(page.data(), static_cast<std::streamsize>(page.size()))) break;
      for (char& c : page) {
        c = static_cast<char>(c ^ kDisguise);
        at = c == disguised_text[at] ? at + 1 : c == disguised_text[0] ? 1 : 0;
        if (at == disguised_text.size()) {
          ++found;
          at = 0;
        }
      }
    }
  }
  return found;
}

// In a process of its own: makes an account, later logs in with it, and answers the session's id, disguised.
struct Client {
  int to[2]{}, from[2]{};
  pid_t pid = -1;
};

void be_the_client(const Client& pipes, const std::filesystem::path& folder) {
  const std::string password =
      disguised({'\x36', '\x35', '\x34', '\x3d', '\x7a', '\x3b', '\x34', '\x3e', '\x7a', '\x29',
                 '\x3f', '\x39', '\x28', '\x3f', '\x2e', '\x7a', '\x2d', '\x35', '\x28', '\x3e'});
  {
    auto library = std::move(casedb::Library::open_or_create(folder).value());
    if (!casedb::add_user(library, "Mia", casedb::Role::mentor, password)) ::_exit(1);
  }
  char done = 1;
  int port = 0;
  if (::write(pipes.from[1], &done, 1) != 1 || ::read(pipes.to[0], &port, sizeof port) != sizeof port) ::_exit(2);
  const auto ask = [&](const std::string& bytes) {
    RawClient client(port);
    client.send(bytes);
    return client.read_all();
  };
  const std::string form = ask("GET /login HTTP/1.1\r\nHost: localhost\r\n\r\n");
  std::size_t at = form.find("Set-Cookie: ") + 12;
  std::string body = "name=Mia&password=" + password + "&token=" + form_token(form, "/login");
  std::replace(body.begin(), body.end(), ' ', '+');
  const std::string answer =
      ask("POST /login HTTP/1.1\r\nHost: localhost\r\nSec-Fetch-Site: same-origin\r\nCookie: " +
          form.substr(at, form.find(';', at) - at) +
          "\r\nContent-Type: application/x-www-form-urlencoded\r\nContent-Length: " + std::to_string(body.size()) +
          "\r\n\r\n" + body);
  at = answer.find('=', answer.find("Set-Cookie: ")) + 1;
  const std::string id = answer.substr(at, 64);
  const std::string page = ask("GET /attempts HTTP/1.1\r\nHost: localhost\r\nCookie: seldinger_" +
                               std::to_string(port) + "=" + id + "\r\n\r\n");
  if (!page.starts_with("HTTP/1.1 200")) ::_exit(3);
  const std::string hidden = disguised(id);
  if (::write(pipes.from[1], hidden.data(), hidden.size()) != static_cast<ssize_t>(hidden.size())) ::_exit(4);
  ::_exit(0);
}

// Was: the password three times, the session's id six times.
TEST(Secrets, ALogInLeavesNeitherThePasswordNorTheSessionsIdInTheServersMemory) {
  const auto folder = fixtures::fresh_test_folder("web") / "library";
  Client client;
  ASSERT_EQ(::pipe(client.to), 0);
  ASSERT_EQ(::pipe(client.from), 0);
  client.pid = ::fork();
  ASSERT_GE(client.pid, 0);
  if (client.pid == 0) be_the_client(client, folder);
  char done = 0;
  ASSERT_EQ(::read(client.from[0], &done, 1), 1);
  Server server = std::move(
      open_server(std::move(casedb::Library::open(folder).value()), {"127.0.0.1", 0}, "1", [](const std::string&) {
      }).value());
  std::thread thread([&] { server.run(); });
  const int port = server.port();
  EXPECT_EQ(::write(client.to[1], &port, sizeof port), static_cast<ssize_t>(sizeof port));
  int status = -1;
  EXPECT_EQ(::waitpid(client.pid, &status, 0), client.pid);
  EXPECT_EQ(status, 0);
  std::string id(64, ' ');
  EXPECT_EQ(::read(client.from[0], id.data(), id.size()), 64);
  // "long and secret word", as it was typed and as a form sends it.
  std::string password = {'\x36', '\x35', '\x34', '\x3d', '\x7a', '\x3b', '\x34', '\x3e', '\x7a', '\x29',
                          '\x3f', '\x39', '\x28', '\x3f', '\x2e', '\x7a', '\x2d', '\x35', '\x28', '\x3e'};
  EXPECT_EQ(count_in_memory(password), 0);
  std::replace(password.begin(), password.end(), '\x7a', static_cast<char>('+' ^ kDisguise));
  EXPECT_EQ(count_in_memory(password), 0);
  EXPECT_EQ(count_in_memory(id), 0);
  // What is there is found.
  std::string there = "it stands here: " + std::to_string(port);
  EXPECT_GE(count_in_memory(disguised(there)), 1);
  server.stop();
  thread.join();
  for (const int file : {client.to[0], client.to[1], client.from[0], client.from[1]}) ::close(file);
}

}  // namespace
}  // namespace seldinger::web
