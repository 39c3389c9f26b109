// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"

namespace homeward
{

void addEvaluateCommand(CliCommand app)
{
  CliCommand evaluate = app.command("evaluate", "Measure against the truth");
  evaluate.requireCommand();
  addEvaluateHomingCommand(evaluate);
  addEvaluateArrivalCommand(evaluate);
  addEvaluatePlacesCommand(evaluate);
  addEvaluateRowsCommand(evaluate);
  addEvaluateMissionCommand(evaluate);
  addDataSetCommand(evaluate);
}

} // namespace homeward
