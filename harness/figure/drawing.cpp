#include "figure/drawing.h"

#include <fmt/format.h>

#include "base/supervise.h"

namespace vsglbench {
namespace {

constexpr size_t kShortTable = 20;  // rows

// --- in the worker ---

DrawnFigure describe(const FigureOutput& figure, const std::vector<std::filesystem::path>& paths,
                     const DeviceInfo& d) {
  DrawnFigure drawn{.paths = paths, .claims = figure.claims};
  for (const FigureTable& table : figure.tables) {
    if (table.rows.size() <= kShortTable) drawn.short_tables.push_back(table.csv());
  }
  drawn.device = {
      {"name", d.name}, {"type", d.type}, {"driver", d.driver}, {"driver_version", d.driver_version}};
  return drawn;
}

DrawnFigure draw(const FigureOrder& order, const Worker<DrawnFigure>& worker) {
  worker.now({{}, "opening the device", order.silence_s});
  Device device({.select = order.device});
  const auto begin = [&](const std::string& step) { worker.now({0, step, order.silence_s}); };
  begin("the start");
  if (order.admit) order.admit(device.info());
  const FigureOutput figure = make_figure({device, order.config, order.assets, begin});
  begin("writing");
  return describe(figure, write_figure(figure, order.folder), device.info());
}

// --- in the caller ---

std::string subject(const Json& config) {
  const std::string figure = config.at("figure");
  if (!config.contains("method")) return "figure " + figure;
  return fmt::format("figure {}, method {}", figure, config["method"].get<std::string>());
}

// What is wrong with the figure, or with the device for all figures.
Error error_of(const End& end, const std::string& what) {
  if (end.kind == ErrorKind::device) return Error(end.kind, end.how);
  if (end.kind != ErrorKind::device_lost) return fail(end.kind, "{}: {}", what, end.message());
  return fail(ErrorKind::case_failed, "{}: {}; if it is too large for the device, make it smaller", what,
              end.message());
}

}  // namespace

Json to_json(const DrawnFigure& drawn) {
  Json json = {{"paths", Json::array()}, {"tables", drawn.short_tables}, {"claims", Json::array()}};
  for (const auto& path : drawn.paths) json["paths"].push_back(path.string());
  for (const Claim& c : drawn.claims) {
    json["claims"].push_back(Json::array({c.text, c.source, c.finding, c.figures}));
  }
  json["device"] = drawn.device;
  return json;
}

void from_json(const Json& json, DrawnFigure* drawn) {
  for (const Json& path : json.at("paths")) drawn->paths.emplace_back(path.get<std::string>());
  for (const Json& table : json.at("tables")) drawn->short_tables.push_back(table);
  for (const Json& c : json.at("claims")) {
    drawn->claims.push_back({c.at(0), c.at(1), c.at(2).get<Finding>(), c.at(3)});
  }
  drawn->device = json.at("device");
}

DrawnFigure draw_figure(const FigureOrder& order) {
  const std::string what = subject(order.config);
  DrawnFigure result;
  supervise<DrawnFigure>({.name = what,
                          .work = [&](const Worker<DrawnFigure>& worker,
                                      const std::vector<size_t>&) { worker.done(0, draw(order, worker)); },
                          .told = [&](const DrawnFigure& drawn) { result = drawn; },
                          .lost = [&](size_t, const End& end) { throw error_of(end, what); }});
  return result;
}

}  // namespace vsglbench
