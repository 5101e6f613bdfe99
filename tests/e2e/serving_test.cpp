// The pages behind a reverse proxy: nginx as docs/serving.md has it, with a certificate made here.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <regex>

#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/until.h"

namespace seldinger {
namespace {

using fixtures::kProgram;
using fixtures::run;

// The block of the page that begins with ```nginx.
std::string example_of_page() {
  const std::string page = fixtures::whole_file(fixtures::source_dir() / "docs/serving.md");
  const std::string begin = "```nginx\n";
  const std::size_t from = page.find(begin);
  EXPECT_NE(from, page.npos);
  return page.substr(from + begin.size(), page.find("```", from + begin.size()) - from - begin.size());
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  EXPECT_NE(text.find(what), text.npos) << "the example has no " << what;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// A program that runs beside the test until it is over.
class Beside {
 public:
  Beside(const std::string& command, const std::filesystem::path& out) {
    pid_ = ::fork();
    if (pid_ == 0) {
      const std::string line = "exec " + command + " > '" + out.string() + "' 2> '" + out.string() + ".err'";
      ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      ::_exit(127);
    }
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  ~Beside() { end(SIGTERM); }
  void end(int signal) {
    if (pid_ > 0) {
      ::kill(pid_, signal);
      ::waitpid(pid_, nullptr, 0);
    }
    pid_ = -1;
  }

 private:
  pid_t pid_ = -1;
};

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof any;
  EXPECT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&any), size), 0);
  EXPECT_EQ(::getsockname(socket, reinterpret_cast<sockaddr*>(&any), &size), 0);
  ::close(socket);
  return ntohs(any.sin_port);
}

class ServingTest : public testing::Test {
 protected:
  std::string curl(const std::string& words) {
    return run("curl -sk -i --max-time 20 --resolve sim.example.org:" + port_ + ":127.0.0.1 -b '" + jar() +
                   "' -c '" + jar() + "' " + words,
               scratch_)
        .out;
  }
  std::string jar() const { return (scratch_ / "jar").string(); }
  std::string page(const std::string& path) { return curl("https://sim.example.org:" + port_ + path); }
  std::string post(const std::string& path, const std::string& form, const std::string& origin) {
    return curl("-H 'Origin: " + origin + "' --data '" + form + "' https://sim.example.org:" + port_ + path);
  }
  static std::string token_in(const std::string& html) {
    std::smatch found;
    return std::regex_search(html, found, std::regex("name=\"token\" value=\"([^\"]+)\"")) ? found.str(1) : "";
  }

  const std::filesystem::path scratch_ = fixtures::fresh_folder("serving");
  std::string port_;
};

