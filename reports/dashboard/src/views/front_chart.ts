// The scatter of the front view: log-log, steps of the front, and over it what is hovered and selected.
import * as Plot from "@observablehq/plot";
import { selectedCases } from "../choice";
import { logAxisX, logAxisY, logDomain, logScale, pictureOf, plotDefaults } from "../charts";
import { lookOf } from "../colours";
import { h, svg } from "../dom";
import { figure, withUnit } from "../format";
import type { Placed, Point } from "../pareto";
import type { FrontData } from "./front";
import { zoomByDragging } from "./zoom";
import type { Box } from "./zoom";

export interface FrontChart {
  element: HTMLElement;
  selectionChanged(): void;
}

interface Reader {
  show(c: number | null): void;
  toggle(c: number): void;
}

interface Drawn {
  svg: SVGElement;
  x: (ms: number) => number;
  y: (error: number) => number;
  toMs: (px: number) => number;
  toError: (px: number) => number;
  frame: { x0: number; x1: number; y0: number; y1: number }; // pixels
  least: number; // error at the lower edge
}

const kNear = 24; // pixels to the point that is hovered

function wholeDomain(data: FrontData): Box {
  const points = data.placed.map((p) => p.point);
  const ahead = data.front.map((p) => p.point);
  const [x0, x1] = logDomain([...points.map((p) => p.ms), ...ahead.map((p) => Math.max(p.msLo, p.ms / 4)), ...ahead.map((p) => p.msHi)]);
  const errors = [...points.map((p) => p.error), ...ahead.map((p) => Math.max(p.errorLo, p.error / 4)), ...ahead.map((p) => p.errorHi)];
  const least = Math.min(...errors.filter((e) => e > 0));
  if (data.floor !== null && data.floor > least / 4) errors.push(data.floor); // a floor far below would squeeze the points
  const [y0, y1] = logDomain(errors, 1.15);
  return { x0, x1, y0, y1 };
}

function zoomOf(data: FrontData): Box | null {
  const v = data.page.state.list("fr.z").map(Number);
  return v.length === 4 && v.every((n) => n > 0) && v[0] < v[1] && v[2] < v[3] ? { x0: v[0], x1: v[1], y0: v[2], y1: v[3] } : null;
}

// The staircase from the upper edge to the right one.
function steps(front: Placed[], top: number, right: number): [number, number][] {
  const points = front.map((p): [number, number] => [p.point.ms, p.point.error]);
  if (points.length === 0) return [];
  return [[points[0][0], top], ...points, [right, points[points.length - 1][1]]];
}

