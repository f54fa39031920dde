// Rows of a comparison: which are shown, in which order, and what its exit code means.
import type { Comparison } from "../data";
import type { State } from "../state";
import { kindOf } from "./changes";
import { holdsAll } from "./filter_box";

export type Row = Comparison["rows"][number];

export const words = ["slower", "worse", "faster", "better", "ambiguous", "same"];

export function exitText(c: Comparison): string {
  if (c.refusal !== "") return `exit code ${c.exit_code}: refused`;
  if (c.exit_code === 0) return "exit code 0: no regression";
  if (c.exit_code === 4) return "exit code 4: a regression";
  if (c.exit_code === 5) return "exit code 5: no regression is certain, but a pass is ambiguous and may be slower";
  return `exit code ${c.exit_code}`;
}

export function countsOf(rows: Row[]): Map<string, number> {
  const out = new Map<string, number>(words.map((w) => [w, 0]));
  for (const r of rows) out.set(r.change, (out.get(r.change) ?? 0) + 1);
  return out;
}

// What is the same is hidden until it is asked for.
export function hiddenChanges(state: State): Set<string> {
  return new Set(state.get("co.hide", "same").split("."));
}

export const size = (r: Row) => Math.abs(Math.log(r.ratio));

// Regressions first, then improvements, then the rest; each from the largest.
export function shownRows(all: Row[], state: State): Row[] {
  const hidden = hiddenChanges(state), hiddenMethods = new Set(state.list("x")), what = state.get("co.w"), text = state.get("co.q");
  const rank = { worse: 0, better: 1, unclear: 2, same: 3 };
  const rows = all.filter((r) => !hidden.has(r.change) && !hiddenMethods.has(r.method) && (what === "" || r.what === what) && holdsAll(`${r.case} ${r.what}`, text));
  if (state.get("co.o") === "size") return rows.sort((a, b) => size(b) - size(a));
  return rows.sort((a, b) => rank[kindOf(a.change)] - rank[kindOf(b.change)] || size(b) - size(a));
}
