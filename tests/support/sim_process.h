// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <csignal>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace homeward
{

/** A pioneer-sim in a process of its own, ended with this object. */
class SimProcess
{
public:
  /** Starts it and waits until it says where it can be reached. */
  explicit SimProcess(const std::vector<std::string> &arguments)
  {
    std::array<int, 2> said{};
    if (::pipe2(said.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error("no pipe");
    }
    m_process = ::fork();
    if (m_process == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL); // a test that dies leaves nobody behind
      ::dup2(said[1], STDOUT_FILENO);
      std::vector<char *> words{const_cast<char *>(HOMEWARD_PIONEER_SIM)};
      for (const std::string &argument : arguments) {
        words.push_back(const_cast<char *>(argument.c_str()));
      }
      words.push_back(nullptr);
      ::execv(HOMEWARD_PIONEER_SIM, words.data());
      ::_exit(127);
    }
    ::close(said[1]);
    std::string line;
    for (char letter = 0; ::read(said[0], &letter, 1) == 1 && letter != '\n';) {
      line.push_back(letter);
    }
    ::close(said[0]);
    m_where = nlohmann::json::parse(line);
  }
  ~SimProcess() { end(SIGTERM); }
  SimProcess(const SimProcess &) = delete;
  SimProcess &operator=(const SimProcess &) = delete;

  std::string arcosTcp() const
  {
    return "tcp:127.0.0.1:" + std::to_string(m_where["arcos_port"].get<int>());
  }
  std::string arcosPty() const { return m_where["arcos_pty"]; }
  std::string lmsPty() const { return m_where["lms_pty"]; }
  int httpPort() const { return m_where["http_port"]; }
  std::string stream() const
  {
    return "http://127.0.0.1:" + std::to_string(httpPort()) + "/camera.mjpg";
  }

  void signal(int number) const { ::kill(m_process, number); }

  /** Ends it with a signal. @return its exit status, or minus the signal that ended it */
  int end(int number)
  {
    if (m_process <= 0) {
      return m_ended;
    }
    int status = 0;
    ::kill(m_process, number);
    ::waitpid(m_process, &status, 0);
    m_process = -1;
    m_ended = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return m_ended;
  }

private:
  pid_t m_process = -1;
  int m_ended = 0;
  nlohmann::json m_where;
};

} // namespace homeward
