// The image view's controls; each changes the settings and says so.
import { checkbox, choice, h } from "../dom";
import { figure } from "../format";
import type { Page } from "../view";
import { type Chosen, labelOf, type Shot, type ShotId } from "./image_choice";
import { type Layout, MOST_STOPS, RANGES, type Settings } from "./image_settings";

export interface Actions {
  change(changes: Partial<Settings>): void;
  zoom(factor: number): void; // 0: the whole picture
  toPixels(): void; // one pixel of the picture a pixel of the screen
}

const LAYOUTS: [Layout, string][] = [["one", "One"], ["divider", "Divider"], ["all", "Side by side"]];

export function exposureWords(stops: number): string {
  return `${stops > 0 ? "+" : stops < 0 ? "−" : ""}${figure(Math.abs(stops))} stops`;
}

function pictures(page: Page, chosen: Chosen): HTMLElement[] {
  const { digest, state } = page;
  const options = chosen.candidates.map((i): [string, string] => [String(digest.images.indexOf(i)), labelOf(page, i)]);
  const select = (key: "a" | "b") =>
    choice(key.toUpperCase(), `im-${key}`, options, String(digest.images.indexOf(chosen[key]!)), (v) => state.set({ [`im.${key}`]: v }));
  return (["a", "b"] as const).filter((key) => chosen[key] !== null).map(select);
}

function layouts(s: Settings, actions: Actions): HTMLElement {
  const button = ([layout, words]: [Layout, string]) =>
    h("button", { type: "button", id: `im-${layout}`, "aria-pressed": String(s.layout === layout), click: () => actions.change({ layout }) }, words);
  return h("div", { class: "segments", role: "group", "aria-label": "Layout" }, ...LAYOUTS.map(button));
}

function sides(s: Settings, shots: Shot[], actions: Actions): HTMLElement[] {
  const options = shots.map((shot): [string, string] => [shot.id, shot.title]);
  if (s.layout === "all") return [];
  const left = choice(s.layout === "one" ? "Picture" : "Left", "im-left", options, s.left, (v) => actions.change({ left: v as ShotId }));
  return s.layout === "one" ? [left] : [left, choice("Right", "im-right", options, s.right, (v) => actions.change({ right: v as ShotId }))];
}

function exposure(s: Settings, actions: Actions): HTMLElement {
  const words = h("output", { for: "im-exposure" }, exposureWords(s.stops));
  const slider = h("input", {
    type: "range", id: "im-exposure", min: -MOST_STOPS, max: MOST_STOPS, step: 0.25, "aria-valuetext": exposureWords(s.stops),
    input: () => actions.change({ stops: Number(slider.value) }),
  });
  slider.value = String(s.stops);
  const reset = h("button", { type: "button", id: "im-exposure-reset", disabled: s.stops === 0, click: () => actions.change({ stops: 0 }) }, "Reset");
  return h("span", { class: "choice" }, h("label", { for: "im-exposure" }, h("span", {}, "Exposure")), slider, words, reset);
}

export function controls(page: Page, chosen: Chosen, shots: Shot[], s: Settings, actions: Actions): HTMLElement[] {
  const button = (id: string, label: string, words: string, click: () => void) => h("button", { type: "button", id, "aria-label": label, click }, words);
  return [
    h("div", { class: "controls" }, ...pictures(page, chosen)),
    h("div", { class: "controls" }, layouts(s, actions), ...sides(s, shots, actions)),
    h(
      "div", { class: "controls" },
      exposure(s, actions),
      checkbox("False colours", "im-false", s.falseColour, (falseColour) => actions.change({ falseColour })),
      choice("Error map", "im-error", [["signed", "too dark, too bright"], ["smape", "SMAPE"]], s.error, (v) => actions.change({ error: v as Settings["error"] })),
      choice("up to", "im-range", RANGES.map((r) => [String(r), `${figure(100 * r)} %`]), String(s.range), (v) => actions.change({ range: Number(v) })),
      h(
        "span", { class: "choice", role: "group", "aria-label": "Zoom" },
        h("span", {}, "Zoom"), button("im-out", "Zoom out", "−", () => actions.zoom(0.5)), button("im-in", "Zoom in", "+", () => actions.zoom(2)),
        button("im-fit", "Fit the whole picture", "Fit", () => actions.zoom(0)), button("im-pixels", "1:1, one pixel of the picture a pixel of the screen", "1:1", () => actions.toPixels()),
      ),
      h("button", { type: "button", id: "im-tool", "aria-pressed": String(s.tool), title: "Drags draw a rectangle", click: () => actions.change({ tool: !s.tool }) }, "Rectangle"),
      s.rectangle && h("button", { type: "button", id: "im-clear", click: () => actions.change({ rectangle: null }) }, "Clear"),
    ),
  ];
}

const KEYS: [string[], string][] = [
  [["1", "…", "5"], "reference, A, B, error of A, error of B (with Shift: right of the divider)"],
  [["←", "→"], "flip"],
  [["+", "−", "0"], "zoom, whole picture"],
  [["Shift", "arrows"], "pan"],
  [["e", "E"], "half a stop brighter, darker"],
  [["f"], "false colours"],
  [["r"], "rectangle: arrows move it, with Shift they size it, Esc takes it away"],
];

export function keysHelp(): HTMLElement {
  const line = ([keys, words]: [string[], string]) => h("div", {}, ...keys.flatMap((k) => [k === "…" ? "…" : h("kbd", {}, k), " "]), words);
  return h(
    "details", { class: "keys" },
    h("summary", {}, "Keys and gestures"),
    ...KEYS.map(line),
    h("div", {}, "Wheel or two fingers zoom; a drag pans, takes the divider along, and with Shift draws a rectangle. The divider's handles are moved by arrow keys, too."),
  );
}