function plot(data: FrontData, label: string, width: number, height: number, box: Box): Drawn {
  const { report, digest } = data.page;
  const method = (p: Placed) => report.methods[report.cases.method[p.point.case]];
  const zero = box.y0 * (box.y1 / box.y0) ** 0.02; // an error of 0 just above the edge, where its mark is seen
  const y = (p: Placed) => (p.point.error > 0 ? p.point.error : zero);
  const behind = data.placed.filter((p) => p.standing === "dominated"), unsure = data.placed.filter((p) => p.standing === "ambiguous");
  const many = data.placed.length > 400;
  const at = { x: (p: Placed) => p.point.ms, y, symbol: (p: Placed) => lookOf(digest, method(p)).symbol, clip: true } as const;
  const colour = (p: Placed) => lookOf(digest, method(p)).colour;
  const clamp = (v: number) => Math.max(v, box.y0 / 2);
  const narrow = width < 560;
  const marks: Plot.Markish[] = [
    ...logAxisX([box.x0, box.x1], `${data.ms}, ms →`, narrow ? 7 : 14),
    ...logAxisY([box.y0, box.y1], `↑ ${data.metric.title}${data.metric.unit ? "," + data.metric.unit : ""}`),
    Plot.frame({ stroke: "var(--line)" }),
    Plot.line(steps(data.front, box.y1 * 2, box.x1 * 2).map(([a, b]) => [a, b > 0 ? b : zero]), { curve: "step-after", stroke: "var(--ink)", strokeOpacity: 0.45, strokeWidth: 1.5, clip: true }),
    Plot.dot(behind, { ...at, r: many ? 2.5 : 3.5, fill: "var(--behind)", className: "behind" }),
    Plot.dot(unsure, { ...at, r: many ? 3 : 4, stroke: colour, fill: "var(--page)", strokeWidth: 1.5, className: "unsure" }),
    Plot.ruleX(data.front, { x: (p) => p.point.ms, y1: (p) => clamp(p.point.errorLo), y2: (p) => clamp(p.point.errorHi), stroke: colour, strokeWidth: 1.2, clip: true }),
    Plot.ruleY(data.front, { y, x1: (p) => Math.max(p.point.msLo, box.x0 / 2), x2: (p) => p.point.msHi, stroke: colour, strokeWidth: 1.2, clip: true }),
    Plot.dot(data.front, { ...at, r: 6, fill: colour, stroke: "var(--ink)", strokeWidth: 1, className: "front" }),
  ];
  if (data.floor !== null && data.floor >= box.y0 && data.floor <= box.y1) {
    marks.push(
      Plot.ruleY([data.floor], { stroke: "var(--soft)", strokeDasharray: "4 3" }),
      Plot.text([data.floor], { x: box.x0, y: (v: number) => v, text: () => `noise of the reference, ${withUnit(data.floor, data.metric.unit)}`, textAnchor: "start", dx: 5, dy: -8, fill: "var(--soft)", stroke: "var(--page)", strokeWidth: 3 }),
    );
  }
  const element = Plot.plot({
    ...plotDefaults(width, height),
    x: logScale([box.x0, box.x1]),
    y: logScale([box.y0, box.y1]),
    symbol: { type: "identity" },
    color: { type: "identity" },
    marks,
  });
  const sx = element.scale("x")!, sy = element.scale("y")!;
  const [fx0, fx1] = sx.range as number[], [fy1, fy0] = sy.range as number[];
  return { svg: pictureOf(element, label), x: sx.apply, y: (v) => sy.apply(v > 0 ? v : zero), toMs: sx.invert!, toError: sy.invert!, frame: { x0: fx0, x1: fx1, y0: fy0, y1: fy1 }, least: box.y0 };
}

// Each front point's number below it on the left, where the front has no neighbours; one that would cover another is left out.
function numbers(data: FrontData, { x, y, frame }: Drawn): SVGElement {
  const there: { x: number; y: number }[] = [];
  const out = svg("g", { class: "numbers" });
  data.front.forEach((p, i) => {
    const at = { x: x(p.point.ms) - 8, y: y(p.point.error) + 14 };
    if (at.x < frame.x0 - 8 || at.x > frame.x1 || at.y < frame.y0 || at.y > frame.y1 + 14) return;
    if (there.some((t) => Math.abs(t.x - at.x) < 16 && Math.abs(t.y - at.y) < 12)) return;
    there.push(at);
    out.append(svg("text", { x: at.x, y: at.y, "text-anchor": "end" }, String(i + 1)));
  });
  return out;
}

// A cross of both intervals and a ring.
function emphasis(data: FrontData, drawn: Drawn, point: Point, kind: "active" | "selected"): SVGElement {
  const { x, y, frame } = drawn;
  const { report, digest } = data.page;
  const inX = (v: number) => Math.min(Math.max(v, frame.x0), frame.x1), inY = (v: number) => Math.min(Math.max(v, frame.y0), frame.y1);
  const cx = x(point.ms), cy = y(point.error);
  if (cx < frame.x0 - 1 || cx > frame.x1 + 1 || cy < frame.y0 - 1 || cy > frame.y1 + 1) return svg("g");
  const left = point.msLo > 0 ? inX(x(point.msLo)) : frame.x0, low = point.errorLo > 0 ? inY(y(point.errorLo)) : point.error > 0 ? frame.y1 : cy;
  const colour = lookOf(digest, report.methods[report.cases.method[point.case]]).colour;
  return svg(
    "g", { class: kind, style: `color: ${colour}` },
    svg("line", { x1: left, x2: inX(x(point.msHi)), y1: cy, y2: cy }),
    svg("line", { x1: cx, x2: cx, y1: low, y2: point.error > 0 ? inY(y(point.errorHi)) : cy }),
    svg("circle", { cx, cy, r: kind === "active" ? 9 : 8, "data-case": point.case }),
  );
}

