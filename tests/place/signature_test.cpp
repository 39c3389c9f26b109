// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/place/histogram.h>
#include <homeward/place/signature.h>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

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

TEST(Histogram, hellingerByHand)
{
  const std::array<float, 2> a{9, 7};
  const std::array<float, 2> b{1, 0};
  EXPECT_NEAR(hellingerDistance(a, b), std::sqrt(1.0 - 0.75), 1e-12);
  const std::array<float, 2> thrice{27, 21};
  EXPECT_NEAR(hellingerDistance(a, thrice), 0.0, 1e-12) << "counts are taken as shares";
  const std::array<float, 2> zero{0, 0};
  EXPECT_DOUBLE_EQ(hellingerDistance(zero, zero), 0.0);
  EXPECT_DOUBLE_EQ(hellingerDistance(zero, a), 1.0);
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
  EXPECT_THROW(hellingerDistance(kReference, five), LogicError);
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

/** Coloured cloud; neighbouring pixels are alike, as in any picture. */
Panorama cloud(unsigned seed, const PanoramaGeometry &geometry)
{
  cv::Mat coarse(geometry.height / 8, geometry.width / 8, CV_8UC3);
  cv::RNG(seed).fill(coarse, cv::RNG::UNIFORM, 0, 256);
  Panorama panorama{cv::Mat(), geometry};
  cv::resize(coarse, panorama.image, {geometry.width, geometry.height}, 0, 0, cv::INTER_LINEAR);
  return panorama;
}

TEST_P(SignatureLaw, rolledColumnsChangeNothing)
{
  // The second width has no half, the third has fewer frequencies than signatures take.
  for (const int width : {360, 361, 40}) {
    const PanoramaGeometry geometry{.width = width, .height = 80};
    const Panorama straight = cloud(5, geometry);
    Panorama turned = straight;
    cv::hconcat(straight.image.colRange(17, width), straight.image.colRange(0, 17), turned.image);
    const Signature here = makeSignature(straight, GetParam());
    const double elsewhere = dissimilarity(here, makeSignature(cloud(6, geometry), GetParam()));
    EXPECT_GT(elsewhere, 0.0);
    EXPECT_LT(dissimilarity(here, makeSignature(turned, GetParam())), 1e-3 * elsewhere) << width;
  }
}

TEST_P(SignatureLaw, statesItsSizeAndWhatItIsMadeOf)
{
  const Signature here = sign({});
  const SignatureTraits &kind = traits(GetParam());
  EXPECT_EQ(kind.kind, GetParam());
  EXPECT_EQ(byteSize(here), here.values.size() * (kind.bytes ? 1 : 4));
  EXPECT_FALSE(kind.invariances.empty());
  if (kind.distance != SignatureDistance::TurnCorrelation) {
    EXPECT_THAT(here.values, testing::Each(testing::Ge(0.0F)));
  }
  if (kind.bytes) {
    EXPECT_THAT(here.values, testing::Each(testing::AllOf(
                                 testing::Le(255.0F),
                                 testing::ResultOf([](float v) { return v - std::floor(v); },
                                                   testing::Eq(0.0F)))));
  }
  if (!kind.perPixel) {
    EXPECT_LE(dissimilarity(here, sign({1.6, 1.2, 0.5})), 1.0);
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

std::vector<SignatureKind> allKinds()
{
  std::vector<SignatureKind> kinds;
  for (const SignatureTraits &kind : signatureKinds()) {
    kinds.push_back(kind.kind);
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Kinds, SignatureLaw, testing::ValuesIn(allKinds()),
                         [](const auto &instance) { return std::string(name(instance.param)); });

TEST(Signature, spectrumIsTheDiscreteFourierTransform)
{
  const PanoramaGeometry geometry{.width = 75, .height = 2};
  Panorama panorama{cv::Mat(2, 75, CV_8UC1), geometry};
  cv::RNG(3).fill(panorama.image, cv::RNG::UNIFORM, 0, 256);
  const Signature signature = makeSignature(panorama, SignatureKind::Fourier);
  ASSERT_EQ(signature.values.size(), 60U);
  cv::Mat rows;
  panorama.image.convertTo(rows, CV_32F);
  cv::dft(rows, rows, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
  for (int f = 0; f < 30; ++f) {
    const auto expected = rows.at<cv::Vec2f>(1, f);
    EXPECT_NEAR(signature.values[30 + static_cast<std::size_t>(f)],
                std::hypot(expected[0], expected[1]), 0.02);
  }
}

TEST(Signature, coloursTellApartWhatIsEquallyBright)
{
  const PanoramaGeometry geometry{.width = 8, .height = 4};
  const auto sign = [&](const cv::Scalar &colour, SignatureKind kind) {
    return makeSignature({cv::Mat(4, 8, CV_8UC3, colour), geometry}, kind);
  };
  const cv::Scalar red(0, 0, 200);
  const cv::Scalar green(0, 102, 0); // as bright in gray
  EXPECT_DOUBLE_EQ(
      dissimilarity(sign(red, SignatureKind::Jeffrey), sign(green, SignatureKind::Jeffrey)), 0.0);
  for (const SignatureKind kind : {SignatureKind::Hsv, SignatureKind::Opponent}) {
    EXPECT_DOUBLE_EQ(dissimilarity(sign(red, kind), sign(green, kind)), 1.0) << name(kind);
  }
}

TEST(Signature, bandsTellApartWhatHasTheSameHistogram)
{
  const PanoramaGeometry geometry{.width = 8, .height = 16};
  Panorama bright{cv::Mat(16, 8, CV_8UC1, cv::Scalar(20)), geometry};
  bright.image.rowRange(0, 8).setTo(220);
  Panorama turned{cv::Mat(), geometry};
  cv::flip(bright.image, turned.image, 0);
  const auto compare = [&](SignatureKind kind) {
    return dissimilarity(makeSignature(bright, kind), makeSignature(turned, kind));
  };
  EXPECT_DOUBLE_EQ(compare(SignatureKind::AbsoluteDifferences), 0.0);
  EXPECT_DOUBLE_EQ(compare(SignatureKind::Bands), 2.0);
}

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
  EXPECT_LT(compare(SignatureKind::AlignedEdges, {}, dusk),
            compare(SignatureKind::AlignedEdges, far, {}));
  EXPECT_LT(compare(SignatureKind::EdgeBytes, {}, dusk),
            compare(SignatureKind::EdgeBytes, far, {}));
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
