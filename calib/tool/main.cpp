// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"

int main(int argc, char **argv)
{
  homeward::Program program(
      "homeward-calibrate",
      "Calibrates a camera under a mirror, or any central camera, from pictures.");
  homeward::addCalibrateCommand(program);
  homeward::addQuickCommand(program);
  homeward::addTargetCommand(program);
  homeward::addMountCommand(program);
  homeward::addConvertCommand(program);
  return program.main(argc, argv);
}
