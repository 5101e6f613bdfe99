#include "tests/load/clients.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <regex>
#include <set>
#include <thread>

#include "app/replay/replay_output.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/sound_check.h"
#include "tests/load/load_library.h"
#include "tests/web/raw_client.h"
#include "web/library_questions.h"
#include "web/routes/routes.h"

namespace seldinger::load {
namespace {

using casedb::Role;
using Clock = std::chrono::steady_clock;

struct Answer {
  int status = 0;
  std::string head, body;
  double ms = 0.0;
};

class Browser {
 public:
  Browser(int port, int number) : port_(port), from_("127.0.1." + std::to_string(number + 1)) {}

  Answer get(const std::string& path) { return ask("GET " + path, ""); }
  void log_in(const std::string& name) {
    const Answer form = get("/login");
    keep_cookies(form.head);
    std::smatch token;
    ASSERT_TRUE(std::regex_search(form.body, token, std::regex("name=\"token\" value=\"([0-9a-f]+)\"")))
        << form.head;
    std::string words = "name=" + name + "&password=" + kPassword + "&token=" + token.str(1);
    std::replace(words.begin(), words.end(), ' ', '+');
    const Answer in = ask("POST /login", words);
    ASSERT_EQ(in.status, 303) << name;
    keep_cookies(in.head);
  }

 private:
  Answer ask(const std::string& line, const std::string& form) {
    std::string request = line + " HTTP/1.1\r\nHost: localhost\r\n";
    for (const auto& [name, value] : cookies_)
      request += (name == cookies_.begin()->first ? "Cookie: " : "; ") + name + "=" + value;
    if (!cookies_.empty()) request += "\r\n";
    if (!form.empty())
      request +=
          "Sec-Fetch-Site: same-origin\r\nContent-Type: application/x-www-form-urlencoded\r\nContent-Length: " +
          std::to_string(form.size()) + "\r\n";
    const auto begun = Clock::now();
    web::RawClient client(port_, from_);
    client.send(request + "\r\n" + form);
    const std::string all = client.read_all(std::chrono::seconds(60));
    Answer answer;
    answer.ms = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    const std::size_t end = all.find("\r\n\r\n");
    if (end == all.npos || !all.starts_with("HTTP/1.1 ")) return answer;
    answer.head = all.substr(0, end);
    answer.body = all.substr(end + 4);
    const std::string length = "\r\nContent-Length: " + std::to_string(answer.body.size());
    // What came in part is no answer.
    if ((answer.head + "\r").find(length + "\r") != answer.head.npos) answer.status = std::stoi(all.substr(9, 3));
    return answer;
  }
  void keep_cookies(const std::string& head) {
    static const std::regex cookie("Set-Cookie: ([^=]+)=([^;]*)");
    for (std::sregex_iterator at(head.begin(), head.end(), cookie), end; at != end; ++at)
      cookies_[at->str(1)] = at->str(2);
  }
  int port_;
  std::string from_;
  std::map<std::string, std::string> cookies_;
};

struct Asked {
  std::string route, path;
  int status = 200;
  std::string holds{};         // stands in the answer
  std::ptrdiff_t people = -1;  // so many links to learners, where it is 0 or more
};

std::ptrdiff_t learners_in(const std::string& page) {
  const std::string link = "href=\"/progress/";
  std::set<std::string> all;
  for (std::size_t at = page.find(link); at != page.npos; at = page.find(link, at + 1))
    all.insert(page.substr(at + link.size(), 36));
  return static_cast<std::ptrdiff_t>(all.size());
}

// What is wrong with an answer; empty: nothing.
std::string fault_of(const Asked& asked, const Answer& answer) {
  if (answer.status != asked.status)
    return asked.path + " answers " + std::to_string(answer.status) + ", not " + std::to_string(asked.status);
  if (answer.body.find(asked.holds) == answer.body.npos) return asked.path + " is without " + asked.holds;
  if (asked.people >= 0 && learners_in(answer.body) != asked.people)
    return asked.path + " lists " + std::to_string(learners_in(answer.body)) + " learners, not " +
           std::to_string(asked.people);
  return {};
}

// Who asks, and for what.
struct Client {
  std::string name;
  Role role = Role::trainee;
  std::vector<Asked> pages;
};

class World {
 public:
  explicit World(casedb::Library& library) : library_(library) {
    for (const casedb::Account& one : casedb::list_users(library)) ids_[one.login_name] = one.person_id;
    case_id_ = library.database().text("SELECT case_id FROM training_case WHERE state = 'published' LIMIT 1");
    study_id_ = library.database().text("SELECT study_id FROM study LIMIT 1");
  }
  // Every route of the role, each with ids that are the reader's to see, and one with somebody else's.
  Client client(Role role, const std::string& name, int trainee) const {
    Client made{name, role, {}};
    const bool reads_people = role == Role::mentor || role == Role::director;
    const std::string own = attempt_of(trainee), others = attempt_of(trainee + 1);
    for (const web::Route& route : web::routes()) {
      const std::string pattern(route.pattern);
      if (route.method != "GET" || !route.who.roles.has(role)) continue;
      Asked asked{pattern, pattern};
      if (pattern.find("{attempt_id}") != pattern.npos) {
        if (role == Role::researcher && route.who.action == casedb::Action::see_recording)
          continue;  // people's are not theirs
        asked.path = filled(pattern, own);
        if (!pattern.ends_with(".png") && !pattern.ends_with("replay.json") && !pattern.ends_with("skin.json"))
          asked.holds = own;
        if (role == Role::trainee || role == Role::mentor)
          made.pages.push_back({pattern, filled(pattern, others), 404});
      } else if (pattern.find("{case_id}") != pattern.npos) {
        asked.path = filled(pattern, case_id_);
        asked.holds = case_id_;
      } else if (pattern.find("{person_id}") != pattern.npos) {
        asked.path = filled(pattern, ids_.at(trainee_name(trainee)));
        if (reads_people) asked.holds = trainee_name(trainee);
      } else if (pattern.find("{study_id}") != pattern.npos) {
        asked.path = filled(pattern, study_id_);
        if (route.is_page) asked.holds = name;
      } else if (pattern.find("{job_id}") != pattern.npos) {
        asked = {pattern, filled(pattern, own), 404};  // nobody here has one
      } else if (pattern == "/progress" && reads_people) {
        asked.people = role == Role::mentor ? kLearners : kTrainees / kProgrammes;
      } else if (route.is_page) {
        asked.holds = name;  // stands above every page
      }
      made.pages.push_back(asked);
      if (pattern == "/attempts" && role != Role::admin) {
        made.pages.push_back(
            {pattern + "?page=N", "/attempts?page=" + std::to_string(role == Role::trainee ? 1 : 9)});
      }
    }
    return made;
  }
  const std::string& id_of(const std::string& name) const { return ids_.at(name); }
  const std::string& case_id() const { return case_id_; }

