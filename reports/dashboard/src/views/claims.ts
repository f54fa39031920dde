// What papers claim, and what was found of it: a claim a line, its trials below.
import type { Claim } from "../data";
import { checkbox, choice, h } from "../dom";
import { figure } from "../format";
import { table, type Column } from "../table";
import type { Page, View } from "../view";
import { boundOf, groupsOf, paperOf, rulingGlyph, rulingOf, rulings, type ClaimGroup, type Ruling } from "./claims_model";
import { filterBox, holdsAll } from "./filter_box";
import { axisHead, axisRound, intervalMark, type Axis } from "./interval_mark";
import "./claims.css";
import "./marks.css";

type Apply = (changes: Record<string, string | number>) => void;

const kinds: Record<Ruling, string> = { holds: "good", "holds in part": "unclear", undecided: "plain", "does not hold": "bad", "not run": "plain" };
const fewGroups = 6; // so many are opened at once

const allClaims = (page: Page): Claim[] => [...page.digest.claims, ...page.report.claims];
const originOf = (c: Claim) => (c.exhibit === "" ? "this report" : c.exhibit);

function chip(r: Ruling, count: number | null): HTMLElement {
  return h("span", { class: `ruling r-${kinds[r]}` }, `${rulingGlyph[r]} ${r}${count === null ? "" : ` ${count}`}`);
}

function chosenClaims(page: Page): Claim[] {
  const { state } = page, ruling = state.get("cl.r"), paper = state.get("cl.p"), exhibit = state.get("cl.e"), text = state.get("cl.q");
  return allClaims(page).filter((c) => (ruling === "" || rulingOf(c) === ruling) && (paper === "" || paperOf(c.source) === paper) &&
                                       (exhibit === "" || originOf(c) === exhibit) &&
                                       holdsAll(`${c.claim} ${c.text} ${c.source} ${c.how} ${c.place} ${c.metric} ${c.why}`, text));
}

function controls(page: Page, set: Apply): HTMLElement {
  const { state } = page, claims = allClaims(page);
  const options = (all: string, values: string[]): [string, string][] => [["", all], ...[...new Set(values)].sort().map((v): [string, string] => [v, v])];
  const counts = rulings.map((r): [string, string] => [r, `${rulingGlyph[r]} ${r} (${claims.filter((c) => rulingOf(c) === r).length})`]);
  return h("div", { class: "controls", role: "group", "aria-label": "Which claims" },
    choice("Ruling of a trial", "cl-r", [["", `all (${claims.length})`], ...counts], state.get("cl.r"), (v) => set({ "cl.r": v })),
    choice("Source", "cl-p", options("all papers", claims.map((c) => paperOf(c.source))), state.get("cl.p"), (v) => set({ "cl.p": v })),
    choice("Tried in", "cl-e", options("everything", claims.map(originOf)), state.get("cl.e"), (v) => set({ "cl.e": v })),
    filterBox("Words", "cl-q", state.get("cl.q"), (v) => set({ "cl.q": v })),
    checkbox("Open all", "cl-open", state.get("cl.open") === "1", (on) => set({ "cl.open": on ? 1 : "" })));
}

// What all claims come to.
function summary(groups: ClaimGroup[]): HTMLElement {
  const out = h("p", { class: "rulings" }, `${groups.length} claim${groups.length === 1 ? "" : "s"}: `);
  for (const r of rulings) {
    const n = groups.filter((g) => g.ruling === r).length;
    if (n > 0) out.append(chip(r, n), " ");
  }
  return out;
}

function axisOf(trials: Claim[], how: string): Axis | null {
  const bound = boundOf(how);
  const ends = trials.flatMap((t) => [t.ratio, t.lo, t.hi]).filter((v): v is number => v !== null && v > 0);
  if (ends.length === 0) return null;
  const round = axisRound(bound ? [...ends, bound.value] : ends, 1, true, false);
  return { width: 230, ...round, log: true, rule: 1, bound, format: (v) => figure(v) };
}

const ratioText = (t: Claim) =>
  t.ratio === null ? "–" : figure(t.ratio) + (t.lo === null || t.hi === null ? "" : ` [${figure(t.lo)} … ${figure(t.hi)}]`);

// Columns that hold nothing for these trials are left out.
interface Shown {
  axis: Axis | null;
  pairs: boolean;
  why: boolean;
}

