#include "figure/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/error.h"

namespace vsglbench {
namespace {

// Okabe and Ito's palette, which colour-blind readers can tell apart; dashes do the same for print.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr const char* kDashes[] = {"none", "8 3", "2 2", "8 3 2 3", "12 4", "4 2"};
constexpr double kLeft = 84, kTop = 44, kBottom = 56, kLine = 18, kCharacter = 7.2;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

size_t letters(const std::string& utf8) {
  return std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; });
}

std::string power_of_ten(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) out += kDigits[c - '0'];
  return out;
}

// 1, 2 or 5 times a power of ten, of which about `wanted` fill the range.
double tick_step(double range, int wanted) {
  const double rough = range / wanted, decade = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * decade * (1 + 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

struct Tick {
  double value;
  std::string label;
};

// From a coordinate to pixels.
class Scale {
 public:
  Scale(const PlotAxis& axis, double least, double most, double first, double last)
      : log_(axis.log), low_(least), high_(most), first_(first), last_(last) {
    if (log_) {
      low_ = std::log10(least), high_ = std::log10(most);
    } else if (axis.from_zero) {
      low_ = std::min(low_, 0.0), high_ = std::max(high_, 0.0);
    }
    const double margin = high_ > low_ ? 0.03 * (high_ - low_) : log_ || low_ == 0 ? 0.5 : std::abs(low_) / 2;
    if (log_ || !axis.from_zero || low_ != 0) low_ -= margin;
    if (log_ || !axis.from_zero || high_ != 0) high_ += margin;
  }

  double operator()(double value) const {
    const double t = ((log_ ? std::log10(value) : value) - low_) / (high_ - low_);
    return first_ + t * (last_ - first_);
  }

  std::vector<Tick> ticks() const { return log_ ? log_ticks() : linear_ticks(); }

 private:
  std::vector<Tick> linear_ticks() const {
    const double step = tick_step(high_ - low_, 6);
    std::vector<Tick> out;
    for (double k = std::ceil(low_ / step); k * step <= high_; ++k) {
      out.push_back({k * step, k == 0 ? "0" : fmt::format("{:.6g}", k * step)});
    }
    return out;
  }

  // Whole decades, some left out where they are many; 1, 2, 5 in between where they are few.
  std::vector<Tick> log_ticks() const {
    const int from = static_cast<int>(std::floor(low_)), to = static_cast<int>(std::floor(high_));
    const int every = std::max(1, (to - from + 7) / 8);
    std::vector<Tick> out;
    for (int e = from; e <= to; ++e) {
      if (e % every != 0) continue;
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, e);
        if (std::log10(value) < low_ || std::log10(value) > high_) continue;
        if (factor == 1) out.push_back({value, power_of_ten(e)});
        if (factor != 1 && high_ - low_ < 1.5) out.push_back({value, fmt::format("{:.6g}", value)});
      }
    }
    return out;
  }

  bool log_;
  double low_, high_, first_, last_;
};

void check(const Plot& plot) {
  if (plot.curves.empty()) throw fail(ErrorKind::case_failed, "plot '{}' has no curve", plot.title);
  const auto refuse = [&](const Curve& curve, const glm::dvec2& p, const char* what) {
    return fail(ErrorKind::case_failed, "plot '{}': curve '{}' has the point ({}, {}), {}", plot.title,
                curve.name, p.x, p.y, what);
  };
  for (const Curve& curve : plot.curves) {
    if (curve.points.empty()) {
      throw fail(ErrorKind::case_failed, "plot '{}': curve '{}' has no points", plot.title, curve.name);
    }
    for (const glm::dvec2& p : curve.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) throw refuse(curve, p, "which is not finite");
      if ((plot.x.log && p.x <= 0) || (plot.y.log && p.y <= 0)) {
        throw refuse(curve, p, "which a logarithmic axis can't show");
      }
    }
  }
}

Scale scale_of(const Plot& plot, int axis, double first, double last) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Curve& curve : plot.curves) {
    for (const glm::dvec2& p : curve.points) least = std::min(least, p[axis]), most = std::max(most, p[axis]);
  }
  return Scale(axis == 0 ? plot.x : plot.y, least, most, first, last);
}

class Writer {
 public:
  explicit Writer(const Plot& plot)
      : plot_(plot),
        right_(kLeft + plot.width),
        bottom_(kTop + plot.height),
        x_(scale_of(plot, 0, kLeft, right_)),
        y_(scale_of(plot, 1, bottom_, kTop)) {}

