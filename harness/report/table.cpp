#include "report/table.h"

#include <algorithm>
#include <array>

namespace vsglbench {
namespace {

constexpr std::array<const char*, 6> kHeads = {"case",   "SMAPE %",     "RMSE",
                                               "bias %", "generate ms", "frame ms"};
using Row = std::array<std::string, kHeads.size()>;

// A case's numbers, or why there are none.
struct Line {
  Row cells;
  std::string message;
};

std::string error_cell(const MetricResult& metric, double scale, const char* format,
                       std::optional<double> floor) {
  if (!metric.value) return "undefined";
  if (floor && *metric.value <= *floor)
    return "≤ floor (" + fmt::format(fmt::runtime(format), *floor * scale) + ")";
  std::string text = fmt::format(fmt::runtime(format), *metric.value * scale);
  if (metric.ci95) text += fmt::format(" ± {:.2g}", 0.5 * metric.ci95->width() * scale);
  return text;
}

Line line_of(const CaseResult& c) {
  Line line;
  line.cells[0] = c.id;
  if (c.status != Status::ok) {
    line.message = fmt::format("{}: {}", name(c.status), c.error ? c.error->message : "no reason recorded");
    return line;
  }
  if (c.accuracy) {
    const Accuracy& a = *c.accuracy;
    line.cells[1] = error_cell(a.smape, 1, "{:.2f}", a.reference.noise_floor_smape);
    line.cells[2] = error_cell(a.rmse, 1, "{:.4g}", a.reference.noise_floor_rmse);
    line.cells[3] = error_cell(a.bias, 100, "{:+.2f}", std::nullopt);
  }
  if (c.generate) line.cells[4] = fmt::format("{:.2f}", c.generate->total.median);
  if (c.frame) line.cells[5] = fmt::format("{:.2f}", c.frame->span.median);
  return line;
}

std::vector<Line> lines_of(const Report& report) {
  std::vector<Line> lines;
  for (const CaseResult& c : report.cases) lines.push_back(line_of(c));
  return lines;
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
  const std::vector<Line> lines = lines_of(report);
  std::array<size_t, kHeads.size()> widths;
  for (size_t i = 0; i < kHeads.size(); ++i) {
    widths[i] = display_width(kHeads[i]);
    for (const Line& line : lines) widths[i] = std::max(widths[i], display_width(line.cells[i]));
  }
  std::string out;
  const auto put = [&](const Row& cells, const std::string& message) {
    out += cells[0];
    if (!message.empty()) {
      out += padding(widths[0], cells[0]) + "  " + message;
    } else {
      out += padding(widths[0], cells[0]);
      for (size_t i = 1; i < cells.size(); ++i) out += "  " + padding(widths[i], cells[i]) + cells[i];
    }
    out += '\n';
  };
  Row heads;
  std::copy(kHeads.begin(), kHeads.end(), heads.begin());
  put(heads, "");
  for (const Line& line : lines) put(line.cells, line.message);
  for (const auto& note : notes(report)) out += note + '\n';
  return out;
}

std::string markdown_table(const Report& report) {
  std::string out = "|", rule = "|";
  for (size_t i = 0; i < kHeads.size(); ++i) {
    out += fmt::format(" {} |", kHeads[i]);
    rule += i == 0 ? " --- |" : " ---: |";
  }
  out += '\n' + rule + '\n';
  for (const Line& line : lines_of(report)) {
    if (line.message.empty()) {
      out += "|";
      for (const auto& cell : line.cells) out += fmt::format(" {} |", escaped(cell));
    } else {
      out += fmt::format("| {} | {} | | | | |", escaped(line.cells[0]), escaped(line.message));
    }
    out += '\n';
  }
  for (const auto& note : notes(report)) out += "\n" + note + "\n";
  return out;
}

}  // namespace vsglbench
