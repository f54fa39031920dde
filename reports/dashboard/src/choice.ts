// What the shared keys of the state mean for the chosen report.
import type { Cases, Estimates, Group, Metric, Report } from "./data";
import type { Page } from "./view";

export function groupIndex({ report, state }: Page): number {
  const g = state.number("g", 0);
  return g >= 0 && g < report.groups.length ? g : 0;
}

// Undefined where no case has an error.
export function groupOf(page: Page): Group | undefined {
  return page.report.groups[groupIndex(page)];
}

export function groupName(report: Report, group: Group): string {
  const name = report.scenes[group.scene].name;
  const rivals = report.groups.filter((g) => g.scene === group.scene);
  const same = rivals.filter((g) => g.visibility === group.visibility);
  const what = group.visibility === "none" ? "without occlusion" : "with occlusion";
  return rivals.length === 1 ? name : `${name}, ${what}` + (same.length > 1 ? `, reference ${group.reference.slice(0, 6)}` : "");
}

// The metrics and times that at least one case has.
export function metricsThere(report: Report): Metric[] {
  return report.metrics.filter((m) => report.cases.errors[m.name]?.value.some((v) => v !== null));
}
export function timesThere(report: Report): Report["times"] {
  return report.times.filter((t) => report.cases.times[t.name]?.value.some((v) => v !== null));
}

// Of a report without any error, or time, one without a name.
export function metricOf({ report, state }: Page): Metric {
  const there = metricsThere(report);
  return there.find((m) => m.name === state.get("m")) ?? there[0] ?? { name: "", title: "no error", unit: "" };
}

export function timeOf({ report, state }: Page): Report["times"][number] {
  const there = timesThere(report);
  return there.find((t) => t.name === state.get("t")) ?? there.find((t) => t.name === "method") ?? there[0] ?? { name: "", words: "no time" };
}

export function errorsOf(page: Page): Cases["errors"][string] {
  return page.report.cases.errors[metricOf(page).name] ?? { value: [], lo: [], hi: [], heavy: [], seeds: [] };
}
export function timesOf(page: Page): Estimates {
  return page.report.cases.times[timeOf(page).name] ?? { value: [], lo: [], hi: [] };
}

export function hiddenMethods({ state }: Page): Set<string> {
  return new Set(state.list("x"));
}

export function methodOf(report: Report, c: number): string {
  return report.methods[report.cases.method[c]];
}

// Indices of the cases of the chosen group, or of its scene, whose method is shown.
export function casesShown(page: Page, of: "group" | "scene" | "report" = "group"): number[] {
  const { report } = page;
  const hidden = hiddenMethods(page);
  const g = groupIndex(page);
  const scene = groupOf(page)?.scene ?? 0;
  const out: number[] = [];
  report.cases.id.forEach((_, c) => {
    if (hidden.has(methodOf(report, c))) return;
    if (of === "group" && report.cases.group[c] !== g) return;
    if (of === "scene" && report.cases.scene[c] !== scene) return;
    out.push(c);
  });
  return out;
}

export function selectedCases({ report, state }: Page): number[] {
  return state.list("c").map(Number).filter((c) => Number.isInteger(c) && c >= 0 && c < report.cases.id.length);
}

// "N=64, rsm=128": what the case's own settings are; those shared by all cases are left out.
export function settingsOf(report: Report, c: number): [string, string][] {
  const out: [string, string][] = [];
  for (const [key, column] of Object.entries(report.cases.parameters)) {
    const v = column[c];
    if (v === null || v === undefined || v === "" || key in report.settings) continue;
    out.push([key, String(v)]);
  }
  return out;
}
