// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "folder.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>

namespace homeward
{

/** What a run of the program left behind. */
struct ProgramRun
{
  int status = -1;
  std::string output; ///< standard output, then standard error
  std::string data;   ///< standard output alone
};

inline std::string fileText(const std::string &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/** Runs `homeward ARGUMENTS` in a shell, after what else the shell is to do. */
inline ProgramRun runProgram(const std::string &arguments, const std::string &before = "")
{
  const Folder folder;
  const std::string said = folder / "said";
  const std::string command = "( " + before + HOMEWARD_PROGRAM + " " + arguments + " ) 2>" + said;
  ProgramRun run;
  FILE *pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c)
  if (pipe == nullptr) {
    return run;
  }
  std::array<char, 4096> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    run.data.append(buffer.data(), got);
  }
  const int ended = pclose(pipe);
  run.output = run.data + fileText(said);
  run.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
  return run;
}

} // namespace homeward
