// What is known of one report of a line: shown where it is pointed at.
import type { Change, History } from "../data";
import { h } from "../dom";
import { changeText, changeWithInterval, kindOf, percentChange } from "./changes";
import { significant, unitText, type HistoryChoice } from "./history_choice";
import { before, mover, type Line } from "./history_model";

export function commitText(history: History, report: number): string {
  const r = history.reports[report];
  return `${r.commit === "" ? "no commit" : r.commit.slice(0, 10)}${r.dirty ? ", changed" : ""}`;
}

export function dateText(history: History, report: number): string {
  return history.reports[report].created.slice(0, 16).replace("T", " ");
}

export function describe(history: History, c: HistoryChoice, line: Line, report: number): HTMLElement {
  const r = history.reports[report], unit = unitText(c.column.unit);
  const figure = (v: number) => significant(v * line.divisor);
  const out = h("div", {}, h("p", { class: "name" }, `${line.scene} · ${line.label}`));
  const add = (name: string, text: string, kind = "") => out.append(h("p", { class: kind }, h("span", { class: "soft" }, `${name} `), text));

  const v = line.y[report], lo = line.lo[report], hi = line.hi[report], then = before(line, report);
  const interval = lo !== null && hi !== null ? ` [${figure(lo)} … ${figure(hi)}]` : "";
  add(c.column.title, v === null ? "no figure" : figure(v) + unit + interval);
  if (v !== null && then !== null) add("since the report before", percentChange(v / then));
  if (v !== null && c.base !== "absolute") add(c.base === "first" ? "since the first" : "beside the median", percentChange(v));
  if (line.noise !== null) add("A/A noise", `± ${significant(100 * line.noise)} %`);

  const changes = history.changes.filter((k) => k.report === report && k.column === c.column.name && line.series.includes(k.series));
  if (line.series.length === 1) for (const k of changes) add(k.until === null ? "compare:" : "crept:", verdict(k), `change-${kindOf(k.change)}`);
  else if (changes.length > 0) add("compare:", summary(changes));
  const most = line.series.length > 1 ? mover(history, line, c.column.name, report) : null;
  if (most) add("changed most:", `${most.label} ${percentChange(most.ratio)}`);

  add("report", `${report + 1} of ${history.reports.length}: ${commitText(history, report)}, ${dateText(history, report)}`);
  add("settings", `${r.name}, ${r.device}`);
  if (r.refusal !== "") add("✕ not compared:", r.refusal);
  return out;
}

export function verdict(c: Change): string {
  return `${changeText(c.change)} ${changeWithInterval(c.ratio, c.lo, c.hi)}, ${c.until !== null ? `from report ${c.report + 1} to ${c.until + 1}` : c.persistent ? "persistent" : "not persistent"}`;
}

function summary(changes: Change[]): string {
  const counts = new Map<string, number>();
  for (const c of changes) counts.set(c.change, (counts.get(c.change) ?? 0) + 1);
  return [...counts].map(([change, n]) => `${n} ${changeText(change)}`).join(", ");
}