TEST_F(ServingTest, TheExampleOfThePageServesOverTls) {
  const std::string library = (scratch_ / "library").string();
  const auto added = run("printf 'a long password\\n' | " + kProgram +
                             " user add ann --role trainee --new-library --library '" + library + "'",
                         scratch_);
  ASSERT_EQ(added.exit_code, 0) << added.err;
  ASSERT_EQ(run("openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=sim.example.org -keyout '" +
                    (scratch_ / "key.pem").string() + "' -out '" + (scratch_ / "cert.pem").string() + "'",
                scratch_)
                .exit_code,
            0);
  port_ = std::to_string(free_port());  // told to the server before the proxy takes it
  Beside server(kProgram + " serve --library '" + library + "' --port 0 --behind https://sim.example.org:" + port_,
                scratch_ / "serve.out");
  std::string url;
  ASSERT_TRUE(fixtures::until([&] {
    url = fixtures::whole_file(scratch_ / "serve.out");
    return url.ends_with("\n");
  })) << fixtures::whole_file(scratch_ / "serve.out.err");
  url.pop_back();

  std::string site = example_of_page();
  site = replaced(site, "443", port_);
  site = replaced(site, "http://127.0.0.1:8080", url);
  site = replaced(site, "/etc/ssl/sim.example.org.crt", (scratch_ / "cert.pem").string());
  site = replaced(site, "/etc/ssl/sim.example.org.key", (scratch_ / "key.pem").string());
  std::ofstream(scratch_ / "nginx.conf")
      << "daemon off; pid nginx.pid; error_log nginx.log; worker_processes 1;\nevents {}\nhttp {\naccess_log off;\n"
      << "client_body_temp_path t1; proxy_temp_path t2; fastcgi_temp_path t3; uwsgi_temp_path t4; scgi_temp_path "
         "t5;\n"
      << site << "}\n";
  Beside proxy("/usr/sbin/nginx -p '" + scratch_.string() + "' -c nginx.conf", scratch_ / "nginx.out");
  ASSERT_TRUE(fixtures::until([&] { return page("/healthz").find("\"ok\"") != std::string::npos; }))
      << fixtures::whole_file(scratch_ / "nginx.out.err") << fixtures::whole_file(scratch_ / "nginx.log")
      << page("/healthz");

  const std::string form = page("/login");
  EXPECT_NE(form.find("; Secure"), form.npos) << form;
  EXPECT_NE(form.find("Strict-Transport-Security"), form.npos);
  const std::string here = "https://sim.example.org:" + port_;
  const std::string fields = "name=ann&password=a+long+password&token=" + token_in(form);
  EXPECT_EQ(post("/login", fields, "https://evil.example.org").rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_EQ(post("/login", fields, "http://sim.example.org:" + port_).rfind("HTTP/1.1 403", 0), 0U)
      << "not by http";
  const std::string in = post("/login", fields, here);
  EXPECT_EQ(in.rfind("HTTP/1.1 303", 0), 0U) << in;
  EXPECT_NE(page("/attempts").find("HTTP/1.1 200"), std::string::npos);
  // Under another name it answers nobody, whatever the proxy lets through.
  EXPECT_EQ(
      curl("-H 'Host: other.example.org' https://sim.example.org:" + port_ + "/login").rfind("HTTP/1.1 421", 0),
      0U);
}

TEST(Serving, ANameThatIsNoOriginIsRefused) {
  const auto scratch = fixtures::fresh_folder("serving");
  const std::string library = (scratch / "library").string();
  ASSERT_EQ(run("printf 'a long password\\n' | " + kProgram +
                    " user add ann --role trainee --new-library --library '" + library + "'",
                scratch)
                .exit_code,
            0);
  for (const char* bad :
       {"http://sim.example.org", "https://", "https://sim.example.org/pages", "sim.example.org"}) {
    const auto ran = run(kProgram + " serve --library '" + library + "' --behind " + bad, scratch);
    EXPECT_NE(ran.exit_code, 0) << bad;
    EXPECT_NE(ran.err.find("bad_origin"), std::string::npos) << bad << ran.err;
  }
}

// Neither the server nor the machine is asked: the one is killed, and begins again on the same library.
TEST_F(ServingTest, WhoIsLoggedInStaysSoWhenTheServerIsKilled) {
  const std::string library = (scratch_ / "library").string(), port = std::to_string(free_port());
  for (const char* name : {"ann", "bob"})
    ASSERT_EQ(run("printf 'a long password\\n' | " + kProgram + " user add " + name +
                      " --role trainee --new-library --library '" + library + "'",
                  scratch_)
                  .exit_code,
              0);
  const std::string here = "http://127.0.0.1:" + port;
  const auto as = [&](const std::string& who, const std::string& words) {
    const std::string cookies = " '" + (scratch_ / who).string() + "'";
    return run("curl -s -i --max-time 20 -H 'Origin: " + here + "' -b" + cookies + " -c" + cookies + " " + words,
               scratch_)
        .out;
  };
  std::optional<Beside> server;
  const auto start = [&] {
    server.emplace(kProgram + " serve --library '" + library + "' --port " + port, scratch_ / "serve.out");
    return fixtures::until([&] { return as("nobody", here + "/healthz").find("\"ok\"") != std::string::npos; });
  };
  ASSERT_TRUE(start());
  for (const std::string who : {"ann", "bob"}) {
    const std::string token = token_in(as(who, here + "/login"));
    ASSERT_NE(as(who, "--data 'name=" + who + "&password=a+long+password&token=" + token + "' " + here + "/login")
                  .find("303"),
              std::string::npos);
  }
  const std::string ann = fixtures::whole_file(scratch_ / "ann");  // as somebody has copied it
  as("ann", "--data 'token=" + token_in(as("ann", here + "/me")) + "' " + here + "/logout");
  std::ofstream(scratch_ / "ann") << ann;
  server->end(SIGKILL);
  ASSERT_TRUE(start());
  EXPECT_TRUE(as("bob", here + "/me").starts_with("HTTP/1.1 200"));
  EXPECT_TRUE(as("ann", here + "/me").starts_with("HTTP/1.1 303")) << "who had logged out";
}

}  // namespace
}  // namespace seldinger
