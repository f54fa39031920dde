#include "run/coverage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace vsglbench {
namespace {

// A side of a square: what it adds to the number of lights to its right.
struct Edge {
  double x;
  int step;
  bool operator<(const Edge& o) const { return x != o.x ? x < o.x : step < o.step; }
};

// A square enters or leaves the scanline.
struct Event {
  double y;
  bool enters;
  Edge left, right;
};

std::vector<Event> events_of(const std::vector<glm::vec4>& squares, double width, double height) {
  std::vector<Event> events;
  for (const glm::vec4& s : squares) {
    const double half = 0.5 * s.z;
    const double x0 = std::clamp(s.x - half, 0.0, width), x1 = std::clamp(s.x + half, 0.0, width);
    const double y0 = std::clamp(s.y - half, 0.0, height), y1 = std::clamp(s.y + half, 0.0, height);
    if (!(x0 < x1 && y0 < y1)) continue;
    events.push_back({y0, true, {x0, 1}, {x1, -1}});
    events.push_back({y1, false, {x0, 1}, {x1, -1}});
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.y < b.y; });
  return events;
}

// The edges on the scanline, from left to right.
class Scanline {
 public:
  void apply(const Event& event) {
    for (const Edge& edge : {event.left, event.right}) {
      const auto at = std::lower_bound(edges_.begin(), edges_.end(), edge);
      if (event.enters) {
        edges_.insert(at, edge);
      } else {
        edges_.erase(at);
      }
    }
  }
  // span(from, to, count) for each part of 0 … width.
  template <class Span>
  void spans(double width, const Span& span) const {
    double from = 0;
    int count = 0;
    for (const Edge& edge : edges_) {
      if (edge.x > from) span(from, edge.x, count);
      from = edge.x;
      count += edge.step;
    }
    if (width > from) span(from, width, count);
  }

 private:
  std::vector<Edge> edges_;
};

// ∫ of a row of the PDF from its left end to x.
class RowIntegral {
 public:
  void set(const float* row, uint32_t width) {
    row_ = row;
    sums_.assign(1, 0);
    for (uint32_t x = 0; x < width; ++x) sums_.push_back(sums_.back() + row[x]);
  }
  double to(double x) const {
    const auto texel = std::min(static_cast<size_t>(x), sums_.size() - 2);
    return sums_[texel] + (x - static_cast<double>(texel)) * row_[texel];
  }

 private:
  const float* row_ = nullptr;
  std::vector<double> sums_;
};

// Integrals over what is below the scanline.
struct Integrals {
  double all = 0, overlap = 0, gap = 0;
  void add(double amount, int count) {
    all += amount;
    overlap += std::max(count - 1, 0) * amount;
    if (count == 0) gap += amount;
  }
};

Coverage means(const Integrals& area, const Integrals& pdf) {
  Coverage c{area.overlap / area.all, area.gap / area.all, std::nullopt, std::nullopt};
  if (pdf.all > 0) {
    c.pdf_overlap = pdf.overlap / pdf.all;
    c.pdf_gap = pdf.gap / pdf.all;
  }
  return c;
}

glm::vec4 checked(const glm::vec4& square, size_t light) {
  if (std::isfinite(square.x) && std::isfinite(square.y) && std::isfinite(square.z) && square.z >= 0)
    return square;
  throw fail(ErrorKind::plugin, "the kernel of light {} is no square: centre ({}, {}), side {}", light,
             square.x, square.y, square.z);
}

template <class T>
std::vector<T> read(const Buffer& buffer, uint64_t count) {
  if (buffer.size() >= count * sizeof(T)) return buffer.download<T>(count);
  throw fail(ErrorKind::plugin, "the method's light shapes have {} bytes for {} records of {}", buffer.size(),
             count, sizeof(T));
}

std::vector<uint32_t> read_clusters(const LightShapes& shapes, uint32_t lights, uint64_t texels) {
  const auto ids = read<uint32_t>(*shapes.ids, texels);
  if (!shapes.texels) return ids;
  const auto places = read<uint32_t>(*shapes.texels, texels);
  std::vector<uint32_t> clusters(texels, lights);
  for (size_t i = 0; i < texels; ++i) {
    if (places[i] >= texels)
      throw fail(ErrorKind::plugin, "cluster {} has texel {}, outside of the RSM", ids[i], places[i]);
    clusters[places[i]] = ids[i];
  }
  return clusters;
}

}  // namespace

RsmShapes read_shapes(const LightShapes& shapes, uint32_t lights, uint64_t texels) {
  RsmShapes out;
  if (shapes.squares) {
    out.squares = read<glm::vec4>(*shapes.squares, lights);
    for (size_t i = 0; i < out.squares.size(); ++i) checked(out.squares[i], i);
  } else if (shapes.ids) {
    out.clusters = read_clusters(shapes, lights, texels);
  }
  return out;
}

Coverage cover_squares(const std::vector<glm::vec4>& squares, uint32_t width, uint32_t height,
                       const std::vector<float>& pdf) {
  const std::vector<Event> events = events_of(squares, width, height);
  Scanline scanline;
  RowIntegral row_pdf;
  Integrals area, weighted;
  auto event = events.begin();
  for (uint32_t row = 0; row < height; ++row) {
    if (!pdf.empty()) row_pdf.set(&pdf[size_t(row) * width], width);
    // Strips of the row between one event and the next: the scanline is the same all through.
    for (double y = row; y < row + 1.0;) {
      for (; event != events.end() && event->y <= y; ++event) scanline.apply(*event);
      const double end = event == events.end() ? row + 1.0 : std::min(row + 1.0, event->y);
      scanline.spans(width, [&](double from, double to, int count) {
        area.add((end - y) * (to - from), count);
        if (!pdf.empty()) weighted.add((end - y) * (row_pdf.to(to) - row_pdf.to(from)), count);
      });
      y = end;
    }
  }
  return means(area, weighted);
}

Coverage cover_clusters(const std::vector<uint32_t>& clusters, uint32_t lights,
                        const std::vector<float>& pdf) {
  Integrals area, weighted;
  for (size_t i = 0; i < clusters.size(); ++i) {
    const int count = clusters[i] < lights ? 1 : 0;
    area.add(1, count);
    if (!pdf.empty()) weighted.add(pdf[i], count);
  }
  return means(area, weighted);
}

std::optional<Coverage> coverage_of(const RsmShapes& shapes, uint32_t lights, uint32_t width, uint32_t height,
                                    const std::vector<float>& pdf) {
  if (!shapes.squares.empty()) return cover_squares(shapes.squares, width, height, pdf);
  if (!shapes.clusters.empty()) return cover_clusters(shapes.clusters, lights, pdf);
  return std::nullopt;
}

}  // namespace vsglbench
