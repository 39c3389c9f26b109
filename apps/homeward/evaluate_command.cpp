// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"

#include <CLI/CLI.hpp>

namespace homeward
{

void addEvaluateCommand(CLI::App &app, int &status)
{
  CLI::App *evaluate = app.add_subcommand("evaluate", "Measure against the truth");
  evaluate->require_subcommand(1);
  addEvaluateHomingCommand(*evaluate, status);
  addEvaluateArrivalCommand(*evaluate, status);
  addEvaluatePlacesCommand(*evaluate, status);
  addDataSetCommand(*evaluate, status);
}

} // namespace homeward
