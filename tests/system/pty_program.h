// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <poll.h>
#include <pty.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <utmp.h>
#include <vector>

namespace homeward
{

/** The program in the foreground of a terminal of its own. */
class PtyProgram
{
public:
  explicit PtyProgram(const std::vector<std::string> &arguments)
  {
    ::openpty(&m_device, &m_terminal, nullptr, nullptr, nullptr);
    m_process = ::fork();
    if (m_process == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::close(m_device);
      ::login_tty(m_terminal);
      std::vector<char *> words{const_cast<char *>(HOMEWARD_PROGRAM)};
      for (const std::string &argument : arguments) {
        words.push_back(const_cast<char *>(argument.c_str()));
      }
      words.push_back(nullptr);
      ::execv(HOMEWARD_PROGRAM, words.data());
      ::_exit(127);
    }
  }
  ~PtyProgram()
  {
    if (m_process > 0) {
      ::kill(m_process, SIGKILL);
      ::waitpid(m_process, nullptr, 0);
    }
    hangUp();
  }
  PtyProgram(const PtyProgram &) = delete;
  PtyProgram &operator=(const PtyProgram &) = delete;

  /** Presses keys. */
  void type(const std::string &keys)
  {
    const ssize_t written = ::write(m_device, keys.data(), keys.size());
    static_cast<void>(written);
  }

  void signal(int number) const { ::kill(m_process, number); }

  /** Pulls the terminal's plug. */
  void hangUp()
  {
    for (int *end : {&m_terminal, &m_device}) {
      if (*end >= 0) {
        ::close(*end);
        *end = -1;
      }
    }
  }

  /** Whether keys need Enter and are echoed. */
  bool isCooked() const
  {
    termios line{};
    ::tcgetattr(m_terminal, &line);
    return (line.c_lflag & ICANON) != 0 && (line.c_lflag & ECHO) != 0;
  }

  /** Everything said so far. */
  const std::string &output()
  {
    pollfd waiting{m_device, POLLIN, 0};
    while (m_device >= 0 && ::poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLIN) != 0) {
      std::array<char, 4096> buffer{};
      const ssize_t count = ::read(m_device, buffer.data(), buffer.size());
      if (count <= 0) {
        break;
      }
      m_output.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return m_output;
  }

  /** Waits until it holds, a minute at most; listens, lest the program waits to be heard. */
  bool eventually(const std::function<bool()> &condition)
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) {
        return false;
      }
      output();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }

  bool says(const std::string &text)
  {
    return eventually([&] { return output().find(text) != std::string::npos; });
  }

  /** Waits for its end. @return its exit status, or minus the signal that ended it; 999: it goes on
   */
  int status()
  {
    int ended = 0;
    if (!eventually([&] { return ::waitpid(m_process, &ended, WNOHANG) == m_process; })) {
      return 999;
    }
    m_process = -1;
    output();
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : -WTERMSIG(ended);
  }

private:
  int m_device = -1;
  int m_terminal = -1; ///< kept open, so that its settings can be read
  pid_t m_process = -1;
  std::string m_output;
};

} // namespace homeward
