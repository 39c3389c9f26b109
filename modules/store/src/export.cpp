// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/store/export.h>

#include "number_text.h"

#include <homeward/store/content_hash.h>

#include <nlohmann/json.hpp>

namespace homeward
{

namespace
{

std::string text(std::int64_t id)
{
  return std::to_string(id);
}

std::string text(const std::optional<double> &bearing)
{
  return bearing ? fixedText(*bearing) : "unknown";
}

std::string quoted(const std::string &words)
{
  return nlohmann::json(words).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::optional<std::string> viewHash(const MapFile &file, NodeId node)
{
  if (!file.hasView(node)) {
    return std::nullopt;
  }
  return hashText(contentHash(file.view(node)));
}

std::string escapedXml(const std::string &words)
{
  std::string escaped;
  for (const char c : words) {
    switch (c) {
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '&':
      escaped += "&amp;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      escaped += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
  return escaped;
}

/** A string of Graphviz's language. */
std::string quotedDot(const std::string &words)
{
  std::string text = "\"";
  for (const char c : words) {
    text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return text + "\"";
}

std::string xmlData(const std::string &key, const std::string &value)
{
  return "<data key=\"" + key + "\">" + escapedXml(value) + "</data>";
}

std::string xmlUse(const EdgeStatistics &known)
{
  return xmlData("tries", text(known.tries)) + xmlData("successes", text(known.successes)) +
         xmlData("mean", fixedText(known.meanSeconds)) +
         (known.lastError.empty() ? "" : xmlData("last_error", known.lastError));
}

/** "0.120000 open; -1.500000 closed (blocked)" */
std::string directionList(const Node &node)
{
  std::string list;
  for (const Direction &direction : node.directions) {
    list += list.empty() ? "" : "; ";
    list += fixedText(direction.bearing) + " " + std::string(name(direction.state));
    list += direction.reason.empty() ? "" : " (" + direction.reason + ")";
  }
  return list;
}

int openDirections(const Node &node)
{
  int count = 0;
  for (const Direction &direction : node.directions) {
    count += direction.state == DirectionState::Open ? 1 : 0;
  }
  return count;
}

nlohmann::ordered_json jsonOf(const std::optional<double> &value)
{
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json jsonOf(const Node &node)
{
  nlohmann::ordered_json directions = nlohmann::ordered_json::array();
  for (const Direction &direction : node.directions) {
    directions.push_back({{"id", direction.id.value},
                          {"bearing_rad", direction.bearing},
                          {"width_rad", direction.width},
                          {"state", name(direction.state)},
                          {"reason", direction.reason}});
  }
  return {{"id", node.id.value}, {"name", node.name}, {"directions", directions}};
}

nlohmann::ordered_json jsonOf(const Edge &edge)
{
  return {{"id", edge.id.value},
          {"a", edge.a.value},
          {"b", edge.b.value},
          {"bearing_at_a_rad", jsonOf(edge.bearingAtA)},
          {"bearing_at_b_rad", jsonOf(edge.bearingAtB)},
          {"length_m", jsonOf(edge.length)},
          {"tries", edge.statistics.tries},
          {"successes", edge.statistics.successes},
          {"mean_s", edge.statistics.meanSeconds},
          {"last_error", edge.statistics.lastError},
          {"last_time_s", edge.statistics.lastTime},
          {"forbidden", edge.forbidden}};
}

nlohmann::ordered_json jsonOf(const MapHeader &header)
{
  return {{"camera_hash", header.cameraHash},
          {"panorama",
           {{"width", header.panorama.width},
            {"height", header.panorama.height},
            {"elevation_min_rad", header.panorama.elevationMin},
            {"elevation_max_rad", header.panorama.elevationMax}}},
          {"signature", {{"kind", header.signatureKind}, {"version", header.signatureVersion}}},
          {"thresholds", header.thresholds}};
}

std::string canonicalHeader(const MapHeader &header)
{
  std::string lines = "homeward map canonical 3\n";
  lines += "camera " + header.cameraHash + "\n";
  lines += "panorama " + text(header.panorama.width) + " " + text(header.panorama.height) + " " +
           fixedText(header.panorama.elevationMin) + " " + fixedText(header.panorama.elevationMax) +
           "\n";
  lines += "signature " + header.signatureKind + " " + text(header.signatureVersion) + "\n";
  for (const auto &[key, value] : header.thresholds) {
    lines += "threshold " + key + " " + fixedText(value) + "\n";
  }
  return lines;
}

/** " tried 3 arrived 2 mean 12.500000 last "lost" forbidden"; nothing of an edge never tried. */
std::string canonicalUse(const Edge &edge)
{
  const EdgeStatistics &known = edge.statistics;
  std::string use;
  if (known.tries > 0) {
    use = " tried " + text(known.tries) + " arrived " + text(known.successes) + " mean " +
          fixedText(known.meanSeconds) + " last " + quoted(known.lastError);
  }
  return use + (edge.forbidden ? " forbidden" : "");
}

} // namespace

std::string exportCanonical(const MapFile &file)
{
  std::string lines = canonicalHeader(file.header());
  for (const auto &[id, node] : file.map().nodes()) {
    lines += "node " + text(id.value) + " view " + viewHash(file, id).value_or("none");
    lines += node.name.empty() ? "\n" : " name " + quoted(node.name) + "\n";
    for (const Direction &direction : node.directions) {
      lines += "direction " + text(id.value) + " " + text(direction.id.value) + " " +
               fixedText(direction.bearing) + " " + fixedText(direction.width) + " " +
               std::string(name(direction.state)) + " " + quoted(direction.reason) + "\n";
    }
  }
  for (const auto &[id, edge] : file.map().edges()) {
    lines += "edge " + text(id.value) + " " + text(edge.a.value) + " " + text(edge.b.value) + " " +
             text(edge.bearingAtA) + " " + text(edge.bearingAtB) + " " + text(edge.length) +
             canonicalUse(edge) + "\n";
  }
  return lines;
}

std::string exportGraphml(const TopologicalMap &map)
{
  std::string xml = R"(<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
  <key id="open" for="node" attr.name="open_directions" attr.type="int"/>
  <key id="directions" for="node" attr.name="directions_rad" attr.type="string"/>
  <key id="name" for="node" attr.name="name" attr.type="string"/>
  <key id="at_source" for="edge" attr.name="bearing_at_source_rad" attr.type="double"/>
  <key id="at_target" for="edge" attr.name="bearing_at_target_rad" attr.type="double"/>
  <key id="length" for="edge" attr.name="length_m" attr.type="double"/>
  <key id="tries" for="edge" attr.name="tries" attr.type="int"/>
  <key id="successes" for="edge" attr.name="successes" attr.type="int"/>
  <key id="mean" for="edge" attr.name="mean_s" attr.type="double"/>
  <key id="last_error" for="edge" attr.name="last_error" attr.type="string"/>
  <key id="forbidden" for="edge" attr.name="forbidden" attr.type="boolean"/>
  <graph id="map" edgedefault="undirected">
)";
  for (const auto &[id, node] : map.nodes()) {
    xml += "    <node id=\"n" + text(id.value) + "\">" +
           xmlData("open", text(openDirections(node))) +
           xmlData("directions", directionList(node)) +
           (node.name.empty() ? "" : xmlData("name", node.name)) + "</node>\n";
  }
  for (const auto &[id, edge] : map.edges()) {
    xml += "    <edge id=\"e" + text(id.value) + "\" source=\"n" + text(edge.a.value) +
           "\" target=\"n" + text(edge.b.value) + "\">";
    xml += edge.bearingAtA ? xmlData("at_source", fixedText(*edge.bearingAtA)) : "";
    xml += edge.bearingAtB ? xmlData("at_target", fixedText(*edge.bearingAtB)) : "";
    xml += edge.length ? xmlData("length", fixedText(*edge.length)) : "";
    xml += edge.statistics.tries > 0 ? xmlUse(edge.statistics) : "";
    xml += edge.forbidden ? xmlData("forbidden", "true") : "";
    xml += "</edge>\n";
  }
  return xml + "  </graph>\n</graphml>\n";
}

std::string exportDot(const TopologicalMap &map)
{
  std::string dot = "graph map {\n  node [shape=circle];\n";
  for (const auto &[id, node] : map.nodes()) {
    std::string looks = openDirections(node) > 0 ? "peripheries=2" : "";
    if (!node.name.empty()) {
      looks += (looks.empty() ? "label=" : ", label=") + quotedDot(node.name);
    }
    dot += "  " + text(id.value) + (looks.empty() ? "" : " [" + looks + "]") + ";\n";
  }
  for (const auto &[id, edge] : map.edges()) {
    dot += "  " + text(edge.a.value) + " -- " + text(edge.b.value) +
           (edge.forbidden ? " [style=dashed, color=red];\n" : ";\n");
  }
  return dot + "}\n";
}

std::string exportJson(const MapFile &file)
{
  nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
  for (const auto &[id, node] : file.map().nodes()) {
    nlohmann::ordered_json entry = jsonOf(node);
    const std::optional<std::string> hash = viewHash(file, id);
    entry["view_hash"] = hash ? nlohmann::ordered_json(*hash) : nlohmann::ordered_json();
    nodes.push_back(entry);
  }
  nlohmann::ordered_json edges = nlohmann::ordered_json::array();
  for (const auto &[id, edge] : file.map().edges()) {
    edges.push_back(jsonOf(edge));
  }
  const nlohmann::ordered_json all = {{"schema", "homeward-map-1"},
                                      {"header", jsonOf(file.header())},
                                      {"nodes", nodes},
                                      {"edges", edges}};
  return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace homeward
