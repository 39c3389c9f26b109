// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli_documents.h"
#include "command.h"

#include <homeward/core/error.h>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include <csignal>
#include <cstdio>
#include <exception>

int main(int argc, char **argv)
{
  cv::setNumThreads(1); // results must not depend on how many threads share a sum
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); // ours is one line
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is a failed write, with its message
  CLI::App app{"Calibrates a camera under a mirror, or any central camera, from pictures."};
  app.name("homeward-calibrate");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", HOMEWARD_VERSION);
  int status = homeward::kExitDone;
  homeward::addCalibrateCommand(app, status);
  homeward::addQuickCommand(app, status);
  homeward::addTargetCommand(app, status);
  homeward::addMountCommand(app, status);
  homeward::addConvertCommand(app, status);
  if (const auto document = homeward::cliDocument(app, HOMEWARD_VERSION, argc, argv)) {
    std::fputs(document->c_str(), stdout);
    return homeward::kExitDone;
  }
  try {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? homeward::kExitDone : homeward::kExitUsage;
  }
  catch (const std::exception &error) {
    std::fprintf(stderr, "homeward-calibrate: %s\n", error.what());
    return homeward::kExitFailed;
  }
  return status;
}
