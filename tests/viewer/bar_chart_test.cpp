// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/viewer/bar_chart.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

TEST(BarChart, namesEverythingItShows)
{
  const BarChart chart{"Recall", {"fourier", "sad"}, {{"day to day", {0.9, 0.7}}}};
  const std::string svg = barChartSvg(chart);
  for (const char *word : {"Recall", "fourier", "sad", "day to day", "100 %", "</svg>"}) {
    EXPECT_THAT(svg, testing::HasSubstr(word));
  }
  EXPECT_EQ(svg, barChartSvg(chart));
}

TEST(BarChart, refusesWhatItCannotShow)
{
  EXPECT_THROW(barChartSvg({"", {"a", "b"}, {{"g", {0.5}}}}), LogicError);
  EXPECT_THROW(barChartSvg({"", {"a"}, {{"g", {1.5}}}}), LogicError);
  EXPECT_THROW(barChartSvg({"", {"a"}, {{"g", {-0.1}}}}), LogicError);
}

} // namespace
} // namespace homeward
