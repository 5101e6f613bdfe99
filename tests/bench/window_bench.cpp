// Rates and lags of the trainer's window while both hands work, what the servo kept meanwhile, and how long a case
// takes to its first picture: by somebody at its mouse, on a screen without a monitor. Figures, no test.
//
//   window_bench PROGRAM OUT.csv SECONDS [--ct SOURCE] [-- OPTIONS OF TRAIN …]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/fixtures/process.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;

std::string program, out_file, ct;
double measured_s = 20.0;
std::vector<std::string> train_options;
constexpr const char* kPassword = "a password";

double load() {
  double one_minute = 0.0;
  return getloadavg(&one_minute, 1) == 1 ? one_minute : -1.0;
}

std::string whole(double number) {
  return std::to_string(std::lround(number));
}

class Table {
 public:
  explicit Table(const std::string& file) : file_(std::fopen(file.c_str(), "w")) {
    say("what,unit,median,least,most,goal,note\n");
  }
  ~Table() { std::fclose(file_); }
  void row(const std::string& what, const std::string& unit, std::vector<double> values, const std::string& goal,
           const std::string& note) {
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%.1f,%.1f,%.1f", values[values.size() / 2], values.front(),
                  values.back());
    say(what + "," + unit + "," + numbers + "," + goal + "," + note + "\n");
  }

 private:
  void say(const std::string& text) {
    std::fputs(text.c_str(), file_);
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
  }
  std::FILE* file_;
};

std::vector<Json> lines_of(const std::filesystem::path& trace) {
  std::vector<Json> lines;
  std::ifstream stream(trace);
  for (std::string line; std::getline(stream, line);)
    if (Json json = Json::parse(line, nullptr, false); json.is_object()) lines.push_back(std::move(json));
  return lines;
}

double first(const std::vector<Json>& lines, const std::string& screen, bool with_picture = false) {
  for (const Json& line : lines)
    if (line["screen"] == screen && (!with_picture || line.value("pictures_s", 0.0) > 0.0)) return line["t_s"];
  return -1.0;
}

double status_mb(int pid, const std::string& field) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(field + ":", 0) == 0) return std::strtod(line.c_str() + field.size() + 1, nullptr) / 1024.0;
  return 0.0;
}

// As a mouse of 125 Hz tells it: to and fro, with the button held.
void drag_about(fixtures::Trainee& trainee, double for_s) {
  const int steps = static_cast<int>(for_s / 0.008);
  const auto [x, y] = trainee.place_of("room").at(0.5, 0.5);
  std::string words = "mousemove " + std::to_string(x) + " " + std::to_string(y) + " sleep 0.1 mousedown 1";
  for (int i = 0; i < steps; ++i)
    words += std::string(" mousemove_relative -- ") + (i / 60 % 2 == 0 ? "1" : "-1") + " 0 sleep 0.008";
  const std::string display = "DISPLAY=" + trainee.screen().display();
  EXPECT_EQ(std::system((display + " xdotool " + words + " mouseup 1").c_str()), 0);  // NOLINT
}

// What the servo kept while the window drew.
void add_servo(const Json& servo, Table& table) {
  const auto us = [&](const char* of, const char* what) { return servo[of][what].get<double>(); };
  const std::string scheduler = servo["scheduler"];
  table.row("servo: compute of a tick at 99.9 %", "us", {us("compute", "p99_9_us")}, "1000",
            "half of them " + whole(us("compute", "p50_us")) + "; most " + whole(us("compute", "max_us")) + "; " +
                scheduler);
  table.row("servo: late at 99.9 %", "us", {us("latency", "p99_9_us")}, "",
            "half of them " + whole(us("latency", "p50_us")) + "; most " + whole(us("latency", "max_us")));
  table.row("servo: ticks missed", "per 1000", {1e3 * servo["missed_share"].get<double>()}, "",
            "of " + std::to_string(servo["ticks"].get<long long>()) + " done");
}

// Of each attempt of a person.
void add_servos(const std::string& library, const std::filesystem::path& scratch, Table& table) {
  const auto ask = [&](const std::string& words) {
    const auto ran = fixtures::run(program + " " + words + " --json --library " + library, scratch);
    return Json::parse(ran.out, nullptr, false);
  };
  const Json listed = ask("attempt list");
  for (const Json& attempt : listed["attempts"]) {
    if (attempt["synthetic"].get<bool>()) continue;
    const Json shown = ask("attempt show " + attempt["attempt_id"].get<std::string>());
    add_servo(shown["servo"], table);
  }
}