 private:
  static std::string filled(const std::string& pattern, const std::string& id) {
    std::string path = pattern;
    const std::size_t at = path.find('{');
    return path.replace(at, path.find('}') - at + 1, id);
  }
  // One with a recording and a picture, where there is one.
  std::string attempt_of(int trainee) const {
    return library_.database().text("SELECT attempt_id FROM attempt WHERE person_id = '" +
                                    ids_.at(trainee_name(trainee)) +
                                    "' ORDER BY picture_sha256 IS NULL, started_us DESC LIMIT 1");
  }
  casedb::Library& library_;
  std::map<std::string, std::string> ids_;
  std::string case_id_, study_id_;
};

// Trainees with a recording are every fourth; cohort and programme of a trainee are the number's rest by 20 and 5.
std::vector<Client> fifty(const World& world) {
  std::vector<Client> all;
  for (int i = 0; i < 30; ++i) all.push_back(world.client(Role::trainee, trainee_name(16 * i), 16 * i));
  for (int i = 0; i < 10; ++i) all.push_back(world.client(Role::mentor, mentor_name(4 * (i % 5)), 4 * (i % 5)));
  for (int i = 0; i < 5; ++i) all.push_back(world.client(Role::director, director_name(i), 16 * i % 20));
  for (int i = 0; i < 3; ++i) all.push_back(world.client(Role::researcher, "researcher", 20 * i));
  for (int i = 0; i < 2; ++i) all.push_back(world.client(Role::admin, "admin", 0));
  return all;
}

struct Waits {
  std::mutex mutex;
  std::map<std::string, std::vector<double>> ms;  // by role and route
  std::vector<std::string> wrong;
};

double share_of(std::vector<double>& ms, double share) {
  std::sort(ms.begin(), ms.end());
  return ms[std::min(ms.size() - 1, static_cast<std::size_t>(share * static_cast<double>(ms.size())))];
}

// What is drawn of an attempt under a probe, the heaviest there is: drawing it takes seconds, here once.
reports::DrawnPictures drawn_pictures() {
  const auto folder = fixtures::fresh_test_folder("load_drawn") / "library";
  fixtures::demo_library("--modality ultrasound", folder);
  auto library = std::move(casedb::Library::open(folder).value());
  std::string telling;
  double longest_s = 0.0;
  for (const casedb::AttemptRow& one : casedb::list_attempts(library))
    if (one.duration_s > longest_s) {
      telling = one.attempt_id;
      longest_s = one.duration_s;
    }
  return app::telling_pictures(library, telling).value();
}

// A server over a library of the test's own.
class Served {
 public:
  explicit Served(int attempts) : folder_(fixtures::fresh_test_folder("load") / "library") {
    load_library(folder_, attempts);
    library_.emplace(std::move(casedb::Library::open(folder_).value()));
    world_.emplace(*library_);
    server_.emplace(
        std::move(web::open_server(std::move(casedb::Library::open(folder_).value()), {"127.0.0.1", 0}, "1",
                                   [this](const std::string& line) {
                                     const std::lock_guard lock(mutex_);
                                     log_.push_back(line);
                                   },
                                   {[](casedb::Library& library, const std::string& case_id) {
                                      return fixtures::sound_check(library, case_id);
                                    },
                                    [drawn = drawn_pictures()](casedb::Library&, const std::string&) {
                                      return base::Result<reports::DrawnPictures>(drawn);
                                    }})
                      .value()));
    thread_ = std::thread([this] { server_->run(); });
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  ~Served() {
    server_->stop();
    thread_.join();
    for (const std::string& line : log_) EXPECT_FALSE(line.starts_with("error")) << line;
    server_.reset();
    library_.reset();
    std::filesystem::remove_all(folder_);
  }
  int port() const { return server_->port(); }
  const World& world() const { return *world_; }
  casedb::Library& library() { return *library_; }

 private:
  std::filesystem::path folder_;
  std::optional<casedb::Library> library_;  // who trains meanwhile
  std::optional<World> world_;
  std::optional<web::Server> server_;
  std::thread thread_;
  std::mutex mutex_;
  std::vector<std::string> log_;
};

}  // namespace

void serve_fifty(int attempts, std::chrono::seconds time) {
  Served served(attempts);
  const std::vector<Client> clients = fifty(served.world());
  std::set<std::string> routes;
  for (const Client& one : clients)
    for (const Asked& asked : one.pages) routes.insert(asked.route);
  Waits waits;
  std::atomic<int> ready = 0;
  std::atomic<bool> go = false;
  Clock::time_point until;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < clients.size(); ++i)
    threads.emplace_back([&, i] {
      const Client& client = clients[i];
      Browser browser(served.port(), static_cast<int>(i));
      browser.log_in(client.name);
      std::map<std::string, std::vector<double>> ms;
      std::vector<std::string> wrong;
      const auto check = [&](const Asked& asked, const Answer& answer) {
        if (std::string fault = fault_of(asked, answer); !fault.empty())
          wrong.push_back(client.name + ": " + fault);
      };
      for (const Asked& asked : client.pages) check(asked, browser.get(asked.path));
      ++ready;
      go.wait(false);
      for (std::size_t at = i * 7; Clock::now() < until; ++at) {
        const Asked& asked = client.pages[at % client.pages.size()];
        const Answer answer = browser.get(asked.path);
        ms[name_of(client.role) + " " + asked.route + (asked.status == 404 ? " (another's)" : "")].push_back(
            answer.ms);
        check(asked, answer);
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
      }
      const std::lock_guard lock(waits.mutex);
      for (auto& [route, all] : ms) waits.ms[route].insert(waits.ms[route].end(), all.begin(), all.end());
      waits.wrong.insert(waits.wrong.end(), wrong.begin(), wrong.end());
    });
  while (ready < static_cast<int>(clients.size()) && !testing::Test::HasFailure())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  until = Clock::now() + time;
  go = true;
  go.notify_all();
  // Nobody's page but their own changes by it.
  casedb::NewAttempt made = casedb::sample_attempt(
      served.world().case_id(), served.library().database().text("SELECT lesion_id FROM lesion WHERE case_id = '" +
                                                                 served.world().case_id() + "' LIMIT 1"));
  made.person_id = served.world().id_of(trainee_name(kTrainees - 1));
  made.operator_name = casedb::kPersonOperator;
  made.picture_png.clear();
  while (Clock::now() + std::chrono::seconds(5) < until) {
    std::this_thread::sleep_for(std::chrono::seconds(5));
    made.started_us = casedb::now_us();
    EXPECT_TRUE(casedb::add_attempt(served.library(), made).has_value());
  }
  for (std::thread& thread : threads) thread.join();

