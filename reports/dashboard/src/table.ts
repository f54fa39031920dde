// The one table of the page: sorted by click or key, filtered by words, saved as CSV; draws the rows that are asked for.
import { h } from "./dom";
import type { State } from "./state";

export interface Column<Row> {
  key: string; // in the state and the CSV
  title: string;
  unit?: string; // of `value`; empty or absent: none
  scaled?: boolean; // the text has a unit of its own, "1.05 MB": the head has none
  hint?: string; // what the column is, in words
  value(row: Row): number | string | null | undefined; // sorts, and stands in the CSV
  text?(row: Row): string; // shown; by default the value
  node?(row: Row): Node; // shown before the text
}

export interface TableOptions<Row> {
  caption: string; // what the table is; shown above it
  file: string; // name of the CSV, without ending
  rows: Row[];
  columns: Column<Row>[];
  state?: State; // with `prefix`: keeps order and filter, quietly, as PREFIX.s and PREFIX.q
  prefix?: string; // "fr.front"
  order?: string; // key of the first order, "-key" falling; by default the rows' own
  note?: string;
  marked?(row: Row): boolean; // drawn as selected
  choose?(row: Row): void; // a click on a row, or Enter on its first cell's button
  chooseLabel?(row: Row): string; // what choosing does, for screen readers
}

const kPage = 200; // rows drawn at once

