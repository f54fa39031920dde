// One chart of the history, and what pointing, dragging and keys do in it.
import { h, svg } from "../dom";
import { drawAxes, drawFocus, drawLane, drawLines, drawMarks, drawRefusals, frameOf, margin, type Frame, type PanelOptions } from "./history_drawing";
import type { Line } from "./history_model";
import { onTheme } from "./paint";

// Of the report below the pointer, the line that is nearest to it.
function nearest(f: Frame, x: number, y: number): { line: Line; report: number } | null {
  const { lines, from, to } = f.options;
  const step = to > from ? f.x(from + 1) - f.x(from) : 1;
  const report = Math.max(from, Math.min(to, from + Math.round((x - f.x(from)) / step)));
  let best: Line | null = null, least = Infinity;
  for (const line of lines) {
    const v = line.y[report];
    const d = v === null ? Infinity : Math.abs(f.y.at(v) - y);
    if (d < least) [best, least] = [line, d];
  }
  return best && { line: best, report };
}

export interface Panel {
  element: HTMLElement;
}

export function historyPanel(options: PanelOptions): Panel {
  const canvas = h("canvas");
  const image = svg("svg", { role: "img", "aria-label": `${options.title}: ${options.lines.length} lines over ${options.to - options.from + 1} reports` });
  const tip = h("div", { class: "history-tip", hidden: true });
  const frame = h("div", { class: "history-frame", id: `hi-frame-${options.id}`, tabindex: 0, role: "group", "aria-roledescription": "chart",
                              "aria-label": `${options.title}. Left and right go from report to report, up and down from line to line, plus and minus zoom, Enter opens a line` }, canvas, image, tip);
  frame.style.height = `${options.height}px`;
  const live = h("p", { class: "visually-hidden", "aria-live": "polite" });
  const element = h("section", { class: "history-panel" }, h("h3", {}, options.title), frame, live);
  let f: Frame = frameOf(options, 0), over: SVGElement | null = null, now: { line: Line; report: number } | null = null;

  function clear(): void {
    over?.remove();
    over = now = null;
    tip.hidden = true;
  }
  // Where nothing is pointed at: the line that was opened, without words over it.
  function rest(): void {
    clear();
    if (options.marker < 0) return;
    over = drawFocus(f, options.lines[0], options.marker);
    image.append(over);
  }
  function focus(line: Line, report: number): void {
    over?.remove();
    now = { line, report };
    over = drawFocus(f, line, report);
    image.append(over);
    tip.replaceChildren(options.describe(line, report));
    tip.hidden = false;
    const x = f.x(report), y = f.y.at(line.y[report] ?? 0), right = x > f.width / 2;
    tip.style.left = right ? "" : `${x + 14}px`;
    tip.style.right = right ? `${f.width - x + 14}px` : "";
    tip.style.top = `${Math.max(0, Math.min(options.height - tip.offsetHeight, y - tip.offsetHeight / 2))}px`;
  }
  function draw(): void {
    if (frame.clientWidth < 120) return;
    f = frameOf(options, frame.clientWidth);
    image.setAttribute("viewBox", `0 0 ${f.width} ${options.height}`);
    drawLines(canvas, f);
    image.replaceChildren(drawAxes(f), drawRefusals(f), drawLane(f));
    if (options.marked) for (const l of options.lines) image.append(drawMarks(f, l, options.changes));
    if (now) focus(now.line, now.report);
    else rest();
  }

  let pressed: number | null = null, band: SVGElement | null = null;
  const place = (e: PointerEvent) => {
    const box = frame.getBoundingClientRect();
    return { x: e.clientX - box.left, y: e.clientY - box.top };
  };
  frame.addEventListener("pointerdown", (e) => { pressed = place(e).x; });
  frame.addEventListener("pointermove", (e) => {
    const { x, y } = place(e);
    if (pressed !== null && Math.abs(x - pressed) > 8) {
      frame.setPointerCapture(e.pointerId);
      clear();
      band?.remove();
      band = svg("rect", { x: Math.min(x, pressed), width: Math.abs(x - pressed), y: margin.top, height: f.bottom - margin.top, class: "band" });
      image.append(band);
      return;
    }
    const at = nearest(f, x, y);
    if (at && (at.line !== now?.line || at.report !== now.report)) focus(at.line, at.report);
  });
  frame.addEventListener("pointerup", (e) => {
    const { x, y } = place(e), start = pressed;
    pressed = null;
    const dragged = band !== null;
    band?.remove();
    band = null;
    const at = nearest(f, x, y), first = start === null ? null : nearest(f, start, y);
    if (dragged && at && first && at.report !== first.report)
      options.zoom(Math.min(at.report, first.report), Math.max(at.report, first.report));
    else if (!dragged && at) options.pick(at.line, at.report);
  });
  // A finger's reading stays until the next tap.
  frame.addEventListener("pointerleave", (e) => { if (pressed === null && e.pointerType !== "touch") rest(); });
  frame.addEventListener("blur", rest);
  frame.addEventListener("keydown", (e) => {
    const here = now ?? (options.lines.length > 0 ? { line: options.lines[0], report: options.to } : null);
    if (!here) return;
    if (e.key === "Enter") return options.pick(here.line, here.report);
    if (e.key === "Escape") return rest();
    if (e.key === "+" || e.key === "-") {
      const half = Math.max(1, Math.round((options.to - options.from) * (e.key === "+" ? 0.25 : 1)));
      return options.zoom(Math.max(0, here.report - half), Math.min(options.history.reports.length - 1, here.report + half));
    }
    const by = { ArrowLeft: -1, ArrowRight: 1 }[e.key] ?? 0, up = { ArrowUp: 1, ArrowDown: -1 }[e.key] ?? 0;
    if (by === 0 && up === 0) return;
    e.preventDefault();
    let { line, report } = here;
    if (now && by !== 0) {
      let next = report + by;
      while (next >= options.from && next <= options.to && line.y[next] === null) next += by;
      if (next >= options.from && next <= options.to) report = next;
    }
    if (now && up !== 0) {
      const there = options.lines.filter((l) => l.y[report] !== null).sort((a, b) => a.y[report]! - b.y[report]!);
      line = there[Math.max(0, Math.min(there.length - 1, there.indexOf(line) + up))] ?? line;
    }
    focus(line, report);
    live.textContent = tip.innerText;
  });
  new ResizeObserver(draw).observe(frame);
  onTheme(frame, draw);
  return { element };
}
