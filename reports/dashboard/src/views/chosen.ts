// Which cases a view of few shows: the front of the group, the selected, or all.
import { casesShown, groupOf, metricOf, selectedCases, timeOf } from "../choice";
import { choice } from "../dom";
import { frontOf, pointsOf } from "../pareto";
import type { Page } from "../view";

export function frontCases(page: Page): number[] {
  if (!groupOf(page)) return [];
  return frontOf(pointsOf(page.report.cases, casesShown(page), metricOf(page).name, timeOf(page).name)).map((p) => p.case);
}

export interface Chosen {
  cases: number[];
  control: HTMLElement;
}

// `key`: of the state. By default the selected cases, where there are some.
export function chosenCases(page: Page, key: string): Chosen {
  const selected = selectedCases(page);
  const of = page.state.get(key, selected.length > 0 ? "selected" : groupOf(page) ? "front" : "all");
  const cases = of === "selected" ? selected : of === "front" ? frontCases(page) : casesShown(page, groupOf(page) ? "group" : "report");
  const options: [string, string][] = [["selected", `the selected (${selected.length})`], ["all", "all of the scene that are shown"]];
  if (groupOf(page)) options.unshift(["front", "the front"]);
  return { cases, control: choice("Cases", key.replace(".", "-"), options, of, (v) => page.state.set({ [key]: v })) };
}
