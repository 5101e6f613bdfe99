// train: the trainer's window.
#include "app/command.h"
#include "app/demo_library.h"
#include "app/train/desk.h"

namespace seldinger::app {

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
  while (window.open()) desk.frame();
  trainer.log_out();
  return kDone;
}

}  // namespace seldinger::app
