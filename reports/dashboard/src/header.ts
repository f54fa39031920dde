// What was measured, by what, on what; the choice of report; light or dark.
import { choice, h } from "./dom";
import { day, figure } from "./format";
import type { Page } from "./view";

function themeButton({ state }: Page): HTMLElement {
  const asked = state.get("d") || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  const other = asked === "dark" ? "light" : "dark";
  return h("button", { type: "button", id: "theme", title: `Show the page ${other}`, click: () => state.set({ d: other }) }, other === "dark" ? "Dark" : "Light");
}

export function header(page: Page): HTMLElement {
  const { report, digest, state } = page;
  const facts: [string, string][] = [
    ["device", report.device],
    ["driver", report.driver],
    ["host", report.host],
    ["commit", report.commit === "" ? "not known" : report.commit.slice(0, 10) + (report.dirty ? ", with changes" : "")],
    ["made", day(report.created)],
    ["frame", `${report.width} × ${report.height}`],
    ["cases", `${report.cases.id.length}, in ${figure(report.wall_s / 60)} min`],
  ];
  const which = digest.reports.length < 2 ? null : choice("Report", "report", digest.reports.map((r, i) => [String(i), `${r.name}, ${r.commit.slice(0, 7)}${i === 0 ? " (base)" : ""}`]), String(digest.reports.indexOf(report)), (r) => state.set({ r: Number(r) === digest.reports.length - 1 ? "" : r, g: "", c: "" }));
  const warnings = [...digest.notes];
  if (!report.complete) warnings.unshift("The report is not complete: the run was ended early.");
  return h(
    "div", {},
    h("div", { class: "title" }, h("h1", {}, report.name), h("p", {}, report.description), which, themeButton(page)),
    h("dl", { class: "facts" }, ...facts.filter(([, v]) => v !== "").map(([k, v]) => h("div", {}, h("dt", {}, k), h("dd", {}, v)))),
    settings(page),
    ...warnings.map((w) => h("p", { class: "warning" }, w)),
  );
}

function settings({ report }: Page): HTMLElement {
  const entries = Object.entries(report.settings);
  return h(
    "details", { class: "settings" },
    h("summary", {}, "Settings of all cases"),
    h("p", { class: "command" }, report.command),
    h("dl", { class: "facts" }, ...entries.map(([k, v]) => h("div", {}, h("dt", {}, k), h("dd", {}, v === "" ? "none" : v)))),
  );
}
