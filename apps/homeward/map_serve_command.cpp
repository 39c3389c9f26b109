// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "dashboard.h"

#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct ServeArguments
{
  std::string map;
  std::string address = "0";
};

int serve(const ServeArguments &arguments)
{
  MapFile file = MapFile::open(arguments.map);
  Dashboard dashboard(arguments.address, false);
  std::printf("open %s\n", dashboard.url().c_str());
  std::fflush(stdout);
  std::vector<std::string> log;
  for (const LogLine &line : file.log()) {
    log.push_back(line.text);
  }
  dashboard.follow(file, log);
  dashboard.await(file, "a finished map", false);
  file.close();
  return kExitDone;
}

} // namespace

void addMapServeCommand(CliCommand map)
{
  auto arguments = std::make_shared<ServeArguments>();
  CliCommand command = map.command("serve", "Show it in a browser, and change it there");
  command.examples("Example: homeward map serve lab.hwm --port 8080");
  command.option("map", arguments->map, "Map file").required();
  command.option("--port", arguments->address, "[HOST:]PORT of the page; 0: any port")
      .showDefault();
  command.run([arguments] { return serve(*arguments); });
}

} // namespace homeward
