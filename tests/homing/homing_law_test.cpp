// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that every homing method keeps, in a room whose geometry is known exactly.
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/homing/homing_method.h>
#include <homeward/homing/scale_space_homing.h>

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

namespace homeward
{
namespace
{

struct MethodCase
{
  std::string name;
  double meanError;   ///< of the direction, degrees
  double turnError;   ///< mean of the heading change, degrees
  double turnedShift; ///< largest change of the direction beyond the robot's own turn, degrees
  double farthest;    ///< of the places it is tried from, metres: a compass holds near home only
};

class HomingLaw : public testing::TestWithParam<MethodCase>
{
protected:
  std::unique_ptr<HomingMethod> m_method = makeHomingMethod(GetParam().name);

  /** A small picture: SIFT is slow. */
  Panorama view(const Pose2 &pose) const
  {
    return m_room.view(pose, {}, {.width = 480, .height = 107});
  }

private:
  SyntheticRoom m_room{11, 6.0, 5.0};
};

double error(double angle, double truth)
{
  return degrees(std::abs(wrapAngle(angle - truth)));
}

TEST_P(HomingLaw, pointsHomeAndTellsTheTurn)
{
  Random random(3, 0);
  double direction = 0.0;
  double turn = 0.0;
  constexpr int kPairs = 10;
  for (int i = 0; i < kPairs; ++i) {
    const Pose2 home{random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5),
                     random.uniform(-kPi, kPi)};
    const double distance = 0.3 + (GetParam().farthest - 0.3) * i / (kPairs - 1);
    const double away = random.uniform(-kPi, kPi);
    const Pose2 current{home.x + distance * std::cos(away), home.y + distance * std::sin(away),
                        random.uniform(-kPi, kPi)};
    const std::optional<HomeVector> found = m_method->compute(view(current), view(home));
    ASSERT_TRUE(found);
    direction += error(found->direction, trueDirection(current, home)) / kPairs;
    turn += error(found->headingChange, current.heading - home.heading) / kPairs;
    EXPECT_GT(found->distanceProxy, 0.0);
    EXPECT_GT(found->confidence, 0.0);
    EXPECT_LE(found->confidence, 1.0);
  }
  EXPECT_LT(direction, GetParam().meanError);
  EXPECT_LT(turn, GetParam().turnError);
}

TEST_P(HomingLaw, robotTurnedLeftBy90ReadsPlus90)
{
  const std::optional<HomeVector> found =
      m_method->compute(view({0.4, 0.3, kPi / 2.0}), view({0.3, 0.3, 0.0}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(degrees(found->headingChange), 90.0, 3.0);
}

TEST_P(HomingLaw, turningTheRobotTurnsTheDirectionBack)
{
  const Panorama home = view({-0.4, 0.2, 0.3});
  const std::optional<HomeVector> straight = m_method->compute(view({0.5, -0.2, 0.0}), home);
  ASSERT_TRUE(straight);
  for (const double turn : {radians(25.0), radians(-110.0), radians(180.0)}) {
    const std::optional<HomeVector> turned = m_method->compute(view({0.5, -0.2, turn}), home);
    ASSERT_TRUE(turned);
    EXPECT_LT(error(turned->direction, straight->direction - turn), GetParam().turnedShift);
    EXPECT_LT(error(turned->headingChange, straight->headingChange + turn), GetParam().turnedShift);
  }
}

TEST_P(HomingLaw, proxyGrowsWithTheDistance)
{
  double before = 0.0;
  for (const double share : {0.1, 0.25, 0.5, 0.9}) {
    const double distance = share * GetParam().farthest;
    double mean = 0.0;
    for (const double away : {0.4, 1.9, 3.4, 5.2}) {
      const std::optional<HomeVector> found =
          m_method->compute(view({distance * std::cos(away), distance * std::sin(away), 1.0}),
                            view({0.0, 0.0, -0.5}));
      ASSERT_TRUE(found);
      mean += found->distanceProxy / 4.0;
    }
    EXPECT_GT(mean, 1.25 * before) << "at " << distance << " m";
    before = mean;
  }
}

TEST_P(HomingLaw, picturesWithoutContentGiveNoAnswer)
{
  const Panorama home = view({});
  for (const double level : {0.0, 90.0, 255.0}) {
    const Panorama empty{cv::Mat(home.image.size(), CV_8UC1, cv::Scalar(level)), home.geometry};
    EXPECT_FALSE(m_method->compute(empty, home));
    EXPECT_FALSE(m_method->compute(home, empty));
    EXPECT_FALSE(m_method->compute(empty, empty));
  }
}

/** Damage that a camera does to what it sees. */
std::vector<Panorama> damaged(const Panorama &seen)
{
  std::vector<Panorama> pictures(4, seen);
  pictures[0].image = seen.image * 4.0; // over-exposed: most of it is white
  pictures[1].image = seen.image.clone();
  pictures[1].image.colRange(0, seen.image.cols / 2).setTo(0); // half covered
  pictures[2].image = seen.image / 40;                         // nearly black
  pictures[3].image = cv::Mat(seen.image.size(), CV_8UC1);     // nothing but noise
  cv::RNG noise(5);
  noise.fill(pictures[3].image, cv::RNG::UNIFORM, 0, 256);
  return pictures;
}

TEST_P(HomingLaw, damagedPicturesNeverGiveNonsense)
{
  const Panorama home = view({});
  const std::vector<Panorama> pictures = damaged(view({0.5, 0.3, 1.0}));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    for (const bool swapped : {false, true}) {
      const std::optional<HomeVector> found =
          swapped ? m_method->compute(home, pictures[i]) : m_method->compute(pictures[i], home);
      if (!found) {
        continue;
      }
      EXPECT_LE(std::abs(found->direction), kPi) << i;
      EXPECT_LE(std::abs(found->headingChange), kPi) << i;
      EXPECT_GT(found->distanceProxy, 0.0) << i;
      EXPECT_LT(found->distanceProxy, 100.0) << i;
      EXPECT_GE(found->confidence, 0.0) << i;
      EXPECT_LE(found->confidence, i == 3 ? 0.4 : 1.0) << i;
    }
  }
}

TEST_P(HomingLaw, panoramasOfOtherSizesCompare)
{
  const SyntheticRoom room{11, 6.0, 5.0};
  const Pose2 here{0.4, 0.3, 0.5};
  const std::optional<HomeVector> found =
      m_method->compute(room.view(here, {}, {.width = 600, .height = 140}), view({0.1, 0.1, 0.3}));
  ASSERT_TRUE(found);
  EXPECT_LT(error(found->headingChange, 0.2), 3.0 + GetParam().turnError);
}

TEST_P(HomingLaw, samePictureIsHome)
{
  const Panorama home = view({0.7, -0.4, 2.0});
  const std::optional<HomeVector> found = m_method->compute(home, home);
  ASSERT_TRUE(found);
  EXPECT_LT(found->distanceProxy, 0.02);
  EXPECT_NEAR(found->headingChange, 0.0, 1e-3);
}

TEST_P(HomingLaw, colourAndGrayAgree)
{
  const Panorama home = view({});
  const Panorama current = view({0.5, 0.3, 1.0});
  Panorama colour = current;
  cv::cvtColor(current.image, colour.image, cv::COLOR_GRAY2BGR);
  const std::optional<HomeVector> gray = m_method->compute(current, home);
  const std::optional<HomeVector> same = m_method->compute(colour, home);
  ASSERT_TRUE(gray && same);
  EXPECT_DOUBLE_EQ(same->direction, gray->direction);
}

TEST_P(HomingLaw, pictureUnlikeItsGeometryIsRefused)
{
  Panorama home = view({});
  Panorama wrong = home;
  wrong.geometry.width = 360;
  EXPECT_THROW(m_method->compute(wrong, home), LogicError);
  wrong = home;
  wrong.image.convertTo(wrong.image, CV_32F);
  EXPECT_THROW(m_method->compute(home, wrong), LogicError);
  EXPECT_THROW(m_method->compute(Panorama{}, home), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Methods, HomingLaw,
                         testing::Values(MethodCase{"minwarping", 4.0, 2.0, 4.0, 1.6},
                                         MethodCase{"hiss", 20.0, 6.0, 15.0, 1.6},
                                         MethodCase{"bearing", 1.0, 0.5, 2.0, 1.6},
                                         MethodCase{"alv", 40.0, 10.0, 15.0, 0.6},
                                         MethodCase{"did", 20.0, 10.0, 15.0, 0.6},
                                         MethodCase{"combined", 4.0, 2.0, 4.0, 1.6}),
                         [](const auto &instance) { return instance.param.name; });

TEST(HomingMethods, everyNameMakesAMethod)
{
  for (const std::string &name : homingMethodNames()) {
    EXPECT_TRUE(makeHomingMethod(name)) << name;
  }
}

TEST(HomingMethods, unknownNameListsTheKnown)
{
  EXPECT_THAT([] { makeHomingMethod("average landmark"); },
              testing::ThrowsMessage<ConfigError>(testing::AllOf(
                  testing::HasSubstr("average landmark"), testing::HasSubstr("minwarping"),
                  testing::HasSubstr("combined"))));
}

TEST(ScaleSpaceHoming, refusesBadOptions)
{
  EXPECT_THROW(ScaleSpaceHoming({.matchRatio = 1.0}), LogicError);
  EXPECT_THROW(ScaleSpaceHoming({.contrastThreshold = 0.0}), LogicError);
}

} // namespace
} // namespace homeward
