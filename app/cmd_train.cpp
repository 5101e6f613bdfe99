// train: the trainer's window.
#include <csignal>

#include "app/command.h"
#include "app/demo_library.h"
#include "app/train/desk.h"

namespace seldinger::app {
namespace {

volatile std::sig_atomic_t told_to_end = 0;
void on_signal(int) {
  told_to_end = 1;
}

// Without --device haply: none. Throws UsageError.
base::Result<std::optional<Arms>> arms_of(const Arguments& arguments) {
  const std::string device = arguments.text("--device", "mouse");
  if (device != "mouse" && device != "haply") throw UsageError("--device is mouse or haply");
  if (device == "mouse") {
    for (const char* option : {"--device-host", "--device-port", "--station"})
      if (arguments.has(option)) throw UsageError(std::string(option) + " is for --device haply");
    return std::optional<Arms>();
  }
  Arms arms;
  arms.place.host = arguments.text("--device-host", arms.place.host);
  arms.place.port = static_cast<int>(arguments.whole("--device-port", arms.place.port, 1, 65535));
  if (arguments.has("--station")) {
    auto known = read_station(arguments.text("--station"));
    if (!known) return known.error();
    arms.station = std::move(*known);
  }
  return std::optional<Arms>(std::move(arms));
}

}  // namespace

int run_train(const Arguments& arguments) {
  const std::string folder = arguments.has("--library") ? arguments.text("--library") : demo_library().string();
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  auto arms = arms_of(arguments);
  if (!arms) return refuse(arms.error());
  Trainer trainer(std::move(*library), std::move(*arms));
  Window::Settings settings;
  settings.title = "Seldinger";
  settings.width = static_cast<int>(arguments.whole("--width", 1280, 640, 16384));
  settings.height = static_cast<int>(arguments.whole("--height", 800, 480, 16384));
  settings.whole_screen = arguments.has("--whole-screen");
  const std::string backend = arguments.text("--backend", "auto");
  if (backend != "gpu" && backend != "cpu" && backend != "auto") throw UsageError("--backend is gpu, cpu or auto");
  Window window(settings);
  if (backend == "gpu" || (backend == "auto" && !window.context().software()))
    trainer.set_pictures_by(PicturesBy::gpu);
  Trace trace(arguments.text("--trace"));
  DeskOptions options;
  options.left_handed = arguments.has("--left-handed");
  options.sound.muted = arguments.has("--mute");
  options.sound.volume = 0.01 * static_cast<double>(arguments.whole("--volume", 70, 0, 100));
  Desk desk(window, trainer, options, arguments.text("--pictures", "."), trace);
  std::signal(SIGTERM, on_signal);  // what runs is stored, as when the window is closed
  std::signal(SIGINT, on_signal);
  while (window.open() && told_to_end == 0) desk.frame();
  trainer.log_out();
  return kDone;
}

}  // namespace seldinger::app
