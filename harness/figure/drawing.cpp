#include "figure/drawing.h"

#include <fmt/format.h>

#include <memory>
#include <new>

#include "base/child.h"
#include "base/error.h"

namespace vsglbench {
namespace {

constexpr size_t kShortTable = 20;  // rows

// --- in the child ---

Json to_json(const FigureOutput& figure, const std::vector<std::filesystem::path>& paths,
             const DeviceInfo& d) {
  Json drawn = {{"paths", Json::array()}, {"tables", Json::array()}, {"claims", Json::array()}};
  for (const auto& path : paths) drawn["paths"].push_back(path.string());
  for (const FigureTable& table : figure.tables) {
    if (table.rows.size() <= kShortTable) drawn["tables"].push_back(table.csv());
  }
  for (const Claim& c : figure.claims) {
    drawn["claims"].push_back(Json::array({c.text, c.source, c.finding, c.figures}));
  }
  drawn["device"] = {
      {"name", d.name}, {"type", d.type}, {"driver", d.driver}, {"driver_version", d.driver_version}};
  return drawn;
}

Json draw(const FigureOrder& order, Device& device, const ToParent& parent) {
  if (order.admit) order.admit(device.info());
  const auto begin = [&](const std::string& step) { parent.send({{"step", step}}); };
  const FigureOutput figure = make_figure({device, order.config, order.assets, begin});
  begin("writing");
  return to_json(figure, write_figure(figure, order.folder), device.info());
}

void work(const FigureOrder& order, const ToParent& parent) {
  std::unique_ptr<Device> device;
  try {
    device = std::make_unique<Device>(DeviceOptions{.select = order.device});
  } catch (const Error& e) {
    return parent.send({{"unusable", e.what()}});
  }
  try {
    parent.send({{"drawn", draw(order, *device, parent)}});
  } catch (const Error& e) {
    const bool device_failed = e.kind() == ErrorKind::device;
    const std::string advice = device_failed ? "; if it is too large for the device, make it smaller" : "";
    parent.send({{"error", e.what() + advice}, {"kind", device_failed ? ErrorKind::case_failed : e.kind()}});
  } catch (const std::bad_alloc&) {
    parent.send({{"error", "out of memory; make it smaller"}, {"kind", ErrorKind::case_failed}});
  } catch (const std::exception& e) {
    parent.send({{"error", e.what()}, {"kind", ErrorKind::case_failed}});
  }
}

// --- in the parent ---

DrawnFigure drawn_from_json(const Json& json) {
  DrawnFigure drawn;
  for (const Json& path : json.at("paths")) drawn.paths.emplace_back(path.get<std::string>());
  for (const Json& table : json.at("tables")) drawn.short_tables.push_back(table);
  for (const Json& c : json.at("claims")) {
    drawn.claims.push_back({c.at(0), c.at(1), c.at(2).get<Finding>(), c.at(3)});
  }
  drawn.device = json.at("device");
  return drawn;
}

std::string subject(const Json& config) {
  const std::string figure = config.at("figure");
  if (!config.contains("method")) return "figure " + figure;
  return fmt::format("figure {}, method {}", figure, config["method"].get<std::string>());
}

}  // namespace

DrawnFigure draw_figure(const FigureOrder& order) {
  const std::string what = subject(order.config);
  std::string step = "the start";
  Child child([&](const ToParent& parent) { work(order, parent); });
  while (const auto message = child.receive(order.silence_s)) {
    if (message->contains("unusable")) throw Error(ErrorKind::device, message->at("unusable"));
    if (message->contains("error")) {
      throw fail(message->at("kind").get<ErrorKind>(), "{}: {} (during {})", what,
                 message->at("error").get<std::string>(), step);
    }
    if (message->contains("drawn")) return drawn_from_json(message->at("drawn"));
    step = message->at("step");
  }
  const std::string& how = child.how_it_ended();
  throw fail(ErrorKind::case_failed, "{}: {} during {}", what, how.empty() ? "ended the process" : how, step);
}

}  // namespace vsglbench
