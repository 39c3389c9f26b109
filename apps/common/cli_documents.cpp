// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli_documents.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace homeward
{
namespace
{

std::vector<const CLI::App *> subcommands(const CLI::App &command)
{
  // A group of options is an app without a name.
  return command.get_subcommands([](const CLI::App *sub) { return !sub->get_name().empty(); });
}

/** Text that man takes as it stands. */
std::string escaped(const std::string &text)
{
  std::string result;
  bool lineBegins = true;
  for (const char c : text) {
    if (lineBegins && (c == '.' || c == '\'')) {
      result += "\\&";
    }
    if (c == '\\') {
      result += "\\e";
    }
    else if (c == '-') {
      result += "\\-";
    }
    else {
      result += c;
    }
    lineBegins = c == '\n';
  }
  return result;
}

void writeOptions(const CLI::App &command, std::ostream &out)
{
  const CLI::Formatter formatter;
  for (const CLI::Option *option : command.get_options()) {
    const bool positional = option->get_positional();
    out << ".TP\n\\fB" << escaped(formatter.make_option_name(option, positional)) << "\\fR"
        << escaped(formatter.make_option_opts(option)) << '\n'
        << escaped(formatter.make_option_desc(option)) << '\n';
  }
}

/** Sections of the subcommands of a command, and of theirs. @param path its full name */
void writeSubcommands(const CLI::App &command, const std::string &path, std::ostream &out)
{
  for (const CLI::App *sub : subcommands(command)) {
    const std::string name = path + " " + sub->get_name();
    out << ".SS \"" << escaped(name) << "\"\n" << escaped(sub->get_description()) << ".\n";
    writeOptions(*sub, out);
    if (!sub->get_footer().empty()) {
      out << ".PP\n.nf\n" << escaped(sub->get_footer()) << "\n.fi\n";
    }
    writeSubcommands(*sub, name, out);
  }
}

/** What begins with a dash, as typed. */
std::string optionWords(const CLI::App &command)
{
  std::string words;
  for (const CLI::Option *option : command.get_options()) {
    for (const std::string &name : option->get_lnames()) {
      words += "--" + name + " ";
    }
    for (const std::string &name : option->get_snames()) {
      words += "-" + name + " ";
    }
  }
  return words;
}

/** Lines that fill the tables `subcommands` and `options` of the script, by the words typed so far.
 */
void writeTables(const CLI::App &command, const std::string &path, std::ostream &out)
{
  std::string names;
  for (const CLI::App *sub : subcommands(command)) {
    names += sub->get_name() + " ";
  }
  out << "  subcommands[\"" << path << "\"]=\"" << names << "\"\n"
      << "  options[\"" << path << "\"]=\"" << optionWords(command) << "\"\n";
  for (const CLI::App *sub : subcommands(command)) {
    writeTables(*sub, path + " " + sub->get_name(), out);
  }
}

/** The manual page of a program and all its subcommands, as man(7) source. */
std::string manPage(const CLI::App &program, const std::string &version)
{
  const std::string &name = program.get_name();
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string summary = program.get_description();
  summary.erase(summary.find_last_not_of('.') + 1);
  std::ostringstream out;
  out << ".TH " << escaped(title) << " 1 \"\" \"Homeward " << version
      << "\" \"User Commands\"\n.ad l\n"
      << ".SH NAME\n"
      << escaped(name) << " \\- " << escaped(summary) << "\n.SH SYNOPSIS\n.B " << escaped(name)
      << '\n';
  const bool commands = !subcommands(program).empty();
  out << (commands ? "[COMMAND] [OPTIONS]\n" : "[OPTIONS]\n") << ".SH OPTIONS\n";
  writeOptions(program, out);
  if (!program.get_footer().empty()) {
    out << ".SH EXAMPLES\n.nf\n" << escaped(program.get_footer()) << "\n.fi\n";
  }
  if (commands) {
    out << ".SH COMMANDS\n";
    writeSubcommands(program, name, out);
  }
  out << ".SH EXIT STATUS\n0 done, 1 failed with a reason, 2 wrong options or files.\n";
  return out.str();
}

/** A script that completes a program's subcommands, options and files in bash. */
std::string bashCompletion(const CLI::App &program)
{
  const std::string &name = program.get_name();
  std::string function = "_" + name;
  std::replace(function.begin(), function.end(), '-', '_');
  std::ostringstream out;
  out << "# Completes the arguments of " << name << " in bash.\n"
      << function << "()\n{\n  local -A subcommands options\n";
  writeTables(program, name, out);
  out << "  local typed=${COMP_WORDS[COMP_CWORD]} path=" << name << " i\n"
      << R"(  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ -n ${options["$path ${COMP_WORDS[i]}"]-} ]]; then
      path+=" ${COMP_WORDS[i]}"
    fi
  done
  if [[ $typed == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${options[$path]}" -- "$typed")
  else
    mapfile -t COMPREPLY < <(compgen -W "${subcommands[$path]}" -- "$typed"; compgen -f -- "$typed")
  fi
}
)"
      << "complete -o filenames -F " << function << ' ' << name << '\n';
  return out.str();
}

} // namespace

std::optional<std::string> cliDocument(const CLI::App &program, const std::string &version,
                                       int argc, char **argv)
{
  const std::string argument = argc == 2 ? argv[1] : "";
  if (argument == "--man") {
    return manPage(program, version);
  }
  if (argument == "--completion") {
    return bashCompletion(program);
  }
  return std::nullopt;
}

} // namespace homeward
