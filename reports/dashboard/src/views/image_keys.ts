// The image view's keys. They count where the view has the focus, but not in a field that wants them itself.
import type { Stage } from "../viewer/stage";
import type { Rectangle } from "../viewer/statistics";
import type { Actions } from "./image_controls";
import { type Shot, SHOTS } from "./image_choice";
import { MOST_STOPS, type Settings } from "./image_settings";

export interface Now {
  settings: Settings;
  shots: Shot[];
  size: [number, number];
}

const ARROWS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const clamp = (v: number, lo: number, hi: number) => Math.min(Math.max(v, lo), hi);

// Moved, or with Shift sized, by so many pixels.
export function stepped(r: Rectangle | null, [dx, dy]: [number, number], sized: boolean, [width, height]: [number, number]): Rectangle {
  if (!r) return { x: width >> 2, y: height >> 2, width: Math.max(width >> 1, 1), height: Math.max(height >> 1, 1) };
  if (sized) return { ...r, width: clamp(r.width + dx, 1, width - r.x), height: clamp(r.height + dy, 1, height - r.y) };
  return { ...r, x: clamp(r.x + dx, 0, width - r.width), y: clamp(r.y + dy, 0, height - r.height) };
}

function arrow(e: KeyboardEvent, { settings: s, shots, size }: Now, stage: Stage, actions: Actions): void {
  const [dx, dy] = ARROWS[e.key];
  if (s.tool) return actions.change({ rectangle: stepped(s.rectangle, [dx, dy], e.shiftKey, size) });
  if (e.shiftKey || dx === 0) {
    stage.pan(-40 * dx, -40 * dy);
    return actions.change({ camera: stage.camera });
  }
  const at = shots.findIndex((shot) => shot.id === s.left);
  const left = shots[(at + dx + shots.length) % shots.length].id;
  actions.change(s.layout === "all" ? { layout: "one", left } : { left });
}

// Whether the key was one of ours.
export function onKey(e: KeyboardEvent, now: Now, stage: Stage, actions: Actions): boolean {
  if (e.ctrlKey || e.altKey || e.metaKey) return false;
  const { settings: s, shots } = now;
  const digit = /^Digit([1-5])$/.exec(e.code) ?? /^Numpad([1-5])$/.exec(e.code);
  if (digit) {
    const id = SHOTS[Number(digit[1]) - 1];
    if (!shots.some((shot) => shot.id === id)) return false;
    actions.change(s.layout === "all" ? { layout: "one", left: id } : e.shiftKey && s.layout === "divider" ? { right: id } : { left: id });
  } else if (e.key in ARROWS) arrow(e, now, stage, actions);
  else if (e.key === "+" || e.key === "=") actions.zoom(Math.SQRT2);
  else if (e.key === "-") actions.zoom(Math.SQRT1_2);
  else if (e.key === "0") actions.zoom(0);
  else if (e.key === "e") actions.change({ stops: Math.min(s.stops + 0.5, MOST_STOPS) });
  else if (e.key === "E") actions.change({ stops: Math.max(s.stops - 0.5, -MOST_STOPS) });
  else if (e.key === "f") actions.change({ falseColour: !s.falseColour });
  else if (e.key === "r") actions.change({ tool: !s.tool, rectangle: s.rectangle ?? (s.tool ? null : stepped(null, [0, 0], false, now.size)) });
  else if (e.key === "Escape" && (s.rectangle || s.tool)) actions.change({ rectangle: null, tool: false });
  else return false;
  return true;
}

// Arrow keys on the divider's handles.
export function onHandleKey(e: KeyboardEvent, stage: Stage, change: (changes: Partial<Settings>) => void): boolean {
  const step = ARROWS[e.key];
  if (!step) return false;
  const d = stage.divider;
  const by = e.shiftKey ? 10 : 1;
  if (e.currentTarget === stage.knob) {
    const turned = d.angle + (step[0] + step[1]) * (e.shiftKey ? 15 : 1);
    change({ divider: { ...d, angle: ((((turned + 180) % 360) + 360) % 360) - 180 } });
  } else change({ divider: { ...d, x: clamp(d.x + (by * step[0]) / 100, 0, 1), y: clamp(d.y + (by * step[1]) / 100, 0, 1) } });
  return true;
}
