#include "dashboard/page.h"

#include <zlib.h>

#include <algorithm>

#include "answer/compare.h"
#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "dashboard/columns.h"
#include "dashboard/digest.h"
#include "dashboard/history.h"
#include "report/noise.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr std::string_view kPlaceholder = "<!--data-->";

// "front-lavapipe", not where it lies.
std::string short_name(const fs::path& given) {
  const fs::path file = report_file(given);
  return file.filename() == "report.json" ? fs::absolute(file).parent_path().filename().string()
                                          : file.stem().string();
}

struct Opened {
  fs::path path;
  Report report;
};

std::string compressed(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::string out(size, '\0');
  const int rc = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                           reinterpret_cast<const Bytef*>(text.data()), text.size(), 9);
  if (rc != Z_OK) throw std::logic_error("zlib refuses to compress");
  out.resize(size);
  return out;
}

const CaseResult* find_case(const Report& report, const std::string& id) {
  const auto it = std::ranges::find(report.cases, id, &CaseResult::id);
  return it == report.cases.end() ? nullptr : &*it;
}

Json median_of(const Report& report, const std::string& id, const std::string& time) {
  const CaseResult* c = id.empty() ? nullptr : find_case(report, id);
  const std::optional<Summary> ms = c ? time_of(*c, time) : std::nullopt;
  return ms ? rounded(ms->median) : Json(nullptr);
}

Json comparison_json(const Report& base, const Report& now) {
  const Comparison c = compare_reports(base, now);
  Json rows = Json::array();
  const auto method_of = [&](const std::string& id) {
    const CaseResult* of = find_case(now, id);
    return of == nullptr ? std::string() : of->method;
  };
  const auto add_time = [&](const TimeChange& t, const std::string& what) {
    rows.push_back({{"case", t.case_id},
                    {"method", t.case_id.empty() ? t.method : method_of(t.case_id)},
                    {"what", what},
                    {"base", median_of(base, t.case_id, t.time)},
                    {"now", median_of(now, t.case_id, t.time)},
                    {"ratio", rounded(t.ratio.value)},
                    {"lo", rounded(t.ratio.ci95.lo)},
                    {"hi", rounded(t.ratio.ci95.hi)},
                    {"noise", rounded(t.noise)},
                    {"change", std::string(name(t.change))}});
  };
  for (const TimeChange& t : c.passes) add_time(t, "pass " + t.time);
  for (const TimeChange& t : c.method_passes) add_time(t, "pass " + t.time + " of " + t.method);
  for (const TimeChange& t : c.times) add_time(t, t.time);
  for (const ErrorChange& e : c.errors) {
    rows.push_back({{"case", e.case_id},
                    {"method", method_of(e.case_id)},
                    {"what", e.metric},
                    {"base", rounded(e.base)},
                    {"now", rounded(e.now)},
                    {"ratio", rounded(e.ratio.value)},
                    {"lo", rounded(e.ratio.ci95.lo)},
                    {"hi", rounded(e.ratio.ci95.hi)},
                    {"noise", nullptr},
                    {"change", std::string(name(e.change))}});
  }
  return {{"base", 0},
          {"now", 1},
          {"refusal", c.refusal},
          {"exit_code", c.exit_code()},
          {"summary", comparison_text(c, false)},
          {"rows", std::move(rows)}};
}

// A cell as to_json(StabilityCell) writes it.
bool is_cell(const Json& cell) {
  if (!cell.is_object()) return false;
  for (const char* key : {"case", "method", "diffuse", "status", "where", "why"}) {
    if (!cell.contains(key) || !cell.at(key).is_string()) return false;
  }
  const auto status = cell.at("status").get<std::string>();
  const Json error = cell.value("error", Json());
  return (error.is_number() || error == "infinite") &&
         (status == "ok" || status == "bias" || status == "bad" || status == "left out");
}

Json stability_json(const fs::path& path) {
  const JsonDocument doc = JsonDocument::load(path, ErrorKind::config);
  const Json& root = doc.root();
  if (!root.is_object() || root.value("schema", Json()) != "vsglbench.stability/1")
    throw doc.error("", "no report of `vsglbench stability --json`: its schema is not vsglbench.stability/1");
  const Json cells = root.value("cells", Json());
  if (!cells.is_array())
    throw doc.error("", "'cells' is no list; make it anew with `vsglbench stability --json`");
  for (size_t i = 0; i < cells.size(); ++i) {
    if (!is_cell(cells[i]))
      throw doc.error(fmt::format("/cells/{}", i), "no cell of `vsglbench stability --json`");
  }
  for (const char* key : {"ok_error", "bad_error"}) {
    if (!root.value(key, Json()).is_number()) throw doc.error("", fmt::format("'{}' is no number", key));
  }
  return {{"ok_error", root.at("ok_error")}, {"bad_error", root.at("bad_error")}, {"cells", cells}};
}

// A page can't say whose scene it is otherwise.
void check_scenes(const Report& report, const std::string& file) {
  for (const CaseResult& c : report.cases) {
    if (scene_index(report, c.scene) < 0)
      throw fail(ErrorKind::config, "{}: case '{}' is of scene '{}', which is not in the report's scenes",
                 file, c.id, c.scene);
  }
}

