// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/place/histogram.h>
#include <homeward/place/signature.h>

#include <gmock/gmock.h>

#include <array>
#include <numeric>
#include <string>

namespace homeward
{
namespace
{

constexpr std::array<float, 6> kReference{6, 26, 37, 26, 3, 2};
constexpr std::array<float, 6> kSimilar{3, 25, 38, 25, 8, 1};
constexpr std::array<float, 6> kDifferent{34, 36, 4, 14, 10, 2};

TEST(Histogram, distancesOfThePublishedExample)
{
  // Table 3.1 of the thesis behind the method, four digits; the logarithm there is decimal.
  EXPECT_NEAR(jeffreyDivergence(kReference, kSimilar), 0.8187, 6e-5);
  EXPECT_NEAR(jeffreyDivergence(kReference, kDifferent), 13.3570, 6e-5);
  EXPECT_NEAR(chiSquare(kReference, kSimilar), 1.8293, 6e-5);
  EXPECT_NEAR(chiSquare(kReference, kDifferent), 27.5716, 6e-5);
  EXPECT_DOUBLE_EQ(sumOfAbsoluteDifferences(kReference, kSimilar), 12.0);
  EXPECT_DOUBLE_EQ(sumOfAbsoluteDifferences(kReference, kDifferent), 90.0);
}

TEST(Histogram, emptyBinsAddNothing)
{
  const std::array<float, 3> a{0, 10, 0};
  const std::array<float, 3> b{0, 0, 10};
  EXPECT_NEAR(jeffreyDivergence(a, b), 20.0 * std::log10(2.0), 1e-12);
  EXPECT_DOUBLE_EQ(chiSquare(a, b), 10.0);
  EXPECT_DOUBLE_EQ(chiSquare(a, a), 0.0);
}

TEST(Histogram, cosineOfNothing)
{
  const std::array<float, 2> zero{0, 0};
  const std::array<float, 2> one{0, 3};
  EXPECT_DOUBLE_EQ(cosineDistance(zero, zero), 0.0);
  EXPECT_DOUBLE_EQ(cosineDistance(zero, one), 1.0);
}

TEST(Histogram, differentNumbersOfBinsAreRefused)
{
  const std::array<float, 5> five{};
  EXPECT_THROW(jeffreyDivergence(kReference, five), LogicError);
  EXPECT_THROW(chiSquare(kReference, five), LogicError);
  EXPECT_THROW(sumOfAbsoluteDifferences(kReference, five), LogicError);
}

class SignatureLaw : public testing::TestWithParam<SignatureKind>
{
protected:
  Signature sign(const Pose2 &pose, const RoomLight &light = {}) const
  {
    return makeSignature(m_room.view(pose, light, {.width = 360, .height = 80}), GetParam());
  }

private:
  SyntheticRoom m_room{41, 6.0, 5.0};
};

TEST_P(SignatureLaw, zeroOnItself)
{
  const Signature here = sign({0.3, 0.2, 1.0});
  EXPECT_NEAR(dissimilarity(here, here), 0.0, 1e-9);
}

TEST_P(SignatureLaw, symmetric)
{
  const Signature a = sign({0.3, 0.2, 1.0});
  const Signature b = sign({-0.8, 0.9, 2.0});
  EXPECT_GT(dissimilarity(a, b), 0.0);
  EXPECT_DOUBLE_EQ(dissimilarity(a, b), dissimilarity(b, a));
}

TEST_P(SignatureLaw, turnedByWholeColumnsItIsTheSame)
{
  const Signature straight = sign({0.3, 0.2, 0.0});
  const double elsewhere = dissimilarity(straight, sign({0.6, 0.2, 0.0}));
  for (const int columns : {1, 77, 180}) {
    const Signature turned = sign({0.3, 0.2, columns * radians(1.0)});
    EXPECT_LT(dissimilarity(straight, turned), 0.02 * elsewhere) << columns << " columns";
  }
}

TEST_P(SignatureLaw, growsWithTheDistance)
{
  const Signature home = sign({0.0, 0.0, 0.0});
  const double near = dissimilarity(home, sign({0.2, 0.1, 0.5}));
  const double far = dissimilarity(home, sign({1.6, 1.2, 0.5}));
  EXPECT_LT(1.2 * near, far);
}

TEST_P(SignatureLaw, namesReadBack)
{
  EXPECT_EQ(parseSignatureKind(name(GetParam())), GetParam());
}

TEST_P(SignatureLaw, aBlackPictureComparesFinitely)
{
  const PanoramaGeometry geometry{.width = 360, .height = 80};
  const Panorama black{cv::Mat::zeros(geometry.height, geometry.width, CV_8UC1), geometry};
  const Signature nothing = makeSignature(black, GetParam());
  EXPECT_DOUBLE_EQ(dissimilarity(nothing, nothing), 0.0);
  EXPECT_TRUE(std::isfinite(dissimilarity(nothing, sign({}))));
}

TEST_P(SignatureLaw, otherSizesAreRefused)
{
  const SyntheticRoom room(41, 6.0, 5.0);
  const Signature large = makeSignature(room.view({}), GetParam());
  EXPECT_THROW(dissimilarity(large, sign({})), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SignatureLaw,
                         testing::Values(SignatureKind::Jeffrey, SignatureKind::ChiSquare,
                                         SignatureKind::AbsoluteDifferences, SignatureKind::Fourier,
                                         SignatureKind::EdgeFourier),
                         [](const auto &instance) { return std::string(name(instance.param)); });

TEST(Signature, edgesSurviveALightChangeThatHistogramsDoNot)
{
  const SyntheticRoom room(41, 6.0, 5.0);
  const auto compare = [&](SignatureKind kind, const Pose2 &pose, const RoomLight &light) {
    return dissimilarity(makeSignature(room.view({}), kind),
                         makeSignature(room.view(pose, light), kind));
  };
  const RoomLight dusk{.gain = 0.4, .slope = 0.4};
  const Pose2 far{1.6, 1.2, 1.0};
  EXPECT_LT(compare(SignatureKind::EdgeFourier, {}, dusk),
            compare(SignatureKind::EdgeFourier, far, {}));
  EXPECT_GT(compare(SignatureKind::Jeffrey, {}, dusk), compare(SignatureKind::Jeffrey, far, {}));
}

TEST(Signature, histogramCountsEveryVisiblePixel)
{
  const PanoramaGeometry geometry{.width = 8, .height = 4};
  Panorama panorama{cv::Mat(4, 8, CV_8UC1, cv::Scalar(7)), geometry};
  panorama.image.row(3).setTo(200);
  const Signature all = makeSignature(panorama, SignatureKind::Jeffrey);
  EXPECT_EQ(all.pixels, 32);
  EXPECT_EQ(all.values[7], 24.0F);
  EXPECT_EQ(all.values[200], 8.0F);
  EXPECT_EQ(std::accumulate(all.values.begin(), all.values.end(), 0.0F), 32.0F);

  cv::Mat visible(4, 8, CV_8UC1, cv::Scalar(255));
  visible.at<std::uint8_t>(3, 5) = 0;
  const Signature seen = makeSignature(panorama, SignatureKind::Jeffrey, visible);
  EXPECT_EQ(seen.pixels, 24);
  EXPECT_EQ(seen.values[200], 0.0F);
  EXPECT_THROW(makeSignature(panorama, SignatureKind::Jeffrey, cv::Mat::zeros(4, 8, CV_8UC1)),
               LogicError);
  EXPECT_THROW(makeSignature(panorama, SignatureKind::Jeffrey, cv::Mat::zeros(2, 8, CV_8UC1)),
               LogicError);
}

TEST(Signature, colourIsComparedInGray)
{
  const Panorama gray = SyntheticRoom(41, 6.0, 5.0).view({});
  Panorama colour = gray;
  cv::cvtColor(gray.image, colour.image, cv::COLOR_GRAY2BGR);
  EXPECT_DOUBLE_EQ(dissimilarity(makeSignature(gray, SignatureKind::Jeffrey),
                                 makeSignature(colour, SignatureKind::Jeffrey)),
                   0.0);
}

TEST(Signature, publishedThresholdsPerPixel)
{
  EXPECT_DOUBLE_EQ(thresholdPerPixel(500.0), 0.025);
}

TEST(Signature, unknownNameListsTheKnown)
{
  EXPECT_THAT([] { parseSignatureKind("gist"); },
              testing::ThrowsMessage<ConfigError>(
                  testing::AllOf(testing::HasSubstr("gist"), testing::HasSubstr("edge_fourier"))));
}

} // namespace
} // namespace homeward
