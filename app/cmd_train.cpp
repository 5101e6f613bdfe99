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

}  // namespace

int run_train(const Arguments& arguments) {
  const std::string folder = arguments.has("--library") ? arguments.text("--library") : demo_library().string();
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  Trainer trainer(std::move(*library));
  Window::Settings settings;
  settings.title = "Seldinger";
  settings.width = static_cast<int>(arguments.whole("--width", 1280, 640, 16384));
  settings.height = static_cast<int>(arguments.whole("--height", 800, 480, 16384));
  settings.whole_screen = arguments.has("--whole-screen");
  Window window(settings);
  Trace trace(arguments.text("--trace"));
  Desk desk(window, trainer, {arguments.has("--left-handed")}, arguments.text("--pictures", "."), trace);
  std::signal(SIGTERM, on_signal);  // what runs is stored, as when the window is closed
  std::signal(SIGINT, on_signal);
  while (window.open() && told_to_end == 0) desk.frame();
  trainer.log_out();
  return kDone;
}

}  // namespace seldinger::app
