// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"

#include <cstdlib>

int main(int argc, char **argv)
{
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0); // a broken film is our one line
  homeward::Program program("homeward", "Visual navigation with a mirror camera.");
  program.requireCommand();
  homeward::addExploreCommand(program);
  homeward::addNavigateCommand(program);
  homeward::addReplayCommand(program);
  homeward::addRigCommand(program);
  homeward::addMapCommand(program);
  homeward::addUnwrapCommand(program);
  homeward::addScanCommand(program);
  homeward::addHomeCommand(program);
  homeward::addLocalizeCommand(program);
  homeward::addEvaluateCommand(program);
  return program.main(argc, argv);
}
