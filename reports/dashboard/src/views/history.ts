// Figures of one machine from report to report: where they changed, and whether they stayed so.
import { lookOf } from "../colours";
import type { Change, History } from "../data";
import { checkbox, choice, h } from "../dom";
import type { Page, View } from "../view";
import { filterBox } from "./filter_box";
import { axisFormat, changesIn, historyChoice, type HistoryChoice } from "./history_choice";
import { describe } from "./history_describe";
import { linesOf, seriesLine, type Line } from "./history_model";
import { historyPanel, type Panel } from "./history_panel";
import { changesTable, figuresTable } from "./history_tables";
import "./history.css";
import "./marks.css";

type Apply = (changes: Record<string, string | number>) => void;

function controls(history: History, c: HistoryChoice, words: HTMLElement, set: Apply): HTMLElement {
  const scenes = [...new Set(history.series.map((s) => s.scene))];
  const last = history.reports.length - 1;
  const zoomed = c.from > 0 || c.to < last;
  return h("div", { class: "controls", role: "group", "aria-label": "What is drawn" },
    choice("Column", "hi-c", history.columns.map((k): [string, string] => [k.name, k.title]), c.column.name, (v) => set({ "hi.c": v })),
    choice("Figures", "hi-b", [["first", "relative to the first"], ["median", "relative to the median"], ["absolute", "absolute"]], c.base, (v) => set({ "hi.b": v })),
    choice("Lines", "hi-l", [["mean", "mean of each method"], ["each", "every series"]], c.means ? "mean" : "each", (v) => set({ "hi.l": v })),
    choice("Scene", "hi-scene", [["", scenes.length > 1 ? `all ${scenes.length}` : "all"], ...scenes.map((s): [string, string] => [s, s])], c.scene, (v) => set({ "hi.scene": v })),
    words,
    checkbox("Logarithmic", "hi-log", c.log, (on) => set({ "hi.log": on ? 1 : "" })),
    zoomed ? h("button", { type: "button", click: () => set({ "hi.from": "", "hi.to": "" }) }, `All ${last + 1} reports`) : null);
}

// A chart for each scene; and one of the series that was opened.
function panelsOf(page: Page, history: History, c: HistoryChoice, set: Apply): { charts: Panel[]; opened: Panel | null; lines: Line[] } {
  const shared = {
    history, from: c.from, to: c.to, log: c.log, format: axisFormat(c),
    look: (line: Line) => lookOf(page.digest, line.method),
    describe: (line: Line, report: number) => describe(history, c, line, report),
    zoom: (from: number, to: number) => set({ "hi.from": from, "hi.to": to }),
  };
  const lines = linesOf(history, c.indices, c.column.name, c.base, c.means);
  const scenes = [...new Set(lines.map((l) => l.scene))];
  // A click on a mean shows the series that it is made of.
  const wordsFor = (line: Line) => (line.series.every((i) => history.series[i].id.includes(`/${line.method}/`)) ? `/${line.method}/` : line.method);
  const pick = (line: Line, report: number) =>
    line.series.length === 1 ? set({ "hi.s": line.series[0], "hi.r": report }) : set({ "hi.l": "each", "hi.q": wordsFor(line), "hi.scene": line.scene });
  const charts = scenes.map((scene) => {
    const mine = lines.filter((l) => l.scene === scene);
    return historyPanel({ ...shared, id: scene, lines: mine, title: `${scene}: ${c.column.title}, ${mine.length} ${c.means ? (mine.length === 1 ? "method" : "methods") : "series"}`,
                          changes: changesIn(history, c.column.name, mine.flatMap((l) => l.series)),
                          height: scenes.length > 1 ? 280 : 400, marked: !c.means && mine.length <= 12, marker: -1, pick });
  });
  const line = c.opened < 0 ? null : seriesLine(history, c.opened, c.column.name, c.base);
  const opened = line && historyPanel({ ...shared, id: "opened-chart", lines: [line], title: `${line.scene} · ${line.label}: ${c.column.title}`, height: 300, marked: false, marker: c.report,
                                        changes: changesIn(history, c.column.name, [c.opened]), pick: (l, report) => set({ "hi.r": report, "hi.s": l.series[0] }) });
  return { charts, opened, lines };
}

