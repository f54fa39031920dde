// What each method does with the hard cases of `vsglbench stability`.
import type { Stability } from "../data";
import type { Page, View } from "../view";
import { hiddenMethods } from "../choice";
import { checkbox, choice, h } from "../dom";
import { table, type Column } from "../table";
import { filterBox, holdsAll } from "./filter_box";
import { cellText, entryText, errorText, isSound, matrixOf, statusClass, statusGlyph, statuses, type Cell, type Matrix } from "./stability_model";
import "./stability.css";

function countsLine(s: Stability): HTMLElement {
  const percent = (v: number) => `${Number((100 * v).toPrecision(3))} %`;
  const out = h("p", { class: "counts" });
  for (const status of statuses)
    out.append(h("span", { class: statusClass(status) }, `${statusGlyph[status]} ${s.cells.filter((c) => c.status === status).length} ${status}`), " ");
  out.append(h("span", { class: "soft" }, `ok: within ${percent(s.ok_error)} of double precision; bad: off by more than ${percent(s.bad_error)}, or impossible; left out: the case means nothing to the method`));
  return out;
}

function chosenCells(page: Page, s: Stability): Cell[] {
  const { state } = page;
  const diffuse = state.get("st.d"), words = state.get("st.q"), hidden = hiddenMethods(page);
  const cells = s.cells.filter((c) => !hidden.has(c.method) && (diffuse === "" || c.diffuse === diffuse || c.diffuse === "-") &&
                                      holdsAll(`${c.case} ${c.method}`, words));
  if (state.get("st.o") !== "1") return cells;
  const failing = new Set(cells.filter((c) => !isSound(c.status)).map((c) => c.case));
  return cells.filter((c) => failing.has(c.case));
}

function controls(page: Page, s: Stability, set: (changes: Record<string, string>) => void): HTMLElement {
  const { state } = page;
  const models = [...new Set(s.cells.map((c) => c.diffuse))].filter((d) => d !== "-");
  const out = h("div", { class: "controls", role: "group", "aria-label": "Filters" });
  if (models.length > 1)
    out.append(choice("Diffuse model", "st-d", [["", `all ${models.length}, the worst shown`], ...models.map((m): [string, string] => [m, m])], state.get("st.d"), (v) => set({ "st.d": v })));
  out.append(checkbox("Failures first", "st-f", state.get("st.f", "1") === "1", (on) => set({ "st.f": on ? "" : "0" })),
             checkbox("Only cases with a failure", "st-o", state.get("st.o") === "1", (on) => set({ "st.o": on ? "1" : "" })),
             filterBox("Case or method", "st-q", state.get("st.q"), (v) => set({ "st.q": v })));
  return out;
}

// One cell can be reached with Tab, the others with the arrow keys from there.
function moveWith(grid: HTMLTableElement): void {
  grid.addEventListener("keydown", (e) => {
    const [down, right] = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[e.key] ?? [0, 0];
    const from = document.activeElement;
    if ((down === 0 && right === 0) || !(from instanceof HTMLTableCellElement)) return;
    e.preventDefault();
    const row = from.parentElement as HTMLTableRowElement;
    const to = grid.tBodies[0].rows[row.sectionRowIndex + down]?.cells[from.cellIndex + right];
    if (!to?.hasAttribute("tabindex")) return;
    from.tabIndex = -1;
    to.tabIndex = 0;
    to.focus();
  });
}

function matrixTable(matrix: Matrix, show: (name: string, lines: string[]) => void): HTMLTableElement {
  const head = h("tr", { role: "row" }, h("th", { scope: "col", role: "columnheader" }, "hard case"));
  for (const m of matrix.methods) head.append(h("th", { scope: "col", role: "columnheader" }, h("span", {}, m)));
  const body = h("tbody", { role: "rowgroup" });
  let first = true;
  for (const row of matrix.rows) {
    const tr = h("tr", { role: "row" }, h("th", { scope: "row", role: "rowheader" }, row.name));
    row.entries.forEach((entry, i) => {
      if (!entry) return tr.append(h("td", { role: "gridcell", tabindex: first ? 0 : -1 }));
      const text = () => show(`${row.name}, ${matrix.methods[i]}`, entry.cells.map(cellText));
      tr.append(h("td", { role: "gridcell", tabindex: first ? 0 : -1, class: statusClass(entry.worst), pointerenter: text, focus: text }, entryText(entry)));
      first = false;
    });
    body.append(tr);
  }
  const grid = h("table", { class: "matrix", role: "grid", "aria-label": "Status by hard case and method; the arrow keys move" },
                    h("thead", { role: "rowgroup" }, head), body);
  moveWith(grid);
  return grid;
}

function tableOf(page: Page, cells: Cell[]): HTMLElement {
  const columns: Column<Cell>[] = [
    { key: "case", title: "hard case", value: (c) => c.case },
    { key: "method", title: "method", value: (c) => c.method },
    { key: "diffuse", title: "diffuse model", value: (c) => c.diffuse },
    { key: "status", title: "status", value: (c) => c.status, text: (c) => `${statusGlyph[c.status]} ${c.status}` },
    { key: "error", title: "relative error", value: (c) => (c.error === "infinite" ? Infinity : c.error), text: (c) => errorText(c.error) },
    { key: "where", title: "where", value: (c) => c.where },
    { key: "why", title: "why", value: (c) => c.why },
  ];
  return table({ caption: "All cells", file: "vsglbench-stability", rows: cells, columns, state: page.state, prefix: "st.all", order: "-error" });
}

function content(matrix: Matrix): HTMLElement[] {
  if (matrix.rows.length === 0) return [h("p", {}, "No case is left by these filters.")];
  const detail = h("div", { class: "detail", role: "status" });
  const show = (name: string, lines: string[]) => detail.replaceChildren(h("p", { class: "name" }, name), ...lines.map((l) => h("p", {}, l)));
  show("", ["Point at a cell, or go to it with Tab and the arrow keys, to see where and why."]);
  return [h("div", { class: "scroll" }, matrixTable(matrix, show)), detail];
}

export const stabilityView: View = {
  id: "stability",
  title: "Stability",
  filters: ["methods"],
  methods: ({ digest }) => [...new Set(digest.stability?.cells.map((c) => c.method))],
  has: (page) => page.digest.stability !== null,
  draw(root, page) {
    const s = page.digest.stability!;
    const body = h("div");
    const fill = () => {
      const cells = chosenCells(page, s);
      body.replaceChildren(...content(matrixOf(cells, page.state.get("st.f", "1") === "1")), tableOf(page, cells));
    };
    root.append(countsLine(s), controls(page, s, (changes) => {
      page.state.set(changes, true);
      fill();
    }), body);
    fill();
  },
};
