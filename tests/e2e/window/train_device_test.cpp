// Two arms at the trainer's window: the simulated service on loopback, the program, and somebody at its keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "app/device_simulation/led_arms.h"
#include "sim/devices/arms/arm_mapping.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;
using fixtures::kProgram;
using fixtures::until;

// A simulated service; port 0: of its own choice.
class Service {
 public:
  Service(const std::filesystem::path& scratch, const std::string& port)
      : said_(scratch / ("service-" + port + ".txt")),
        process_({kProgram, "device", "simulate", "--port", port, "--seconds", "300"}, said_) {
    EXPECT_TRUE(until([&] { return fixtures::whole_file(said_).ends_with("\n"); }));
  }
  std::string port() const {
    const std::string said = fixtures::whole_file(said_);
    return said.substr(said.rfind(':') + 1, said.size() - said.rfind(':') - 2);
  }
  void kill() {
    process_.signal(SIGKILL);
    EXPECT_TRUE(until([&] { return process_.ended(); }));
  }

 private:
  std::filesystem::path said_;
  fixtures::Process process_;
};

glm::dvec3 place(const Json& line, const char* field) {
  const Json at = line.value(field, Json::array({NAN, NAN, NAN}));
  return {at[0], at[1], at[2]};
}

// How far a tool gets about in so long, from corner to corner of the box that holds its way.
double way_mm(const fixtures::Trainee& trainee, const char* field, double seconds) {
  glm::dvec3 least = place(trainee.now(), field), most = least;
  until(
      [&] {
        const glm::dvec3 at = place(trainee.now(), field);
        least = glm::min(least, at);
        most = glm::max(most, at);
        return false;
      },
      seconds);
  return glm::length(most - least);
}

// Its states of both arms. One that is well may be late where the machine is busy; that it pushes is asked of it.
bool arms_are(const fixtures::Trainee& trainee, const Json& states) {
  const Json now = trainee.now().value("arms", Json::array());
  if (now.size() != states.size()) return false;
  for (std::size_t side = 0; side < states.size(); ++side)
    if (now[side] != states[side] && !(states[side] == "ok" && now[side] == "late")) return false;
  return true;
}

// Two arms at a service of the test's: the left one's probe is in the air, the right one's needle goes straight
// down through the entry as deep as it is told to.
struct AtTheEntry {
  AtTheEntry() : led(*app::LedArms::start()) {
    led->put(0, stylus({-60.0, devices::kEntryAboveMm + 60.0, 30.0}));
    led->put(1, stylus({0.0, devices::kEntryAboveMm + 30.0, 0.0}));
  }
  static app::LedStylus stylus(const glm::dvec3& at_mm) {
    return {at_mm, glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}), false};  // the stylus' z is up
  }
  void go_down_to(double mm) {
    while (std::abs(mm - deep_mm) > 1e-9) {
      deep_mm += std::clamp(mm - deep_mm, -0.3, 0.3);
      led->lead(1, stylus({0.0, devices::kEntryAboveMm - deep_mm, 0.0}));
      fixtures::let_pass(0.01);  // a hand's speed: 30 mm/s
      felt_n = std::max(felt_n, asked_n());
    }
  }
  // A hand that rests feels little: tissue gives way.
  double feels_to_and_fro() {
    felt_n = 0.0;
    for (const double way_mm : {2.0, -2.0}) go_down_to(deep_mm + way_mm);
    return felt_n;
  }
  double asked_n() const { return glm::length(led->service().arm(1).asked_n); }
  double motor_n() const { return glm::length(led->service().arm(1).motor_n); }
  std::shared_ptr<app::LedArms> led;
  double deep_mm = -30.0, felt_n = 0.0;  // the most that was asked of the right arm on its way
};

struct Fault {
  const char* name;
  std::function<void()> begin;
  Json arms;  // while it lasts; null: it lasts no time
  // Of late answers one now and then looks like an early one, and force begins to come in.
  double most_n = 0.0;
};