function legend(): HTMLElement {
  const item = (kind: string, glyph: string, text: string) => h("span", {}, h("span", { class: `change-${kind}` }, glyph), ` ${text}`);
  return h("p", { class: "legend note" },
    item("worse", "▲", "slower or worse"), item("better", "▼", "faster or better"), h("span", {}, "filled: persistent; hollow: not; dashed: it crept there, in steps too small to be told from noise"), item("refusal", "✕", "not compared with the one before"),
    h("span", {}, "Bars below the lines count the series that changed. Pointing at a line shows its 95 % intervals and, in grey, A/A noise round its level; a click opens it; dragging zooms."));
}

// Everything below the controls.
function content(page: Page, history: History, c: HistoryChoice, set: Apply): HTMLElement[] {
  const { charts, opened, lines } = panelsOf(page, history, c, set);
  const jump = (k: Change) => {
    set({ "hi.c": k.column, "hi.s": k.series, "hi.r": k.report });
    document.getElementById("hi-opened")?.scrollIntoView({ block: "nearest" });
  };
  const out: HTMLElement[] = [legend()];
  if (charts.length === 0) out.push(h("p", {}, "No series with a figure in this column is left by these filters."));
  out.push(h("div", { class: charts.length > 1 ? "history-panels many" : "history-panels" }, ...charts.map((p) => p.element)));
  if (opened) {
    const close = h("button", { type: "button", click: () => set({ "hi.s": "", "hi.r": "" }) }, "Close this series");
    out.push(h("section", { id: "hi-opened", class: "history-opened" }, opened.element, h("div", { class: "opened-figures" }, describe(history, c, seriesLine(history, c.opened, c.column.name, c.base)!, c.report), close)));
  }
  out.push(...changeLists(page, history, c, jump), figuresLater(history, c, opened ? [seriesLine(history, c.opened, c.column.name, c.base)!] : lines));
  return out;
}

function changeLists(page: Page, history: History, c: HistoryChoice, jump: (k: Change) => void): HTMLElement[] {
  const mine = new Set(c.indices);
  const all = history.changes.filter((k) => mine.has(k.series)).sort((a, b) => b.report - a.report || Math.abs(Math.log(b.ratio)) - Math.abs(Math.log(a.ratio)));
  const lasting = all.filter((k) => k.persistent);
  return [
    changesTable(history, lasting, "Persistent changes", "hi.p", page.state, jump),
    changesTable(history, all, "All changes", "hi.a", page.state, jump),
  ];
}

// The table of all figures may have 100,000 rows: it is made when it is asked for.
function figuresLater(history: History, c: HistoryChoice, lines: Line[]): HTMLElement {
  const words = lines.length === 1 ? `Figures of ${lines[0].label}` : `Figures of these ${lines.length} lines`;
  const details = h("details", { class: "later" }, h("summary", {}, `${words} as a table`));
  details.addEventListener("toggle", () => {
    if (details.open && details.childElementCount === 1) details.append(figuresTable(history, c, lines, words, "history"));
  });
  return details;
}

export const historyView: View = {
  id: "history",
  title: "History",
  filters: ["methods"],
  methods: ({ digest }) => [...new Set(digest.history?.series.map((s) => s.method))],
  has: (page) => (page.digest.history?.reports.length ?? 0) > 0,
  draw(root, page) {
    const history = page.digest.history!;
    const head = h("div"), body = h("div");
    const fill = () => {
      const c = historyChoice(page, history), focused = document.activeElement?.id;
      const input = words.querySelector("input")!;
      if (focused !== input.id) input.value = c.text;
      head.replaceChildren(controls(history, c, words, set));
      body.replaceChildren(...content(page, history, c, set));
      if (focused) document.getElementById(focused)?.focus();
    };
    const set: Apply = (changes) => {
      page.state.set(changes, true);
      fill();
    };
    // Stays the same element, so that the caret stays in its place.
    const words = filterBox("Series", "hi-q", page.state.get("hi.q"), (v) => set({ "hi.q": v }));
    root.append(head, body);
    fill();
  },
};
