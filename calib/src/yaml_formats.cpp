// SPDX-License-Identifier: GPL-3.0-or-later
#include "format_parts.h"

#include <opencv2/core.hpp>
#include <yaml-cpp/yaml.h>

#include <cmath>

namespace homeward
{
namespace
{

/** `count` numbers of a list of cam0. */
std::vector<double> numbers(const YAML::Node &camera, const std::string &key, std::size_t count,
                            const std::string &origin)
{
  const YAML::Node list = camera[key];
  std::vector<double> values;
  if (list && list.IsSequence()) {
    for (const auto &item : list) {
      double value = 0.0;
      if (item.IsScalar() && YAML::convert<double>::decode(item, value) && std::isfinite(value)) {
        values.push_back(value);
      }
    }
  }
  if (values.size() != count || list.size() != count) {
    throw ConfigError(origin + ": cam0." + key + " must be a list of " + std::to_string(count) +
                      " numbers");
  }
  return values;
}

std::string wordOf(const YAML::Node &camera, const std::string &key, const std::string &origin)
{
  const YAML::Node word = camera[key];
  if (!word || !word.IsScalar()) {
    throw ConfigError(origin + ": cam0." + key + " is missing");
  }
  return word.Scalar();
}

Eigen::VectorXd vectorOf(std::initializer_list<double> values)
{
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}

ModelPointer kalibrModel(const YAML::Node &camera, const std::string &origin)
{
  const std::string model = wordOf(camera, "camera_model", origin);
  const std::string distortion = wordOf(camera, "distortion_model", origin);
  const auto size = numbers(camera, "resolution", 2, origin);
  const PictureSize pixels = sizeOr(size[0], size[1], std::nullopt, origin);
  const bool none = distortion == "none";
  if (model == "omni" || (model == "pinhole" && distortion != "equidistant")) {
    if (!none && distortion != "radtan") {
      throw ConfigError(origin + ": cam0.distortion_model '" + distortion + "' of '" + model +
                        "' is not read here; radtan and none are");
    }
    const auto d =
        none ? std::vector<double>(4, 0.0) : numbers(camera, "distortion_coeffs", 4, origin);
    auto p = numbers(camera, "intrinsics", model == "omni" ? 5 : 4, origin);
    if (model == "pinhole") {
      p.insert(p.begin(), 0.0);
    }
    return modelFrom("unified",
                     vectorOf({p[0], p[1], p[2], p[3], p[4], d[0], d[1], d[2], d[3], 0.0}), pixels,
                     origin);
  }
  if (model == "pinhole") {
    const auto p = numbers(camera, "intrinsics", 4, origin);
    const auto d = numbers(camera, "distortion_coeffs", 4, origin);
    return modelFrom("kannala_brandt", vectorOf({d[0], d[1], d[2], d[3], p[0], p[1], p[2], p[3]}),
                     pixels, origin);
  }
  if ((model == "eucm" || model == "ds") && none) {
    const auto p = numbers(camera, "intrinsics", 6, origin);
    return modelFrom(model == "ds" ? "double_sphere" : "extended_unified",
                     vectorOf({p[0], p[1], p[2], p[3], p[4], p[5]}), pixels, origin);
  }
  throw ConfigError(origin + ": cam0 is '" + model + "' with '" + distortion +
                    "'; omni-radtan, pinhole-radtan, pinhole-equidistant, eucm-none and ds-none "
                    "are read here");
}

cv::Mat matrixOf(const cv::FileStorage &file, const char *key, const char *other,
                 const std::string &origin)
{
  const cv::FileNode node = file[key].empty() ? file[other] : file[key];
  cv::Mat matrix;
  if (node.isReal() || node.isInt()) {
    matrix = cv::Mat(1, 1, CV_64F, cv::Scalar(static_cast<double>(node)));
  }
  else if (!node.empty()) {
    node >> matrix;
  }
  if (matrix.empty() || matrix.channels() != 1) {
    throw ConfigError(origin + ": '" + key + "' (or '" + other +
                      "') is missing or no matrix; write K, D and xi of cv::omnidir::calibrate");
  }
  matrix.convertTo(matrix, CV_64F);
  return matrix.reshape(1, 1).clone();
}

std::string listed(const Eigen::VectorXd &values)
{
  std::string out;
  for (const double value : values) {
    out += (out.empty() ? "[" : ", ") + digits(value);
  }
  return out + "]";
}

} // namespace

ModelPointer parseKalibr(const std::string &text, const std::string &origin)
{
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap() || !root["cam0"] || !root["cam0"].IsMap()) {
      throw ConfigError(origin + ": there is no cam0; a Kalibr camchain names its cameras so");
    }
    return kalibrModel(root["cam0"], origin);
  }
  catch (const YAML::Exception &error) {
    throw ConfigError(origin + " is not YAML: " + error.what());
  }
}

