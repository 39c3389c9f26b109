// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/protocol/sick.h>
#include <homeward/drivers/steady_clock.h>
#include <homeward/robot/laser_scanner.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace homeward
{

/** How a LMS-2xx is to measure. */
struct SickOptions
{
  int fieldOfView = 180; ///< degrees: 180 or 100
  int resolution = 100;  ///< hundredths of a degree: 100, 50 or (with 100 degrees only) 25
  int baud = 38400;      ///< speed to measure at: 9600, 19200 or 38400
  Duration answerTimeout = std::chrono::seconds(1);  ///< of an ordinary telegram
  Duration configTimeout = std::chrono::seconds(15); ///< of one that writes to its memory
  Duration silence = std::chrono::seconds(2); ///< robot time without a scan: it counts as gone
  double clockRate = 1.0;                     ///< see SteadyClock
};

/**
 * A SICK LMS-2xx on a serial line, in millimetres up to 32 m. One thread reads its scans and stamps
 * them with the time when their first byte left the scanner. The scanner's stored configuration is
 * written only where it differs.
 */
class SickLaser final : public LaserScanner
{
public:
  /**
   * Finds the scanner's speed, configures it and starts the measurement.
   * @throw DeviceError when none answers or it refuses; LogicError with options it cannot have
   */
  SickLaser(std::unique_ptr<ByteStream> stream, const SickOptions &options);

  /** Stops the measurement. */
  ~SickLaser() override;

  std::optional<Scan> scan() override;

private:
  void start();
  void findSpeed();
  void configure();
  std::optional<SickTelegram> ask(const Bytes &payload, std::uint8_t answer, Duration timeout);
  SickTelegram need(const Bytes &payload, std::uint8_t answer, Duration timeout,
                    const std::string &what);
  void run(const std::stop_token &stop);
  void take(const SickTelegram &telegram, Time now);

  SickOptions m_options;
  SteadyClock m_clock{m_options.clockRate};
  std::unique_ptr<ByteStream> m_stream;
  SickReader m_reader;

  std::mutex m_knowing;
  std::optional<Scan> m_scan;
  Time m_heard{};        ///< of the last scan, or of the start
  std::string m_failure; ///< why the thread ended

  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
