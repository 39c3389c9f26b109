// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/dataset/data_set.h>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <fstream>

namespace homeward
{
namespace
{

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char *kHeader = "file,x_m,y_m,heading_rad,light\n";
constexpr const char *kLayout = "projection: equirectangular\nelevation_min_deg: -40\n"
                                "elevation_max_deg: 40\nforward_column: 31.5\ncolumns: clockwise\n";

cv::Mat noise(const cv::Size &size, int type, std::uint64_t seed)
{
  cv::RNG engine(seed);
  cv::Mat picture(size, type);
  engine.fill(picture, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

/** Pixels that differ. */
int differences(const cv::Mat &a, const cv::Mat &b)
{
  return a.size() != b.size() || a.type() != b.type()
             ? -1
             : cv::countNonZero(cv::Mat(a != b).reshape(1));
}

void expectSame(const DataSet &a, const DataSet &b)
{
  EXPECT_EQ(a.geometry(), b.geometry());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.view(i).file, b.view(i).file);
    EXPECT_EQ(a.view(i).light, b.view(i).light);
    EXPECT_EQ(a.view(i).pose.x, b.view(i).pose.x);
    EXPECT_EQ(a.view(i).pose.y, b.view(i).pose.y);
    EXPECT_EQ(a.view(i).pose.heading, b.view(i).pose.heading);
    EXPECT_EQ(differences(a.picture(i), b.picture(i)), 0) << a.view(i).file;
    EXPECT_EQ(differences(a.panorama(i).image, b.panorama(i).image), 0) << a.view(i).file;
  }
}

/** Names in no order, poses of many digits. */
void fill(DataSet &set, const cv::Size &size)
{
  Random random(3, 1);
  for (const char *file : {"z.png", "a.png", "sub/m.png"}) {
    const Pose2 pose{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0),
                     random.uniform(-kPi, kPi)};
    set.add({file, pose, set.size() == 1 ? "night" : "day"},
            noise(size, set.size() == 2 ? CV_8UC3 : CV_8UC1, set.size()));
  }
}

TEST(DataSet, whatIsWrittenIsReadBack)
{
  const Folder folder;
  PanoramaLayout cylinder;
  cylinder.projection = PanoramaLayout::Projection::Cylindrical;
  cylinder.columns = PanoramaLayout::Columns::CounterClockwise;
  cylinder.forwardColumn = 0.25;
  DataSet panoramas(cylinder, {64, 16});
  fill(panoramas, {64, 16});
  panoramas.write(folder / "panoramas");
  expectSame(DataSet::read(folder / "panoramas"), panoramas);

  const PanoramaGeometry geometry{96, 20, radians(-30.0), radians(25.0)};
  DataSet mirrors(testCamera(), geometry);
  fill(mirrors, {640, 480});
  mirrors.write(folder / "mirrors");
  const DataSet back = DataSet::read(folder / "mirrors", geometry);
  expectSame(back, mirrors);
  EXPECT_EQ(back.geometry().width, 96);
  EXPECT_EQ(differences(back.visible(), Unwarper(testCamera(), geometry).visible()), 0);
}

TEST(DataSet, lightsKeepTheOrderOfTheTable)
{
  DataSet set(PanoramaLayout{}, {64, 16});
  fill(set, {64, 16});
  EXPECT_THAT(set.lights(), testing::ElementsAre("day", "night"));
  EXPECT_THAT(set.viewsOf("day"), testing::ElementsAre(0U, 2U));
  EXPECT_TRUE(set.viewsOf("dusk").empty());
  EXPECT_THROW(set.add({"z.png", {}, "day"}, noise({64, 16}, CV_8UC1, 1)), LogicError);
  EXPECT_THROW(set.add({"b.png", {}, "day"}, noise({60, 16}, CV_8UC1, 1)), LogicError);
}

/** A folder with two good panoramas, to be spoilt. */
struct BadDataSet : testing::Test
{
  void SetUp() override
  {
    write("poses.csv", std::string(kHeader) + "b.png,1,2,0.5,day\na.png,-1.5,2e-1,-3,day\n");
    write("panorama.yaml", kLayout);
    cv::imwrite(folder / "a.png", noise({64, 16}, CV_8UC1, 1));
    cv::imwrite(folder / "b.png", noise({64, 16}, CV_8UC1, 2));
  }

