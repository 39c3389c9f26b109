// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibrate_options.h"
#include "command.h"
#include "files.h"
#include "live_views.h"
#include "pictures.h"
#include "report.h"
#include "stop_signal.h"
#include "target_print.h"

#include <homeward/calib/board_detector.h>
#include <homeward/calib/calibration.h>
#include <homeward/calib/guidance.h>
#include <homeward/camera/camera_model_file.h>
#include <homeward/camera/unified_model.h>
#include <homeward/camera/unwarper.h>
#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <unistd.h>

namespace homeward
{
namespace
{

/** Pictures and the boards that were found in them. */
struct FoundBoards
{
  BoardViews views;
  std::vector<cv::Mat> pictures; ///< one a view
  std::vector<std::string> missed;
  std::optional<MirrorCircles> mirror;
  cv::Mat first;
  std::size_t tried = 0;
};

FoundBoards findIn(const Pictures &pictures, const Target &target, int threads)
{
  std::vector<cv::Mat> grays;
  for (const cv::Mat &image : pictures.images) {
    grays.push_back(grayOf(image));
  }
  FoundBoards found;
  found.mirror = findMirror(meanOf(grays));
  found.views.width = grays[0].cols;
  found.views.height = grays[0].rows;
  found.first = pictures.images[0];
  found.tried = grays.size();
  const bool watched = isatty(STDERR_FILENO) != 0;
  auto views = findBoards(grays, target, found.mirror, threads, [&](int done) {
    if (watched) {
      std::fprintf(stderr, "\rlooking for boards: %d of %zu%s", done, grays.size(),
                   static_cast<std::size_t>(done) == grays.size() ? "\n" : "");
    }
  });
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i]) {
      views[i]->name = pictures.names[i];
      found.views.views.push_back(std::move(*views[i]));
      found.pictures.push_back(pictures.images[i]);
    }
    else {
      found.missed.push_back(pictures.names[i]);
    }
  }
  return found;
}

FoundBoards boardsOf(const CalibrateOptions &options, const Target &target)
{
  if (!options.live.empty()) {
    const auto camera = openLiveCamera(options.live);
    return findIn(watch(*camera, options.live, target, {options.most, options.keep}, stopSignal()),
                  target, options.threads);
  }
  const Pictures pictures =
      options.film.empty() ? readPictures(options.pictures) : readFilm(options.film, options.most);
  return findIn(pictures, target, options.threads);
}

/** Calibrates, and moves the boards' points to where that camera shows them. */
Calibration calibrateRefining(FoundBoards &found, const Target &target,
                              const CalibrationOptions &how)
{
  std::vector<cv::Mat> grays;
  for (const cv::Mat &picture : found.pictures) {
    grays.push_back(grayOf(picture));
  }
  CalibrationOptions quick;
  quick.crossValidate = false;
  found.views = refineBoards(grays, target, found.views, *calibrate(found.views, quick).model);
  return calibrate(found.views, how);
}

/** How the picture lies: numbered markers tell whether it is flipped, else the user does. */
CameraMount mountOf(const CalibrateOptions &options, const Target &target,
                    const Calibration &calibration)
{
  CameraMount mount = options.mount.mount();
  if (target.kind == TargetKind::AprilGrid || target.kind == TargetKind::Charuco) {
    mount.leftIsClockwise = calibration.mirrored;
  }
  return mount;
}

/** The camera as the unwarper takes it; nothing for models that it does not know. */
std::optional<MirrorCamera> mirrorCameraOf(const Calibration &calibration, const FoundBoards &found,
                                           const CameraMount &mount)
{
  const auto *unified = dynamic_cast<const UnifiedModel *>(calibration.model.get());
  if (unified == nullptr || !found.mirror) {
    return std::nullopt;
  }
  return MirrorCamera{unified->camera(), ringOf(*found.mirror, unified->camera()), mount,
                      rimOf(*found.mirror)};
}

/** Of every two estimated parameters, by their names. */
nlohmann::json correlationsOf(const Calibration &calibration)
{
  const std::vector<std::string> names = calibration.model->parameterNames();
  const Eigen::MatrixXd correlations = calibration.correlations();
  nlohmann::json json = nlohmann::json::object();
  for (Eigen::Index i = 0; i < correlations.rows(); ++i) {
    for (Eigen::Index k = 0; k < correlations.cols(); ++k) {
      if (i != k && correlations(i, i) > 0.0 && correlations(k, k) > 0.0) {
        json[names[static_cast<std::size_t>(i)]][names[static_cast<std::size_t>(k)]] =
            correlations(i, k);
      }
    }
  }
  return json;
}

