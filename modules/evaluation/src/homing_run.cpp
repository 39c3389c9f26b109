// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/homing_run.h>

#include "parallel.h"

#include <homeward/core/error.h>
#include <homeward/homing/bearing_homing.h>
#include <homeward/homing/homing_method.h>
#include <homeward/homing/min_warping.h>
#include <homeward/homing/scale_space_homing.h>
#include <homeward/homing/visual_compass.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <numeric>
#include <set>

namespace homeward
{

namespace
{

/** Processor time of this thread, milliseconds. */
double threadMilliseconds()
{
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/** Makes work(i) for each i, and tells the mean processor time. */
template <class Work> double timed(std::size_t count, int threads, const Work &work)
{
  std::vector<double> spent(count);
  inParallel(count, threads, [&](std::size_t i) {
    const double begin = threadMilliseconds();
    work(i);
    spent[i] = threadMilliseconds() - begin;
  });
  return count == 0 ? 0.0
                    : std::accumulate(spent.begin(), spent.end(), 0.0) / static_cast<double>(count);
}

/** Each wanted panorama, prepared once. */
template <class Prepared> struct PreparedViews
{
  std::map<std::size_t, Prepared> views;
  double milliseconds = 0.0; ///< each, mean
};

template <class Prepare>
auto prepareAll(const std::function<Panorama(std::size_t)> &panorama,
                const std::set<std::size_t> &wanted, int threads, const Prepare &prepare)
{
  PreparedViews<decltype(prepare(Panorama{}))> result;
  for (const std::size_t index : wanted) {
    result.views[index]; // so that threads change values only
  }
  const std::vector<std::size_t> indices(wanted.begin(), wanted.end());
  std::vector<double> spent(indices.size());
  inParallel(indices.size(), threads, [&](std::size_t i) {
    const Panorama picture = panorama(indices[i]);
    const double begin = threadMilliseconds();
    result.views.at(indices[i]) = prepare(picture);
    spent[i] = threadMilliseconds() - begin;
  });
  result.milliseconds = std::accumulate(spent.begin(), spent.end(), 0.0) /
                        std::max(1.0, static_cast<double>(spent.size()));
  return result;
}

template <class Prepare, class Compare>
HomingAnswers runMethod(const HomingTask &task, int threads, const Prepare &prepare,
                        const Compare &compare)
{
  std::set<std::size_t> viewIndices;
  std::set<std::size_t> homeIndices;
  for (const HomingPair &pair : task.pairs) {
    viewIndices.insert(pair.view);
    homeIndices.insert(pair.home);
  }
  const auto views = prepareAll(task.viewPanorama, viewIndices, threads, prepare);
  const auto homes = prepareAll(task.homePanorama, homeIndices, threads, prepare);
  HomingAnswers result;
  result.answers.resize(task.pairs.size());
  const double comparing = timed(task.pairs.size(), threads, [&](std::size_t i) {
    const HomingPair &pair = task.pairs[i];
    result.answers[i] = compare(views.views.at(pair.view), homes.views.at(pair.home));
  });
  result.milliseconds = views.milliseconds + comparing;
  return result;
}

MinWarpingOptions withColumns(int columns)
{
  MinWarpingOptions options;
  options.columns = columns;
  return options;
}

HomingAnswers runMinWarping(const MinWarpingOptions &options, const HomingTask &task, int threads)
{
  const MinWarping method(options);
  return runMethod(
      task, threads, [&](const Panorama &panorama) { return method.prepare(panorama); },
      [&](const ColumnFeatures &view, const ColumnFeatures &home) {
        const std::optional<WarpingMatch> match = method.match(view, home);
        return match ? std::optional(match->home) : std::nullopt;
      });
}

/** A method whose views are prepared as ScaleSpaceView. */
template <class Method>
HomingAnswers runKeypoints(const Method &method, const HomingTask &task, int threads)
{
  return runMethod(
      task, threads, [&](const Panorama &panorama) { return method.prepare(panorama); },
      [&](const ScaleSpaceView &view, const ScaleSpaceView &home) {
        return method.match(view, home);
      });
}

/** A method that prepares nothing: both views are made ready for every pair. */
HomingAnswers runWhole(const std::string &name, const HomingTask &task, int threads)
{
  return runMethod(
      task, threads, [](const Panorama &panorama) { return panorama; },
      [&](const Panorama &view, const Panorama &home) {
        return makeHomingMethod(name)->compute(view, home);
      });
}

HomingAnswers runCompass(const CompassOptions &options, const HomingTask &task, int threads)
{
  HomingAnswers result = runMethod(
      task, threads, [](const Panorama &panorama) { return panorama; },
      [&](const Panorama &view, const Panorama &home) -> std::optional<HomeVector> {
        const std::optional<CompassReading> reading = visualCompass(view, home, options);
        return reading ? std::optional(
                             HomeVector{0.0, 0.0, reading->headingChange, reading->confidence})
                       : std::nullopt;
      });
  result.givesDirection = false;
  return result;
}

} // namespace

const std::vector<std::string> &homingMethods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"minwarping-thorough", "minwarping-288", "minwarping-144",
                                  "minwarping-72"};
    for (const std::string &name : homingMethodNames()) {
      if (name != "minwarping") {
        list.push_back(name);
      }
    }
    list.insert(list.end(), {"hiss-published", "compass", "edge-compass"});
    return list;
  }();
  return names;
}

HomingAnswers runHoming(const std::string &method, const HomingTask &task, int threads)
{
  const auto known = std::find(homingMethods().begin(), homingMethods().end(), method);
  if (known == homingMethods().end()) {
    std::string names;
    for (const std::string &name : homingMethods()) {
      names += (names.empty() ? "" : ", ") + name;
    }
    throw ConfigError("homing method '" + method + "' is unknown, use one of " + names);
  }
  HomingAnswers result;
  if (method == "hiss") {
    result = runKeypoints(ScaleSpaceHoming(), task, threads);
  }
  else if (method == "hiss-published") {
    ScaleSpaceOptions published;
    published.published = true;
    result = runKeypoints(ScaleSpaceHoming(published), task, threads);
  }
  else if (method == "bearing") {
    result = runKeypoints(BearingHoming(), task, threads);
  }
  else if (method == "compass") {
    result = runCompass(kZeilCompass, task, threads);
  }
  else if (method == "edge-compass") {
    result = runCompass({}, task, threads);
  }
  else if (method.rfind("minwarping-", 0) != 0) {
    result = runWhole(method, task, threads);
  }
  else {
    const std::string setting = method.substr(method.find('-') + 1);
    result = runMinWarping(
        setting == "thorough" ? kThoroughWarping : withColumns(std::stoi(setting)), task, threads);
  }
  result.method = method;
  return result;
}

} // namespace homeward
