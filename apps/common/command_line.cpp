// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include "cli_documents.h"
#include "files.h"

#include <homeward/core/error.h>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace homeward
{

CliOption &CliOption::required()
{
  m_option->required();
  return *this;
}

CliOption &CliOption::showDefault()
{
  m_option->capture_default_str();
  return *this;
}

CliOption &CliOption::between(int low, int high)
{
  m_option->check(CLI::Range(low, high));
  return *this;
}

CliOption &CliOption::between(double low, double high)
{
  m_option->check(CLI::Range(low, high));
  return *this;
}

CliOption &CliOption::positive()
{
  m_option->check(CLI::PositiveNumber);
  return *this;
}

CliOption &CliOption::oneOf(const std::vector<std::string> &values)
{
  m_option->check(CLI::IsMember(values));
  return *this;
}

CliOption &CliOption::count(int fewest, int most)
{
  m_option->expected(fewest, most);
  return *this;
}

CliOption &CliOption::excludes(const std::string &option)
{
  m_option->excludes(option);
  return *this;
}

CliOption &CliOption::needs(const std::string &option)
{
  m_option->needs(option);
  return *this;
}

CliCommand CliCommand::command(const std::string &name, const std::string &description)
{
  return {*m_app->add_subcommand(name, description), *m_shared};
}

void CliCommand::requireCommand()
{
  m_app->require_subcommand(1);
}

void CliCommand::examples(const std::string &text)
{
  m_app->footer(text);
}

template <typename Value>
CliOption CliCommand::option(const std::string &names, Value &value, const std::string &description)
{
  return CliOption(*m_app->add_option(names, value, description));
}

template CliOption CliCommand::option(const std::string &, std::string &, const std::string &);
template CliOption CliCommand::option(const std::string &, int &, const std::string &);
template CliOption CliCommand::option(const std::string &, std::int64_t &, const std::string &);
template CliOption CliCommand::option(const std::string &, std::size_t &, const std::string &);
template CliOption CliCommand::option(const std::string &, double &, const std::string &);
template CliOption CliCommand::option(const std::string &, std::vector<std::string> &,
                                      const std::string &);
template CliOption CliCommand::option(const std::string &, std::vector<double> &,
                                      const std::string &);

CliOption CliCommand::output(const std::string &names, std::string &file,
                             const std::string &description)
{
  m_shared->outputs.push_back(&file);
  return option(names, file, description);
}

void CliCommand::json(std::string &file, const std::string &what)
{
  output("--json", file, "Write " + what + " as JSON (- for standard output)");
}

CliOption CliCommand::flag(const std::string &name, bool &value, const std::string &description)
{
  return CliOption(*m_app->add_flag(name, value, description));
}

void CliCommand::flag(const std::string &name, std::function<void()> then,
                      const std::string &description)
{
  m_app->add_flag_callback(name, std::move(then), description);
}

CliCommand CliCommand::exactlyOneOf(const std::string &name, const std::string &description)
{
  CLI::Option_group *group = m_app->add_option_group(name, description);
  group->require_option(1);
  return {*group, *m_shared};
}

void CliCommand::remove(const std::string &option)
{
  m_app->remove_option(m_app->get_option(option));
}

void CliCommand::run(std::function<int()> action)
{
  m_app->callback([app = m_app, shared = m_shared, action = std::move(action)] {
    if (!app->get_subcommands().empty()) {
      return;
    }
    const auto &outputs = shared->outputs;
    if (std::any_of(outputs.begin(), outputs.end(),
                    [](const auto *file) { return *file == "-"; })) {
      keepStandardOutputForFiles();
    }
    shared->status = action();
  });
}

struct Program::State
{
  CLI::App app;
  Shared shared;
};

Program::Program(std::unique_ptr<State> state)
    : CliCommand(state->app, state->shared), m_state(std::move(state))
{}

Program::Program(const std::string &name, const std::string &description)
    : Program(std::make_unique<State>())
{
  cv::setNumThreads(1); // results must not depend on how many threads share a sum
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); // ours is one line
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is a failed write, with its message
  app().name(name);
  app().description(description);
  app().require_subcommand(0, 1);
  app().set_version_flag("--version", HOMEWARD_VERSION);
}

Program::~Program() = default;

int Program::main(int argc, char **argv)
{
  if (const auto document = cliDocument(app(), HOMEWARD_VERSION, argc, argv)) {
    std::fputs(document->c_str(), stdout);
    return kExitDone;
  }
  const auto complain = [this](const std::exception &error) {
    std::fprintf(stderr, "%s: %s\n", app().get_name().c_str(), error.what());
  };
  try {
    app().parse(argc, argv);
  }
  catch (const CLI::ParseError &error) {
    return app().exit(error) == 0 ? kExitDone : kExitUsage;
  }
  catch (const ConfigError &error) {
    complain(error);
    return kExitUsage;
  }
  catch (const std::exception &error) {
    complain(error);
    return kExitFailed;
  }
  return m_state->shared.status;
}

} // namespace homeward
