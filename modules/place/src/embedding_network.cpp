// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/embedding_network.h>

#include <homeward/core/error.h>

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace homeward
{

namespace
{

/** The columns, so many to the right. */
cv::Mat turned(const cv::Mat &image, int columns)
{
  if (columns == 0) {
    return image;
  }
  cv::Mat result;
  cv::hconcat(image.colRange(image.cols - columns, image.cols),
              image.colRange(0, image.cols - columns), result);
  return result;
}

cv::dnn::Net readNetwork(const std::filesystem::path &file)
{
  if (!std::filesystem::is_regular_file(file)) {
    throw ConfigError("there is no network file " + file.string());
  }
  try {
    return cv::dnn::readNetFromONNX(file.string());
  }
  catch (const cv::Exception &) {
    throw ConfigError(file.string() +
                      " is no network that OpenCV can read; give an ONNX file of opset 11 or so");
  }
}

} // namespace

class EmbeddingNetwork::Impl
{
public:
  Impl(std::filesystem::path file, const EmbeddingOptions &options)
      : m_file(std::move(file)), m_options(options), m_net(readNetwork(m_file))
  {
    if (options.turns < 1 || options.input.empty()) {
      throw LogicError("a network needs an input size and at least one turn");
    }
    if (m_net.empty()) {
      throw ConfigError(m_file.string() + " holds no network");
    }
  }

  std::vector<float> run(const cv::Mat &bgr)
  {
    std::vector<float> sum;
    for (int turn = 0; turn < m_options.turns; ++turn) {
      const cv::Mat output = forward(turned(bgr, turn * bgr.cols / m_options.turns));
      const auto *values = output.ptr<float>();
      sum.resize(output.total(), 0.0F);
      std::transform(sum.begin(), sum.end(), values, sum.begin(), std::plus<>());
    }
    if (!std::all_of(sum.begin(), sum.end(), [](float value) { return std::isfinite(value); })) {
      throw ConfigError("network " + m_file.string() + " gives what is no number");
    }
    return sum;
  }

private:
  cv::Mat forward(const cv::Mat &bgr)
  {
    try {
      m_net.setInput(cv::dnn::blobFromImage(bgr, m_options.scale, m_options.input, m_options.mean,
                                            true, false, CV_32F));
      cv::Mat output = m_net.forward();
      if (output.empty() || output.depth() != CV_32F) {
        throw ConfigError("network " + m_file.string() + " gives no vector of floats");
      }
      return output.clone();
    }
    catch (const cv::Exception &) {
      throw ConfigError("network " + m_file.string() + " cannot take pictures of " +
                        std::to_string(m_options.input.width) + " x " +
                        std::to_string(m_options.input.height) + "; give the size it was made for");
    }
  }

  std::filesystem::path m_file;
  EmbeddingOptions m_options;
  cv::dnn::Net m_net;
};

EmbeddingNetwork::EmbeddingNetwork(const std::filesystem::path &file,
                                   const EmbeddingOptions &options)
    : m_impl(std::make_unique<Impl>(file, options))
{}

EmbeddingNetwork::~EmbeddingNetwork() = default;

Signature EmbeddingNetwork::compute(const Panorama &panorama) const
{
  cv::Mat bgr = panorama.image;
  if (bgr.type() == CV_8UC1) {
    cv::cvtColor(panorama.image, bgr, cv::COLOR_GRAY2BGR);
  }
  if (bgr.empty() || bgr.type() != CV_8UC3) {
    throw LogicError("panorama picture must be 8-bit gray or BGR");
  }
  return {SignatureKind::Embedding, static_cast<int>(bgr.total()), m_impl->run(bgr)};
}

} // namespace homeward
