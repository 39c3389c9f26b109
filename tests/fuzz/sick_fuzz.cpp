// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/sick.h>

#include <cmath>
#include <cstdlib>

using namespace homeward;

namespace
{

void readTelegram(const SickTelegram &telegram)
{
  const auto scan = parseSickScan(telegram);
  if (!scan) {
    return;
  }
  if (scan->counts.size() <= 401 && parseSickScan(encodeSickScan(*scan)) != scan) {
    std::abort();
  }
  if (scan->counts.size() < 2) {
    return;
  }
  for (const int flagBits : {1, 2, 3}) {
    for (const float range : sickRanges(*scan, flagBits, kPi, Time{}).ranges) {
      if (!std::isnan(range) && !(range >= 0.0F)) {
        std::abort();
      }
    }
  }
}

} // namespace

/** A stream of bytes in pieces of the size that its first byte says, and a payload as it stands. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  if (size < 2) {
    return 0;
  }
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const std::size_t piece = data[0] % 64U + 1U;
  SickReader reader;
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
    reader.push(bytes.subspan(begin, std::min(piece, bytes.size() - begin)));
    while (const auto telegram = reader.next()) {
      readTelegram(*telegram);
    }
  }
  readTelegram({kSickScanner, Bytes(bytes.begin(), bytes.end())});
  return 0;
}
