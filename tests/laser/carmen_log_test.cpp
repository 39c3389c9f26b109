// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/core/error.h>
#include <homeward/laser/carmen_log.h>

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <zlib.h>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/** A file of the running test, removed afterwards. */
class LogFile
{
public:
  explicit LogFile(const std::string &text, bool compressed = false)
      : m_path(
            std::filesystem::path(::testing::TempDir()) /
            (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".log"))
  {
    if (compressed) {
      const gzFile file = gzopen(m_path.c_str(), "wb");
      gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
      gzclose(file);
    }
    else {
      std::ofstream(m_path, std::ios::binary) << text;
    }
  }

  ~LogFile() { std::filesystem::remove(m_path); }
  LogFile(const LogFile &) = delete;
  LogFile &operator=(const LogFile &) = delete;

  const std::filesystem::path &path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

/** A laser line of n readings 0.01 (i + 1) metres, the last one `last`. */
std::string laserLine(int n, const std::string &last = "5")
{
  std::ostringstream line;
  line << "FLASER " << n;
  for (int i = 1; i < n; ++i) {
    line << ' ' << 0.01 * i;
  }
  line << ' ' << last << " 1.5 -2.5 4 1.25 -2.25 -0.5 12.75 nohost 13.5\n";
  return line.str();
}

/** Reading `text` throws one line with the file, the line number and `words`. */
void expectRefused(const std::string &text, int line, const std::string &words)
{
  const LogFile file(text);
  try {
    readCarmenLog(file.path());
    ADD_FAILURE() << "accepted: " << text.substr(0, 60);
  }
  catch (const ConfigError &error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(file.path().string() + ":" + std::to_string(line)),
                                    HasSubstr(words), Not(HasSubstr("\n"))));
  }
}

TEST(CarmenLog, ReadsEveryFieldOfALaserLine)
{
  const LogFile file("# a comment\nPARAM x 1 nohost 0\n" + laserLine(180) +
                     "ODOM 1 2 3 0 0 0 1 nohost 1\nNEFF 30\n");
  const CarmenLog log = readCarmenLog(file.path());
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(log.odometryLines, 1U);
  const CarmenScan &scan = log.scans[0];
  ASSERT_EQ(scan.scan.ranges.size(), 180U);
  EXPECT_FLOAT_EQ(scan.scan.ranges[0], 0.01F);
  EXPECT_FLOAT_EQ(scan.scan.ranges[178], 1.79F);
  EXPECT_FLOAT_EQ(scan.scan.ranges[179], 5.0F);
  EXPECT_EQ(scan.pose.x, 1.5);
  EXPECT_EQ(scan.pose.y, -2.5);
  EXPECT_DOUBLE_EQ(scan.pose.heading, 4.0 - 2.0 * kPi);
  EXPECT_EQ(scan.odometry.x, 1.25);
  EXPECT_EQ(scan.odometry.y, -2.25);
  EXPECT_EQ(scan.odometry.heading, -0.5);
  EXPECT_EQ(scan.time, 12.75);
  EXPECT_EQ(toSeconds(scan.scan.stamp), 12.75);
}

TEST(CarmenLog, FirstReadingIsToTheRight)
{
  const std::vector<std::pair<int, double>> kinds{{180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}};
  for (const auto &[count, step] : kinds) {
    const LogFile file(laserLine(count));
    const Scan scan = readCarmenLog(file.path()).scans.at(0).scan;
    EXPECT_DOUBLE_EQ(scan.angle(0), -kPi / 2.0);
    EXPECT_DOUBLE_EQ(scan.angleStep, radians(step));
    EXPECT_NEAR(scan.angle(scan.ranges.size() - 1), kPi / 2.0,
                count % 2 == 0 ? radians(step) + 1e-9 : 1e-9);
  }
}

TEST(CarmenLog, IsTheSameCompressed)
{
  const std::string text = laserLine(361) + laserLine(361) + "ODOM\n";
  const LogFile file(text, true);
  const CarmenLog log = readCarmenLog(file.path());
  EXPECT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.odometryLines, 1U);
  EXPECT_EQ(log.scans[0].scan.ranges, log.scans[1].scan.ranges);
}

TEST(CarmenLog, KnowsWhatTheSensorCanSee)
{
  const std::vector<std::pair<std::string, double>> kinds{
      {"5", 8.0},      {"8.191", 8.0}, {"11", 16.0},    {"32.7", 32.0}, {"50", 50.0},
      {"51.16", 50.0}, {"60", 80.0},   {"81.91", 80.0}, {"100", 100.0}};
  for (const auto &[largest, range] : kinds) {
    const LogFile file(laserLine(180, largest) + laserLine(180));
    for (const CarmenScan &scan : readCarmenLog(file.path()).scans) {
      EXPECT_EQ(scan.scan.rangeMax, range) << largest;
    }
  }
}