// However an arm is lost while its needle is in tissue: its force is gone, its tool stays, the attempt goes on, and
// when it is back the tool goes on from where it is, and pushes back again.
TEST(ArmFaults, WhateverHappensToAnArmWhoseNeedleIsInTissueForcesEndAndTheAttemptGoesOn) {
  const auto library = fixtures::library_to_try("train_device_faults", "mpr");
  AtTheEntry desk;
  app::HaplySimulation& service = desk.led->service();
  fixtures::Trainee trainee(
      kProgram, library.path(), library.folder(),
      fixtures::in_small_window({"--device", "haply", "--device-port", std::to_string(service.port()), "--station",
                                 (library.folder() / "station.json").string()}));
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  const Json both = {"ok", "ok"};
  ASSERT_TRUE(until([&] { return arms_are(trainee, both); })) << trainee.now();
  for (const char* key : {"y", "F4"}) trainee.press(key);
  // The mouse's start melts into the arm's place outside the body.
  ASSERT_TRUE(trainee.stands_still([](const Json& line) { return place(line, "needle_lps_mm"); }, 0.1))
      << trainee.now();
  desk.go_down_to(30.0);
  const auto inserted_mm = [&] { return trainee.now().value("inserted_mm", 0.0); };
  ASSERT_TRUE(until([&] { return inserted_mm() > 10.0; })) << trainee.now();
  EXPECT_GT(desk.felt_n, 0.2) << "N, on the way in";
  // The hand is there: else its own way would count as the fault's.
  ASSERT_TRUE(trainee.stands_still("inserted_mm", 0.3)) << trainee.now();
  trainee.keep_picture();

  const Json none = {"lost", "lost"};
  const std::vector<Fault> faults = {
      {"the needle's arm is unplugged",
       [&] {
         service.set({.unplugged = {false, true}});
       },
       {"ok", "lost"}},
      {"the service says nothing", [&] { service.set({.silent = true}); }, none},
      {"every answer is 4 ms late", [&] { service.set({.delay_s = 0.004}); }, Json({"late", "late"}), 0.1},
      {"nobody is let in", [&] { service.set({.away = true}); }, none},
      {"it hangs up", [&] { service.hang_up(); }, nullptr},
      {"garbage in a message", [&] { service.say_once("{\"inverse3\": [{\"device_id\": 7", false); }, nullptr},
      {"garbage beside the protocol", [&] { service.say_once(std::string(300, '\x85'), true); }, nullptr},
      {"the machine stands still while the hand goes on",
       [&] {
         trainee.program().signal(SIGSTOP);
         desk.go_down_to(desk.deep_mm + 15.0);
         trainee.program().signal(SIGCONT);
       },
       nullptr},
      {"the arms change places in its messages", [&] { service.set({.swapped = true}); }, nullptr},
  };
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.name);
    const glm::dvec3 before = place(trainee.now(), "needle_lps_mm");
    const double before_s = trainee.now().value("attempt_s", 0.0);
    fault.begin();
    if (!fault.arms.is_null()) {
      EXPECT_TRUE(until([&] { return desk.motor_n() <= fault.most_n; }, 2.0)) << "the motors let go";
      EXPECT_TRUE(until([&] { return arms_are(trainee, fault.arms); })) << trainee.now();
      for (int i = 0; i < 50; ++i) {
        EXPECT_LE(desk.motor_n(), fault.most_n) << "and stay so";
        fixtures::let_pass(0.01);  // half a second in which nothing may come
      }
    }
    EXPECT_TRUE(until([&] { return trainee.now().value("attempt_s", 0.0) > before_s + 1.0; })) << "it goes on";
    const bool swapped = std::string(fault.name).find("places") != std::string::npos;
    if (!swapped) service.set({});
    ASSERT_TRUE(until([&] { return arms_are(trainee, both); })) << trainee.now();
    EXPECT_LT(glm::length(place(trainee.now(), "needle_lps_mm") - before), 6.0) << "nothing was torn";
    EXPECT_GT(inserted_mm(), 5.0);
    EXPECT_TRUE(until([&] { return desk.feels_to_and_fro() > 0.2; })) << "it is felt again";
    service.set({});
  }
  trainee.keep_picture();
  desk.go_down_to(-20.0);
  EXPECT_TRUE(until([&] { return inserted_mm() <= 0.0; })) << trainee.now();
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());
  EXPECT_EQ(library.ask("replay " + library.persons_attempt() + " --verify")["verified"], true);
}

