// The stability suite's cells as a matrix: a hard case a row, a method a column.
import type { Stability } from "../data";
import { figure } from "../format";

export type Cell = Stability["cells"][number];
export type Status = Cell["status"];

export const statuses: Status[] = ["bad", "bias", "ok", "left out"]; // worst first
export const statusGlyph: Record<Status, string> = { bad: "✗", bias: "≈", ok: "✓", "left out": "–" };

export const statusClass = (s: Status) => `status s-${s.replace(" ", "-")}`;

export interface Entry {
  cells: Cell[]; // one a diffuse model
  worst: Status;
}

export interface Matrix {
  methods: string[];
  rows: { name: string; entries: (Entry | null)[]; bad: number; bias: number }[]; // one entry a method
}

export const isSound = (s: Status) => s === "ok" || s === "left out";

function entryOf(cells: Cell[]): Entry | null {
  const worst = statuses.find((s) => cells.some((c) => c.status === s));
  return worst ? { cells, worst } : null;
}

// `failuresFirst`: rows with the most bad cells above; else as the suite has them.
export function matrixOf(cells: Cell[], failuresFirst: boolean): Matrix {
  const methods = [...new Set(cells.map((c) => c.method))];
  const byRow = new Map<string, Map<string, Cell[]>>();
  for (const c of cells) {
    const row = byRow.get(c.case) ?? new Map<string, Cell[]>();
    row.set(c.method, [...(row.get(c.method) ?? []), c]);
    byRow.set(c.case, row);
  }
  const count = (row: Map<string, Cell[]>, s: Status) => [...row.values()].flat().filter((c) => c.status === s).length;
  const rows = [...byRow].map(([name, row]) => ({
    name,
    entries: methods.map((m) => entryOf(row.get(m) ?? [])),
    bad: count(row, "bad"),
    bias: count(row, "bias"),
  }));
  if (failuresFirst) rows.sort((a, b) => b.bad - a.bad || b.bias - a.bias);
  return { methods, rows };
}

// "✗ bad", or "✗ bad 1 of 3" where other diffuse models fare better.
export function entryText(e: Entry): string {
  const same = e.cells.filter((c) => c.status === e.worst).length;
  const some = !isSound(e.worst) && same < e.cells.length;
  return `${statusGlyph[e.worst]} ${e.worst}${some ? ` ${same} of ${e.cells.length}` : ""}`;
}

export function errorText(error: number | "infinite"): string {
  if (error === "infinite") return "infinite";
  return figure(error);
}

export function cellText(c: Cell): string {
  const where = c.where === "" ? "" : ` at ${c.where}`;
  const why = c.where !== "" && c.why.startsWith(`${c.where}: `) ? c.why.slice(c.where.length + 2) : c.why;
  return `${statusGlyph[c.status]} ${c.status}${c.diffuse === "-" ? "" : `, diffuse model ${c.diffuse}`}: ` +
         `worst relative error ${errorText(c.error)}${where}${why === "" ? "" : `. ${why}`}`;
}
