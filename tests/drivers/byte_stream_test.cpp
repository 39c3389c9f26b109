// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>

#include "fake_device.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::HasSubstr;

std::string complaint(const std::string &address)
{
  try {
    openStream(address, 9600);
  }
  catch (const RuntimeError &error) {
    return error.what();
  }
  return {};
}

TEST(ByteStream, NoBytesAreNoneAndNotAnError)
{
  Line line = tcpLine();
  std::array<std::uint8_t, 4> buffer{};
  EXPECT_EQ(line.driver->read(buffer, std::chrono::milliseconds(1)), 0U);
  ::close(line.device);
  EXPECT_THROW(line.driver->read(buffer, kPatience), DeviceError);
}

TEST(ByteStream, WritingToAClosedSocketIsAnErrorAndNoSignal)
{
  Line line = tcpLine();
  ::close(line.device);
  const std::array<std::uint8_t, 4> bytes{};
  EXPECT_TRUE(soon([&] {
    try {
      line.driver->write(bytes);
      return false;
    }
    catch (const DeviceError &) {
      return true;
    }
  }));
}

TEST(ByteStream, SerialLinesAreRaw)
{
  Line line = serialLine();
  const std::unique_ptr<ByteStream> device = streamOver(line.device, "device");
  std::array<std::uint8_t, 256> all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<std::uint8_t>(i);
  }
  for (ByteStream *from : {device.get(), line.driver.get()}) {
    ByteStream *to = from == device.get() ? line.driver.get() : device.get();
    from->write(all);
    std::vector<std::uint8_t> got;
    std::array<std::uint8_t, 256> buffer{};
    while (got.size() < all.size()) {
      const std::size_t count = to->read(buffer, kPatience);
      ASSERT_GT(count, 0U);
      got.insert(got.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
    }
    EXPECT_TRUE(std::equal(all.begin(), all.end(), got.begin(), got.end()));
  }
}

TEST(ByteStream, AddressesThatLeadNowhereAreNamed)
{
  EXPECT_THAT(complaint("/dev/no_such_line"), HasSubstr("/dev/no_such_line"));
  EXPECT_THAT(complaint("/dev/null"), HasSubstr("not a serial line"));
  EXPECT_THAT(complaint("tcp:127.0.0.1:1"), HasSubstr("127.0.0.1:1: cannot connect"));
  for (const char *wrong :
       {"", "robot", "tcp:", "tcp:host", "tcp::80", "tcp:host:0", "tcp:host:x", "tcp:host:65536"}) {
    EXPECT_THROW(openStream(wrong, 9600), ConfigError) << wrong;
  }
}

TEST(ByteStream, OnlyUsualSpeeds)
{
  Line line = serialLine();
  EXPECT_NO_THROW(line.driver->setBaud(115200));
  EXPECT_THROW(line.driver->setBaud(12345), DeviceError);
  ::close(line.device);
}

} // namespace
} // namespace homeward
