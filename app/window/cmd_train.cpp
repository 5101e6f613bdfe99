// train: the trainer's window.
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/words.h"
#include "app/window/desk.h"

namespace seldinger::app {
namespace {

constexpr const char* kStationVariable = "SELDINGER_STATION";

volatile std::sig_atomic_t told_to_end = 0;
void on_signal(int) {
  told_to_end = 1;
}

// With a mouse: none. Throws UsageError.
base::Result<std::optional<Arms>> arms_of(const Arguments& arguments) {
  const std::string device = arguments.text("--device", "mouse");
  if (device != "mouse" && device != "haply" && device != "virtual")
    throw UsageError("--device is mouse, haply or virtual");
  for (const char* option : {"--device-host", "--device-port"})
    if (device != "haply" && arguments.has(option))
      throw UsageError(std::string(option) + " is for --device haply");
  if (device == "mouse") {
    if (arguments.has("--station")) throw UsageError("--station is for --device haply or virtual");
    return std::optional<Arms>();
  }
  Arms arms;
  if (device == "virtual") {
    auto led = LedArms::start();
    if (!led) return led.error();
    arms.led = std::move(*led);
    arms.place = arms.led->place();
  } else {
    arms.place.host = arguments.text("--device-host", arms.place.host);
    arms.place.port = static_cast<int>(arguments.whole("--device-port", arms.place.port, 1, 65535));
    arms.station_file = usual_station_file();
  }
  // A file that is not there yet is made when something is kept.
  if (arguments.has("--station")) arms.station_file = arguments.text("--station");
  if (!arms.station_file.empty() && std::filesystem::exists(arms.station_file)) {
    auto known = read_station(arms.station_file);
    if (!known) return error_of("--station", arms.station_file.string(), known.error());
    arms.station = std::move(*known);
  }
  return std::optional<Arms>(std::move(arms));
}

// As the option says, else the environment, else nobody named it.
base::Result<std::string> station_name_of(const Arguments& arguments) {
  const char* set = std::getenv(kStationVariable);
  const bool told = arguments.has("--station-name");
  std::string name = told                             ? arguments.text("--station-name")
                     : set != nullptr && *set != '\0' ? set
                                                      : casedb::kUnnamedStation;
  if (const auto fits = casedb::check_station_name(name); !fits)
    return error_of(told ? "--station-name" : kStationVariable, name, fits.error());
  return name;
}

int run_train(const Arguments& arguments) {
  auto station = station_name_of(arguments);
  if (!station) return refuse(station.error());
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  auto arms = arms_of(arguments);
  if (!arms) return refuse(arms.error());
  Trainer trainer(std::move(*library), std::move(*arms));
  trainer.set_station(std::move(*station));
  if (arguments.has("--case"))
    if (const auto refused = trainer.open_at_log_in(arguments.text("--case"))) return refuse(*refused);
  Window::Settings settings;
  settings.title = "Seldinger";
  const bool as_asked = arguments.has("--width") || arguments.has("--height") || arguments.has("--whole-screen");
  const std::filesystem::path size_file = as_asked ? std::filesystem::path() : window_size_file();
  const WindowSize before = read_window_size(size_file).value_or(WindowSize{1280, 800, false});
  settings.width = static_cast<int>(arguments.whole("--width", before.width, kLeastWidth, 16384));
  settings.height = static_cast<int>(arguments.whole("--height", before.height, kLeastHeight, 16384));
  settings.whole_screen = arguments.has("--whole-screen") || before.whole_screen;
  settings.letters = arguments.number("--letters", 1.0, 0.75, 2.0);
  const std::string backend = arguments.text("--backend", "auto");
  if (backend != "gpu" && backend != "cpu" && backend != "auto") throw UsageError("--backend is gpu, cpu or auto");
  Window window(settings);
  if (backend == "gpu" || (backend == "auto" && !window.context().software()))
    trainer.set_pictures_by(session::PicturesBy::gpu);
  Trace trace(arguments.text("--trace"));
  ScreenWords words(arguments.text("--words"));
  DeskOptions options;
  options.left_handed = arguments.has("--left-handed");
  options.sound.muted = arguments.has("--mute");
  options.sound.volume = 0.01 * static_cast<double>(arguments.whole("--volume", 70, 0, 100));
  Desk desk(window, trainer, options, arguments.text("--pictures", "."), trace, words);
  std::signal(SIGTERM, on_signal);  // what runs is stored, as when the window is closed
  std::signal(SIGINT, on_signal);
  while (window.open() && told_to_end == 0) desk.frame();
  trainer.log_out();
  if (!as_asked) keep_window_size(size_file, window.size());
  return kDone;
}

constexpr Option kTrainOptions[] = {
    kLibrary,
    {"--case", "CASE", "whoever logs in finds this case's briefing open"},
    {"--device", "mouse|haply|virtual",
     "what holds the tools: mouse, keys, gamepad and 3-D mouse; or two arms of a Haply Inverse service, and these "
     "for what an arm does not hold; or two simulated arms that these lead, to try arms without any; default "
     "mouse"},
    {"--device-host", "ADDRESS", "where the Haply Inverse service is; default 127.0.0.1"},
    {"--device-port", "N", "its port; default 10001"},
    {"--station", "FILE.json",
     "whose arms are left and right, where they stand, and how they are set, as the device page (F10) keeps it; "
     "default with haply ~/.config/seldinger/station.json"},
    {"--station-name", "NAME",
     "what this workstation is called in records, pages and exports; else SELDINGER_STATION of the environment, "
     "else "
     "“this computer”"},
    {"--left-handed", nullptr, "the needle in the left hand: probe, marker and mouse buttons change sides"},
    {"--backend", "gpu|cpu|auto",
     "what makes ultrasound's pictures; auto, which it is unless given: the GPU where GL has hardware"},
    {"--width", "PIXELS", "of the window, at least 800; as it was when it was closed, at first 1280"},
    {"--height", "PIXELS", "of the window, at least 600; as it was when it was closed, at first 800"},
    {"--whole-screen", nullptr, "without a frame; Alt+Enter changes it"},
    {"--letters", "SIZE",
     "of letters and buttons, 0.75 to 2; 1 unless given. They grow with the window and the screen's dots too, and "
     "as far as there is room"},
    {"--mute", nullptr, "without sound, until M is pressed"},
    {"--volume", "PERCENT", "of the sound; 70 unless given"},
    {"--pictures", "DIR", "where F12 keeps pictures of the window; else the working folder"},
    {"--words", "FILE|-",
     "the words of each screen, and what has the keyboard's focus, for a screen reader: what is new of them, as it "
     "comes; - is standard output"},
    {"--trace", "FILE.jsonl", "screen, rates and lags, four times a second and after each key"},
};

}  // namespace

Command train_command() {
  return {.name = "train",
          .options = kTrainOptions,
          .summary =
              "The trainer's window: log in, choose a case, puncture under guidance with mouse and keys or two "
              "arms, and get feedback on it.",
          .run = &run_train};
}

}  // namespace seldinger::app
