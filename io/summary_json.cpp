// SPDX-License-Identifier: BSD-3-Clause
#include "io/summary_json.hpp"

#include "io/csv_tables.hpp"

#include <nlohmann/json.hpp>

namespace cdca {
namespace {

using Json = nlohmann::ordered_json;

Json point(const Vec2& p) { return Json::array({p.x(), p.y()}); }

Json number_or_null(int id) { return id < 0 ? Json(nullptr) : Json(id); }

/// One JSON value for every record of a list.
template <class Record, class Convert>
Json list(const std::vector<Record>& records, Convert convert) {
  Json values = Json::array();
  for (const Record& record : records) values.push_back(convert(record));
  return values;
}

Json step_json(const std::vector<std::string>& reaction_names, const StepRecord& record) {
  Json values = Json::object();
  for (const TableCell& cell : history_row(reaction_names, record))
    std::visit([&](const auto& value) { values[cell.column] = value; }, cell.value);
  return values;
}

Json tip_json(const TipRecord& tip) {
  Json values{{"crack", tip.crack}, {"end", tip.end},     {"x", tip.at.x()},
              {"y", tip.at.y()},    {"state", tip.state}, {"partner", number_or_null(tip.partner)}};
  const bool active = tip.state == "active";
  const auto add = [&](const char* key, double value) {
    values[key] = active ? Json(value) : Json(nullptr);
  };
  add("K_I", tip.k1);
  add("K_II", tip.k2);
  add("U_tension", tip.u_tension);
  add("U_shear", tip.u_shear);
  add("angle_deg", tip.angle_deg);
  return values;
}

Json crack_json(const CrackRecord& crack) {
  return {{"name", crack.name}, {"points", list(crack.points, point)}, {"length", crack.length}};
}

Json event_json(const EventRecord& event) {
  return {{"step", event.step},
          {"cycle", event.cycle},
          {"kind", event.kind},
          {"crack", number_or_null(event.crack)},
          {"end", number_or_null(event.end)},
          {"partner", number_or_null(event.partner)},
          {"at", point(event.at)}};
}

Json network_json(const NetworkRecord& network) {
  return {{"clusters", network.clusters},
          {"largest", network.largest},
          {"spans_x", network.spans_x},
          {"spans_y", network.spans_y}};
}

Json performance_json(const PerformanceRecord& record) {
  return {{"wall_s", record.wall_s},
          {"setup_s", record.setup_s},
          {"solve_s", record.solve_s},
          {"output_s", record.output_s},
          {"linear_solves", record.linear_solves},
          {"solver_iterations", record.solver_iterations},
          {"peak_rss_bytes", record.peak_rss_bytes},
          {"unknowns_per_rank", record.unknowns_per_rank}};
}

/// Names and titles come from the user and need not be sound UTF-8; that must not lose the results.
std::string compact(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A line per key, and a line per record of a list: easy to read and to compare by lines.
std::string laid_out(const Json& top) {
  std::string text = "{";
  for (const auto& [key, value] : top.items()) {
    text += (text.size() > 1 ? ",\n  " : "\n  ") + compact(key) + ": ";
    if (!value.is_array() || value.empty()) {
      text += compact(value);
      continue;
    }
    text += "[";
    for (std::size_t i = 0; i < value.size(); ++i)
      text += (i > 0 ? ",\n    " : "\n    ") + compact(value[i]);
    text += "\n  ]";
  }
  return text + "\n}\n";
}

}  // namespace

std::string summary_json(const Summary& summary) {
  Json top = Json::object();
  top["version"] = summary.version;
  top["title"] = summary.title;
  top["status"] = summary.status;
  top["message"] = summary.message;
  top["ranks"] = summary.ranks;
  top["elements"] = summary.elements;
  top["nodes"] = summary.nodes;
  top["unknowns"] = summary.unknowns;
  top["load_factor"] = summary.load_factor;
  top["steps"] = list(summary.steps, [&](const StepRecord& record) {
    return step_json(summary.reaction_names, record);
  });
  top["tips"] = list(summary.tips, tip_json);
  top["cracks"] = list(summary.cracks, crack_json);
  top["network"] = network_json(summary.network);
  top["events"] = list(summary.events, event_json);
  top["performance"] = performance_json(summary.performance);
  return laid_out(top);
}

}  // namespace cdca
