// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/sick_laser.h>
#include <homeward/drivers/steady_clock.h>

#include <array>
#include <utility>

namespace homeward
{
namespace
{

constexpr Duration kTick = std::chrono::milliseconds(50);

// Commands and answers.
constexpr std::uint8_t kMode = 0x20;
constexpr std::uint8_t kModeAnswer = 0xA0;
constexpr std::uint8_t kGetConfig = 0x74;
constexpr std::uint8_t kGetConfigAnswer = 0xF4;
constexpr std::uint8_t kSetConfig = 0x77;
constexpr std::uint8_t kSetConfigAnswer = 0xF7;
constexpr std::uint8_t kVariant = 0x3B;
constexpr std::uint8_t kVariantAnswer = 0xBB;

// Second byte of kMode.
constexpr std::uint8_t kInstallation = 0x00;
constexpr std::uint8_t kContinuous = 0x24;
constexpr std::uint8_t kOnRequest = 0x25;

// Places in the block of the configuration, and what is wanted there.
constexpr std::size_t kMeasuringModeAt = 5;
constexpr std::size_t kUnitAt = 6;
constexpr std::uint8_t kThirtyTwoMetres = 0x06; ///< one flag bit: field A
constexpr std::uint8_t kMillimetres = 0x01;
constexpr int kFlagBits = 1;

std::uint8_t baudCode(int baud)
{
  switch (baud) {
  case 9600:
    return 0x42;
  case 19200:
    return 0x41;
  case 38400:
    return 0x40;
  default:
    throw LogicError("SICK laser at " + std::to_string(baud) + " baud; 9600, 19200 or 38400");
  }
}

Bytes installationMode()
{
  Bytes payload{kMode, kInstallation};
  for (const char letter : std::string("SICK_LMS")) {
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
  m_heard = SteadyClock().now();
  m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
}

void SickLaser::run(const std::stop_token &stop)
{
  std::array<std::uint8_t, 1024> buffer{};
  try {
    while (!stop.stop_requested()) {
      m_reader.push(std::span(buffer).first(m_stream->read(buffer, kTick)));
      const Time now = SteadyClock().now();
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
  const std::lock_guard lock(m_knowing);
  m_scan = sickRanges(*scan, kFlagBits, radians(m_options.fieldOfView), now);
  m_heard = now;
}

std::optional<Scan> SickLaser::scan()
{
  const std::lock_guard lock(m_knowing);
  if (!m_failure.empty()) {
    throw DeviceError("SICK laser is lost: " + m_failure);
  }
  const Duration age = SteadyClock().now() - m_heard;
  if (age > m_options.silence) {
    throw DeviceError("SICK laser has been silent for " + std::to_string(toSeconds(age)) + " s");
  }
  return m_scan;
}

} // namespace homeward