export function table<Row>(o: TableOptions<Row>): HTMLElement {
  const key = (name: string) => `${o.prefix}.${name}`;
  const stored = (name: string) => (o.state && o.prefix ? o.state.get(key(name)) : "");
  const store = (name: string, value: string) => {
    if (o.state && o.prefix) o.state.set({ [key(name)]: value }, true);
  };
  let order = stored("s") || o.order || "";
  let words = stored("q");
  let limit = kPage;
  const texts = new Map<Row, string>(); // of all cells, for the filter

  const numeric = new Set(o.columns.filter((c) => o.rows.every((r) => typeof c.value(r) !== "string")).map((c) => c.key));
  const shownText = (c: Column<Row>, row: Row): string => {
    if (c.text) return c.text(row);
    const v = c.value(row);
    return v === null || v === undefined ? "–" : String(v);
  };

  function matching(): Row[] {
    const parts = words.toLowerCase().split(/\s+/).filter((w) => w !== "");
    if (parts.length === 0) return o.rows;
    return o.rows.filter((row) => {
      let text = texts.get(row);
      if (text === undefined) {
        text = o.columns.map((c) => shownText(c, row)).join(" ").toLowerCase();
        texts.set(row, text);
      }
      return parts.every((w) => text.includes(w));
    });
  }

  function sorted(rows: Row[]): Row[] {
    const falling = order.startsWith("-");
    const column = o.columns.find((c) => c.key === (falling ? order.slice(1) : order));
    if (!column) return rows;
    const keyed = rows.map((row) => ({ row, v: column.value(row) ?? null }));
    const sign = falling ? -1 : 1;
    keyed.sort((a, b) => {
      if (a.v === null || b.v === null) return (a.v === null ? 1 : 0) - (b.v === null ? 1 : 0); // what isn't there comes last
      if (typeof a.v === "number" && typeof b.v === "number") return sign * (a.v - b.v);
      return sign * String(a.v).localeCompare(String(b.v), "en", { numeric: true });
    });
    return keyed.map((k) => k.row);
  }

  const body = h("tbody");
  const more = h("p", { class: "more" });
  const count = h("span", { class: "count", role: "status" });
  const heads = o.columns.map((c) => {
    const button = h("button", { type: "button", title: c.hint, click: () => sortBy(c.key) }, c.title + (c.unit?.trim() && !c.scaled ? `, ${c.unit.trim()}` : ""));
    return h("th", { scope: "col", class: numeric.has(c.key) ? "figure" : false }, button);
  });

  function cellOf(c: Column<Row>, row: Row, first: boolean): HTMLElement {
    const cell = h(first ? "th" : "td", { scope: first ? "row" : null, class: numeric.has(c.key) ? "figure" : false });
    const node = c.node?.(row);
    const text = shownText(c, row);
    if (first && o.choose) {
      const chosen = o.marked?.(row) ?? false;
      cell.append(h("button", { type: "button", class: "row", title: o.chooseLabel?.(row), "aria-pressed": o.marked ? String(chosen) : null }, node, text));
    } else cell.append(...(node ? [node, text] : [text]));
    return cell;
  }

  // Those that are chosen, without drawing anew: what is focused stays so, and as many rows stay.
  function mark(): void {
    drawn.forEach((row, i) => {
      const chosen = o.marked?.(row) ?? false;
      body.children[i].classList.toggle("marked", chosen);
      if (o.marked) body.children[i].querySelector("button.row")?.setAttribute("aria-pressed", String(chosen));
    });
  }

  let drawn: Row[] = [];
  function draw(): void {
    const rows = sorted(matching());
    drawn = rows.slice(0, limit);
    body.replaceChildren(...drawn.map((row) => h("tr", { class: o.marked?.(row) ? "marked" : false }, ...o.columns.map((c, at) => cellOf(c, row, at === 0)))));
    count.textContent = rows.length === o.rows.length ? `${rows.length} rows` : `${rows.length} of ${o.rows.length} rows`;
    more.replaceChildren();
    if (rows.length > limit) {
      const left = rows.length - limit;
      const next = (by: number) => () => {
        limit += by;
        draw();
      };
      more.append(`${limit} of ${rows.length} rows are shown. `, h("button", { type: "button", click: next(kPage) }, `Next ${Math.min(kPage, left)}`), " ", h("button", { type: "button", click: next(left) }, "Show all"));
    }
    o.columns.forEach((c, at) => {
      const sort = order === c.key ? "ascending" : order === "-" + c.key ? "descending" : "none";
      heads[at].setAttribute("aria-sort", sort);
    });
  }
  function sortBy(name: string): void {
    order = order === name ? "-" + name : name;
    store("s", order);
    draw();
  }

  const filter = h("input", { type: "search", value: words, placeholder: "Filter rows", "aria-label": `Filter rows of: ${o.caption}` });
  filter.addEventListener("input", () => {
    words = filter.value;
    limit = kPage;
    store("q", words);
    draw();
  });
  body.addEventListener("click", (event) => {
    const tr = (event.target as Element).closest("tr");
    if (!tr || !o.choose || (event.target as Element).closest("a")) return;
    o.choose(drawn[Array.prototype.indexOf.call(body.children, tr)]);
    mark();
  });

  const csv = h("button", { type: "button", click: () => save(o.file + ".csv", csvOf(o.columns, sorted(matching()))) }, "CSV");
  csv.setAttribute("aria-label", `Save as CSV: ${o.caption}`);
  draw();
  return h(
    "section", { class: o.choose ? "table choosable" : "table" },
    h("div", { class: "tablehead" }, h("h3", {}, o.caption), count, filter, csv),
    o.note ? h("p", { class: "note" }, o.note) : null,
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": o.caption }, h("table", {}, h("thead", {}, h("tr", {}, ...heads)), body)),
    more,
  );
}

// RFC 4180; a cell that a spreadsheet would take for a formula gets a ' before it.
export function csvOf<Row>(columns: Column<Row>[], rows: Row[]): string {
  const cell = (v: number | string | null | undefined): string => {
    if (v === null || v === undefined) return "";
    if (typeof v === "number") return String(v);
    const safe = /^[=+\-@\t]/.test(v) ? "'" + v : v;
    return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
  };
  const head = columns.map((c) => cell(c.title + (c.unit?.trim() ? ` (${c.unit.trim()})` : "")));
  return [head, ...rows.map((row) => columns.map((c) => cell(c.value(row))))].map((line) => line.join(",") + "\r\n").join("");
}

export function save(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "text/csv;charset=utf-8" }));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
