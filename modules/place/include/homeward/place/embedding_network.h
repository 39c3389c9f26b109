// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/place/signature.h>

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

namespace homeward
{

/** What a network expects of its input. */
struct EmbeddingOptions
{
  cv::Size input{224, 224};       ///< pixels
  double scale = 1.0 / 255.0;     ///< of a colour value, after the mean was taken off
  cv::Scalar mean = cv::Scalar(); ///< red, green, blue
  int turns = 4; ///< copies of the panorama, turned by equal steps, whose embeddings are added
};

/**
 * A neural network of the user's own that turns a picture into a vector, from an ONNX file: input
 * 1 x 3 x height x width, red first; all numbers of its output count.
 */
class EmbeddingNetwork
{
public:
  /** @throw ConfigError when the file is missing or no network that OpenCV can run */
  explicit EmbeddingNetwork(const std::filesystem::path &file,
                            const EmbeddingOptions &options = {});
  ~EmbeddingNetwork();

  /**
   * A signature of kind Embedding; not to be called from two threads at once.
   * @throw ConfigError when the network cannot take pictures of the size in the options, or gives
   * no numbers
   */
  Signature compute(const Panorama &panorama) const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
