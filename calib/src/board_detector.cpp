// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/board_detector.h>

#include "grid_boards.h"

#include <homeward/camera/unified_model.h>
#include <homeward/core/error.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace homeward
{

namespace
{

void checkPicture(const cv::Mat &picture)
{
  if (picture.type() != CV_8UC1 || picture.empty()) {
    throw LogicError("boards are found in 8-bit gray pictures, not in type " +
                     std::to_string(picture.type()));
  }
}

} // namespace

std::optional<BoardView> findBoard(const cv::Mat &picture, const Target &target,
                                   const std::optional<MirrorCircles> &mirror)
{
  checkPicture(picture);
  checkTarget(target);
  const bool grid = target.kind == TargetKind::Chessboard || target.kind == TargetKind::CircleGrid;
  std::optional<BoardView> view =
      grid ? findGridBoard(picture, target, mirror) : findMarkerBoard(picture, target, mirror);
  return view;
}

std::vector<std::optional<BoardView>> findBoards(const std::vector<cv::Mat> &pictures,
                                                 const Target &target,
                                                 const std::optional<MirrorCircles> &mirror,
                                                 int threads, const std::function<void(int)> &done)
{
  std::vector<std::optional<BoardView>> views(pictures.size());
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  int finished = 0;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t i = next++; i < pictures.size(); i = next++) {
      try {
        views[i] = findBoard(pictures[i], target, mirror);
      }
      catch (...) {
        const std::lock_guard lock(reporting);
        failure = std::current_exception();
        return;
      }
      const std::lock_guard lock(reporting);
      ++finished;
      if (done) {
        done(finished);
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) {
      helpers.emplace_back(run);
    }
    run();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  return views;
}

BoardViews refineBoards(const std::vector<cv::Mat> &pictures, const Target &target,
                        const BoardViews &views, const CameraModel &camera)
{
  const auto *unified = dynamic_cast<const UnifiedModel *>(&camera);
  if (unified == nullptr || pictures.size() != views.views.size()) {
    throw LogicError("boards are refined by a unified camera, not " + camera.name() +
                     ", in a picture a view, not " + std::to_string(pictures.size()) + " for " +
                     std::to_string(views.views.size()));
  }
  checkTarget(target);
  BoardViews refined = views;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    checkPicture(pictures[i]);
    const auto refine = target.kind == TargetKind::AprilGrid ? refineTags : refineGridPoints;
    refined.views[i] = refine(pictures[i], target, views.views[i], unified->camera());
  }
  return refined;
}

} // namespace homeward
