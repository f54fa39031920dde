// Error against time of one group: the front, what it dominates, and what the next step along it costs and brings.
import { casesShown, groupName, groupOf, metricOf, selectedCases, settingsOf, timeOf } from "../choice";
import { lookOf, swatch } from "../colours";
import { h } from "../dom";
import { bytes, figure, signed, withInterval } from "../format";
import { place, pointsOf } from "../pareto";
import type { Placed } from "../pareto";
import { table } from "../table";
import type { Column } from "../table";
import type { Page, View } from "../view";
import { frontChart } from "./front_chart";
import { details } from "./front_details";

// What the chart, the panel and the tables are drawn from.
export interface FrontData {
  page: Page;
  title: string; // of the group
  placed: Placed[]; // by time
  front: Placed[];
  byCase: Map<number, Placed>;
  floor: number | null; // of the metric: the error of an exact image
  ms: string; // name of the time
  metric: { title: string; unit: string };
}

function dataOf(page: Page): FrontData | null {
  const group = groupOf(page);
  if (!group) return null;
  const metric = metricOf(page), time = timeOf(page);
  const points = pointsOf(page.report.cases, casesShown(page), metric.name, time.name);
  const placed = place(points, group.noise[time.name] ?? 0);
  return {
    page, placed, metric,
    title: groupName(page.report, group),
    front: placed.filter((p) => p.standing === "front"),
    byCase: new Map(placed.map((p) => [p.point.case, p])),
    floor: group.floor[metric.name] ?? null,
    ms: time.name,
  };
}

type Toggle = (c: number) => void;

function baseColumns({ page, metric, ms }: FrontData): Column<Placed>[] {
  const { report, digest } = page;
  const method = (p: Placed) => report.methods[report.cases.method[p.point.case]];
  return [
    { key: "case", title: "case", value: (p) => report.cases.label[p.point.case], node: (p) => swatch(lookOf(digest, method(p))) },
    { key: "ms", title: ms, unit: "ms", value: (p) => p.point.ms, text: (p) => withInterval(p.point.ms, p.point.msLo, p.point.msHi, "") },
    { key: "error", title: metric.title, unit: metric.unit, value: (p) => p.point.error, text: (p) => withInterval(p.point.error, p.point.errorLo, p.point.errorHi, "") },
  ];
}

function extraColumns({ page: { report } }: FrontData): Column<Placed>[] {
  return report.extra.map((e) => {
    const value = (p: Placed) => report.cases.extra[e.name]?.[p.point.case] ?? null;
    return { key: e.name, title: e.unit === "B" ? e.name.replace("_bytes", "") : e.name.replaceAll("_", " "), unit: e.unit === "B" ? "" : e.unit, hint: e.words, value, text: (p) => (e.unit === "B" ? bytes(value(p)) : figure(value(p), 4)) };
  });
}

function settingsColumn({ page: { report } }: FrontData): Column<Placed> {
  return { key: "settings", title: "settings", value: (p) => settingsOf(report, p.point.case).map(([k, v]) => `${k}=${v}`).join(", ") };
}

// Each point of the front beside the one before it.
function frontTable(data: FrontData, toggle: Toggle): HTMLElement {
  const before = new Map(data.front.map((p, i) => [p, data.front[i - 1]]));
  const ms = (p: Placed) => (before.get(p) ? p.point.ms - before.get(p)!.point.ms : null);
  const error = (p: Placed) => (before.get(p) ? p.point.error - before.get(p)!.point.error : null);
  const [name, ...figures] = baseColumns(data);
  const chosen = new Set(selectedCases(data.page));
  return table<Placed>({
    caption: "The front", file: `front-${data.title}`, rows: data.front, state: data.page.state, prefix: "fr.front",
    columns: [
      name,
      { key: "n", title: "no.", hint: "number in the chart, by time", value: (p) => data.front.indexOf(p) + 1 },
      ...figures,
      { key: "more", title: "costs more", unit: "ms", hint: "than the point before it", value: ms, text: (p) => signed(ms(p), "") },
      { key: "brings", title: "brings", unit: data.metric.unit, hint: "error beside the point before it", value: error, text: (p) => signed(error(p), "") },
      ...extraColumns(data),
      settingsColumn(data),
    ],
    marked: (p) => chosen.has(p.point.case), choose: (p) => toggle(p.point.case), chooseLabel: () => "select for the other views",
  });
}

