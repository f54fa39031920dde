// Two reports beside each other: what became faster, slower, better, worse.
import { allMethods } from "../colours";
import type { Comparison } from "../data";
import { checkbox, choice, h } from "../dom";
import { figure } from "../format";
import { table, type Column } from "../table";
import type { Page, View } from "../view";
import { changeGlyph, changeText, changeWithInterval, kindOf, percentChange } from "./changes";
import { countsOf, exitText, hiddenChanges, shownRows, type Row } from "./compare_model";
import { filterBox } from "./filter_box";
import { axisHead, axisRound, intervalMark, type Axis } from "./interval_mark";
import "./compare.css";
import "./marks.css";

type Apply = (changes: Record<string, string | number>) => void;

const drawn = 60; // rows of the chart; all are in the table

function verdict(page: Page, c: Comparison): HTMLElement {
  const name = (i: number) => {
    const r = page.digest.reports[i];
    return `${r.name}, ${r.commit.slice(0, 10)}${r.dirty ? " with changes" : ""} of ${r.created.slice(0, 10)}`;
  };
  const bad = c.refusal !== "" || c.exit_code !== 0;
  return h("div", { class: "verdict" },
    h("p", {}, h("span", { class: "soft" }, "base "), name(c.base), h("span", { class: "soft" }, " → now "), name(c.now)),
    h("p", { class: bad ? "bad name" : "good name" }, exitText(c)),
    c.refusal === "" ? null : h("p", { class: "bad", role: "alert" }, `Not compared: ${c.refusal}`),
    c.summary === "" ? null : h("details", { open: c.summary.split("\n").length < 12 }, h("summary", {}, "What `vsglbench compare` says"), h("pre", { tabindex: 0 }, c.summary.trim())));
}

function controls(page: Page, c: Comparison, set: Apply): HTMLElement {
  const { state } = page, hidden = hiddenChanges(state);
  const kinds = [...new Set(c.rows.map((r) => r.what))];
  const toggle = (word: string, on: boolean) => {
    const now = hiddenChanges(state);
    if (on) now.delete(word);
    else now.add(word);
    const text = [...now].filter((w) => w !== "").join(".");
    set({ "co.hide": text === "same" ? "" : text || "-" });
  };
  const boxes = [...countsOf(c.rows)].filter(([, n]) => n > 0).map(([word, n]) =>
    h("span", { class: `change-${kindOf(word)}` }, checkbox(`${changeText(word)} ${n}`, `co-${word}`, !hidden.has(word), (on) => toggle(word, on))));
  return h("div", { class: "controls", role: "group", "aria-label": "Which rows" }, ...boxes,
    choice("Of", "co-w", [["", "everything"], ...kinds.map((w): [string, string] => [w, w])], state.get("co.w"), (v) => set({ "co.w": v })),
    choice("Order", "co-o", [["", "regressions first"], ["size", "by size"]], state.get("co.o"), (v) => set({ "co.o": v })),
    filterBox("Case", "co-q", state.get("co.q"), (v) => set({ "co.q": v })));
}

const rowName = (r: Row) => (r.case === "" ? r.what : `${r.case} · ${r.what}`);
const rowText = (r: Row) => changeWithInterval(r.ratio, r.lo, r.hi);

function rowMark(axis: Axis, r: Row): SVGElement {
  return intervalMark(axis, { value: r.ratio, lo: r.lo, hi: r.hi, noise: r.noise, shape: r.change, kind: kindOf(r.change),
                              label: `${rowName(r)}: ${r.change}, ${rowText(r)}` });
}

