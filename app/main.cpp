// The program `seldinger`.
#include "app/commands.h"
#include "app/run_program.h"

int main(int argc, char** argv) {
  return seldinger::app::run_program(argc, argv, seldinger::app::commands());
}