  void write(const std::string &name, const std::string &text) const
  {
    std::ofstream(folder / name, std::ios::binary) << text;
  }

  /** What reading the folder and every picture complains of, one line; "" when all is well. */
  std::string complaint() const
  {
    try {
      const DataSet set = DataSet::read(folder / "");
      for (std::size_t i = 0; i < set.size(); ++i) {
        set.panorama(i);
      }
    }
    catch (const ConfigError &error) {
      std::string text = error.what();
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      return text;
    }
    return "";
  }

  Folder folder;
};

TEST_F(BadDataSet, unsortedNamesWindowsLineEndsAndBlankLinesAreFine)
{
  EXPECT_EQ(complaint(), "");
  write("poses.csv", "file,x_m,y_m,heading_rad,light\r\nb.png, 1, 2, 0.5, day\r\n\r\n");
  EXPECT_EQ(complaint(), "");
}

TEST_F(BadDataSet, aBadLineIsNamed)
{
  const auto with = [&](const std::string &line) {
    write("poses.csv", std::string(kHeader) + "b.png,1,2,0.5,day\n" + line + "\n");
    return complaint();
  };
  EXPECT_THAT(with("a.png,1,2,day"), AllOf(HasSubstr("poses.csv line 3"), HasSubstr("4 fields")));
  EXPECT_THAT(with("a.png,1,2,0,day,9"), HasSubstr("6 fields"));
  EXPECT_THAT(with("a.png,1,2m,0,day"),
              AllOf(HasSubstr("line 3"), HasSubstr("y_m"), HasSubstr("'2m'")));
  EXPECT_THAT(with("a.png,nan,2,0,day"), HasSubstr("x_m must be a number, not 'nan'"));
  EXPECT_THAT(with("a.png,1,2,,day"), HasSubstr("heading_rad must be a number, not ''"));
  EXPECT_THAT(with("a.png,1,2,1e999,day"), HasSubstr("1e999"));
  EXPECT_THAT(with("a.png,1,2,0,"), HasSubstr("names no light"));
  EXPECT_THAT(with(",1,2,0,day"), HasSubstr("names no file"));
  EXPECT_THAT(with("b.png,1,2,0,day"), HasSubstr("b.png stands in the table already"));
  EXPECT_THAT(with("c.png,1,2,0,day"), AllOf(HasSubstr("poses.csv names c.png"), HasSubstr("not")));
}

TEST_F(BadDataSet, aTableWithoutHeaderOrLinesIsNamed)
{
  write("poses.csv", "b.png,1,2,0.5,day\n");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("line 1"), HasSubstr("file,x_m,y_m")));
  write("poses.csv", kHeader);
  EXPECT_THAT(complaint(), HasSubstr("names no picture"));
  write("poses.csv", "");
  EXPECT_THAT(complaint(), HasSubstr("names no picture"));
  fs::remove(folder / "poses.csv");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("cannot read"), HasSubstr("poses.csv")));
}

TEST_F(BadDataSet, aBrokenPictureIsNamed)
{
  write("a.png", "no picture");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("cannot decode"), HasSubstr("a.png")));
  write("a.png", "");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("cannot decode"), HasSubstr("a.png")));
  std::vector<unsigned char> bytes;
  for (const char *ending : {".png", ".jpg"}) {
    cv::imencode(ending, noise({64, 16}, CV_8UC1, 1), bytes);
    write("a.png", std::string(bytes.begin(), bytes.begin() + std::ssize(bytes) / 2));
    EXPECT_THAT(complaint(), AllOf(HasSubstr("cannot decode"), HasSubstr("a.png"))) << ending;
  }
}