// Temporal entries learn which pictures are theirs.
void join_pictures(Json* digest) {
  const Json& images = digest->at("images");
  for (size_t k = 0; k < images.size(); ++k) {
    const Json& image = images[k];
    const auto kind = image.at("kind").get<std::string>();
    if (kind != "profile" && kind != "flicker") continue;
    for (Json& t : digest->at("reports").at(image.at("report").get<size_t>()).at("temporal")) {
      if (t.at("case") == image.at("case")) t[kind == "profile" ? "profile" : "worst"] = k;
    }
  }
}

std::vector<Opened> open_two(const std::vector<fs::path>& paths) {
  std::vector<Opened> out;
  for (const fs::path& path : paths) out.push_back({path, read_report_at(path)});
  return out;
}

// Reads all, one at a time; the newest stays.
std::vector<Opened> read_history(const std::vector<fs::path>& paths, Json* history,
                                 std::vector<std::string>* notes) {
  struct Known {
    std::string created;
    fs::path path;
  };
  std::vector<Known> all;
  std::vector<Opened> newest;
  for (const fs::path& path : paths) {
    Report report = read_report_at(path);
    all.push_back({report.created, path});
    if (newest.empty() || report.created >= newest.front().report.created) {
      newest.clear();
      newest.push_back({path, std::move(report)});
    }
  }
  std::ranges::stable_sort(all, {}, &Known::created);
  History made;
  size_t others = 0;
  for (const Known& k : all) {
    const Report report = read_report_at(k.path);
    const Report& last = newest.front().report;
    if (report.device.name == last.device.name && report.host.cpu == last.host.cpu) {
      made.add(report, short_name(k.path));
    } else {
      ++others;
    }
  }
  if (others > 0)
    notes->push_back(fmt::format(
        "{} of {} reports are of other machines than the newest and not in its history", others, all.size()));
  *history = made.json(notes);
  return newest;
}

}  // namespace

Dashboard make_dashboard(const DashboardOrder& order) {
  if (order.reports.empty()) throw fail(ErrorKind::usage, "dashboard: no report is named");
  metric_title(order.pictures.metric);  // refuses what is none, before anything is read
  Json history = nullptr;
  std::vector<std::string> notes;
  const std::vector<Opened> opened =
      order.reports.size() > 2 ? read_history(order.reports, &history, &notes) : open_two(order.reports);
  Dashboard out;
  Json reports = Json::array(), claims = Json::array();
  size_t left_out = 0;
  double room = order.pictures.max_mb;
  for (size_t i = 0; i < opened.size(); ++i) {
    const Report& report = opened[i].report;
    check_scenes(report, report_file(opened[i].path).string());
    reports.push_back(digest_of(report, short_name(opened[i].path)));
    const double share = room / static_cast<double>(opened.size() - i);
    ChosenPictures chosen = choose_pictures(report, report_file(opened[i].path).parent_path(), i,
                                            digest_groups(report).of_case, order.pictures, share);
    for (Picture& p : chosen.list) {
      room -= static_cast<double>(p.base64.size()) / 1e6;
      out.pictures.push_back(std::move(p));
    }
    left_out += chosen.left_out;
    for (const std::string& note : chosen.notes)
      notes.push_back(opened.size() == 1 ? note : short_name(opened[i].path) + ": " + note);
  }
  if (!order.papers.empty())
    claims = digest_papers(JsonDocument::load(order.papers, ErrorKind::config).root(), order.papers.string());
  Json images = Json::array();
  for (const Picture& p : out.pictures) images.push_back(p.entry);
  if (left_out > 0)
    notes.push_back(fmt::format("{} pictures are left out, for which {:.3g} MB are too few (--max-mb)",
                                left_out, order.pictures.max_mb));
  Json comparison = nullptr;
  if (opened.size() == 2) comparison = comparison_json(opened[0].report, opened[1].report);
  out.digest = {{"schema", "vsglbench.dashboard/1"},
                {"created", utc_now()},
                {"commit", opened.back().report.git.commit},
                {"reports", std::move(reports)},
                {"comparison", std::move(comparison)},
                {"history", std::move(history)},
                {"stability", order.stability.empty() ? Json(nullptr) : stability_json(order.stability)},
                {"claims", std::move(claims)},
                {"images", std::move(images)},
                {"notes", notes}};
  join_pictures(&out.digest);
  return out;
}

void write_dashboard(const Dashboard& dashboard, const fs::path& out) {
  const fs::path page = library_directory() / "vsglbench" / "dashboard.html";
  std::error_code ec;
  if (!fs::exists(page, ec))
    throw fail(ErrorKind::usage, "{}: is not there: this build has no dashboard; build it where npm is",
               page.string());
  const std::string text = read_text(page);
  const size_t at = text.find(kPlaceholder);
  if (at == std::string::npos) throw std::logic_error("dashboard.html has no place for data");
  // JSON in base64 can't end the element that it stands in, whatever a report says.
  const std::string json = dashboard.digest.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string filled = text.substr(0, at);
  filled += "<script type=\"text/plain\" id=\"data\">" + base64(compressed(json)) + "</script>\n";
  for (const Picture& p : dashboard.pictures) {
    filled += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n",
                          p.entry.at("element").get<std::string>(), p.base64);
  }
  filled += text.substr(at + kPlaceholder.size());
  write_text(out, filled);
}

}  // namespace vsglbench