  std::string write() {
    begin();
    axes();
    for (size_t i = 0; i < plot_.curves.size(); ++i) curve(i);
    legend();
    for (size_t i = 0; i < plot_.notes.size(); ++i) {
      text(kLeft, bottom_ + kBottom + kLine * static_cast<double>(i), "start", plot_.notes[i], 12);
    }
    add("</svg>\n");
    return fmt::to_string(out_);
  }

 private:
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
  }
  void text(double x, double y, const char* anchor, const std::string& what, int size,
            const char* more = "") {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\"{}>{}</text>\n", x, y, anchor,
        size, more, escaped(what));
  }

  void begin() {
    // Wide enough for the longest line of the legend, and of the title and the notes.
    size_t longest = 0, widest = 0;
    for (const Curve& c : plot_.curves) longest = std::max(longest, letters(c.name));
    for (const auto& note : plot_.notes) widest = std::max(widest, letters(note));
    const double width = std::max({right_ + 64 + kCharacter * static_cast<double>(longest),
                                   kLeft + 20 + 6.6 * static_cast<double>(widest),
                                   kLeft + 20 + 8.4 * static_cast<double>(letters(plot_.title))});
    const double rows = static_cast<double>(plot_.notes.size());
    const double height = std::max(bottom_ + kBottom + kLine * rows,
                                   kTop + kLine * static_cast<double>(plot_.curves.size() + 1));
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} "
        "{1:.0f}\" font-family=\"sans-serif\" fill=\"#000\">\n",
        width, height);
    add("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    text(kLeft, kTop - 18, "start", plot_.title, 15, " font-weight=\"bold\"");
  }

  void axes() {
    for (const Tick& tick : x_.ticks()) {
      line(x_(tick.value), kTop, x_(tick.value), bottom_, "#ddd");
      text(x_(tick.value), bottom_ + 17, "middle", tick.label, 12);
    }
    for (const Tick& tick : y_.ticks()) {
      line(kLeft, y_(tick.value), right_, y_(tick.value), "#ddd");
      text(kLeft - 7, y_(tick.value) + 4, "end", tick.label, 12);
    }
    add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#555\"/>\n", kLeft,
        kTop, plot_.width, plot_.height);
    text((kLeft + right_) / 2, bottom_ + 36, "middle", plot_.x.label, 13);
    const double middle = (kTop + bottom_) / 2;
    const std::string turn = fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle);
    text(18, middle, "middle", plot_.y.label, 13, turn.c_str());
  }

  void line(double x1, double y1, double x2, double y2, const char* colour) {
    add("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
        colour);
  }

  void stroke(size_t i, const std::string& points) {
    const bool published = plot_.curves[i].published;
    add("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" "
        "stroke-dasharray=\"{}\"/>\n",
        points, published ? "#000" : kColours[i % std::size(kColours)],
        published ? "5 5" : kDashes[i % std::size(kDashes)]);
  }
  void mark(size_t i, double x, double y) {
    const bool published = plot_.curves[i].published;
    const char* colour = published ? "#000" : kColours[i % std::size(kColours)];
    add("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", x,
        y, published ? "#fff" : colour, colour);
  }

  void curve(size_t i) {
    const Curve& c = plot_.curves[i];
    std::string points;
    for (const glm::dvec2& p : c.points) points += fmt::format("{:.2f},{:.2f} ", x_(p.x), y_(p.y));
    if (c.style != CurveStyle::points) stroke(i, points);
    if (c.style == CurveStyle::line) return;
    for (const glm::dvec2& p : c.points) mark(i, x_(p.x), y_(p.y));
  }

  void legend() {
    for (size_t i = 0; i < plot_.curves.size(); ++i) {
      const Curve& c = plot_.curves[i];
      const double left = right_ + 14, y = kTop + 8 + kLine * static_cast<double>(i);
      if (c.style != CurveStyle::points) {
        stroke(i, fmt::format("{:.1f},{:.1f} {:.1f},{:.1f}", left, y, left + 32, y));
      }
      if (c.style != CurveStyle::line) mark(i, left + 16, y);
      text(left + 40, y + 4, "start", c.name, 12);
    }
  }

  const Plot& plot_;
  double right_, bottom_;
  Scale x_, y_;
  fmt::memory_buffer out_;
};

}  // namespace

std::string to_svg(const Plot& plot) {
  check(plot);
  return Writer(plot).write();
}

}  // namespace vsglbench
