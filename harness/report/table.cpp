#include "report/table.h"

#include <algorithm>

namespace vsglbench {
namespace {

using Row = std::vector<std::string>;

// A case's numbers, or why there are none.
struct Line {
  Row cells;
  std::string message;
};

struct Table {
  Row heads;
  std::vector<Line> lines;
};

std::string error_cell(const MetricResult& metric, double scale, const char* format,
                       std::optional<double> floor) {
  if (!metric.value) return "undefined";
  std::string text = fmt::format(fmt::runtime(format), *metric.value * scale);
  if (floor && *metric.value <= *floor)
    return text + " ≤ floor " + fmt::format(fmt::runtime(format), *floor * scale);
  if (metric.ci95) text += fmt::format(" ± {:.2g}", 0.5 * metric.ci95->width() * scale);
  return text;
}

Row cells_of_frame(const CaseResult& c) {
  Row cells(6);
  cells[0] = c.id;
  if (c.accuracy) {
    const Accuracy& a = *c.accuracy;
    cells[1] = error_cell(a.smape, 1, "{:.2f}", a.reference.noise_floor_smape);
    cells[2] = error_cell(a.rmse, 1, "{:.4g}", a.reference.noise_floor_rmse);
    cells[3] = error_cell(a.bias, 100, "{:+.2f}", std::nullopt);
  }
  if (c.generate) cells[4] = fmt::format("{:.2f}", c.generate->total.median);
  if (c.frame) cells[5] = fmt::format("{:.2f}", c.frame->span.median);
  return cells;
}

std::string ratio_cell(const Summary& time, const Summary& first) {
  if (time.min <= 0 || first.min <= 0) return "undefined";  // the device's clock saw no time pass
  const Ratio r = median_ratio(time.samples, first.samples);
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", r.value, r.ci95.lo, r.ci95.hi);
}

Row cells_of_generation(const CaseResult& c, const CaseResult& first) {
  const GenerateResult& g = *c.generate;
  return {c.id, fmt::format("{:.2f}", g.total.median), fmt::format("{:.2f}", g.gbuffer_ms),
          fmt::format("{:.2f}", g.rsm_ms),
          c.id == first.id ? "1" : ratio_cell(g.total, first.generate->total)};
}

Table table_of(const Report& report) {
  const bool generation = std::any_of(report.cases.begin(), report.cases.end(),
                                      [](const CaseResult& c) { return c.measure == Measure::generation; });
  Table table;
  table.heads = generation ? Row{"case", "generate ms", "G-buffer ms", "RSM ms", "x first [95 %]"}
                           : Row{"case", "SMAPE %", "RMSE", "bias %", "generate ms", "frame ms"};
  const CaseResult* first = nullptr;  // sound one of the scene
  for (const CaseResult& c : report.cases) {
    if (c.status != Status::ok) {
      table.lines.push_back(
          {{c.id}, fmt::format("{}: {}", name(c.status), c.error ? c.error->message : "no reason recorded")});
      continue;
    }
    if (!first || first->scene != c.scene) first = &c;
    table.lines.push_back({generation ? cells_of_generation(c, *first) : cells_of_frame(c), ""});
  }
  return table;
}

// Columns on a terminal: one for each sign of UTF-8 text.
size_t display_width(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padding(size_t width, const std::string& text) {
  return std::string(width - std::min(width, display_width(text)), ' ');
}

// What a reader must know of the numbers above.
std::vector<std::string> notes(const Report& report) {
  std::vector<std::string> out;
  const bool cpu = report.device.type == "cpu";
  out.push_back(fmt::format(
      "device: {}, {}; host: {}", report.device.name,
      cpu ? "a CPU: do not compare its times with a GPU's" : report.device.type + " GPU", report.host.cpu));
  if (report.aa) {
    out.push_back(fmt::format("times that differ by less than {:.2g} % are noise (A/A pair {})",
                              100 * report.aa->noise_floor, report.aa->case_id));
  }
  if (report.config.value("measure", "") == "generation") {
    out.push_back(fmt::format(
        "only generation was measured: every case of a scene on the same halves and PDFs, made by {}",
        report.config.value("pdfs_made_by", "an unknown method")));
  }
  if (!report.complete) out.push_back("incomplete: the run was stopped before its last case");
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : std::string(1, c);
  return out;
}

}  // namespace

std::string terminal_table(const Report& report) {
  const Table table = table_of(report);
  std::vector<size_t> widths;
  for (const auto& head : table.heads) widths.push_back(display_width(head));
  for (const Line& line : table.lines) {
    for (size_t i = 0; i < line.cells.size(); ++i)
      widths[i] = std::max(widths[i], display_width(line.cells[i]));
  }
  std::string out;
  const auto put = [&](const Row& cells, const std::string& message) {
    out += cells[0] + padding(widths[0], cells[0]);
    if (!message.empty()) out += "  " + message;
    for (size_t i = 1; i < cells.size(); ++i) out += "  " + padding(widths[i], cells[i]) + cells[i];
    out += '\n';
  };
  put(table.heads, "");
  for (const Line& line : table.lines) put(line.cells, line.message);
  for (const auto& note : notes(report)) out += note + '\n';
  return out;
}

std::string markdown_table(const Report& report) {
  const Table table = table_of(report);
  std::string out = "|", rule = "|";
  for (size_t i = 0; i < table.heads.size(); ++i) {
    out += fmt::format(" {} |", table.heads[i]);
    rule += i == 0 ? " --- |" : " ---: |";
  }
  out += '\n' + rule + '\n';
  for (const Line& line : table.lines) {
    Row cells = line.cells;
    if (!line.message.empty()) cells.push_back(line.message);
    cells.resize(table.heads.size());
    out += "|";
    for (const auto& cell : cells) out += cell.empty() ? " |" : fmt::format(" {} |", escaped(cell));
    out += '\n';
  }
  for (const auto& note : notes(report)) out += "\n" + note + "\n";
  return out;
}

}  // namespace vsglbench
