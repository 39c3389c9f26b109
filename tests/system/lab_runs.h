// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "program.h"
#include "test_paths.h"

#include <gtest/gtest.h>

#include <string>

namespace homeward
{

/** Short explorations of the laboratory, with their maps in a folder of the test. */
class LabRuns : public testing::Test
{
protected:
  /** The arguments of one, of so many simulated seconds. */
  std::string exploration(int seconds, const std::string &map) const
  {
    return "explore --world " + (dataDir() / "worlds/lab.sdf").string() + " --max-time " +
           std::to_string(seconds) + " --map " + folder / map + " ";
  }

  std::string canonical(const std::string &map) const
  {
    const ProgramRun run = runProgram("map export --canonical " + folder / map);
    EXPECT_EQ(run.status, 0) << run.output;
    return run.data;
  }

  Folder folder;
};

} // namespace homeward
