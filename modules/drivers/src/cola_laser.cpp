// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/cola_laser.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <utility>

namespace homeward
{
namespace
{

/** How long the thread waits for bytes before it looks whether it is to end. */
constexpr Duration kTick = std::chrono::milliseconds(20);

/** The second word of a telegram: what it is about. */
std::string subject(const std::string &telegram)
{
  const std::size_t begin = telegram.find(' ');
  return begin == std::string::npos
             ? ""
             : telegram.substr(begin + 1, telegram.find(' ', begin + 1) - begin - 1);
}

} // namespace

ColaLaser::ColaLaser(std::unique_ptr<ByteStream> stream, const ColaOptions &options)
    : m_options(options), m_stream(std::move(stream))
{
  if (m_options.resolution != 25 && m_options.resolution != 50) {
    throw LogicError("LMS1xx with a resolution of " + std::to_string(m_options.resolution) +
                     " hundredths of a degree; 25 or 50");
  }
  configure();
  awaitReadiness();
  order("sEN LMDscandata 1", "sEA LMDscandata 1");
  m_heard = m_clock.now();
  m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
}

ColaLaser::~ColaLaser()
{
  m_thread.request_stop();
  if (m_thread.joinable()) {
    m_thread.join();
  }
  try {
    m_stream->write(frameCola("sEN LMDscandata 0"));
  }
  catch (const DeviceError &) { // it is gone, so it cannot be told
  }
}

std::string ColaLaser::ask(const std::string &telegram)
{
  m_stream->write(frameCola(telegram));
  const SteadyClock clock;
  const Time deadline = clock.now() + m_options.answerTimeout;
  std::array<std::uint8_t, 4096> buffer{};
  for (Time now = clock.now(); now < deadline; now = clock.now()) {
    m_reader.push(std::span(buffer).first(m_stream->read(buffer, deadline - now)));
    while (const std::optional<std::string> answer = m_reader.next()) {
      // A stream that somebody else started may still run.
      if (answer->starts_with("sFA") ||
          (subject(*answer) == subject(telegram) && !answer->starts_with("sSN"))) {
        return *answer;
      }
    }
  }
  throw DeviceError("LMS1xx: no answer to '" + telegram + "'; is this its CoLa port, in ASCII?");
}

void ColaLaser::order(const std::string &telegram, const std::string &answer)
{
  const std::string said = ask(telegram);
  if (!said.starts_with(answer)) {
    throw DeviceError("LMS1xx: refuses '" + telegram + "': '" + said + "'");
  }
}

void ColaLaser::configure()
{
  // The password of an authorised client, as the telegram listing has it.
  order("sMN SetAccessMode 03 F4724744", "sAN SetAccessMode 1");
  const std::string step = std::to_string(100 * m_options.resolution);
  order("sMN mLMPsetscancfg +" + step + " +1 +" + step + " -450000 +2250000",
        "sAN mLMPsetscancfg 0"); // rate in hundredths of a hertz, step and angles in 1/10000 degree
  order("sWN LMDscandatacfg 01 00 0 1 0 00 00 0 0 0 0 +1", "sWA LMDscandatacfg");
  order("sMN Run", "sAN Run 1");
}

void ColaLaser::awaitReadiness()
{
  constexpr Duration kPause = std::chrono::milliseconds(100);
  SteadyClock clock;
  const Time deadline = clock.now() + m_options.warmUp;
  while (!ask("sRN STlms").starts_with("sRA STlms 7")) {
    if (clock.now() > deadline) {
      throw DeviceError("LMS1xx: answers but does not get ready to measure");
    }
    clock.sleepUntil(clock.now() + kPause);
  }
}

void ColaLaser::run(const std::stop_token &stop)
{
  std::array<std::uint8_t, 4096> buffer{};
  try {
    while (!stop.stop_requested()) {
      m_reader.push(std::span(buffer).first(m_stream->read(buffer, kTick)));
      const Time now = m_clock.now();
      while (const std::optional<std::string> telegram = m_reader.next()) {
        if (const std::optional<ColaScan> scan = parseColaScan(*telegram)) {
          take(*scan, now);
        }
      }
    }
  }
  catch (const std::exception &error) {
    const std::lock_guard lock(m_knowing);
    m_failure = error.what();
  }
}

void ColaLaser::take(const ColaScan &scan, Time now)
{
  if (scan.angleStep != 100 * m_options.resolution || scan.counts.empty()) {
    return; // a measurement from before the configuration
  }
  constexpr std::uint32_t kMost = 100'000; // microseconds that sweep and sending may take
  const std::uint32_t age = std::min(scan.sent - scan.begun, kMost);
  const std::lock_guard lock(m_knowing);
  m_scan = colaRanges(scan, m_options.rangeMax, now - std::chrono::microseconds(age));
  m_heard = now;
}

std::optional<Scan> ColaLaser::scan()
{
  const std::lock_guard lock(m_knowing);
  if (!m_failure.empty()) {
    throw DeviceError("LMS1xx is lost: " + m_failure);
  }
  const Duration age = m_clock.now() - m_heard;
  if (age > m_options.silence) {
    throw DeviceError("LMS1xx has been silent for " + std::to_string(toSeconds(age)) + " s");
  }
  return m_scan;
}

} // namespace homeward
