// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "target_options.h"
#include "target_print.h"

#include <CLI/CLI.hpp>
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

void addTargetCommand(CLI::App &app, int &status)
{
  auto options = std::make_shared<PrintOptions>();
  CLI::App *command = app.add_subcommand("target", "Print a target to scale");
  command->footer(
      "Example: homeward-calibrate target --target charuco --columns 8 --rows 6 --pitch "
      "45 --paper a3 --pdf board.pdf\nPrint at 100 %, check the scale of 100 mm, glue it "
      "on something flat.");
  addTargetOptions(*command, options->target);
  auto *pdf = command->add_option("--pdf", options->pdf, "PDF to write (- for standard output)");
  auto *svg = command->add_option("--svg", options->svg, "SVG to write (- for standard output)");
  command->add_option("--paper", options->paper, "a4, a3, a2, a1, a0 or letter (the target's size)")
      ->check(CLI::IsMember({"a4", "a3", "a2", "a1", "a0", "letter"}));
  command->add_option("--json", options->json, "Write a summary as JSON (- for standard output)");
  command->callback([options, pdf, svg, &status] {
    if (pdf->count() == 0 && svg->count() == 0) {
      throw CLI::RequiredError("--pdf or --svg");
    }
    print(*options);
    status = kExitDone;
  });
}

} // namespace homeward
