// Error and time of a group's points in log-log.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "answer/chart.h"
#include "answer/front.h"
#include "answer/series.h"
#include "figure/axis.h"
#include "image/font.h"

namespace vsglbench {
namespace {

constexpr size_t kMostBars = 300;    // points with intervals; of more, only the front has them
constexpr size_t kMostJoined = 150;  // points of which a method's are joined over N
constexpr size_t kMostNamed = 12;    // points of the front
constexpr double kApart = 17;        // pixels between two numbers
constexpr size_t kMostKinds = 24;  // choices of settings with a mark of their own; of more, methods have one
constexpr size_t kMostKindsOfOne = 12;  // of one method
constexpr double kRow = 19;             // of the legend
constexpr size_t kKindsWithRoom = 10;   // on a page of the usual height

class FrontChart {
 public:
  explicit FrontChart(const ChartSource& source)
      : source_(source), group_(source.group), front_(front_of(group_)), all_(group_.points.size()) {
    std::iota(all_.begin(), all_.end(), size_t{0});
    choose_kinds();
    errors_ = log_errors(group_, all_);
    double least = group_.points.front().ms.value, most = least;
    for (const Point& p : group_.points) {
      least = std::min(least, std::max(p.ms.ci95.lo, p.ms.value / 4));
      most = std::max(most, p.ms.ci95.hi);
    }
    x_ = log_axis('x', least, most);
    y_ = log_axis('y', errors_.least, errors_.most);
  }

  Chart chart() {
    Chart c;
    c.kind = "front";
    c.title = fmt::format("{}: {} against time", source_.subject(), metric_title(source_.options.metric));
    c.subtitle = source_.circumstances();
    std::vector<std::string> beside = front_texts();
    for (const Kind& kind : kinds_) beside.push_back("xxxxx" + kind.name);  // and its mark
    make_room(&c, beside, 40);
    if (kinds_.size() > kKindsWithRoom)
      c.height += static_cast<uint32_t>(kRow * static_cast<double>(kinds_.size() - kKindsWithRoom));
    c.notes = notes();
    const PlotPlace at = plot_place(c);
    c.commands = x_.commands + y_.commands +
                 fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                             Gnuplot::quoted(source_.time_label()), Gnuplot::quoted(source_.error_label())) +
                 floor_line(source_, y_);
    c.commands += data();  // says which methods have a point; the names of the front stand below theirs
    c.commands += front_names(c, at);
    c.commands += fmt::format("plot {}\n", fmt::join(curves(), ", \\\n     "));
    return c;
  }

 private:
  bool many() const { return all_.size() > kMostBars; }

  std::vector<std::string> notes() const {
    std::vector<std::string> out = {
        "line: the front, whose points no other case beats in both; the numbered are named on the right"};
    out.push_back(many() ? fmt::format("{} cases; bars, 95 % intervals of error (over seeds) and time (over "
                                       "frames), are those of the front alone",
                                       all_.size())
                         : "bars: 95 % intervals of error (over seeds) and time (over frames)");
    for (std::string& note : error_notes(errors_)) out.push_back(std::move(note));
    if (const std::string note = floor_note(source_, y_); !note.empty()) out.push_back(note);
    if (!told_apart_)
      out.push_back(fmt::format(
          "a mark is a method: {} choices of its settings but N have no room for their own", choices_));
    if (!source_.shared().empty()) out.push_back(source_.shared());
    return out;
  }

  // A method with a choice of all settings but N, or where there are too many of these, a method.
  struct Kind {
    std::string name;
    size_t method = 0, choice = 0;  // its place, and which of its choices
    std::vector<size_t> points;
  };

  void choose_kinds() {
    std::map<std::pair<size_t, std::string>, std::vector<size_t>> by_name;
    std::map<size_t, size_t> of_method;
    for (const size_t i : all_) {
      const size_t method = source_.place(group_.points[i].result->method);
      auto& points = by_name[{method, source_.label_without(i, "N")}];
      of_method[method] += points.empty() ? 1 : 0;
      points.push_back(i);
    }
    choices_ = by_name.size();
    told_apart_ = choices_ <= kMostKinds && std::ranges::all_of(of_method, [](const auto& count) {
                    return count.second <= kMostKindsOfOne;
                  });
    std::map<size_t, size_t> met;
    for (const auto& [key, points] : by_name) {
      const auto& [method, name] = key;
      const size_t choice = told_apart_ ? met[method]++ : 0;
      if (told_apart_ || kinds_.empty() || kinds_.back().method != method)
        kinds_.push_back(
            {told_apart_ ? name : group_.points[points.front()].result->method, method, choice, {}});
      auto& all = kinds_.back().points;
      all.insert(all.end(), points.begin(), points.end());
    }
  }

  // An error of 0 just above the lower edge, where its mark is seen.
  double y(const Point& p) const {
    return p.error.value > 0 ? p.error.value : y_.least * std::pow(y_.most / y_.least, 0.02);
  }

  std::string row(const Point& p) const {
    const double low = y_.least, error = y(p);
    const bool zero = !(p.error.value > 0);
    return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", p.ms.value, error,
                       std::max(p.ms.ci95.lo, x_.least), std::max(p.ms.ci95.hi, p.ms.value),
                       zero ? error : std::max(p.error.ci95.lo, low),
                       zero ? error : std::max(p.error.ci95.hi, error));
  }

