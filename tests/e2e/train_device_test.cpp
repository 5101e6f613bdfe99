// Two arms at the trainer's window: the simulated service on loopback, the program, and somebody at its keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "tests/fixtures/process.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::until;

const std::string kProgram = SELDINGER_PROGRAM;
constexpr const char* kPassword = "a password";

// A simulated service; port 0: of its own choice.
class Service {
 public:
  Service(const std::filesystem::path& scratch, const std::string& port)
      : said_(scratch / ("service-" + port + ".txt")),
        process_({kProgram, "device", "simulate", "--port", port, "--seconds", "300"}, said_) {
    EXPECT_TRUE(until([&] { return fixtures::whole_file(said_).ends_with("\n"); }, 20.0));
  }
  std::string port() const {
    const std::string said = fixtures::whole_file(said_);
    return said.substr(said.rfind(':') + 1, said.size() - said.rfind(':') - 2);
  }
  void kill() {
    process_.signal(SIGKILL);
    EXPECT_TRUE(until([&] { return process_.ended(); }, 10.0));
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

TEST(TrainDevice, ToolsFollowTheArmsStayWithoutThemAndFollowAgain) {
  const auto scratch = fixtures::fresh_folder("train_device");
  const std::string library = (scratch / "library").string();
  const auto run = [&](const std::string& words) {
    const auto ran = fixtures::run(words + " --library " + library, scratch);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return ran.out;
  };
  run(kProgram + " demo --no-serve --json");
  run(std::string("printf '") + kPassword + "\\n' | " + kProgram + " user add mona --role mentor");
  const auto before = Json::parse(run(kProgram + " attempt list --json"))["attempts"].size();

  auto service = std::make_unique<Service>(scratch, "0");
  const std::string port = service->port();
  fixtures::Trainee trainee(kProgram, library, scratch, {"--device", "haply", "--device-port", port});
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  const auto arms_are = [&](const char* state) {
    const Json arms = trainee.now().value("arms", Json::array());
    return arms == Json::array({state, state});
  };
  ASSERT_TRUE(until([&] { return arms_are("ok"); }, 20.0)) << trainee.now();
  trainee.screen().press("y");
  // Both go round circles of 20 mm.
  EXPECT_GT(way_mm(trainee, "needle_lps_mm", 4.0), 25.0);
  EXPECT_GT(way_mm(trainee, "probe_lps_mm", 4.0), 25.0);
  trainee.keep_picture();

  service->kill();
  ASSERT_TRUE(until([&] { return arms_are("lost"); }, 10.0)) << trainee.now();
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const double lost_s = trainee.now().value("attempt_s", 0.0);
  EXPECT_LT(way_mm(trainee, "needle_lps_mm", 2.0), 0.5) << "it stays";
  EXPECT_LT(way_mm(trainee, "probe_lps_mm", 1.0), 0.5);
  EXPECT_GT(trainee.now().value("attempt_s", 0.0), lost_s + 1.5) << "the attempt goes on";
  trainee.keep_picture();
  // Keys hold what no arm does.
  const glm::dvec3 stayed = place(trainee.now(), "needle_lps_mm");
  ASSERT_EQ(trainee.now().value("held", ""), "needle");
  for (int i = 0; i < 8; ++i) trainee.screen().press("Page_Up");
  EXPECT_TRUE(until([&] { return glm::length(place(trainee.now(), "needle_lps_mm") - stayed) > 0.5; }, 10.0));

  service = std::make_unique<Service>(scratch, port);
  ASSERT_TRUE(until([&] { return arms_are("ok"); }, 20.0)) << trainee.now();
  EXPECT_GT(way_mm(trainee, "needle_lps_mm", 4.0), 25.0);
  EXPECT_GT(way_mm(trainee, "probe_lps_mm", 4.0), 25.0);
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());

  const Json listed = Json::parse(run(kProgram + " attempt list --json"))["attempts"];
  ASSERT_EQ(listed.size(), before + 1);
  std::string mine;
  for (const Json& attempt : listed)
    if (!attempt["synthetic"].get<bool>()) mine = attempt["attempt_id"].get<std::string>();
  const Json shown = Json::parse(run(kProgram + " attempt show " + mine + " --json"));
  ASSERT_TRUE(shown.contains("servo")) << shown;
  EXPECT_GT(shown["servo"].value("ticks", 0), 10000) << shown["servo"];
  EXPECT_EQ(Json::parse(run(kProgram + " replay " + mine + " --verify --json"))["verified"], true);
}

}  // namespace
}  // namespace seldinger