TEST(Window, Bench) {
  const auto scratch = fixtures::fresh_folder("window_bench");
  const std::string library = (scratch / "library").string();
  const auto done = [&](const std::string& words) {
    const auto ran = fixtures::run(
        std::string("printf '") + kPassword + "\\n' | " + program + " " + words + " --library " + library, scratch);
    ASSERT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
  };
  done("demo --no-serve" + (ct.empty() ? std::string() : " --ct " + ct));
  done("user add mona --role mentor");
  Table table(out_file);
  const double load_before = load();
  double prepared_s = 0.0;
  {
    fixtures::Trainee trainee(program, library, scratch, train_options);
    ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
    ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
    const double resident_ready_mb = status_mb(trainee.program().pid(), "VmRSS");
    ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
    trainee.prepare();
    ASSERT_NO_FATAL_FAILURE(trainee.press_probe_on());
    const double from_s = trainee.now()["t_s"];
    drag_about(trainee, 0.5 * measured_s);
    trainee.take("needle");
    drag_about(trainee, 0.5 * measured_s);
    const double to_s = trainee.now()["t_s"];
    const double resident_mb = status_mb(trainee.program().pid(), "VmRSS");
    const double most_mb = status_mb(trainee.program().pid(), "VmHWM");
    ASSERT_NO_FATAL_FAILURE(trainee.sign_out());
    trainee.program().signal(SIGTERM);
    ASSERT_TRUE(fixtures::until([&] { return trainee.program().ended(); }, 20.0));

    const std::vector<Json> lines = lines_of(trainee.trace());
    std::vector<double> frames, pictures, force, room, picture;
    std::string method;
    for (const Json& line : lines) {
      if (line["screen"] != "attempt" || line["t_s"] <= from_s || line["t_s"] > to_s) continue;
      method = line["method"];
      frames.push_back(line["frames_s"]);
      pictures.push_back(line["pictures_s"]);
      force.push_back(line["hand_to_force_ms"]);
      room.push_back(line["hand_to_room_ms"]);
      picture.push_back(line["hand_to_picture_ms"]);
    }
    ASSERT_GT(frames.size(), 4U);
    std::vector<double> sorted = frames;
    std::sort(sorted.begin(), sorted.end());
    char goal_ms[32];
    std::snprintf(goal_ms, sizeof goal_ms, "%.0f", 15.0 + 1e3 / sorted[sorted.size() / 2]);
    char note[160];
    std::snprintf(note, sizeof note, "%s; both hands' tools moving; quarters of a second; load %.1f to %.1f",
                  fixtures::Trainee::size_of(train_options).c_str(), load_before, load());
    table.row("window", "frames/s", frames, "15", note);
    table.row("ultrasound (" + method.substr(0, method.find(',')) + ")", "pictures/s", pictures,
              method.find("lattice") == 0 ? "12" : "5",
              method.find(',') == std::string::npos ? "" : method.substr(method.find(',') + 2));
    // What hands want is given out over 17 ms and more, which is not in it.
    const std::string longest = "from a telling to the swap; longest of each quarter of a second";
    table.row("hand to force", "ms", force, "", "from a telling to the tick that takes it in; likewise");
    table.row("hand to room", "ms", room, goal_ms, longest);
    table.row("hand to ultrasound", "ms", picture, goal_ms, longest + "; goal: a frame and 15 ms");
    prepared_s = first(lines, "ready") - first(lines, "briefing");
    table.row("case prepared", "s", {prepared_s}, "", ct.empty() ? "built-in torso" : "real CT");
    table.row("cold start to the first picture", "s",
              {prepared_s + first(lines, "attempt", true) - first(lines, "attempt")}, "3",
              "prepared and then entered; without the person's time between");
    table.row("memory", "MB", {resident_mb}, "",
              "most " + std::to_string(static_cast<int>(most_mb)) + "; before the attempt " +
                  std::to_string(static_cast<int>(resident_ready_mb)));
  }
  add_servos(library, scratch, table);
}

}  // namespace
}  // namespace seldinger

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc < 4) {
    std::fprintf(stderr, "window_bench PROGRAM OUT.csv SECONDS [--ct SOURCE] [-- OPTIONS OF TRAIN …]\n");
    return 2;
  }
  seldinger::program = argv[1];
  seldinger::out_file = argv[2];
  seldinger::measured_s = std::atof(argv[3]);
  for (int i = 4; i < argc; ++i) {
    if (std::string(argv[i]) == "--ct" && i + 1 < argc)
      seldinger::ct = argv[++i];
    else if (std::string(argv[i]) != "--")
      seldinger::train_options.push_back(argv[i]);
  }
  return RUN_ALL_TESTS();
}
