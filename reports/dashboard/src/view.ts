// A view is one tab of the page.
import type { Digest, Report } from "./data";
import type { State } from "./state";

export interface Page {
  digest: Digest;
  report: Report; // the chosen one, state key r
  state: State;
}

export type Filter = "group" | "metric" | "time" | "methods";

export interface View {
  id: string; // of its tab, and state key v
  title: string;
  filters?: Filter[]; // of the shared ones, those that it heeds; absent: all
  methods?(page: Page): string[]; // those that it shows; absent: of the chosen report
  has(page: Page): boolean; // whether there is something to show
  // Draws into an empty element; is called again, with an empty element, whenever the state has changed other than quietly.
  draw(root: HTMLElement, page: Page): void;
}
