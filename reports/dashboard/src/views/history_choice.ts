// What a reader has chosen in the history: keys of the state, and what they are where the fragment says nothing.
import { hiddenMethods } from "../choice";
import type { Change, History } from "../data";
import type { Page } from "../view";
import { percentChange } from "./changes";
import { chosen, type Base } from "./history_model";

export interface HistoryChoice {
  column: History["columns"][number];
  base: Base;
  means: boolean; // a line for the mean of each method; else one for each series
  scene: string; // empty: all
  text: string;
  log: boolean;
  from: number; // first and last report shown
  to: number;
  indices: number[]; // of the series that scene, methods and text leave
  opened: number; // the series that has a chart of its own; -1: none
  report: number; // the one marked in it
}

const fewLines = 12; // so many can be told apart

export function historyChoice(page: Page, history: History): HistoryChoice {
  const { state } = page, last = history.reports.length - 1;
  const within = (v: number, lo: number, hi: number) => Math.max(lo, Math.min(hi, Math.round(v)));
  const from = within(state.number("hi.from", 0), 0, last), opened = state.number("hi.s", -1);
  const scene = state.get("hi.scene"), text = state.get("hi.q");
  const indices = chosen(history, scene, hiddenMethods(page), text);
  return {
    column: history.columns.find((c) => c.name === state.get("hi.c")) ?? history.columns[0],
    base: (["absolute", "median"] as Base[]).find((b) => b === state.get("hi.b")) ?? "first",
    means: state.get("hi.l", indices.length > fewLines ? "mean" : "each") === "mean",
    scene,
    text,
    log: state.get("hi.log") === "1",
    from,
    to: within(state.number("hi.to", last), from, last),
    indices,
    opened: history.series[opened] ? opened : -1,
    report: within(state.number("hi.r", last), 0, last),
  };
}

// The changes of some series in the chosen column.
export function changesIn(history: History, column: string, indices: number[]): Change[] {
  const mine = new Set(indices);
  return history.changes.filter((c) => c.column === column && mine.has(c.series));
}

export const significant = (v: number) => String(Number(v.toPrecision(4))).replace("-", "−");

export const unitText = (unit: string) => (unit === "" || unit.startsWith(" ") ? unit : ` ${unit}`);

// How an axis writes its figures.
export function axisFormat(c: HistoryChoice): (v: number) => string {
  if (c.base === "absolute") return (v) => significant(v) + unitText(c.column.unit);
  return (v) => (v < 0.5 || v > 2 ? `× ${significant(v)}` : percentChange(v));
}