function trialRow(t: Claim, { axis, pairs, why }: Shown): HTMLElement {
  const ruling = rulingOf(t);
  const mark = axis && t.ratio !== null && intervalMark({ ...axis, bound: boundOf(t.how) }, {
    value: t.ratio, lo: t.lo ?? t.ratio, hi: t.hi ?? t.ratio, noise: null, shape: "", kind: kinds[ruling], label: `${t.place} ${t.metric}: ${ruling}, ratio ${ratioText(t)}` });
  return h("tr", {}, h("th", { scope: "row" }, t.place), h("td", {}, t.metric), h("td", {}, originOf(t)), h("td", {}, chip(ruling, null)),
           axis && h("td", { class: "mark" }, mark), axis && h("td", { class: "figure" }, ratioText(t)),
           pairs && h("td", { class: "figure" }, t.pairs > 0 ? String(t.pairs) : "–"), why && h("td", { class: "why" }, t.why));
}

// The trials of one way to try it, on one axis: what is shaded is what the claim promises.
function trialsTable(how: string, trials: Claim[]): HTMLElement[] {
  const shown: Shown = { axis: axisOf(trials, how), pairs: trials.some((t) => t.pairs > 0), why: trials.some((t) => t.why !== "") };
  const head = (text: string, figures = false) => h("th", { scope: "col", class: figures ? "figure" : false }, text);
  const { axis } = shown;
  return [h("p", { class: "how" }, how),
          h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `Trials: ${how}` }, h("table", { class: "trials" },
            h("thead", {}, h("tr", {}, head("scene"), head("metric"), head("tried in"), head("ruling"),
                             axis && h("th", { scope: "col", "aria-label": "ratio, on an axis" }, axisHead(axis)), axis && head("ratio, and 95 % interval", true),
                             shown.pairs && head("pairs", true), shown.why && head("why"))),
            h("tbody", {}, ...trials.map((t) => trialRow(t, shown)))))];
}

// Its trials are drawn when it is opened.
function groupOf(g: ClaimGroup, open: boolean): HTMLElement {
  const counts = rulings.map((r) => [r, g.trials.filter((t) => rulingOf(t) === r).length] as const).filter(([, n]) => n > 0);
  const shown = g.trials.length > 1 ? counts.map(([r, n]) => `${n} ${r}`).join(", ") : "1 trial";
  const said = g.trials.length < g.tried ? `${shown}, of ${g.tried} trials` : shown;
  const out = h("details", { class: "claim", id: `claim-${g.claim}`, open },
    h("summary", {}, chip(g.ruling, null), h("span", { class: "text" }, g.text), h("span", { class: "soft" }, `${g.sources.join("; ")} · ${said}`)));
  const fill = () => {
    if (!out.open || out.childElementCount > 1) return;
    for (const how of new Set(g.trials.map((t) => t.how))) out.append(...trialsTable(how, g.trials.filter((t) => t.how === how)));
  };
  out.addEventListener("toggle", fill);
  fill();
  return out;
}

function trialsAsTable(page: Page, claims: Claim[]): HTMLElement {
  const columns: Column<Claim>[] = [
    { key: "claim", title: "claim", value: (c) => c.claim },
    { key: "source", title: "source", value: (c) => c.source },
    { key: "exhibit", title: "tried in", value: originOf },
    { key: "place", title: "scene", value: (c) => c.place },
    { key: "metric", title: "metric", value: (c) => c.metric },
    { key: "ruling", title: "ruling", value: rulingOf, text: (c) => `${rulingGlyph[rulingOf(c)]} ${rulingOf(c)}` },
    { key: "ratio", title: "ratio", value: (c) => c.ratio, text: (c) => figure(c.ratio) },
    { key: "lo", title: "from", value: (c) => c.lo, text: (c) => figure(c.lo) },
    { key: "hi", title: "to", value: (c) => c.hi, text: (c) => figure(c.hi) },
    { key: "pairs", title: "pairs", value: (c) => c.pairs },
    { key: "text", title: "text", value: (c) => c.text },
    { key: "how", title: "how", value: (c) => c.how },
    { key: "why", title: "why", value: (c) => c.why },
  ];
  return table({ caption: "All trials", file: "vsglbench-claims", rows: claims, columns, state: page.state, prefix: "cl.all" });
}

export const claimsView: View = {
  id: "claims",
  title: "Claims",
  filters: [],
  has: (page) => allClaims(page).length > 0,
  draw(root, page) {
    const body = h("div");
    const fill = () => {
      const claims = chosenClaims(page), groups = groupsOf(claims, allClaims(page));
      const open = page.state.get("cl.open") === "1" || groups.length <= fewGroups;
      const list = groups.length > 0 ? groups.map((g) => groupOf(g, open)) : [h("p", {}, "No claim is left by these filters.")];
      body.replaceChildren(summary(groups), ...list, trialsAsTable(page, claims));
    };
    root.append(controls(page, (changes) => {
      page.state.set(changes, true);
      fill();
    }), body);
    fill();
  },
};
