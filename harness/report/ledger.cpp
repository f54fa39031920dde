#include "report/ledger.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/printable.h"
#include "report/table_layout.h"

namespace vsglbench {
namespace {

double mib(int64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

bool is_priced(const EffectReport& e) { return e.ms && e.ms_ci95 && e.bytes; }

std::string price_of(const EffectReport& e) {
  if (!is_priced(e)) return "";
  return fmt::format("{:+.2f} ms [{:.2f} … {:.2f}], {:+.2f} MiB", *e.ms, e.ms_ci95->lo, e.ms_ci95->hi,
                     mib(*e.bytes));
}

std::string rows(const std::vector<EffectReport>& effects, const char* indent, bool reasons) {
  size_t name_width = 0, price_width = 0;
  for (const EffectReport& e : effects) {
    name_width = std::max(name_width, e.name.size());
    price_width = std::max(price_width, display_width(price_of(e)));
  }
  std::string out;
  for (const EffectReport& e : effects) {
    if (!reasons && !is_priced(e)) continue;
    out += fmt::format("{}{:<{}}  {}", indent, e.name, name_width, e.needed ? "needed " : "skipped");
    if (price_width > 0) out += fmt::format("  {:<{}}", price_of(e), reasons ? price_width : 0);
    if (reasons) out += "  " + printable(e.reason);
    out += '\n';
  }
  return out;
}

std::string total_of(const EffectPricing& p) {
  return fmt::format(
      "{}: {:.1f} ms and {:.1f} MiB; with all effects {:.1f} ms and {:.1f} MiB, {:.2f} [{:.2f} … {:.2f}] "
      "times as long; {} rounds, {:.1f} s\n",
      printable(p.case_id), p.span_ms, mib(p.bytes), p.span_ms_all, mib(p.bytes_all), p.ratio.value,
      p.ratio.ci95.lo, p.ratio.ci95.hi, p.rounds, p.seconds);
}

}  // namespace

std::string ledger_text(const std::vector<EffectReport>& effects) { return rows(effects, "", true); }

std::string short_ledger(const SceneReport& scene) {
  std::vector<std::string> needed;
  for (const EffectReport& e : scene.effects)
    if (e.needed) needed.push_back(e.name);
  std::string out = fmt::format("{} calls for {} of {} effects: {}\n", printable(scene.name), needed.size(),
                                scene.effects.size(), fmt::join(needed, ", "));
  if (scene.effects_priced) out += "  " + total_of(*scene.effects_priced) + rows(scene.effects, "  ", false);
  return out;
}

std::string ledgers_of(const Report& report) {
  std::string out;
  for (const SceneReport& scene : report.scenes) {
    if (scene.effects.empty()) continue;
    if (!out.empty()) out += '\n';
    out += fmt::format("{}\n{}", printable(scene.name), ledger_text(scene.effects));
    if (scene.effects_priced) out += total_of(*scene.effects_priced);
  }
  if (out.empty()) throw fail(ErrorKind::usage, "this report holds no ledger of effects; it is of old");
  return out;
}

}  // namespace vsglbench
