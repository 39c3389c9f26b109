// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/viewer/line_chart.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

TEST(LineChart, namesEverythingItShows)
{
  const LineChart chart{
      "Coverage", "time, s", {{"seed 1", {{5.0, 0.2}, {30.0, 0.9}}, 40.0}, {"seed 2", {}, 0.0}}};
  const std::string svg = lineChartSvg(chart);
  for (const char *word : {"Coverage", "time, s", "seed 1", "seed 2", "100 %", ">40<", "</svg>"}) {
    EXPECT_THAT(svg, testing::HasSubstr(word));
  }
  EXPECT_EQ(svg, lineChartSvg(chart));
}

TEST(LineChart, aShareHoldsUntilTheNextPoint)
{
  // 640 pixels from 60 on are 100 s, 300 pixels from 350 up are 100 %.
  const std::string svg = lineChartSvg({"", "", {{"", {{25.0, 0.5}, {50.0, 1.0}}, 100.0}}});
  EXPECT_THAT(svg, testing::ContainsRegex("220[.0]*,350[.0]* 220[.0]*,200[.0]* 380[.0]*,200[.0]* "
                                          "380[.0]*,50[.0]* 700[.0]*,50[.0]*"));
}

TEST(LineChart, refusesWhatItCannotShow)
{
  const auto draw = [](const std::vector<Eigen::Vector2d> &points) {
    return lineChartSvg({"", "", {{"", points, 0.0}}});
  };
  EXPECT_THROW(draw({{1.0, 1.5}}), LogicError);
  EXPECT_THROW(draw({{1.0, -0.5}}), LogicError);
  EXPECT_THROW(draw({{-1.0, 0.5}}), LogicError);
  EXPECT_THROW(draw({{2.0, 0.5}, {1.0, 0.6}}), LogicError);
}

} // namespace
} // namespace homeward
