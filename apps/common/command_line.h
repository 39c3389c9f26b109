// SPDX-License-Identifier: GPL-3.0-or-later
// Commands and options of our programs. CLI11 parses them and stays behind this header: it takes
// five seconds in every source that includes it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI // NOLINT(readability-identifier-naming)
{
class App;
class Option;
} // namespace CLI

namespace homeward
{

/** Exit statuses of every program. */
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/** What is asked of one option. */
class CliOption
{
public:
  explicit CliOption(CLI::Option &option) : m_option(&option) {}

  CliOption &required();
  /** The help shows the value that its variable has now. */
  CliOption &showDefault();
  CliOption &between(int low, int high);
  CliOption &between(double low, double high);
  CliOption &positive();
  CliOption &oneOf(const std::vector<std::string> &values);
  /** So many values, at least and at most. */
  CliOption &count(int fewest, int most);
  CliOption &excludes(const std::string &option);
  CliOption &needs(const std::string &option);

private:
  CLI::Option *m_option;
};

/** A command of a program, or the program itself: a handle that is cheap to copy. */
class CliCommand
{
public:
  /** What all commands of a program share. */
  struct Shared
  {
    int status = kExitDone;                   ///< of what has run
    std::vector<const std::string *> outputs; ///< files to write
  };

  CliCommand(CLI::App &app, Shared &shared) : m_app(&app), m_shared(&shared) {}

  /** A command of this one. */
  CliCommand command(const std::string &name, const std::string &description);

  /** One of its commands must be given. */
  void requireCommand();

  /** What the help ends with. */
  void examples(const std::string &text);

  /**
   * @param names "name" for an argument by its place, else "--name" or "-n,--name"
   * @param value string, int, std::int64_t, std::size_t, double, or a vector of strings or doubles;
   *   left alone when the option is not given
   */
  template <typename Value>
  CliOption option(const std::string &names, Value &value, const std::string &description);

  /**
   * A file to write, where "-" is standard output: what is said goes to standard error then.
   * @param description ends with what "-" means
   */
  CliOption output(const std::string &names, std::string &file, const std::string &description);

  /** `--json FILE`. @param what the JSON holds, such as "a summary" */
  void json(std::string &file, const std::string &what);

  CliOption flag(const std::string &name, bool &value, const std::string &description);
  void flag(const std::string &name, std::function<void()> then, const std::string &description);

  /** A group of options, of which exactly one must be given. */
  CliCommand exactlyOneOf(const std::string &name, const std::string &description);

  /** Takes an option away again. */
  void remove(const std::string &option);

  /** What it does, once the options have their values, unless a command of it was given. */
  void run(std::function<int()> action);

protected:
  CLI::App &app() const { return *m_app; }

private:
  CLI::App *m_app;
  Shared *m_shared;
};

/** A program: its own options, its commands, and what all programs do alike. */
class Program : public CliCommand
{
public:
  Program(const std::string &name, const std::string &description);
  ~Program();
  Program(const Program &) = delete;
  Program &operator=(const Program &) = delete;

  /**
   * Parses the arguments and runs what they ask for. An error is one line on standard error.
   * @return exit status: kExitUsage for wrong options and ConfigError, kExitFailed for any other
   */
  int main(int argc, char **argv);

private:
  struct State;
  Program(std::unique_ptr<State> state);

  std::unique_ptr<State> m_state;
};

} // namespace homeward
