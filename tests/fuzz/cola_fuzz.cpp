// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/cola.h>

#include <cmath>
#include <cstdlib>

using namespace homeward;

namespace
{

void readTelegram(std::string_view telegram)
{
  const auto scan = parseColaScan(telegram);
  if (!scan) {
    return;
  }
  if (parseColaScan(encodeColaScan(*scan)) != scan) {
    std::abort();
  }
  if (scan->angleStep == 0) {
    return;
  }
  for (const float range : colaRanges(*scan, 20.0, Time{}).ranges) {
    if (!std::isnan(range) && !(range >= 0.0F)) {
      std::abort();
    }
  }
}

} // namespace

/** A stream of bytes in pieces of the size that its first byte says, and a telegram as it stands.
 */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  if (size < 2) {
    return 0;
  }
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const std::size_t piece = data[0] % 64U + 1U;
  ColaReader reader;
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
    reader.push(bytes.subspan(begin, std::min(piece, bytes.size() - begin)));
    while (const auto telegram = reader.next()) {
      readTelegram(*telegram);
    }
  }
  readTelegram({reinterpret_cast<const char *>(bytes.data()), bytes.size()});
  return 0;
}
