// SPDX-License-Identifier: GPL-3.0-or-later
#include "lms_server.h"

#include "scan_samples.h"

#include <homeward/core/angle.h>
#include <homeward/drivers/protocol/sick_commands.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace homeward
{
using namespace sick;

namespace
{

constexpr std::uint8_t kFine = 0x10;     ///< status byte behind every answer
constexpr std::uint8_t kNotKnown = 0x92; ///< answers what it does not understand
constexpr std::size_t kBlockSize = 34;   ///< of the configuration
constexpr std::size_t kStatusSize = 152; ///< of its answer, status byte left out
constexpr std::string_view kName = "LMS200;301063 V02.10";
constexpr double kBitsPerByte = 10.0;
constexpr std::size_t kQueueLimit = 16384; ///< bytes; who asks faster than the line answers waits

void append(Bytes &payload, std::string_view text)
{
  payload.insert(payload.end(), text.begin(), text.end());
}

std::uint8_t low(int value)
{
  return static_cast<std::uint8_t>(value & 0xFF);
}

} // namespace

LmsServer::LmsServer() : m_block(kBlockSize, 0)
{
  m_block[2] = 70; // how much a reading must stand out
}

void LmsServer::receive(std::span<const std::uint8_t> bytes, int lineBaud)
{
  if (lineBaud != m_baud) {
    return; // noise to it
  }
  m_reader.push(bytes);
  while (const std::optional<SickTelegram> telegram = m_reader.next()) {
    if (telegram->address == kSickHost) {
      obey(telegram->payload);
    }
  }
}

void LmsServer::obey(const Bytes &payload)
{
  switch (payload.front()) {
  case kReset:
    answer({kResetAnswer});
    restart();
    break;
  case kMode:
    setMode(payload);
    break;
  case kStatus:
    answer(status());
    break;
  case kType: {
    Bytes type{kTypeAnswer};
    append(type, kName);
    answer(type);
    break;
  }
  case kVariant:
    setVariant(payload);
    break;
  case kGetConfig: {
    Bytes config{kGetConfigAnswer};
    config.insert(config.end(), m_block.begin(), m_block.end());
    answer(config);
    break;
  }
  case kSetConfig:
    configure(payload);
    break;
  default:
    answer({kNotKnown});
    break;
  }
}

void LmsServer::setMode(const Bytes &payload)
{
  constexpr std::uint8_t kDone = 0;
  constexpr std::uint8_t kBadPassword = 1;
  constexpr std::uint8_t kFault = 2;
  const std::uint8_t mode = payload.size() > 1 ? payload[1] : std::uint8_t{0xFF};
  switch (mode) {
  case kInstallation:
    m_installing =
        std::equal(payload.begin() + 2, payload.end(), kPassword, kPassword + sizeof kPassword - 1);
    m_measuring = false;
    answer({kModeAnswer, m_installing ? kDone : kBadPassword});
    return;
  case kContinuous:
  case kOnRequest:
    m_measuring = mode == kContinuous;
    m_installing = false;
    break;
  case kBaud9600:
    setBaud(9600);
    break;
  case kBaud19200:
    setBaud(19200);
    break;
  case kBaud38400:
    setBaud(38400);
    break;
  default:
    answer({kModeAnswer, kFault});
    return;
  }
  answer({kModeAnswer, kDone});
}

void LmsServer::setBaud(int baud)
{
  m_nextBaud = baud;
}

void LmsServer::configure(const Bytes &payload)
{
  if (m_installing) {
    const std::size_t size = std::min(payload.size() - 1, m_block.size());
    std::copy_n(payload.begin() + 1, size, m_block.begin());
  }
  Bytes config{kSetConfigAnswer, static_cast<std::uint8_t>(m_installing ? 1 : 0)};
  config.insert(config.end(), m_block.begin(), m_block.end());
  answer(config);
}

void LmsServer::setVariant(const Bytes &payload)
{
  bool done = false;
  if (payload.size() >= 5) {
    const int angle = payload[1] | payload[2] << 8;
    const int resolution = payload[3] | payload[4] << 8;
    const bool fine = angle == 100 && resolution == 25;
    done = (angle == 180 || angle == 100) && (resolution == 100 || resolution == 50 || fine);
    if (done) {
      m_fieldOfView = angle;
      m_resolution = resolution;
      m_measuring = false;
    }
  }
  answer({kVariantAnswer, static_cast<std::uint8_t>(done ? 1 : 0), low(m_fieldOfView), 0,
          low(m_resolution), 0});
}

void LmsServer::restart()
{
  m_measuring = false;
  m_installing = false;
  setBaud(9600);
  Bytes awake{kPowerOn};
  append(awake, kName);
  answer(awake);
}

void LmsServer::answer(Bytes payload)
{
  const bool acknowledged = payload.front() != kPowerOn;
  if (acknowledged) {
    send(std::array{kSickAck});
  }
  payload.push_back(kFine);
  send(frameSick({kSickScanner, std::move(payload)}));
}

void LmsServer::send(std::span<const std::uint8_t> bytes)
{
  if (m_queue.size() < kQueueLimit) {
    m_queue.insert(m_queue.end(), bytes.begin(), bytes.end());
  }
}

Bytes LmsServer::step(Duration span, LaserScanner &laser)
{
  if (m_queue.empty() && m_measuring) {
    if (const std::optional<Scan> scan = laser.scan()) {
      measure(*scan);
    }
  }
  m_credit += toSeconds(span) * m_baud / kBitsPerByte;
  const auto count =
      static_cast<std::ptrdiff_t>(std::min(static_cast<double>(m_queue.size()), m_credit));
  const Bytes leaving(m_queue.begin(), m_queue.begin() + count);
  m_queue.erase(m_queue.begin(), m_queue.begin() + count);
  m_credit = m_queue.empty() && !m_measuring ? 0.0 : m_credit - static_cast<double>(count);
  if (m_queue.empty()) {
    m_baud = m_nextBaud;
  }
  return leaving;
}

void LmsServer::measure(const Scan &scan)
{
  const std::uint8_t mode = m_block[kMeasuringModeAt];
  const double unit = m_block[kUnitAt] == kMillimetres ? 0.001 : 0.01;
  const auto mask = static_cast<std::uint16_t>(0xFFFFU >> static_cast<unsigned>(flagBits(mode)));
  // The nine highest counts are words: "beyond the range" is the lowest, "no echo" one above.
  const RangeWords words{static_cast<std::uint16_t>(mask - 7),
                         static_cast<std::uint16_t>(mask - 8)};
  const auto count = static_cast<std::size_t>(m_fieldOfView * 100 / m_resolution + 1);
  send(frameSick(encodeSickScan({unit, true,
                                 sampleScan(scan, -radians(m_fieldOfView) / 2.0,
                                            radians(m_resolution / 100.0), count, unit, words),
                                 kFine})));
}

Bytes LmsServer::status() const
{
  Bytes payload(kStatusSize, 0);
  payload[0] = kStatusAnswer;
  const std::string_view version = "V02.10 ";
  std::copy(version.begin(), version.end(), payload.begin() + 1);
  payload[8] = m_measuring ? kContinuous : kOnRequest;
  payload[102] = m_block[kMeasuringModeAt];
  payload[107] = low(m_fieldOfView);
  payload[109] = low(m_resolution);
  payload[122] = m_block[kUnitAt];
  std::copy(version.begin(), version.end(), payload.begin() + 124);
  return payload;
}

} // namespace homeward
