// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/protocol/cola.h>
#include <homeward/drivers/steady_clock.h>
#include <homeward/robot/laser_scanner.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace homeward
{

/** How a LMS1xx is to measure. */
struct ColaOptions
{
  int resolution = 50;    ///< hundredths of a degree: 50 (50 Hz) or 25 (25 Hz)
  double rangeMax = 20.0; ///< metres
  Duration answerTimeout = std::chrono::seconds(1); ///< of a telegram
  Duration warmUp = std::chrono::seconds(60);       ///< until its mirror turns as it should
  Duration silence = std::chrono::seconds(2); ///< robot time without a scan: it counts as gone
  double clockRate = 1.0;                     ///< see SteadyClock
};

/**
 * A SICK LMS1xx on Ethernet, 270 degrees. One thread reads its scans and stamps them with the time
 * when their sweep began. What it is told holds until it is switched off; its memory is not
 * written.
 */
class ColaLaser final : public LaserScanner
{
public:
  /**
   * Configures the scanner, waits until it is ready and starts the stream.
   * @throw DeviceError when none answers or it refuses; LogicError with options it cannot have
   */
  ColaLaser(std::unique_ptr<ByteStream> stream, const ColaOptions &options);

  /** Stops the stream. */
  ~ColaLaser() override;

  std::optional<Scan> scan() override;

private:
  void configure();
  void awaitReadiness();
  std::string ask(const std::string &telegram);
  void order(const std::string &telegram, const std::string &answer);
  void run(const std::stop_token &stop);
  void take(const ColaScan &scan, Time now);

  ColaOptions m_options;
  SteadyClock m_clock{m_options.clockRate};
  std::unique_ptr<ByteStream> m_stream;
  ColaReader m_reader;

  std::mutex m_knowing;
  std::optional<Scan> m_scan;
  Time m_heard{};        ///< of the last scan, or of the start
  std::string m_failure; ///< why the thread ended

  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