TEST(CarmenLog, TakesWindowsLineEndsAndALastLineWithoutEnd)
{
  std::string text = laserLine(180);
  text.pop_back();
  const LogFile file("ODOM 1\r\n" + text + "\r\n" + text);
  EXPECT_EQ(readCarmenLog(file.path()).scans.size(), 2U);
}

TEST(CarmenLog, RefusesAMalformedLaserLineByNumber)
{
  const std::string good = laserLine(180);
  expectRefused(good + good.substr(0, 300) + "\n", 2, "FLASER");
  expectRefused(good + good.substr(0, good.size() - 13) + "\n", 2, "ends before");
  expectRefused("# x\n" + laserLine(180, "oops"), 2, "\"oops\"");
  expectRefused(laserLine(180, "nan"), 1, "\"nan\"");
  expectRefused(laserLine(180, "1.2.3"), 1, "\"1.2.3\"");
  expectRefused(laserLine(180, "-1"), 1, "below 0");
  expectRefused(laserLine(90), 1, "90");
  expectRefused("FLASER\n", 1, "number of readings");
  expectRefused("FLASER 180.5 1\n", 1, "180.5");
  expectRefused("FLASER 181" + good.substr(10), 1, "FLASER");
  expectRefused(laserLine(180, "5 5"), 1, "FLASER");
}

TEST(CarmenLog, RefusesWhatIsNoLog)
{
  expectRefused("", 0, "not a CARMEN log");
  expectRefused("once upon a time\nthere was a robot\n", 2, "not a CARMEN log");
  expectRefused(std::string(3U << 20U, 'x'), 1, "megabyte");
  EXPECT_THROW(readCarmenLog("/no/such/file.log"), ConfigError);
  EXPECT_THROW(readCarmenLog(::testing::TempDir()), ConfigError);
}

TEST(CarmenLog, RefusesACompressedFileCutShortOrDamaged)
{
  std::string text;
  for (int i = 0; i < 200; ++i) {
    text += laserLine(180, std::to_string(i * 0.123));
  }
  const LogFile whole(text, true);
  std::ifstream stream(whole.path(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (const std::size_t length : {bytes.size() / 2, bytes.size() - 4}) {
    const LogFile cut(bytes.substr(0, length));
    try {
      readCarmenLog(cut.path());
      ADD_FAILURE() << "accepted " << length << " of " << bytes.size() << " bytes";
    }
    catch (const ConfigError &error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(cut.path().string() + ":"),
                                      HasSubstr("ends too early; copy it again")));
    }
  }
  std::string damaged = bytes;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  const LogFile file(damaged);
  EXPECT_THROW(readCarmenLog(file.path()), ConfigError);
}

struct OutsideLog
{
  const char *name;
  std::size_t scans;
  std::size_t odometryLines;
  std::size_t readings;
  double rangeMax;
};

class OutsideCarmenLog : public ::testing::TestWithParam<OutsideLog>
{};

// Counts by zcat FILE | grep -c '^FLASER' and '^ODOM'.
TEST_P(OutsideCarmenLog, IsReadWhole)
{
  const OutsideLog &expected = GetParam();
  const std::filesystem::path name =
      std::filesystem::path("laser") / (std::string(expected.name) + ".log.gz");
  HOMEWARD_NEEDS_OUTSIDE_DATA(name);
  const CarmenLog log = readCarmenLog(outsideDataDir() / name);
  EXPECT_EQ(log.scans.size(), expected.scans);
  EXPECT_EQ(log.odometryLines, expected.odometryLines);
  for (const CarmenScan &scan : log.scans) {
    EXPECT_EQ(scan.scan.ranges.size(), expected.readings);
    EXPECT_EQ(scan.scan.rangeMax, expected.rangeMax);
    EXPECT_GT(scan.time, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OutsideCarmenLog,
                         ::testing::Values(OutsideLog{"aces", 440, 7814, 180, 50.0},
                                           OutsideLog{"edmonton", 340, 6351, 180, 50.0},
                                           OutsideLog{"fhw", 488, 13935, 180, 50.0},
                                           OutsideLog{"freiburg-101", 292, 4569, 360, 80.0},
                                           OutsideLog{"intel", 910, 14541, 180, 80.0},
                                           OutsideLog{"seattle", 241, 19311, 361, 80.0}),
                         [](const auto &given) {
                           std::string name = given.param.name;
                           std::erase(name, '-');
                           return name;
                         });

} // namespace
} // namespace homeward
