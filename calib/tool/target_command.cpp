// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "target_options.h"
#include "target_print.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <memory>

namespace homeward
{
namespace
{

struct PrintOptions
{
  TargetOptions target;
  std::string pdf;
  std::string svg;
  std::string paper;
  std::string json;
};

void print(const PrintOptions &options)
{
  const Target target = options.target.target();
  if (!options.pdf.empty()) {
    writeText(options.pdf, printTarget(target, {TargetPage::Format::Pdf, options.paper}));
  }
  if (!options.svg.empty()) {
    writeText(options.svg, printTarget(target, {TargetPage::Format::Svg, options.paper}));
  }
  const TargetArt art = drawTarget(target);
  nlohmann::json json = jsonHeader("target");
  json["target"] = describe(target);
  json["width_m"] = art.width;
  json["height_m"] = art.height;
  writeJson(options.json, json);
}

} // namespace

void addTargetCommand(CliCommand app)
{
  auto options = std::make_shared<PrintOptions>();
  CliCommand command = app.command("target", "Print a target to scale");
  command.examples(
      "Example: homeward-calibrate target --target charuco --columns 8 --rows 6 --pitch "
      "45 --paper a2 --pdf board.pdf\nPrint at 100 %, check the scale of 100 mm, glue it "
      "on something flat.");
  addTargetOptions(command, options->target);
  command.output("--pdf", options->pdf, "PDF to write (- for standard output)");
  command.output("--svg", options->svg, "SVG to write (- for standard output)");
  command.option("--paper", options->paper, "a4, a3, a2, a1, a0 or letter (the target's size)")
      .oneOf({"a4", "a3", "a2", "a1", "a0", "letter"});
  command.json(options->json, "a summary");
  command.run([options] {
    if (options->pdf.empty() && options->svg.empty()) {
      throw ConfigError("--pdf or --svg is required; see --help");
    }
    print(*options);
    return kExitDone;
  });
}

} // namespace homeward
