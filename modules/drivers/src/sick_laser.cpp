// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/sick_commands.h>
#include <homeward/drivers/sick_laser.h>
#include <homeward/drivers/steady_clock.h>

#include <array>
#include <utility>

namespace homeward
{
using namespace sick;

namespace
{

constexpr Duration kTick = std::chrono::milliseconds(50);

constexpr int kFlagBits = 1;
constexpr double kBitsPerByte = 10.0;
constexpr std::size_t kFrameSize = 6; ///< bytes of a telegram beside its payload

std::uint8_t baudCode(int baud)
{
  switch (baud) {
  case 9600:
    return kBaud9600;
  case 19200:
    return kBaud19200;
  case 38400:
    return kBaud38400;
  default:
    throw LogicError("SICK laser at " + std::to_string(baud) + " baud; 9600, 19200 or 38400");
  }
}

Bytes installationMode()
{
  Bytes payload{kMode, kInstallation};
  for (const char letter : std::string(kPassword)) {
    payload.push_back(static_cast<std::uint8_t>(letter));
  }
  return payload;
}

void checkOptions(const SickOptions &options)
{
  const bool wide = options.fieldOfView == 180;
  const bool step =
      options.resolution == 100 || options.resolution == 50 || (!wide && options.resolution == 25);
  if ((!wide && options.fieldOfView != 100) || !step) {
    throw LogicError("SICK laser with " + std::to_string(options.fieldOfView) + " degrees in " +
                     std::to_string(options.resolution) + " hundredths");
  }
}

} // namespace

SickLaser::SickLaser(std::unique_ptr<ByteStream> stream, const SickOptions &options)
    : m_options(options), m_stream(std::move(stream))
{
  checkOptions(m_options);
  findSpeed();
  configure();
  start();
}

SickLaser::~SickLaser()
{
  m_thread.request_stop();
  if (m_thread.joinable()) {
    m_thread.join();
  }
  try {
    m_stream->write(frameSick({kSickHost, {kMode, kOnRequest}}));
  }
  catch (const DeviceError &) { // it is gone, so it cannot be told
  }
}

std::optional<SickTelegram> SickLaser::ask(const Bytes &payload, std::uint8_t answer,
                                           Duration timeout)
{
  m_stream->write(frameSick({kSickHost, payload}));
  const SteadyClock clock;
  const Time deadline = clock.now() + timeout;
  std::array<std::uint8_t, 1024> buffer{};
  for (Time now = clock.now(); now < deadline; now = clock.now()) {
    m_reader.push(std::span(buffer).first(m_stream->read(buffer, deadline - now)));
    while (std::optional<SickTelegram> telegram = m_reader.next()) {
      if (telegram->address == kSickScanner && telegram->payload.front() == answer) {
        return telegram;
      }
    }
  }
  return std::nullopt;
}

SickTelegram SickLaser::need(const Bytes &payload, std::uint8_t answer, Duration timeout,
                             const std::string &what)
{
  std::optional<SickTelegram> telegram = ask(payload, answer, timeout);
  if (!telegram) {
    throw DeviceError("SICK laser: no answer to '" + what + "'");
  }
  return *std::move(telegram);
}

void SickLaser::findSpeed()
{
  for (const int baud : {m_options.baud, 9600, 38400, 19200}) {
    m_stream->setBaud(baud);
    if (!ask({kMode, kOnRequest}, kModeAnswer, m_options.answerTimeout)) {
      continue;
    }
    if (baud != m_options.baud) {
      need({kMode, baudCode(m_options.baud)}, kModeAnswer, m_options.answerTimeout, "set speed");
      m_stream->setBaud(m_options.baud);
    }
    return;
  }
  throw DeviceError("no SICK laser answers at 9600, 19200 or 38400 baud; is it on?");
}

void SickLaser::configure()
{
  const SickTelegram config =
      need({kGetConfig}, kGetConfigAnswer, m_options.answerTimeout, "get configuration");
  // The answer is F4, the block, a status byte.
  if (config.payload.size() < kUnitAt + 3) {
    throw DeviceError("SICK laser: its configuration has only " +
                      std::to_string(config.payload.size()) + " bytes");
  }
  Bytes block(config.payload.begin() + 1, config.payload.end() - 1);
  if (block[kMeasuringModeAt] != kThirtyTwoMetres || block[kUnitAt] != kMillimetres) {
    const SickTelegram entered =
        need(installationMode(), kModeAnswer, m_options.configTimeout, "enter installation mode");
    if (entered.payload.size() < 2 || entered.payload[1] != 0) {
      throw DeviceError("SICK laser: refuses the installation password");
    }
    block[kMeasuringModeAt] = kThirtyTwoMetres;
    block[kUnitAt] = kMillimetres;
    block.insert(block.begin(), kSetConfig);
    const SickTelegram set =
        need(block, kSetConfigAnswer, m_options.configTimeout, "set configuration");
    if (set.payload.size() < 2 || set.payload[1] != 1) {
      throw DeviceError("SICK laser: refuses millimetres up to 32 m");
    }
  }
  const auto angle = static_cast<std::uint8_t>(m_options.fieldOfView);
  const auto step = static_cast<std::uint8_t>(m_options.resolution);
  const SickTelegram variant = need({kVariant, angle, 0, step, 0}, kVariantAnswer,
                                    m_options.configTimeout, "set angle and resolution");
  if (variant.payload.size() < 2 || variant.payload[1] != 1) {
    throw DeviceError("SICK laser: refuses " + std::to_string(m_options.fieldOfView) +
                      " degrees in " + std::to_string(m_options.resolution) + " hundredths");
  }
}

void SickLaser::start()
{
  need({kMode, kContinuous}, kModeAnswer, m_options.answerTimeout, "start measuring");
  m_heard = m_clock.now();
  m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
}

void SickLaser::run(const std::stop_token &stop)
{
  std::array<std::uint8_t, 1024> buffer{};
  try {
    while (!stop.stop_requested()) {
      m_reader.push(std::span(buffer).first(m_stream->read(buffer, kTick)));
      const Time now = m_clock.now();
      while (const std::optional<SickTelegram> telegram = m_reader.next()) {
        take(*telegram, now);
      }
    }
  }
  catch (const std::exception &error) {
    const std::lock_guard lock(m_knowing);
    m_failure = error.what();
  }
}

void SickLaser::take(const SickTelegram &telegram, Time now)
{
  const int expected = m_options.fieldOfView * 100 / m_options.resolution + 1;
  const std::optional<SickScan> scan = parseSickScan(telegram);
  if (!scan || !scan->whole || std::cmp_not_equal(scan->counts.size(), expected)) {
    return; // another telegram, or a measurement from before the configuration
  }
  const double onTheLine =
      kBitsPerByte * static_cast<double>(telegram.payload.size() + kFrameSize) / m_options.baud;
  const std::lock_guard lock(m_knowing);
  m_scan =
      sickRanges(*scan, kFlagBits, radians(m_options.fieldOfView), now - fromSeconds(onTheLine));
  m_heard = now;
}

std::optional<Scan> SickLaser::scan()
{
  const std::lock_guard lock(m_knowing);
  if (!m_failure.empty()) {
    throw DeviceError("SICK laser is lost: " + m_failure);
  }
  const Duration age = m_clock.now() - m_heard;
  if (age > m_options.silence) {
    throw DeviceError("SICK laser has been silent for " + std::to_string(toSeconds(age)) + " s");
  }
  return m_scan;
}

} // namespace homeward