std::string formatKalibr(const CameraModel &model)
{
  const Eigen::VectorXd p = model.parameters();
  std::string kind;
  Eigen::VectorXd intrinsics;
  std::string distortion = "none";
  Eigen::VectorXd coefficients(0);
  if (model.name() == "unified") {
    if (p[9] != 0.0) {
      cannotHold("Kalibr", model, "skew");
    }
    kind = p[0] == 0.0 ? "pinhole" : "omni";
    intrinsics = p[0] == 0.0 ? p.segment(1, 4) : p.head(5);
    distortion = "radtan";
    coefficients = p.segment(5, 4);
  }
  else if (model.name() == "kannala_brandt") {
    kind = "pinhole";
    intrinsics = p.tail(4);
    distortion = "equidistant";
    coefficients = p.head(4);
  }
  else if (model.name() == "extended_unified" || model.name() == "double_sphere") {
    kind = model.name() == "double_sphere" ? "ds" : "eucm";
    intrinsics = p;
  }
  else {
    cannotHold("Kalibr", model, "anything");
  }
  return "cam0:\n  camera_model: " + kind + "\n  intrinsics: " + listed(intrinsics) +
         "\n  distortion_model: " + distortion +
         "\n  distortion_coeffs: " + (coefficients.size() > 0 ? listed(coefficients) : "[]") +
         "\n  resolution: [" + std::to_string(model.width()) + ", " +
         std::to_string(model.height()) + "]\n";
}

ModelPointer parseOpencv(const std::string &text, const std::string &origin,
                         std::optional<PictureSize> given)
{
  try {
    const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    const cv::Mat K = matrixOf(file, "camera_matrix", "K", origin);
    const cv::Mat D = matrixOf(file, "distortion_coefficients", "D", origin);
    const cv::Mat xi = matrixOf(file, "xi", "Xi", origin);
    if (K.total() != 9 || D.total() != 4 || xi.total() != 1) {
      throw ConfigError(origin +
                        ": the camera matrix must have 9, the distortion 4 and xi 1 "
                        "numbers, not " +
                        std::to_string(K.total()) + ", " + std::to_string(D.total()) + " and " +
                        std::to_string(xi.total()));
    }
    const auto k = [&](int i) { return K.at<double>(i); };
    const auto d = [&](int i) { return D.at<double>(i); };
    const cv::FileNode width = file["image_width"];
    const cv::FileNode height = file["image_height"];
    return modelFrom(
        "unified",
        vectorOf({xi.at<double>(0), k(0), k(4), k(2), k(5), d(0), d(1), d(2), d(3), k(1)}),
        sizeOr(width.isInt() ? static_cast<double>(width) : 0.0,
               height.isInt() ? static_cast<double>(height) : 0.0, given, origin),
        origin);
  }
  catch (const cv::Exception &error) {
    throw ConfigError(origin + ": OpenCV cannot read it: " + error.err);
  }
}

std::string formatOpencv(const CameraModel &model)
{
  if (model.name() != "unified") {
    cannotHold("OpenCV", model, "anything");
  }
  const Eigen::VectorXd p = model.parameters();
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "image_width" << model.width() << "image_height" << model.height();
  file << "camera_matrix" << cv::Mat(cv::Matx33d(p[1], p[9], p[3], 0.0, p[2], p[4], 0.0, 0.0, 1.0));
  file << "distortion_coefficients" << cv::Mat(cv::Matx14d(p[5], p[6], p[7], p[8]));
  file << "xi" << p[0];
  return file.releaseAndGetString();
}

} // namespace homeward