nlohmann::json summaryOf(const FoundBoards &found, const Calibration &calibration)
{
  nlohmann::json json = jsonHeader("calibrate");
  json["seed"] = 0;
  json["model"] = calibration.model->name();
  const std::vector<std::string> names = calibration.model->parameterNames();
  const Eigen::VectorXd values = calibration.model->parameters();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    json["parameters"][names[i]] = {{"value", values(k)},
                                    {"sigma", std::sqrt(calibration.covariance(k, k))}};
  }
  json["correlations"] = correlationsOf(calibration);
  json["rms_px"] = calibration.rms;
  json["robust_rms_px"] = calibration.robustRms;
  json["heldout_rms_px"] =
      calibration.heldoutRms ? nlohmann::json(*calibration.heldoutRms) : nlohmann::json(nullptr);
  json["views"] = found.tried;
  json["boards_found"] = found.views.views.size();
  json["outliers"] = calibration.outliers;
  json["missed"] = found.missed;
  json["warnings"] = calibration.warnings;
  return json;
}

void writeReport(const std::string &file, const FoundBoards &found, const Target &target,
                 const Calibration &calibration, const std::optional<MirrorCamera> &camera)
{
  if (file.empty()) {
    return;
  }
  ReportContent content;
  content.target = describe(target);
  content.views = found.views;
  content.calibration = calibration;
  content.pictures = found.pictures;
  content.missed = found.missed;
  content.mirror = found.mirror;
  const UnifiedModel rough(roughCamera(found.mirror, found.views.width, found.views.height));
  content.bendBefore = bendOfBoards(found.views, rough);
  content.bendAfter = bendOfBoards(found.views, *calibration.model);
  if (camera) {
    content.panorama = Unwarper(*camera, wholePanorama(*camera)).unwarp(found.first).image;
  }
  writeText(file, reportHtml(content));
}

void say(const FoundBoards &found, const Calibration &calibration, const CalibrateOptions &options)
{
  std::printf("%zu of %zu boards found; rms %.3f px, %.3f px without %d outliers; wrote %s\n",
              found.views.views.size(), found.tried, calibration.rms, calibration.robustRms,
              calibration.outliers, options.output.c_str());
  if (calibration.model->name() != "unified") {
    std::fprintf(stderr, "homeward-calibrate: homeward itself drives with the unified model only; "
                         "this file is for other programs, without mirror and mount\n");
  }
  for (const std::string &missed : found.missed) {
    std::fprintf(stderr, "homeward-calibrate: no board in %s\n", missed.c_str());
  }
  for (const std::string &warning : calibration.warnings) {
    std::fprintf(stderr, "homeward-calibrate: %s\n", warning.c_str());
  }
}

void calibrateFromBoards(const CalibrateOptions &options)
{
  const auto begin = std::chrono::steady_clock::now();
  const Target target = options.target.target();
  FoundBoards found = boardsOf(options, target);
  if (found.views.views.empty()) {
    throw ConfigError("no " + describe(target) + " is seen in any of the " +
                      std::to_string(found.tried) +
                      " pictures; check --target, --columns and --rows");
  }
  CalibrationOptions how;
  how.model = options.model;
  how.estimateDistortion = !options.noDistortion;
  const Calibration calibration = calibrateRefining(found, target, how);
  const auto camera = mirrorCameraOf(calibration, found, mountOf(options, target, calibration));
  writeText(options.output,
            camera ? formatMirrorCamera(*camera) : formatCameraModel(*calibration.model));
  writeReport(options.report, found, target, calibration, camera);
  nlohmann::json json = summaryOf(found, calibration);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = spent.count();
  writeJson(options.json, json);
  say(found, calibration, options);
}

} // namespace

void addCalibrateCommand(CliCommand app)
{
  auto options = std::make_shared<CalibrateOptions>();
  app.examples("Example: homeward-calibrate pictures/ --target charuco --columns 8 --rows 6 "
               "--pitch 45 -o camera.yaml --report report.html");
  addCalibrateOptions(app, *options);
  app.run([options] {
    if (options->pictures.empty() && options->film.empty() && options->live.empty()) {
      throw ConfigError("pictures, --film or --live is required; see --help");
    }
    calibrateFromBoards(*options);
    return kExitDone;
  });
}

} // namespace homeward
