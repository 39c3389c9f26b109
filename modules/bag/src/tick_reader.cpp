// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/bag/tick_reader.h>

#include "ros_error.h"
#include "tick_messages.h"

#include <homeward/bag/bag_reader.h>

#include <nlohmann/json.hpp>

namespace homeward
{
namespace fs = std::filesystem;

class TickReader::Impl
{
public:
  explicit Impl(std::vector<fs::path> parts) : m_parts(std::move(parts))
  {
    if (m_parts.empty()) {
      throw StoreError("there is no bag to replay");
    }
    open();
  }

  std::optional<Tick> next()
  {
    while (true) {
      std::optional<BagMessage> message = m_bag->next();
      if (!message) {
        if (m_part + 1 >= m_parts.size()) {
          return std::nullopt;
        }
        ++m_part;
        open();
        continue;
      }
      if (std::optional<Tick> tick = m_decoder.take(std::move(*message))) {
        return tick;
      }
    }
  }

  const fs::path &path() const { return m_parts[m_part]; }
  const std::string &setup() const { return m_setup; }

private:
  void open()
  {
    m_bag = std::make_unique<BagReader>(path());
    m_decoder = {};
    const std::optional<BagMessage> first = m_bag->next();
    const auto *event = first ? std::get_if<BagEvent>(&first->what) : nullptr;
    const nlohmann::json told =
        event != nullptr ? nlohmann::json::parse(event->json, nullptr, false) : nlohmann::json();
    if (!told.is_object() || told.value("event", "") != "recording") {
      throw StoreError("the bag " + path().string() +
                       " is no recording of a mission; --build-map makes a map of any drive");
    }
    if (told.at("version") != 1 || told.at("part") != m_part) {
      throw StoreError("the bag " + path().string() + " is version " + told.at("version").dump() +
                       ", part " + told.at("part").dump() + " of a recording; version 1, part " +
                       std::to_string(m_part) + " is wanted");
    }
    const std::string setup = told.at("setup").dump();
    if (m_part > 0 && setup != m_setup) {
      throw StoreError("the bag " + path().string() + " is of another recording than the first");
    }
    m_setup = setup;
  }

  std::vector<fs::path> m_parts;
  std::size_t m_part = 0;
  std::unique_ptr<BagReader> m_bag;
  TickDecoder m_decoder;
  std::string m_setup;
};

TickReader::TickReader(std::vector<fs::path> parts)
    : m_impl(std::make_unique<Impl>(std::move(parts)))
{}

TickReader::~TickReader() = default;

const std::string &TickReader::setup() const
{
  return m_impl->setup();
}

std::optional<Tick> TickReader::next()
{
  return withBag(m_impl->path(), "it is damaged", [this] { return m_impl->next(); });
}

} // namespace homeward
