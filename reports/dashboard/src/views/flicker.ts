// How much methods flicker in a scene in motion: figures, series over the frames, and pictures of where it is worst.
import "./flicker.css";
import { casesShown, methodOf } from "../choice";
import { lookOf, swatch } from "../colours";
import { bytesOf, type Flicker, type Image, type Temporal } from "../data";
import { choice, h } from "../dom";
import { figure } from "../format";
import { type Column, table } from "../table";
import type { Page, View } from "../view";
import { type Measure, namesOf, seriesChart, stepsOf, stepsWord, valuesChart } from "./flicker_charts";

function temporalsShown(page: Page): Temporal[] {
  const shown = new Set(casesShown(page, "scene"));
  return page.report.temporal.filter((t) => shown.has(t.case));
}

function columnsOf(page: Page, names: Map<Temporal, string>): Column<Temporal>[] {
  const { report, digest } = page;
  const number = (key: string, title: string, hint: string, value: (t: Temporal) => number | null): Column<Temporal> => ({ key, title, hint, value, text: (t) => figure(value(t)) });
  const ends = (key: string, of: (t: Temporal) => { lo: number; hi: number } | null): Column<Temporal>[] => [
    number(`${key}_lo`, "from", `lower end of the 95 % interval of ${key}`, (t) => of(t)?.lo ?? null),
    number(`${key}_hi`, "to", `upper end of the 95 % interval of ${key}`, (t) => of(t)?.hi ?? null),
  ];
  const of = (m: Measure, key: keyof Flicker) => (t: Temporal) => (t[m]?.[key] as number | undefined) ?? null;
  return [
    { key: "case", title: "case", value: (t) => names.get(t)!, node: (t) => swatch(lookOf(digest, methodOf(report, t.case))) },
    number("derivative", "derivative", "mean |change of the image − change of the reference| from frame to frame, over the references' mean", of("derivative", "value")),
    ...ends("derivative", (t) => t.derivative),
    number("derivative_p99", "p99", "99th percentile over pixels of the derivative", of("derivative", "p99")),
    { key: "worst", title: "worst frame", hint: "frame that differs most from the one before", value: of("derivative", "worst_frame") },
    number("static", "static", "mean difference of a still frame between two seeds, over the reference's mean", of("static", "value")),
    ...ends("static", (t) => t.static),
    number("static_p99", "p99", "99th percentile over pixels of the static flicker", of("static", "p99")),
    number("detail", "detail", "how much of the reference's gradients is kept: 1 is as sharp, below is blurred", (t) => t.detail?.value ?? null),
    ...ends("detail", (t) => t.detail),
    number("gain", "gain", "mean of the image over the reference's", (t) => t.detail?.gain ?? null),
    number("noise_floor", "noise floor", "derivative of the references' own noise", (t) => t.noise_floor),
    number("unlit", "black image", "derivative of an image that is black throughout", (t) => t.unlit),
  ];
}

function valuesTable(page: Page, all: Temporal[]): HTMLElement {
  const names = namesOf(page, all);
  return table({ caption: "Flicker and detail", file: `${page.report.name}-flicker`, rows: all, columns: columnsOf(page, names), state: page.state, prefix: "fl" });
}

function stepsTable(page: Page, all: Temporal[], measure: Measure): HTMLElement {
  type Row = ReturnType<typeof stepsOf>[number];
  const columns: Column<Row>[] = [
    { key: "case", title: "case", value: (s) => s.label },
    { key: "at", title: stepsWord[measure], value: (s) => s.at },
    { key: "value", title: measure, value: (s) => s.value, text: (s) => figure(s.value, 4) },
    { key: "worst", title: "worst", value: (s) => (s.worst ? "worst" : "") },
  ];
  const rows = stepsOf(page, all, measure);
  return h("details", {}, h("summary", { class: "soft" }, "Figures of the series"), table({ caption: `${measure} of each ${stepsWord[measure]}`, file: `${page.report.name}-${measure}-series`, rows, columns }));
}

// A picture; one that moves has a button that stops it, and stands still where the reader's system asks for that.
function pictureOf(image: Image, words: string, moves: boolean): HTMLElement {
  const url = URL.createObjectURL(new Blob([bytesOf(image.element) as BlobPart], { type: "image/png" }));
  const still = h("canvas", { role: "img", "aria-label": `${words} (its first frame)`, hidden: true });
  const element = h("img", { alt: words, error: () => element.replaceWith(h("p", { class: "failed" }, "The picture can't be read.")) });
  const button = h("button", { type: "button", click: () => stop(still.hidden) }, "Stop");
  const stop = (on: boolean) => {
    still.hidden = !on;
    element.hidden = on;
    button.textContent = on ? "Play" : "Stop";
  };
  element.addEventListener("load", () => {
    URL.revokeObjectURL(url);
    Object.assign(still, { width: element.naturalWidth, height: element.naturalHeight });
    still.getContext("2d")!.drawImage(element, 0, 0);
    if (moves && matchMedia("(prefers-reduced-motion: reduce)").matches) stop(true);
  });
  element.src = url;
  return h("figure", {}, element, still, h("figcaption", {}, words, " ", moves ? button : null));
}

function pictures(page: Page, all: Temporal[]): HTMLElement | null {
  const { digest, state } = page;
  const with_ = all.filter((t) => digest.images[t.worst] || digest.images[t.profile]);
  if (with_.length === 0) return null;
  const names = namesOf(page, all);
  const worst = with_.reduce((a, b) => ((b.derivative?.value ?? 0) > (a.derivative?.value ?? 0) ? b : a));
  const asked = with_.find((t) => String(t.case) === state.get("fl.c")) ?? with_.find((t) => state.list("c").includes(String(t.case))) ?? worst;
  const pick = choice("Case", "fl-case", with_.map((t) => [String(t.case), names.get(t)!]), String(asked.case), (c) => state.set({ "fl.c": c }));
  const name = names.get(asked)!;
  return h(
    "section", {},
    h("h2", {}, "Where it flickers most"),
    h("div", { class: "controls" }, pick),
    h(
      "div", { class: "flicker-pictures" },
      digest.images[asked.worst] ? pictureOf(digest.images[asked.worst], `${name}: the crop that flickers most, beside the reference, over time`, true) : null,
      digest.images[asked.profile] ? pictureOf(digest.images[asked.profile], `${name}: one row of pixels, time downwards; what flickers is dashed`, false) : null,
    ),
  );
}

export const flickerView: View = {
  id: "flicker",
  title: "Flicker",
  filters: ["group", "methods"],
  has: ({ report }) => report.temporal.length > 0,
  draw(root, page) {
    const all = temporalsShown(page);
    if (all.length === 0) {
      root.append(h("p", {}, "No case shown has frames in motion."));
      return;
    }
    const measures = (["derivative", "static"] as const).filter((m) => all.some((t) => t[m]));
    const measure = measures.find((m) => m === page.state.get("fl.m")) ?? measures[0];
    root.append(h("h2", {}, "Flicker of each case"), valuesChart(page, all), valuesTable(page, all));
    if (measure) {
      const pick = choice("Series of", "fl-measure", measures.map((m) => [m, m === "derivative" ? "derivative, over frames" : "static, over seeds"]), measure, (m) => page.state.set({ "fl.m": m === measures[0] ? "" : m }));
      root.append(h("h2", {}, "Series"), h("div", { class: "controls" }, pick), seriesChart(page, all, measure), stepsTable(page, all, measure));
    }
    const shown = pictures(page, all);
    if (shown) root.append(shown);
  },
};