// Dots and intervals round 1, one a row. A hovered row says its figures, which stand beside it, too.
function chart(rows: Row[], width: number): HTMLElement {
  const shown = rows.slice(0, drawn);
  const ratios = shown.map((r) => r.ratio);
  // An interval that is far longer than all ratios ends in an arrow, else it would press the others together.
  const reach = Math.max(...ratios.map((r) => Math.abs(Math.log(r))), 0.01) * 1.6;
  const ends = shown.flatMap((r) => [r.lo, r.hi]).filter((v) => v > 0 && Math.abs(Math.log(v)) < reach);
  const axis: Axis = { width, ...axisRound([...ratios, ...ends], 1, true, true), log: true, rule: 1, bound: null, format: (v) => (v > 3 || v < 1 / 3 ? `×${figure(v)}` : percentChange(v).replace(".0", "")) };
  const line = (r: Row) => h("tr", { title: `${rowName(r)}: ${figure(r.base)} → ${figure(r.now)}, ${rowText(r)}, noise ${r.noise === null ? "not known" : `± ${figure(100 * r.noise)} %`}` },
    h("td", {}, rowMark(axis, r)), h("td", { class: "figure" }, rowText(r)), h("td", { class: `change-${kindOf(r.change)}` }, changeText(r.change)), h("th", { scope: "row" }, rowName(r)));
  return h("section", {}, h("h3", {}, rows.length > drawn ? `Ratios, now over base: the first ${drawn} of ${rows.length} rows` : `Ratios, now over base: ${rows.length} rows`),
    h("div", { class: "scroll ratios", tabindex: 0, role: "region", "aria-label": "Ratios, now over base" }, h("table", {},
      h("thead", {}, h("tr", {}, h("th", { scope: "col", "aria-label": "ratio, on an axis" }, axisHead(axis)), h("th", { scope: "col", class: "figure" }, "by, and 95 % interval"), h("th", { scope: "col" }, "change"), h("th", { scope: "col" }, "case"))),
      h("tbody", {}, ...shown.map(line)))),
    h("p", { class: "note" }, "▲ more than before, ▼ less, ◇ ambiguous; grey: A/A noise; an arrow: the interval goes on."));
}

function rowsTable(page: Page, rows: Row[]): HTMLElement {
  const columns: Column<Row>[] = [
    { key: "case", title: "case", value: (r) => r.case, text: (r) => r.case || "all" },
    { key: "what", title: "what", value: (r) => r.what },
    { key: "change", title: "change", value: (r) => r.change, node: (r) => changeGlyph(r.change) },
    { key: "base", title: "base", value: (r) => r.base, text: (r) => figure(r.base, 4) },
    { key: "now", title: "now", value: (r) => r.now, text: (r) => figure(r.now, 4) },
    { key: "ratio", title: "ratio", hint: "now over base", value: (r) => r.ratio, text: (r) => figure(r.ratio, 4) },
    { key: "lo", title: "from", hint: "lower end of the 95 % interval", value: (r) => r.lo, text: (r) => figure(r.lo, 4) },
    { key: "hi", title: "to", hint: "upper end of the 95 % interval", value: (r) => r.hi, text: (r) => figure(r.hi, 4) },
    { key: "noise", title: "A/A noise", unit: "%", value: (r) => (r.noise === null ? null : 100 * r.noise), text: (r) => (r.noise === null ? "not known" : figure(100 * r.noise)) },
  ];
  return table({ caption: "All figures of these rows", file: "vsglbench-compare", rows, columns, state: page.state, prefix: "co.all" });
}

export const compareView: View = {
  id: "compare",
  title: "Compare",
  filters: ["methods"],
  methods: ({ digest }) => allMethods(digest).filter((m) => digest.comparison?.rows.some((r) => r.method === m)),
  has: (page) => page.digest.comparison !== null,
  draw(root, page) {
    const c = page.digest.comparison!, body = h("div");
    root.append(verdict(page, c));
    if (c.rows.length === 0) return;
    const fill = () => {
      const rows = shownRows(c.rows, page.state);
      const width = Math.max(90, Math.min(420, root.clientWidth - 290));
      if (rows.length === 0) body.replaceChildren(h("p", {}, "No row is left by these filters: what is the same is hidden until it is asked for."));
      else body.replaceChildren(chart(rows, width), rowsTable(page, rows));
    };
    root.append(controls(page, c, (changes) => {
      page.state.set(changes, true);
      fill();
    }), body);
    fill();
  },
};