// The device page by its keys, with arms that have no hardware.
TEST(TrainDevice, AnArmIsCalibratedAndTestedAtTheDevicePageAndHoldsTheNeedleAfterwards) {
  const auto library = fixtures::library_to_try("train_device_page", "mpr");
  const auto station = library.folder() / "station.json";
  const std::string case_id = library.ask("case list")["cases"].at(0)["case_id"];
  EXPECT_EQ(library.call("train --case nonsense").exit_code, 3);
  fixtures::Trainee trainee(
      kProgram, library.path(), library.folder(),
      fixtures::in_small_window({"--device", "virtual", "--station", station.string(), "--case", case_id}));
  const auto asks = [&](const char* words) {
    return trainee.now().value("asks", std::string()).find(words) != std::string::npos;
  };
  trainee.press("F10");
  ASSERT_TRUE(trainee.reaches("devices")) << "before anybody logs in";
  ASSERT_TRUE(until([&] { return arms_are(trainee, {"ok", "ok"}); })) << trainee.now();
  for (const char* key : {"2", "c"}) trainee.press(key);
  ASSERT_TRUE(until([&] { return asks("on a: "); })) << trainee.now();
  for (const char* point : {"on b: ", "on c: ", "on d: ", "on e: ", "on f: ", "All points"}) {
    trainee.press("v");
    // A point is taken of a hand that has come to rest; until then it is asked for again.
    ASSERT_TRUE(until([&] {
      trainee.press("space");
      return until([&] { return asks(point); }, 3.0);
    })) << trainee.now();
  }
  trainee.keep_picture();
  EXPECT_FALSE(std::filesystem::exists(station));
  trainee.press("Return");
  ASSERT_TRUE(until([&] { return std::filesystem::exists(station); }));
  const Json kept = Json::parse(fixtures::whole_file(station));
  EXPECT_EQ(kept["devices"]["right"]["points"].size(), 6U);
  EXPECT_EQ(kept["devices"]["right"]["device_id"], "sim-right");
  EXPECT_LT(kept["devices"]["right"]["residual_max_mm"].get<double>(), 1.0);

  trainee.press("t");
  ASSERT_TRUE(until([&] { return asks("as far as it goes"); })) << trainee.now();
  for (const char* key : {"Right", "Down", "Prior"}) trainee.screen().hold(key, 1.5);
  for (int more = 0; more < 6 && asks("as far as it goes"); ++more)
    for (const char* key : {"Right", "Down", "Prior"}) trainee.screen().hold(key, 0.6);
  ASSERT_TRUE(until([&] { return asks("fit for an attempt"); })) << trainee.now();
  trainee.keep_picture();

  trainee.press("Escape");
  ASSERT_TRUE(trainee.reaches("log_in")) << "back where one was";
  trainee.say_who("mona", kPassword);
  ASSERT_TRUE(trainee.reaches("ready")) << "the case of this workstation";
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  trainee.press("y");
  ASSERT_TRUE(until([&] { return arms_are(trainee, {"ok", "ok"}); })) << trainee.now();
  trainee.press("F10");
  ASSERT_NO_FATAL_FAILURE(trainee.push_needle_to(20.0));
  EXPECT_GT(trainee.now().value("inserted_mm", 0.0), 12.0) << "the mouse leads the arm, the arm the needle";
  trainee.keep_picture();
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());
}

TEST(TrainDevice, ToolsFollowTheArmsStayWithoutThemAndFollowAgain) {
  const auto library = fixtures::library_to_try("train_device", "ultrasound");
  const auto before = library.ask("attempt list")["attempts"].size();

  auto service = std::make_unique<Service>(library.folder(), "0");
  const std::string port = service->port();
  fixtures::Trainee trainee(kProgram, library.path(), library.folder(),
                            fixtures::in_small_window({"--device", "haply", "--device-port", port, "--station",
                                                       (library.folder() / "station.json").string()}));
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  const auto both_are = [&](const char* state) { return arms_are(trainee, Json::array({state, state})); };
  ASSERT_TRUE(until([&] { return both_are("ok"); })) << trainee.now();
  trainee.press("y");
  // Both go round circles of 20 mm.
  EXPECT_GT(way_mm(trainee, "needle_lps_mm", 4.0), 25.0);
  EXPECT_GT(way_mm(trainee, "probe_lps_mm", 4.0), 25.0);
  trainee.keep_picture();

  service->kill();
  ASSERT_TRUE(until([&] { return both_are("lost"); })) << trainee.now();
  const auto needle_at = [](const Json& line) { return place(line, "needle_lps_mm"); };
  ASSERT_TRUE(trainee.stands_still(needle_at, 0.5)) << trainee.now();
  const double lost_s = trainee.now().value("attempt_s", 0.0);
  EXPECT_LT(way_mm(trainee, "needle_lps_mm", 2.0), 0.5) << "it stays";
  EXPECT_LT(way_mm(trainee, "probe_lps_mm", 1.0), 0.5);
  EXPECT_GT(trainee.now().value("attempt_s", 0.0), lost_s + 1.5) << "the attempt goes on";
  trainee.keep_picture();
  // Keys hold what no arm does.
  const glm::dvec3 stayed = place(trainee.now(), "needle_lps_mm");
  ASSERT_EQ(trainee.now().value("held", ""), "needle");
  for (int i = 0; i < 8; ++i) trainee.press("Page_Up");
  EXPECT_TRUE(until([&] { return glm::length(place(trainee.now(), "needle_lps_mm") - stayed) > 0.5; }));

  service = std::make_unique<Service>(library.folder(), port);
  ASSERT_TRUE(until([&] { return both_are("ok"); })) << trainee.now();
  EXPECT_GT(way_mm(trainee, "needle_lps_mm", 4.0), 25.0);
  EXPECT_GT(way_mm(trainee, "probe_lps_mm", 4.0), 25.0);
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());

  ASSERT_EQ(library.ask("attempt list")["attempts"].size(), before + 1);
  const std::string mine = library.persons_attempt();
  const Json shown = library.ask("attempt show " + mine);
  ASSERT_TRUE(shown.contains("servo")) << shown;
  EXPECT_GT(shown["servo"].value("ticks", 0), 10000) << shown["servo"];
  EXPECT_EQ(library.ask("replay " + mine + " --verify")["verified"], true);
}

}  // namespace
}  // namespace seldinger