export function frontChart(data: FrontData, reader: Reader): FrontChart {
  const { report, state } = data.page;
  const whole = wholeDomain(data);
  const label = `${data.title}: ${data.metric.title} against ${data.ms} time of ${data.placed.length} cases, ${data.front.length} of them the front. The tables below have the figures.`;
  const box = h("div", { class: "chart plot", tabindex: 0, role: "group", "aria-label": "Points of the chart: arrow keys move, Enter selects, plus and minus zoom, Escape resets" });
  const tip = h("div", { class: "tip", "aria-hidden": "true" });
  const over = svg("g", { class: "over" });
  const reset = h("button", { type: "button", id: "fr-reset", click: () => zoom(null) }, "Reset zoom");
  const clear = h("button", { type: "button", id: "fr-clear", click: () => state.set({ c: "" }) }, "Clear selection");
  let drawn: Drawn;
  let active: number | null = null; // case
  let width = 0;

  function draw(): void {
    if (width < 50) return;
    const height = Math.round(Math.min(560, Math.max(340, width * 0.62)));
    drawn = plot(data, label, width, height, zoomOf(data) ?? whole);
    drawn.svg.append(numbers(data, drawn), over);
    box.replaceChildren(drawn.svg, tip);
    reset.disabled = zoomOf(data) === null;
    emphasise();
  }
  function emphasise(): void {
    const chosen = selectedCases(data.page).map((c) => data.byCase.get(c)).filter((p) => p !== undefined);
    clear.disabled = selectedCases(data.page).length === 0;
    const now = active === null ? undefined : data.byCase.get(active);
    over.replaceChildren(...chosen.map((p) => emphasis(data, drawn, p.point, "selected")), ...(now ? [emphasis(data, drawn, now.point, "active")] : []));
    reader.show(active ?? chosen.at(-1)?.point.case ?? null);
    tip.hidden = !now;
    if (!now) return;
    tip.replaceChildren(h("strong", {}, report.cases.label[now.point.case]), h("br"), `${withUnit(now.point.ms, " ms")}, ${withUnit(now.point.error, data.metric.unit)} ${data.metric.title}`);
    const x = drawn.x(now.point.ms), y = drawn.y(now.point.error);
    const right = x > width / 2;
    tip.style.left = right ? "" : `${x + 14}px`;
    tip.style.right = right ? `${width - x + 14}px` : "";
    tip.style.top = `${Math.max(0, y - 46)}px`;
  }
  function activate(c: number | null): void {
    if (c === active) return;
    active = c;
    emphasise();
  }
  function zoom(to: Box | null): void {
    const short = (v: number) => Number(v.toPrecision(4));
    state.set({ "fr.z": to ? [to.x0, to.x1, to.y0, to.y1].map(short).join(",") : "" }, true);
    draw();
  }

  const inFrame = (p: Placed) => {
    const x = drawn.x(p.point.ms), y = drawn.y(p.point.error), f = drawn.frame;
    return x >= f.x0 && x <= f.x1 && y >= f.y0 && y <= f.y1;
  };
  function nearest(px: number, py: number): number | null {
    let best: number | null = null, least = kNear ** 2;
    for (const p of data.placed) {
      const dx = drawn.x(p.point.ms) - px, dy = drawn.y(p.point.error) - py;
      const d = (dx * dx + dy * dy) * (p.standing === "front" ? 0.5 : 1); // of two that overlap, the front's
      if (d < least && inFrame(p)) [best, least] = [p.point.case, d];
    }
    return best;
  }

  // Left and right along the time, up and down along the front.
  function keys(event: KeyboardEvent): void {
    const along = (list: Placed[], by: number) => {
      const seen = list.filter(inFrame);
      if (seen.length === 0) return;
      const now = active === null ? undefined : data.byCase.get(active);
      let at = now ? seen.indexOf(now) : -1;
      if (now && at < 0) at = seen.findIndex((p) => p.point.ms >= now.point.ms) - (by > 0 ? 1 : 0);
      activate(seen[Math.min(Math.max(now ? at + by : 0, 0), seen.length - 1)].point.case);
    };
    const scale = (by: number) => {
      const now = zoomOf(data) ?? whole;
      const p = active === null ? undefined : data.byCase.get(active)?.point;
      const about = (lo: number, hi: number, centre: number): [number, number] => [centre * (lo / centre) ** by, centre * (hi / centre) ** by];
      const [x0, x1] = about(now.x0, now.x1, p?.ms ?? Math.sqrt(now.x0 * now.x1));
      const [y0, y1] = about(now.y0, now.y1, p && p.error > 0 ? p.error : Math.sqrt(now.y0 * now.y1));
      const out = x0 <= whole.x0 && x1 >= whole.x1 && y0 <= whole.y0 && y1 >= whole.y1;
      zoom(out ? null : { x0, x1, y0, y1 });
    };
    const act: Record<string, () => void> = {
      ArrowRight: () => along(data.front, 1), ArrowLeft: () => along(data.front, -1),
      ArrowDown: () => along(data.placed, 1), ArrowUp: () => along(data.placed, -1),
      Home: () => activate(data.front[0].point.case), End: () => activate(data.front.at(-1)!.point.case),
      Enter: () => active !== null && reader.toggle(active), " ": () => active !== null && reader.toggle(active),
      "+": () => scale(0.5), "=": () => scale(0.5), "-": () => scale(2),
      Escape: () => zoom(null),
    };
    const run = act[event.key];
    if (!run || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    run();
  }
  box.addEventListener("keydown", keys);
  box.addEventListener("pointermove", (e) => {
    const r = box.getBoundingClientRect();
    activate(nearest(e.clientX - r.left, e.clientY - r.top));
  });
  box.addEventListener("pointerleave", (e) => e.pointerType !== "touch" && activate(null)); // a finger's reading stays
  zoomByDragging(box, {
    frame: () => drawn.frame,
    zoom: (r) => zoom({ x0: drawn.toMs(r.x0), x1: drawn.toMs(r.x1), y0: drawn.toError(r.y1), y1: drawn.toError(r.y0) }),
    click: (px, py) => {
      const c = nearest(px, py);
      if (c !== null) reader.toggle(c);
    },
  });
  new ResizeObserver((entries) => {
    const now = Math.floor(entries[0].contentRect.width);
    if (Math.abs(now - width) < 2) return;
    width = now;
    draw();
  }).observe(box);

  const below = data.floor === null ? "" : data.floor >= whole.y0 ? "" : ` The reference's own noise is ${withUnit(data.floor, data.metric.unit)}, below the chart.`;
  const noise = report.groups[data.page.state.number("g", 0)]?.noise[data.ms];
  const caption = h(
    "figcaption", {},
    h("span", { class: "key" }, key("front"), "front, numbered by time, with 95 % intervals"),
    h("span", { class: "key" }, key("unsure"), "behind it, but the intervals can't tell"),
    h("span", { class: "key" }, key("behind"), "dominated"),
    noise === undefined ? "" : `Times are told apart beyond ${figure(noise * 100, 2)} % (A/A).`,
    below,
  );
  return {
    element: h("figure", {}, h("div", { class: "controls" }, h("h2", {}, `${data.title}: ${data.metric.title} against time`), reset, clear), box, caption),
    selectionChanged: () => width >= 50 && emphasise(),
  };
}

function key(kind: "front" | "unsure" | "behind"): SVGElement {
  const style = { front: "fill: var(--method-0); stroke: var(--ink)", unsure: "fill: var(--page); stroke: var(--method-0); stroke-width: 1.5", behind: "fill: var(--behind)" }[kind];
  return svg("svg", { width: 14, height: 12, viewBox: "-7 -6 14 12", "aria-hidden": "true" }, svg("circle", { r: kind === "front" ? 5 : 4, style }));
}
