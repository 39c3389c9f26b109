// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/core/error.h>
#include <homeward/store/content_hash.h>
#include <homeward/store/export.h>
#include <homeward/store/node_views.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using MapFileTest = StoreTest;

TEST_F(MapFileTest, ReadsBackAllThatWasWritten)
{
  auto written = MapFile::create(path(), smallHeader());
  fill(written);
  const TopologicalMap map = written.map();
  written.close();

  const auto read = MapFile::open(path());
  EXPECT_EQ(read.header(), smallHeader());
  EXPECT_EQ(read.map(), map);
  EXPECT_EQ(read.map().nodes().size(), 3U);
  EXPECT_EQ(read.map().edges().size(), 2U);
  EXPECT_EQ(read.map().node({1}).directions[1].reason, "blocked");
  EXPECT_THAT(read.log(),
              ElementsAre(LogLine{0.0, "node 0"}, LogLine{1.0, "node 1"}, LogLine{2.0, "node 2"}));
  EXPECT_EQ(read.value("at_node"), "2");
  EXPECT_EQ(read.value("elsewhere"), std::nullopt);
}

TEST_F(MapFileTest, KeepsDoublesToTheLastBit)
{
  MapHeader header = smallHeader();
  header.panorama.elevationMin = -0.1 - 0.2;
  header.thresholds["third"] = 1.0 / 3.0;
  {
    auto file = MapFile::create(path(), header);
    file.append({.changes = {NodeAdded{{{0}, {{{0}, 1e-17, 2.0 / 3.0}}}}}});
  }
  const auto read = MapFile::open(path(), MapFile::Access::Read);
  EXPECT_EQ(read.header(), header);
  EXPECT_EQ(read.map().node({0}).directions[0].bearing, 1e-17);
  EXPECT_EQ(read.map().node({0}).directions[0].width, 2.0 / 3.0);
}

TEST_F(MapFileTest, GoesOnWhereItStopped)
{
  MapFile::create(path(), smallHeader()).append(nodeUpdate(0));
  MapFile::open(path()).append(nodeUpdate(1));
  MapFile::open(path()).append({.log = {{9.0, "only talk"}}, .values = {{"at_node", "1"}}});
  const auto read = MapFile::open(path());
  EXPECT_EQ(read.map().nodes().size(), 2U);
  EXPECT_EQ(read.log().back(), (LogLine{9.0, "only talk"}));
  EXPECT_EQ(read.value("at_node"), "1");
}

TEST_F(MapFileTest, HasNoNameBeforeItsFirstPlace)
{
  {
    auto file = MapFile::create(path(), smallHeader());
    EXPECT_THAT(files(), AllOf(Contains("test.hwm.part"), Not(Contains("test.hwm"))));
    file.append({.log = {{0.0, "looking round"}}});
    EXPECT_THAT(files(), AllOf(Contains("test.hwm.part"), Not(Contains("test.hwm"))));
  }
  EXPECT_THAT(files(), IsEmpty());

  auto file = MapFile::create(path(), smallHeader());
  file.append(nodeUpdate(0));
  EXPECT_THAT(files(), ElementsAre("test.hwm", "test.hwm-shm", "test.hwm-wal"));
}

TEST_F(MapFileTest, IsOnePlainFileWhenClosed)
{
  auto file = MapFile::create(path(), smallHeader());
  fill(file);
  file.close();
  EXPECT_THAT(files(), ElementsAre("test.hwm"));
  EXPECT_THROW(file.append(nodeUpdate(3)), LogicError);
  EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).map().nodes().size(), 3U);
  EXPECT_THAT(files(), ElementsAre("test.hwm"));
}

TEST_F(MapFileTest, ReplacesAnOlderMapOnlyWhenToldAndOnlyWithAPlace)
{
  MapFile::create(path(), smallHeader()).append(nodeUpdate(0));
  EXPECT_THROW(MapFile::create(path(), smallHeader()), StoreError);

  MapHeader other = smallHeader();
  other.cameraHash = "other";
  auto file = MapFile::create(path(), other, MapFile::IfExists::Replace);
  EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).header(), smallHeader());
  file.append(nodeUpdate(0));
  EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).header(), other);
}

TEST_F(MapFileTest, RefusesAnUpdateThatBreaksARuleAsAWhole)
{
  auto file = MapFile::create(path(), smallHeader());
  fill(file);
  const std::string before = exportCanonical(file);

  MapUpdate broken = nodeUpdate(3);
  broken.changes.push_back(EdgeAdded{{{7}, {3}, {0}}});
  EXPECT_THROW(file.append(broken), LogicError);
  MapUpdate noticedLate = nodeUpdate(3);
  noticedLate.view->node = {0}; // after the node was written
  EXPECT_THROW(file.append(noticedLate), LogicError);
  EXPECT_THROW(file.append({.view = NewView{{0}, encodeView(smallPanorama(5))}}), LogicError);
  EXPECT_THROW(file.append({.view = NewView{{9}, encodeView(smallPanorama(5))}}), LogicError);
  EXPECT_THROW(file.append({.log = {{std::nan(""), "when?"}}}), LogicError);

  EXPECT_EQ(exportCanonical(file), before);
  EXPECT_EQ(exportCanonical(MapFile::open(path(), MapFile::Access::Read)), before);
  file.append(nodeUpdate(3));
  EXPECT_EQ(file.map().nodes().size(), 4U);
}

