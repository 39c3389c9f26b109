// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <opencv2/core/types.hpp>
#include <tinyxml2.h>

#include <string>
#include <vector>

namespace homeward
{

/** About the rectangle that a <text> of an SVG covers, pixels. */
inline cv::Rect2d boxOf(const tinyxml2::XMLElement &text)
{
  const double size = text.DoubleAttribute("font-size");
  const double width = 0.58 * size * static_cast<double>(std::string(text.GetText()).size());
  const std::string anchor = text.Attribute("text-anchor");
  const double share = anchor == "start" ? 0.0 : anchor == "middle" ? 0.5 : 1.0;
  return {text.DoubleAttribute("x") - share * width, text.DoubleAttribute("y") - 0.75 * size, width,
          0.9 * size};
}

/** No words of a picture cover others, and none leaves it. */
inline void expectWordsApart(const std::string &svg)
{
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  const tinyxml2::XMLElement &root = *document.RootElement();
  const cv::Rect2d whole(0.0, 0.0, root.DoubleAttribute("width"), root.DoubleAttribute("height"));
  std::vector<const tinyxml2::XMLElement *> texts;
  for (const auto *text = root.FirstChildElement("text"); text != nullptr;
       text = text->NextSiblingElement("text")) {
    const cv::Rect2d box = boxOf(*text);
    EXPECT_EQ(box & whole, box) << text->GetText() << " at width " << whole.width;
    for (const tinyxml2::XMLElement *other : texts) {
      EXPECT_LE((box & boxOf(*other)).area(), 0.0)
          << text->GetText() << " covers " << other->GetText() << " at width " << whole.width;
    }
    texts.push_back(text);
  }
}

} // namespace homeward
