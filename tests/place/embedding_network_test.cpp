// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.h"
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/place/embedding_network.h>
#include <homeward/place/place_index.h>

#include <gmock/gmock.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace homeward
{
namespace
{

using testing::HasSubstr;

/** A field of a protocol buffer: of a length, or a number. */
std::string field(int number, const std::string &bytes)
{
  return std::string{static_cast<char>(number << 3 | 2), static_cast<char>(bytes.size())} + bytes;
}
std::string field(int number, char value)
{
  return {static_cast<char>(number << 3), value};
}

/** A value of an ONNX graph, 1 x 3 x 8 x 16 or so. */
std::string tensor(const std::string &name, const std::string &sizes)
{
  std::string shape;
  for (const char size : sizes) {
    shape += field(1, field(1, size));
  }
  const std::string type = field(1, field(1, char{1}) + field(2, shape));
  return field(1, name) + field(2, type);
}

/** An ONNX file of one operation that takes 8 x 8 pixels: the mean of each colour. */
std::string meanColourNetwork()
{
  const std::string node = field(1, std::string("x")) + field(2, std::string("y")) +
                           field(3, std::string("mean")) +
                           field(4, std::string("GlobalAveragePool"));
  const std::string graph = field(1, node) + field(2, std::string("g")) +
                            field(11, tensor("x", {1, 3, 8, 8})) +
                            field(12, tensor("y", {1, 3, 1, 1}));
  return field(1, char{7}) + field(7, graph) + field(8, field(2, char{11}));
}

struct Embedding : testing::Test
{
  std::string write(const std::string &name, const std::string &bytes) const
  {
    std::string file = folder / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  Folder folder;
  EmbeddingOptions small{{8, 8}, 1.0 / 255.0, {}, 4};
};

TEST_F(Embedding, runsANetworkFromAFile)
{
  const EmbeddingNetwork network(write("mean.onnx", meanColourNetwork()), small);
  Panorama panorama{cv::Mat(32, 64, CV_8UC3, cv::Scalar(51, 102, 204)),
                    {.width = 64, .height = 32}};
  const Signature signature = network.compute(panorama);
  EXPECT_EQ(signature.kind, SignatureKind::Embedding);
  ASSERT_EQ(signature.values.size(), 3U);
  EXPECT_NEAR(signature.values[0], 4 * 0.8, 1e-3) << "red comes first";
  EXPECT_NEAR(signature.values[2], 4 * 0.2, 1e-3);
}

TEST_F(Embedding, staysWhenTheRobotTurnsAndCanBeSearched)
{
  const EmbeddingNetwork network(write("mean.onnx", meanColourNetwork()), small);
  const SyntheticRoom room(41, 6.0, 5.0);
  PlaceIndex index(SignatureKind::Embedding);
  std::vector<Signature> seen;
  for (int i = 0; i < 3; ++i) {
    const auto view = [&](double heading) {
      return network.compute(
          room.view({-1.0 + 0.9 * i, 0.2, heading}, {}, {.width = 360, .height = 80}));
    };
    index.add(NodeId{i}, view(0.0));
    seen.push_back(view(kPi / 2.0));
    EXPECT_NEAR(dissimilarity(view(0.0), seen.back()), 0.0, 1e-5);
  }
  EXPECT_EQ(index.nearest(seen, 1).size(), 3U);
}

TEST_F(Embedding, refusesWhatIsNoNetwork)
{
  const auto reason = [](const auto &call) -> std::string {
    try {
      call();
    }
    catch (const ConfigError &error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(reason([&] { EmbeddingNetwork(folder / "none.onnx", small); }),
              HasSubstr("there is no network file"));
  const std::string text = write("text.onnx", "this is no network\n");
  EXPECT_THAT(reason([&] { EmbeddingNetwork(text, small); }), HasSubstr("text.onnx"));
  const std::string half = write("half.onnx", meanColourNetwork().substr(0, 40));
  EXPECT_THAT(reason([&] { EmbeddingNetwork(half, small); }), HasSubstr("half.onnx"));
  EXPECT_THROW(makeSignature({cv::Mat(32, 64, CV_8UC1, cv::Scalar(1)), {.width = 64, .height = 32}},
                             SignatureKind::Embedding),
               LogicError);
  EXPECT_THROW(parseSignatureKind("embedding"), ConfigError);
}

} // namespace
} // namespace homeward