TEST_F(BadDataSet, aPictureOfAnotherSizeIsNamed)
{
  cv::imwrite(folder / "a.png", noise({60, 16}, CV_8UC1, 1));
  EXPECT_THAT(complaint(), AllOf(HasSubstr("a.png has 60 x 16"), HasSubstr("64 x 16")));
  fs::remove(folder / "panorama.yaml");
  write("camera.yaml", formatMirrorCamera(testCamera()));
  EXPECT_THAT(complaint(), AllOf(HasSubstr("b.png has 64 x 16"), HasSubstr("640 x 480")));
}

TEST_F(BadDataSet, oneLayoutFileIsNeededAndItsMistakesAreNamed)
{
  const auto with = [&](const std::string &from, const std::string &to) {
    std::string text = kLayout;
    write("panorama.yaml", text.replace(text.find(from), from.size(), to));
    return complaint();
  };
  EXPECT_THAT(with("equirectangular", "fisheye"),
              AllOf(HasSubstr("panorama.yaml: projection"), HasSubstr("'fisheye'")));
  EXPECT_THAT(with(": clockwise", ": left"), HasSubstr("counterclockwise, not 'left'"));
  EXPECT_THAT(with("31.5", "middle"), HasSubstr("forward_column must be a number, not 'middle'"));
  EXPECT_THAT(with("elevation_max_deg: 40", "elevation_max_deg: -45"), HasSubstr("horizon"));
  EXPECT_THAT(with("forward_column", "front"), HasSubstr("unknown key 'front'"));
  EXPECT_THAT(with("columns: clockwise\n", ""), HasSubstr("columns is missing"));
  EXPECT_THAT(with("projection", "[projection"), HasSubstr("not YAML"));
  write("camera.yaml", formatMirrorCamera(testCamera()));
  EXPECT_THAT(complaint(), HasSubstr("has both"));
  fs::remove(folder / "camera.yaml");
  fs::remove(folder / "panorama.yaml");
  EXPECT_THAT(complaint(), HasSubstr("has neither"));
}

/** A mirror full of stripes in a black mount; the camera has shifted by so many pixels. */
cv::Mat shiftedPicture(const MirrorCamera &camera, const Eigen::Vector2d &shift)
{
  cv::Mat1b picture(camera.model.height(), camera.model.width(), uchar{0});
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const Eigen::Vector2d away = Eigen::Vector2d(u, v) - camera.rim->centre - shift;
      if (away.norm() < camera.rim->radius) {
        picture(v, u) =
            cv::saturate_cast<uchar>(140.0 + 60.0 * std::sin(away.norm() / 4.0) *
                                                 std::cos(5.0 * std::atan2(away.y(), away.x())));
      }
    }
  }
  return picture;
}

TEST(DataSet, FollowsACameraThatHasShiftedSinceItsFileWasWritten)
{
  MirrorCamera camera{UnifiedCamera({0.95, 108, 108, 319.5, 239.5, 0, 0, 0, 0}, 640, 480),
                      {30.0, 220.0},
                      {},
                      MirrorRim{{319.5, 239.5}, 220.0}};
  const Folder folder;
  DataSet straight(camera);
  straight.add({"a.png", {}, "day"}, shiftedPicture(camera, {0.0, 0.0}));
  straight.write(folder / "straight");
  DataSet shifted(camera);
  shifted.add({"a.png", {}, "day"}, shiftedPicture(camera, {3.0, -2.0}));
  shifted.write(folder / "shifted");
  const cv::Mat before = DataSet::read(folder / "straight").panorama(0).image;
  const auto apart = [&](const cv::Mat &picture) {
    return cv::norm(before, picture, cv::NORM_L1) / static_cast<double>(before.total());
  };
  EXPECT_GT(apart(shifted.panorama(0).image), 10.0); // gray levels
  EXPECT_LT(apart(DataSet::read(folder / "shifted").panorama(0).image), 2.0);
  shifted.followRim();
  EXPECT_LT(apart(shifted.panorama(0).image), 2.0);
}

} // namespace
} // namespace homeward