TEST_F(MapFileTest, RefusesAViewThatDoesNotFitTheHeader)
{
  auto file = MapFile::create(path(), smallHeader());
  MapUpdate update = nodeUpdate(0);
  update.view->bytes = {1, 2, 3};
  EXPECT_THROW(file.append(update), RuntimeError);
  update.view->bytes = encodeView({cv::Mat(8, 16, CV_8UC1, cv::Scalar(9)), {16, 8, -0.75, 0.5}});
  EXPECT_THROW(file.append(update), RuntimeError);
  EXPECT_THAT(file.map().nodes(), IsEmpty());
}

TEST_F(MapFileTest, ReadersMayLookWhileItGrows)
{
  auto writer = MapFile::create(path(), smallHeader());
  writer.append(nodeUpdate(0));
  auto reader = MapFile::open(path(), MapFile::Access::Read);
  writer.append(nodeUpdate(1));
  EXPECT_EQ(reader.map().nodes().size(), 1U);
  EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).map().nodes().size(), 2U);
  EXPECT_THROW(reader.append(nodeUpdate(2)), LogicError);
}

TEST_F(MapFileTest, SaysWhatItWasMadeWith)
{
  auto file = MapFile::create(path(), smallHeader());
  MapHeader wanted = smallHeader();
  wanted.thresholds.clear();
  wanted.signatureVersion = 3;
  file.expectMadeWith(wanted);
  wanted.cameraHash = "another";
  try {
    file.expectMadeWith(wanted);
    ADD_FAILURE();
  }
  catch (const StoreError &error) {
    EXPECT_THAT(error.what(),
                HasSubstr("made with camera " + smallHeader().cameraHash + ", not another"));
  }
}

TEST_F(MapFileTest, ViewsAreWhatDecodingTheStoredBytesGives)
{
  const ViewBytes bytes = encodeView(smallPanorama(4, CV_8UC3));
  auto file = MapFile::create(path(), smallHeader());
  MapUpdate update = nodeUpdate(0);
  update.view->bytes = bytes;
  file.append(update);
  file.append({.changes = {NodeAdded{{{1}, {}}}}});

  EXPECT_TRUE(file.hasView({0}));
  EXPECT_FALSE(file.hasView({1}));
  EXPECT_EQ(file.view({0}), bytes);
  EXPECT_THROW(file.view({1}), LogicError);
  const Panorama expected = decodeView(bytes, smallHeader().panorama);
  EXPECT_EQ(cv::norm(file.panorama({0}).image, expected.image, cv::NORM_INF), 0.0);
  EXPECT_EQ(file.panorama({0}).geometry, smallHeader().panorama);
}

TEST_F(MapFileTest, NodeViewsKeepTheLatestOnly)
{
  auto file = MapFile::create(path(), smallHeader());
  fill(file);
  NodeViews views(file, 2);
  const cv::Mat first = views({0}).image;
  EXPECT_EQ(views({1}).image.at<unsigned char>(0, 0),
            file.panorama({1}).image.at<unsigned char>(0, 0));
  EXPECT_EQ(views({0}).image.data, first.data);
  views({2});
  EXPECT_EQ(views({0}).image.data, first.data);
  views({1});
  views({2});
  EXPECT_NE(views({0}).image.data, first.data);
  EXPECT_THROW(views({5}), LogicError);
  EXPECT_THROW(NodeViews(file, 0), LogicError);
}

TEST(ViewCodec, KeepsColourAndGrayAndIsCloseToTheOriginal)
{
  for (const int type : {CV_8UC1, CV_8UC3}) {
    Panorama smooth{cv::Mat(160, 720, type), {}};
    for (int v = 0; v < 160; ++v) {
      smooth.image.row(v).setTo(cv::Scalar::all(40 + v));
    }
    const ViewBytes bytes = encodeView(smooth);
    EXPECT_EQ(encodeView(smooth), bytes);
    const Panorama back = decodeView(bytes, smooth.geometry);
    ASSERT_EQ(back.image.type(), type);
    EXPECT_LE(cv::norm(back.image, smooth.image, cv::NORM_INF), 4.0);
  }
}

TEST(ViewCodec, RefusesWhatIsNoPanorama)
{
  EXPECT_THROW(encodeView({cv::Mat(), {}}), LogicError);
  EXPECT_THROW(encodeView({cv::Mat(8, 32, CV_8UC1), {}}), LogicError);
  EXPECT_THROW(encodeView({cv::Mat(160, 720, CV_16UC1), {}}), LogicError);
  EXPECT_THROW(decodeView({}, {}), RuntimeError);
}

// Published check values of FNV-1a 64: http://www.isthe.com/chongo/tech/comp/fnv/
TEST(ContentHash, IsFnv1a)
{
  EXPECT_EQ(contentHashText(""), "cbf29ce484222325");
  EXPECT_EQ(contentHashText("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(contentHashText("foobar"), "85944171f73967e8");
}

} // namespace
} // namespace homeward