  std::size_t requests = 0;
  std::vector<double> every;
  std::printf("%-58s %7s %8s %8s %8s\n", "ms", "n", "p50", "p95", "most");
  for (auto& [route, ms] : waits.ms) {
    requests += ms.size();
    every.insert(every.end(), ms.begin(), ms.end());
    const double p50 = share_of(ms, 0.5), p95 = share_of(ms, 0.95);
    std::printf("%-58s %7zu %8.1f %8.1f %8.1f\n", route.c_str(), ms.size(), p50, p95, ms.back());
  }
  const double p50 = share_of(every, 0.5), p95 = share_of(every, 0.95);
  std::printf("%-58s %7zu %8.1f %8.1f %8.1f\n", "all", requests, p50, p95, every.back());
  EXPECT_TRUE(waits.wrong.empty()) << waits.wrong.size()
                                   << " answers were wrong, the first: " << waits.wrong.front();
  const auto of_a_role = [](const web::Route& route) {
    return route.method == "GET" && !(route.who.roles == web::kOpen.roles);
  };
  EXPECT_EQ(std::ssize(routes), 1 + std::count_if(web::routes().begin(), web::routes().end(), of_a_role))
      << "every page of every role, and the list's later pages";
}

void check_first_loads(int attempts, std::size_t most_bytes) {
  Served served(attempts);
  const auto compressed = [](const std::string& text) {
    uLongf size = compressBound(text.size());
    std::vector<Bytef> out(size);
    EXPECT_EQ(compress2(out.data(), &size, reinterpret_cast<const Bytef*>(text.data()), text.size(), 6), Z_OK);
    return static_cast<std::size_t>(size) + 12;  // gzip's longer head and end
  };
  static const std::regex part("(?:href=\"(/[a-z_.-]+\\.(?:css|svg))|src=\"(/[^\"]+))\"");
  int number = 0;
  std::set<std::pair<Role, std::string>> seen;
  for (const Client& client : fifty(served.world())) {
    Browser browser(served.port(), number++);
    bool logged_in = false;
    for (const Asked& asked : client.pages) {
      if (asked.path.ends_with(".png")) continue;  // of the pages that show it
      if (asked.status != 200 || !seen.emplace(client.role, asked.path.substr(0, 8) + asked.route).second) continue;
      if (!logged_in) browser.log_in(client.name);
      logged_in = true;
      const Answer page = browser.get(asked.path);
      ASSERT_EQ(page.status, 200) << asked.path;
      std::size_t bytes = compressed(page.head) + compressed(page.body);
      std::set<std::string> parts;
      for (std::sregex_iterator at(page.body.begin(), page.body.end(), part), end; at != end; ++at)
        parts.insert(at->str(1).empty() ? at->str(2) : at->str(1));
      // Those that browsers fetch only near the screen too: on a large one all are.
      static const std::regex beside("(?:src|<image[^>]* href)=\"([a-z][^\":]*)\"");
      for (std::sregex_iterator at(page.body.begin(), page.body.end(), beside), end; at != end; ++at)
        parts.insert(asked.path.substr(0, asked.path.rfind('/') + 1) + at->str(1));
      for (const std::string& one : parts) {
        const Answer answer = browser.get(one);
        EXPECT_EQ(answer.status, 200) << one;
        bytes += one.find(".png") != one.npos ? answer.body.size() : compressed(answer.body);
      }
      EXPECT_LE(bytes, most_bytes) << name_of(client.role) << " " << asked.path;
      std::printf("%-10s %-44s %7zu bytes, %zu parts\n", name_of(client.role).c_str(), asked.route.c_str(), bytes,
                  parts.size() + 1);
    }
  }
}

}  // namespace seldinger::load
