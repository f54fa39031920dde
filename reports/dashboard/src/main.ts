// The page: what was measured, tabs of views, the filters that views share, and the view itself.
import "./style.css";
import { readDigest } from "./data";
import type { Digest } from "./data";
import { h } from "./dom";
import { filters } from "./filters";
import { header } from "./header";
import { State } from "./state";
import type { Page, View } from "./view";
import { views } from "./views";

function chosenView(page: Page): View | undefined {
  const there = views.filter((v) => v.has(page));
  return there.find((v) => v.id === page.state.get("v")) ?? there[0];
}

// Of a URL that names a view which is not there.
function missedView(page: Page, chosen: View | undefined): HTMLElement | null {
  const asked = page.state.get("v");
  if (asked === "" || !chosen || asked === chosen.id) return null;
  const known = views.find((v) => v.id === asked);
  const why = known ? `This report has nothing for the view “${known.title}”` : `There is no view “${asked}”`;
  return h("p", { class: "warning", role: "status" }, `${why}: “${chosen.title}” is shown instead.`);
}

function tabs(page: Page, chosen: View | undefined): HTMLElement {
  const there = views.filter((v) => v.has(page));
  const go = (to: View) => {
    page.state.set({ v: to === there[0] ? "" : to.id });
    document.getElementById("tab-" + to.id)?.focus();
  };
  const keys = (event: KeyboardEvent) => {
    const at = there.indexOf(chosen!);
    const step = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: there.length - 1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    go(there[(step + there.length) % there.length]);
  };
  const buttons = there.map((v) => {
    const on = v === chosen;
    return h("button", { role: "tab", type: "button", id: "tab-" + v.id, "aria-selected": String(on), "aria-controls": "view", tabindex: on ? 0 : -1, click: () => go(v) }, v.title);
  });
  return h("div", { role: "tablist", "aria-label": "Views", class: "tabs", keydown: keys }, ...buttons);
}

function start(digest: Digest, app: HTMLElement): void {
  const state = new State();
  const head = h("header", {}), nav = h("nav", { "aria-label": "Views" }), missed = h("div"), bar = h("div", { class: "filters" });
  const root = h("main", { id: "view", role: "tabpanel", tabindex: -1 });
  app.append(head, nav, missed, bar, root);

  const draw = () => {
    const report = digest.reports[state.number("r", -1)] ?? digest.reports[digest.reports.length - 1]; // the newest
    const page: Page = { digest, report, state };
    const focused = document.activeElement?.id;
    document.documentElement.dataset.theme = state.get("d");
    head.replaceChildren(header(page));
    const view = chosenView(page);
    nav.replaceChildren(tabs(page, view));
    missed.replaceChildren(missedView(page, view) ?? "");
    bar.replaceChildren(...filters(page, view));
    root.style.minHeight = `${root.offsetHeight}px`; // else the page would jump while it is empty
    root.replaceChildren();
    root.className = "view-" + (view?.id ?? "none");
    if (view) root.setAttribute("aria-labelledby", "tab-" + view.id);
    document.title = `${report.name} · vsglbench`;
    if (view) view.draw(root, page);
    else root.append(h("p", {}, "There is nothing to show: the report has no cases."));
    root.style.minHeight = "";
    if (focused && document.activeElement?.id !== focused) document.getElementById(focused)?.focus();
  };
  state.onChange(draw);
  draw();
}

const app = document.getElementById("app")!;
try {
  start(await readDigest(), app);
} catch (error) {
  app.replaceChildren(h("p", { class: "failed", role: "alert" }, `The page's data can't be shown: ${error}`));
  throw error;
}