function allTable(data: FrontData, toggle: Toggle): HTMLElement {
  const { report } = data.page;
  const chosen = new Set(selectedCases(data.page));
  const [name, ...figures] = baseColumns(data);
  const by = (p: Placed) => p.by.map((q) => report.cases.label[q.case]).join("; ");
  return table<Placed>({
    caption: "All points of the chart", file: `points-${data.title}`, rows: data.placed, state: data.page.state, prefix: "fr.all",
    columns: [
      name,
      { key: "standing", title: "standing", value: (p) => p.standing },
      ...figures,
      { key: "by", title: "by", hint: "the points of the front that dominate it, or could", value: by, text: (p) => (p.by.length > 1 ? `${report.cases.label[p.by[0].case]} and ${p.by.length - 1} more` : by(p)) },
      settingsColumn(data),
    ],
    marked: (p) => chosen.has(p.point.case), choose: (p) => toggle(p.point.case), chooseLabel: () => "select for the other views",
  });
}

// Cases of the scene that have no point, and why.
function missingTable(data: FrontData): HTMLElement | null {
  const { report } = data.page;
  const { cases } = report;
  const rows = casesShown(data.page, "scene").filter((c) => cases.status[c] !== "ok");
  if (rows.length === 0) return null;
  return table<number>({
    caption: "Failed and skipped cases of the scene", file: `missing-${data.title}`, rows, state: data.page.state, prefix: "fr.missing",
    columns: [
      { key: "case", title: "case", value: (c) => cases.label[c], node: (c) => swatch(lookOf(data.page.digest, report.methods[cases.method[c]])) },
      { key: "status", title: "status", value: (c) => cases.status[c] },
      { key: "why", title: "why", value: (c) => cases.message[c] },
    ],
  });
}

export const frontView: View = {
  id: "front",
  title: "Error against time",
  has: ({ report }) => report.groups.length > 0,
  draw(root, page) {
    const data = dataOf(page);
    if (!data) return;
    const missing = missingTable(data);
    if (data.placed.length === 0) {
      root.append(h("p", {}, "No case of this scene that is shown has both this time and this error."), missing ?? "");
      return;
    }
    const panel = h("section", { class: "details", "aria-label": "The point", "aria-live": "polite", tabindex: 0 });
    const tables = h("div", {});
    const toggle = (c: number) => {
      const chosen = selectedCases(page);
      const now = chosen.includes(c) ? chosen.filter((v) => v !== c) : [...chosen, c];
      page.state.set({ c: now.join(",") }, true);
      redraw();
    };
    const chart = frontChart(data, { show: (c) => panel.replaceChildren(...details(data, c)), toggle });
    const redraw = () => {
      chart.selectionChanged();
      const focused = document.activeElement?.closest("tr") ? (document.activeElement as HTMLElement).textContent : null;
      const scrolled = [...tables.querySelectorAll(".scroll")].map((s) => s.scrollTop);
      tables.replaceChildren(frontTable(data, toggle), allTable(data, toggle), ...(missing ? [missing] : []));
      tables.querySelectorAll(".scroll").forEach((s, i) => (s.scrollTop = scrolled[i] ?? 0));
      if (focused !== null) [...tables.querySelectorAll<HTMLElement>("button.row")].find((b) => b.textContent === focused)?.focus();
    };
    root.append(h("div", { class: "columns" }, chart.element, panel), tables);
    redraw();
  },
};
