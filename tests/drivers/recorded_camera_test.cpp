// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/recorded_camera.h>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <unistd.h>

namespace homeward
{
namespace
{

/** A folder of its own for each test, gone afterwards. */
class RecordedCamera : public testing::Test
{
protected:
  RecordedCamera()
      : m_folder(std::filesystem::temp_directory_path() /
                 ("homeward_camera_" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(m_folder);
  }
  ~RecordedCamera() override { std::filesystem::remove_all(m_folder); }

  std::string file(const std::string &name) const { return (m_folder / name).string(); }

private:
  std::filesystem::path m_folder;
};

TEST_F(RecordedCamera, PicturesComeInOrderWithTheirColours)
{
  for (int i = 7; i < 10; ++i) {
    cv::imwrite(file("view_000" + std::to_string(i) + ".png"),
                cv::Mat(4, 6, CV_8UC3, cv::Scalar(10 * i, 20, 200)));
  }
  FolderCamera camera(file("view_%04d.png"), 7);
  Time last{};
  for (int i = 7; i < 10; ++i) {
    const std::optional<Frame> frame = camera.grab();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->image.type(), CV_8UC3);
    EXPECT_EQ(frame->image.size(), cv::Size(6, 4));
    EXPECT_EQ(frame->image.at<cv::Vec3b>(2, 3), cv::Vec3b(static_cast<uchar>(10 * i), 20, 200));
    EXPECT_GT(frame->stamp, last);
    last = frame->stamp;
  }
  EXPECT_FALSE(camera.grab());
  EXPECT_FALSE(camera.grab());
}

TEST_F(RecordedCamera, AFrameStaysWhenTheNextIsGrabbed)
{
  for (int i = 0; i < 2; ++i) {
    cv::imwrite(file(std::to_string(i) + ".png"), cv::Mat(4, 6, CV_8UC3, cv::Scalar::all(i)));
  }
  FolderCamera camera(file("%d.png"), 0);
  const Frame first = camera.grab().value();
  camera.grab();
  EXPECT_EQ(first.image.at<cv::Vec3b>(0, 0)[0], 0);
}

TEST_F(RecordedCamera, WrongPicturesAreRefused)
{
  EXPECT_THROW(FolderCamera(file("%04d.png"), 0), ConfigError);
  for (const char *wrong : {"view.png", "%s.png", "%d%d.png", "%4.2f.png", "%", "%123d.png"}) {
    EXPECT_THROW(FolderCamera(file(wrong), 0), ConfigError) << wrong;
  }
  std::ofstream(file("0.png")) << "no picture";
  FolderCamera camera(file("%d.png"), 0);
  EXPECT_THROW(camera.grab(), DeviceError);
}

TEST_F(RecordedCamera, AFilmGivesEveryFrameOnce)
{
  const std::string film = file("film.avi");
  {
    cv::VideoWriter writer(film, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0, {64, 48});
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < 5; ++i) {
      writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(20 + 40 * i)));
    }
  }
  VideoCamera camera(film);
  for (int i = 0; i < 5; ++i) {
    const std::optional<Frame> frame = camera.grab();
    ASSERT_TRUE(frame) << i;
    EXPECT_NEAR(frame->image.at<cv::Vec3b>(20, 20)[1], 20 + 40 * i, 3);
  }
  EXPECT_FALSE(camera.grab());
  EXPECT_THROW(VideoCamera(file("none.avi")), ConfigError);
  EXPECT_THROW(VideoCamera(file("film.txt")), ConfigError);
}

} // namespace
} // namespace homeward
