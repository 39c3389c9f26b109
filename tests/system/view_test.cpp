// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab_runs.h"

#include <gmock/gmock.h>
#include <opencv2/videoio.hpp>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::HasSubstr;

class View : public LabRuns
{};

/** How many pictures a video has; each must be of the size that is documented. */
int pictures(const std::string &file)
{
  cv::VideoCapture video(file);
  int count = 0;
  for (cv::Mat picture; video.read(picture); ++count) {
    EXPECT_EQ(picture.size(), cv::Size(1280, 840));
  }
  return count;
}

TEST_F(View, WritesAVideoAndChangesNothing)
{
  const ProgramRun run = runProgram(exploration(40, "seen.hwm") + "--video " + folder / "a.mp4");
  EXPECT_EQ(run.status, 1) << run.output;         // the time was over
  EXPECT_NEAR(pictures(folder / "a.mp4"), 80, 4); // two a second
  runProgram(exploration(40, "unseen.hwm"));
  EXPECT_EQ(canonical("seen.hwm"), canonical("unseen.hwm"));

  const ProgramRun drive = runProgram("navigate --map " + folder / "seen.hwm" +
                                      " --to 0 --from 1 --video " + folder / "b.avi");
  EXPECT_EQ(drive.status, 0) << drive.output;
  EXPECT_GT(pictures(folder / "b.avi"), 10);
}

TEST_F(View, NeedsAVideoThatCanBeWritten)
{
  const ProgramRun kind = runProgram(exploration(10, "a.hwm") + "--video " + folder / "a.gif");
  EXPECT_EQ(kind.status, 2);
  EXPECT_THAT(kind.output, AllOf(HasSubstr("a.gif"), HasSubstr(".mp4 or .avi")));
  const ProgramRun place = runProgram(exploration(10, "a.hwm") + "--video " + folder / "no/a.mp4");
  EXPECT_EQ(place.status, 2);
  EXPECT_THAT(place.output, HasSubstr("no/a.mp4 cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.hwm"));
}

TEST_F(View, NeedsADisplay)
{
  const ProgramRun none = runProgram(exploration(10, "a.hwm") + "--view", "unset DISPLAY; ");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.output, AllOf(HasSubstr("DISPLAY"), HasSubstr("--video")));
  const ProgramRun wrong = runProgram(exploration(10, "a.hwm") + "--view", "DISPLAY=:9999 ");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.output, AllOf(HasSubstr(":9999"), HasSubstr("--video")));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.hwm"));
}

TEST_F(View, NeedsAnAddressForItsPage)
{
  const ProgramRun wrong = runProgram(exploration(10, "a.hwm") + "--serve x");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.output, HasSubstr("'x' is no [HOST:]PORT"));
  const ProgramRun away = runProgram(exploration(10, "a.hwm") + "--serve 203.0.113.7:8080");
  if (away.output.find("without its page") != std::string::npos) {
    GTEST_SKIP() << "the program was built without its page";
  }
  EXPECT_EQ(away.status, 2);
  EXPECT_THAT(away.output, HasSubstr("cannot listen on 203.0.113.7:8080"));
  const ProgramRun both =
      runProgram(exploration(10, "a.hwm") + "--serve 0 --record " + folder / "a.bag");
  EXPECT_EQ(both.status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.hwm"));
}

TEST_F(View, OpensItsWindows)
{
  if (!std::filesystem::exists("/usr/bin/xvfb-run") ||
      !std::filesystem::exists("/usr/bin/xwininfo")) {
    GTEST_SKIP() << "no xvfb-run or no xwininfo (Debian: xvfb, x11-utils)";
  }
  // What windows there are is asked for again and again until the mission is over.
  std::ofstream(folder / "go") << HOMEWARD_PROGRAM << " " << exploration(40, "seen.hwm")
                               << "--view & mission=$!\n"
                               << "while kill -0 $mission 2>/dev/null; do\n"
                               << "  xwininfo -root -tree >> " << folder / "windows"
                               << "; sleep 0.2\ndone\n";
  const ProgramRun run = runProgram("--version", "xvfb-run -a sh " + folder / "go && ");
  const std::string windows = fileText(folder / "windows");
  for (const char *title : {"view", "scan", "map", "speeds"}) {
    EXPECT_THAT(windows, HasSubstr("Homeward: " + std::string(title))) << run.output;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "seen.hwm"));
}

} // namespace
} // namespace homeward
