// Error against the values of one key.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "answer/chart.h"
#include "answer/series.h"
#include "figure/axis.h"
#include "image/font.h"

namespace vsglbench {
namespace {

constexpr size_t kMostSeries = 14;

class SeriesChart {
 public:
  SeriesChart(const ChartSource& source, std::string key) : source_(source), key_(std::move(key)) {
    for (Series& s : series_over(source.group, key_)) {
      if (s.points.size() > 1) series_.push_back(std::move(s));
    }
    in_all_ = series_.size();
    choose();
    for (const Series& s : series_) {
      for (const auto& [value, i] : s.points) points_.push_back(i), note_value(value);
    }
  }

  bool empty() const { return series_.empty(); }

  Chart chart() const {
    const LogErrors errors = log_errors(source_.group, points_);
    const LogAxis y = log_axis('y', errors.least, errors.most);
    Chart c;
    c.kind = "over-" + key_;
    c.title = fmt::format("{}: {} over {}", source_.subject(), metric_title(source_.options.metric), key_);
    c.subtitle = source_.report.device.name;
    c.notes = {"bars: 95 % intervals over seeds; a line joins cases that differ in " + key_ + " alone"};
    if (series_.size() < in_all_)
      c.notes.push_back(
          fmt::format("{} of {} lines: of every method those with the least error", series_.size(), in_all_));
    for (std::string& note : error_notes(errors)) c.notes.push_back(std::move(note));
    if (const std::string note = floor_note(source_, y); !note.empty()) c.notes.push_back(note);
    if (!source_.shared().empty()) c.notes.push_back(source_.shared());
    c.commands = y.commands + floor_line(source_, y) + x_axis() +
                 fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                             Gnuplot::quoted(key_label()), Gnuplot::quoted(source_.error_label()));
    std::vector<std::string> curves, names;
    for (const Series& line : series_)
      names.push_back(source_.label_without(line.points.front().second, key_));
    make_room(&c, names, 80);
    const Font font(13);
    for (size_t k = 0; k < series_.size(); ++k) {
      c.commands += fmt::format("$s{} << END\n", k);
      for (const auto& [value, i] : series_[k].points)
        c.commands += row(value, source_.group.points[i], y, k);
      c.commands += "END\n";
      const std::string name = font.fit(names[k], c.right - 74);
      curves.push_back(fmt::format(
          "$s{0} using 1:2 with lines lw 1.5 lc rgb '{1}' notitle, \\\n"
          "     $s{0} using 1:2:3:4 with yerrorbars {2} pointsize 1.2 lw 1.2 title {3} noenhanced",
          k, colour_of(k), point_style(k), Gnuplot::quoted(name)));
    }
    c.commands += fmt::format("plot {}\n", fmt::join(curves, ", \\\n     "));
    return c;
  }

 private:
  double least_error(const Series& s) const {
    double least = source_.group.points[s.points.front().second].error.value;
    for (const auto& [value, i] : s.points) least = std::min(least, source_.group.points[i].error.value);
    return least;
  }
  const std::string& method(const Series& s) const {
    return source_.group.points[s.points.front().second].result->method;
  }

  // Every method's best, then every method's second, as many as can be told apart; then by method.
  void choose() {
    std::ranges::stable_sort(series_, {}, [&](const Series& s) { return least_error(s); });
    std::map<std::string, size_t> met;
    std::vector<std::pair<size_t, size_t>> order;  // rank within the method, index
    for (size_t k = 0; k < series_.size(); ++k) order.emplace_back(met[method(series_[k])]++, k);
    std::ranges::stable_sort(order, {}, [](const auto& o) { return o.first; });
    order.resize(std::min(order.size(), kMostSeries));
    std::vector<Series> chosen;
    for (const auto& [rank, k] : order) chosen.push_back(series_[k]);
    std::ranges::stable_sort(chosen, {}, [&](const Series& s) { return source_.place(method(s)); });
    series_ = std::move(chosen);
  }

  void note_value(const Json& value) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (std::ranges::count(names_, text) == 0) names_.push_back(text);
    numbers_ = numbers_ && value.is_number();
    if (!value.is_number()) return;
    values_.insert(value.get<double>());
  }
  bool log() const { return numbers_ && *values_.begin() > 0; }

  std::string key_label() const {
    static const std::map<std::string, std::string> words = {
        {"N", "N, lights"}, {"rsm", "rsm, texels along an edge"}, {"importance_lights", "importance lights"}};
    const auto at = words.find(key_);
    return at == words.end() ? key_ : at->second;
  }

  std::string x_axis() const {
    std::vector<std::string> tics;
    if (!numbers_) {
      for (size_t k = 0; k < names_.size(); ++k)
        tics.push_back(fmt::format("{} {}", Gnuplot::quoted(names_[k]), k));
      return fmt::format("set xrange [-0.5:{}]\nset xtics noenhanced ({})\n",
                         static_cast<double>(names_.size()) - 0.5, fmt::join(tics, ", "));
    }
    for (const double v : values_) tics.push_back(fmt::format("{:.6g}", v));
    const std::string at = fmt::format("set xtics ({})\n", fmt::join(tics, ", "));
    if (log())
      return log_axis('x', *values_.begin(), *values_.rbegin()).commands +
             "set format x '%g'\nset mxtics 1\n" + at;
    const double margin = 0.04 * (*values_.rbegin() - *values_.begin());
    return fmt::format("set xrange [{}:{}]\n", *values_.begin() - margin, *values_.rbegin() + margin) + at;
  }

  double x(const Json& value, size_t line) const {
    if (!numbers_) {
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      const auto place = static_cast<double>(std::ranges::find(names_, text) - names_.begin());
      return place + 0.4 * ((static_cast<double>(line) + 0.5) / static_cast<double>(series_.size()) - 0.5);
    }
    return value.get<double>();
  }

  std::string row(const Json& value, const Point& p, const LogAxis& y, size_t line) const {
    const bool zero = !(p.error.value > 0);
    const double error = zero ? y.least * std::pow(y.most / y.least, 0.02) : p.error.value;
    return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", x(value, line), error,
                       zero ? error : std::max(p.error.ci95.lo, y.least),
                       zero ? error : std::max(p.error.ci95.hi, error));
  }

  const ChartSource& source_;
  std::string key_;
  std::vector<Series> series_;
  size_t in_all_ = 0;
  std::vector<size_t> points_;
  std::vector<std::string> names_;  // of values, in the order met
  std::set<double> values_;
  bool numbers_ = true;
};

}  // namespace

std::optional<Chart> series_chart(const ChartSource& source, const std::string& key) {
  const SeriesChart chart(source, key);
  if (chart.empty()) return std::nullopt;
  return chart.chart();
}

}  // namespace vsglbench