  // A block of points a kind, one of errors of 0, the front and its steps, and each series over N.
  std::string data() {
    std::string out;
    for (size_t k = 0; k < kinds_.size(); ++k) {
      std::string rows;
      for (const size_t i : kinds_[k].points) {
        if (group_.points[i].error.value > 0) rows += row(group_.points[i]);
      }
      if (rows.empty()) continue;
      out += fmt::format("$m{} << END\n{}END\n", k, rows);
      drawn_.push_back(k);
    }
    out += "$zero << END\n";
    for (const Point& p : group_.points) {
      if (!(p.error.value > 0)) out += row(p);
    }
    out += "END\n$front << END\n";
    for (const size_t i : front_) out += row(group_.points[i]);
    const Point &first = group_.points[front_.front()], &last = group_.points[front_.back()];
    out += fmt::format("END\n$steps << END\n{:.9g} {:.9g}\n", first.ms.value, y_.most);
    for (const size_t i : front_)
      out += fmt::format("{:.9g} {:.9g}\n", group_.points[i].ms.value, y(group_.points[i]));
    out += fmt::format("{:.9g} {:.9g}\nEND\n", x_.most, y(last));
    return out + joined_data();
  }

  std::string joined_data() {
    if (all_.size() > kMostJoined) return "";
    std::string out;
    for (const Series& s : series_over(group_, "N")) {
      if (s.points.size() < 2) continue;
      out += fmt::format("$n{} << END\n", joined_.size());
      for (const auto& [value, i] : s.points)
        out += fmt::format("{:.9g} {:.9g}\n", group_.points[i].ms.value, y(group_.points[i]));
      out += "END\n";
      joined_.push_back(source_.place(group_.points[s.points.front().second].result->method));
    }
    return out;
  }

  std::vector<std::string> curves() const {
    std::vector<std::string> out;
    for (size_t k = 0; k < joined_.size(); ++k)
      out.push_back(fmt::format("$n{} using 1:2 with lines lw 1 lc rgb '#70{}' notitle", k,
                                colour_of(joined_[k]).substr(1)));
    for (const size_t k : drawn_) {
      const Kind& kind = kinds_[k];
      const std::string style = point_style(kind.method, kind.choice);
      const std::string title = fmt::format("title {} noenhanced", Gnuplot::quoted(kind.name));
      if (many()) {
        out.push_back(fmt::format("$m{} using 1:2 with points {} pointsize 0.5 notitle", k, style));
        out.push_back(fmt::format("NaN with points {} pointsize 1.2 {}", style, title));
      } else {
        out.push_back(fmt::format("$m{} using 1:2:3:4:5:6 with xyerrorbars {} pointsize 1.2 lw 1.2 {}", k,
                                  style, title));
      }
    }
    if (errors_.zero > 0)
      out.push_back("$zero using 1:2 with points pointtype 10 pointsize 1.4 lc rgb 'black' notitle");
    if (many())
      out.push_back(
          "$front using 1:2:3:4:5:6 with xyerrorbars pointtype 6 pointsize 0.9 lw 1.2 lc rgb 'black' "
          "notitle");
    out.push_back("$steps using 1:2 with steps lw 1.8 lc rgb 'black' title 'front'");
    return out;
  }

  // "3  5.1 %, 1.07 ms: vpl N=64", of those that are named.
  std::vector<std::string> front_texts() const {
    std::vector<std::string> out;
    for (const size_t i : evenly(front_, kMostNamed)) {
      const Point& p = group_.points[i];
      out.push_back(fmt::format("{}  {}, {}: {}", out.size() + 1, source_.error_text(p.error.value),
                                ms_text(p.ms.value), source_.label(i)));
    }
    return out;
  }

  // Numbers at the lower left of points, where the front leaves room, and their names beside the plot.
  std::string front_names(const Chart& chart, const PlotPlace& at) const {
    const Font font(13);
    const std::vector<size_t> named = evenly(front_, kMostNamed);
    const std::vector<std::string> texts = front_texts();
    double list = at.top + 34 + kRow * static_cast<double>(drawn_.size());
    std::string out = page_label(chart,
                                 named.size() < front_.size()
                                     ? fmt::format("front, {} of its {} points:", named.size(), front_.size())
                                     : "front:",
                                 at.right + 22, list);
    glm::dvec2 before(-1e9);
    for (size_t k = 0; k < named.size(); ++k) {
      const Point& p = group_.points[named[k]];
      const auto part = [](double v, const LogAxis& a) {
        return std::log(v / a.least) / std::log(a.most / a.least);
      };
      const glm::dvec2 place(at.left + (at.right - at.left) * part(p.ms.value, x_),
                             at.bottom - (at.bottom - at.top) * part(y(p), y_));
      glm::dvec2 label(place.x - 9, place.y + 13);
      if (glm::length(label - before) < kApart) label = before + glm::dvec2(kApart, 8);
      label.y = std::min(label.y, at.bottom - 7);
      before = label;
      out += fmt::format("set label '{}' at screen {:.6f}, screen {:.6f} right font small front\n", k + 1,
                         label.x / chart.width, 1 - label.y / chart.height);
      list += kRow;
      out += page_label(chart, font.fit(texts[k], chart.right - 34), at.right + 22, list);
    }
    return out;
  }

  const ChartSource& source_;
  const PointGroup& group_;
  std::vector<size_t> front_, all_;
  LogErrors errors_;
  LogAxis x_, y_;
  std::vector<Kind> kinds_;     // by method
  size_t choices_ = 0;          // of settings but N, of all methods
  bool told_apart_ = true;      // each has a mark
  std::vector<size_t> drawn_;   // kinds with a point
  std::vector<size_t> joined_;  // places of the methods of series over N
};

}  // namespace

Chart front_chart(const ChartSource& source) { return FrontChart(source).chart(); }

}  // namespace vsglbench
