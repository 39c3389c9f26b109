// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/bag/bag_repair.h>

#include <homeward/core/error.h>

#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The format: http://wiki.ros.org/Bags/Format/2.0
namespace homeward
{
namespace
{

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr char kMessage = 2;
constexpr char kHeader = 3;
constexpr char kIndex = 4;
constexpr char kChunk = 5;
constexpr char kChunkInfo = 6;
constexpr char kConnection = 7;

/** Fields of a record's header, by name. */
using Fields = std::map<std::string, std::string, std::less<>>;

template <class Number> Number numberFrom(std::string_view bytes)
{
  Number number{};
  if (bytes.size() < sizeof number) {
    throw StoreError("a number is cut off");
  }
  std::memcpy(&number, bytes.data(), sizeof number); // little-endian, as the machines are
  return number;
}

template <class Number> std::string toBytes(Number number)
{
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

Fields fieldsFrom(std::string_view bytes)
{
  Fields fields;
  while (!bytes.empty()) {
    const auto length = numberFrom<std::uint32_t>(bytes);
    const std::string_view field = bytes.substr(4, length);
    const std::size_t equals = field.find('=');
    if (field.size() < length || equals == std::string_view::npos) {
      throw StoreError("a field of a record is cut off");
    }
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
    bytes.remove_prefix(4 + std::size_t{length});
  }
  return fields;
}

/** @throw StoreError when there is no such field */
const std::string &field(const Fields &fields, std::string_view name)
{
  const auto found = fields.find(name);
  if (found == fields.end()) {
    throw StoreError("a record has no field " + std::string(name));
  }
  return found->second;
}

char kindOf(const Fields &fields)
{
  return numberFrom<char>(field(fields, "op"));
}

std::string withLength(const std::string &bytes)
{
  return toBytes(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

std::string record(const Fields &fields, const std::string &data)
{
  std::string header;
  for (const auto &[name, value] : fields) {
    std::string named = name;
    named += '=';
    named += value;
    header += withLength(named);
  }
  return withLength(header) + withLength(data);
}

/** Where messages of one connection are in a chunk. */
struct Index
{
  std::uint32_t count = 0;
  std::string entries; ///< time and offset of each
};

/** A closed chunk. */
struct Chunk
{
  std::uint64_t begin = 0; ///< in the file
  std::uint64_t end = 0;   ///< in the file
  std::string first;       ///< time, as in the file
  std::string last;
  std::map<std::uint32_t, Index> indexes; ///< by connection
};

/** Seconds, then nanoseconds: in this order times compare. */
std::uint64_t order(const std::string &time)
{
  return (std::uint64_t{numberFrom<std::uint32_t>(time)} << 32U) |
         numberFrom<std::uint32_t>(std::string_view(time).substr(4));
}

class Repair
{
public:
  explicit Repair(const std::filesystem::path &path)
      : m_path(path), m_file(path, std::ios::in | std::ios::out | std::ios::binary)
  {
    if (!m_file) {
      throw StoreError("it cannot be opened for writing");
    }
    m_size = std::filesystem::file_size(path);
  }

  BagRepair run()
  {
    std::string version(kVersion.size(), '\0');
    m_file.read(version.data(), static_cast<std::streamsize>(version.size()));
    if (!m_file || version != kVersion) {
      throw StoreError("it is no ROS 1 bag of version 2.0");
    }
    if (numberFrom<std::uint64_t>(field(header(), "index_pos")) != 0) {
      return {};
    }
    readChunks();
    if (m_chunks.empty()) {
      throw StoreError("no chunk of it was closed: there is nothing to keep");
    }
    BagRepair done{true, m_chunks.size(), m_messages, m_size - m_chunks.back().end};
    write();
    return done;
  }

private:
  /** The bytes of a part of a record, which begins with their number; nothing where it is cut off.
   */
  std::optional<std::string> part()
  {
    char length[4];
    m_file.read(length, sizeof length);
    if (!m_file) {
      return std::nullopt;
    }
    const auto bytes = numberFrom<std::uint32_t>({length, sizeof length});
    if (bytes > m_size) {
      return std::nullopt;
    }
    std::string read(bytes, '\0');
    m_file.read(read.data(), bytes);
    return m_file ? std::optional(read) : std::nullopt;
  }

  /** Of the bag. */
  Fields header()
  {
    const std::optional<std::string> fields = part();
    if (!fields || !part()) {
      throw StoreError("its header is cut off");
    }
    Fields read = fieldsFrom(*fields);
    if (kindOf(read) != kHeader) {
      throw StoreError("it does not begin with a header");
    }
    return read;
  }

  void readChunks()
  {
    while (true) {
      const auto begin = static_cast<std::uint64_t>(m_file.tellg());
      const std::optional<std::string> head = part();
      const std::optional<Fields> fields = head ? std::optional(fieldsFrom(*head)) : std::nullopt;
      if (!fields || !isClosed(*fields)) {
        return;
      }
      const std::optional<std::string> data = part();
      if (!data) {
        return;
      }
      if (kindOf(*fields) == kChunk) {
        if (field(*fields, "compression") != "none") {
          throw StoreError("it holds compressed chunks; rosbag reindex mends it");
        }
        m_chunks.push_back(readChunk(*data));
        m_chunks.back().begin = begin;
      }
      // Index records are of the chunk before.
      m_chunks.back().end = static_cast<std::uint64_t>(m_file.tellg());
      if (kindOf(*fields) == kChunk) {
        m_endOfData = m_chunks.back().end;
      }
    }
  }

  /** Whether a record is a closed chunk, which says its size, or the index of one. */
  bool isClosed(const Fields &fields) const
  {
    const char kind = kindOf(fields);
    return kind == kChunk ? numberFrom<std::uint32_t>(field(fields, "size")) > 0
                          : kind == kIndex && !m_chunks.empty();
  }

  Chunk readChunk(std::string_view data)
  {
    Chunk chunk;
    const std::size_t whole = data.size();
    while (!data.empty()) {
      const auto offset = static_cast<std::uint32_t>(whole - data.size());
      const auto headBytes = numberFrom<std::uint32_t>(data);
      const Fields fields = fieldsFrom(data.substr(4, headBytes));
      const std::size_t before = 8 + std::size_t{headBytes};
      if (before > data.size()) {
        throw StoreError("a record of a chunk is cut off");
      }
      const auto bytes = numberFrom<std::uint32_t>(data.substr(before - 4));
      if (before + bytes > data.size()) {
        throw StoreError("a record of a chunk is cut off");
      }
      const std::uint32_t connection = numberFrom<std::uint32_t>(field(fields, "conn"));
      if (kindOf(fields) == kConnection) {
        m_connections[connection] = std::string(data.substr(0, before + bytes));
      }
      else if (kindOf(fields) == kMessage) {
        note(chunk, connection, field(fields, "time"), offset);
      }
      data.remove_prefix(before + bytes);
    }
    return chunk;
  }

  void note(Chunk &chunk, std::uint32_t connection, const std::string &time, std::uint32_t offset)
  {
    Index &index = chunk.indexes[connection];
    ++index.count;
    index.entries += time + toBytes(offset);
    ++m_messages;
    if (chunk.first.empty() || order(time) < order(chunk.first)) {
      chunk.first = time;
    }
    if (chunk.last.empty() || order(time) > order(chunk.last)) {
      chunk.last = time;
    }
  }

  /** Cuts off what is not closed, then writes what closing the bag would have. */
  void write()
  {
    std::string tail;
    for (const auto &[connection, index] : m_chunks.back().indexes) {
      tail += record({{"op", std::string(1, kIndex)},
                      {"ver", toBytes(std::uint32_t{1})},
                      {"conn", toBytes(connection)},
                      {"count", toBytes(index.count)}},
                     index.entries);
    }
    const std::uint64_t indexAt = m_endOfData + tail.size();
    for (const auto &[connection, bytes] : m_connections) {
      tail += bytes;
    }
    for (const Chunk &chunk : m_chunks) {
      std::string counts;
      for (const auto &[connection, index] : chunk.indexes) {
        counts += toBytes(connection) + toBytes(index.count);
      }
      tail += record({{"op", std::string(1, kChunkInfo)},
                      {"ver", toBytes(std::uint32_t{1})},
                      {"chunk_pos", toBytes(chunk.begin)},
                      {"start_time", chunk.first},
                      {"end_time", chunk.last},
                      {"count", toBytes(static_cast<std::uint32_t>(chunk.indexes.size()))}},
                     counts);
    }
    m_file.clear();
    std::filesystem::resize_file(m_path, m_endOfData);
    m_file.seekp(static_cast<std::streamoff>(m_endOfData));
    m_file << tail;
    m_file.flush();
    // The header last: until it says where the index is, the bag can be repaired again.
    writeHeader(indexAt);
    m_file.flush();
    if (!m_file) {
      throw StoreError("its index cannot be written; is the disk full?");
    }
  }

  void writeHeader(std::uint64_t indexAt)
  {
    constexpr std::size_t kBytes = 4096; // with both lengths
    std::string made =
        record({{"op", std::string(1, kHeader)},
                {"index_pos", toBytes(indexAt)},
                {"conn_count", toBytes(static_cast<std::uint32_t>(m_connections.size()))},
                {"chunk_count", toBytes(static_cast<std::uint32_t>(m_chunks.size()))}},
               {});
    made.resize(made.size() - 4); // the length of the data
    made += withLength(std::string(kBytes - 4 - made.size(), ' '));
    m_file.seekp(static_cast<std::streamoff>(kVersion.size()));
    m_file << made;
  }

  std::filesystem::path m_path;
  std::fstream m_file;
  std::uint64_t m_size = 0;
  std::uint64_t m_endOfData = 0; ///< of the last closed chunk, without its index
  std::size_t m_messages = 0;
  std::vector<Chunk> m_chunks;
  std::map<std::uint32_t, std::string> m_connections; ///< records
};

} // namespace

BagRepair repairBag(const std::filesystem::path &path)
{
  try {
    return Repair(path).run();
  }
  catch (const StoreError &error) {
    throw StoreError("the bag " + path.string() + ": " + error.what());
  }
}

} // namespace homeward
