// What a reader has chosen in the image view, in the state's keys im.*.
import type { State } from "../state";
import type { Camera, Divider } from "../viewer/scene";
import type { Rectangle } from "../viewer/statistics";
import { type ShotId, SHOTS } from "./image_choice";

export type Layout = "one" | "divider" | "all";

export interface Settings {
  layout: Layout;
  left: ShotId; // the one picture, or that on the divider's first side
  right: ShotId;
  stops: number; // over the scene's exposure
  falseColour: boolean;
  error: "signed" | "smape";
  range: number; // of error maps: 1 is 100 %
  camera: Camera | null; // null: the whole picture
  divider: Divider;
  rectangle: Rectangle | null;
  tool: boolean; // a drag draws a rectangle
}

export const MOST_STOPS = 10;
export const RANGES = [0.1, 0.2, 0.5, 1, 2];

function numbers(text: string, count: number): number[] | null {
  const out = text.split(",").map(Number);
  return text !== "" && out.length === count && out.every(Number.isFinite) ? out : null;
}

export function readSettings(state: State): Settings {
  const shot = (key: string, otherwise: ShotId) => SHOTS.find((s) => s === state.get(key)) ?? otherwise;
  const layout = state.get("im.l");
  const camera = numbers(state.get("im.z"), 3);
  const divider = numbers(state.get("im.d"), 3) ?? [50, 50, 0];
  const part = numbers(state.get("im.s"), 4)?.map(Math.round);
  return {
    layout: layout === "one" || layout === "all" ? layout : "divider",
    left: shot("im.p", "r"),
    right: shot("im.q", "a"),
    stops: Math.min(Math.max(state.number("im.ex", 0), -MOST_STOPS), MOST_STOPS),
    falseColour: state.get("im.f") === "1",
    error: state.get("im.e") === "smape" ? "smape" : "signed",
    range: RANGES.includes(state.number("im.er", 1)) ? state.number("im.er", 1) : 1,
    camera: camera && camera[0] > 0 ? { zoom: camera[0], x: camera[1], y: camera[2] } : null,
    divider: { x: divider[0] / 100, y: divider[1] / 100, angle: divider[2] },
    rectangle: part && part[0] >= 0 && part[1] >= 0 && part[2] > 0 && part[3] > 0 ? { x: part[0], y: part[1], width: part[2], height: part[3] } : null,
    tool: state.get("im.t") === "1",
  };
}

const short = (v: number) => Number(v.toFixed(2));

// Quietly: the view draws it itself.
export function writeSettings(state: State, s: Settings): void {
  const { camera, divider, rectangle } = s;
  const placed = [short(100 * divider.x), short(100 * divider.y), Math.round(divider.angle)].join(",");
  state.set(
    {
      "im.l": s.layout === "divider" ? "" : s.layout,
      "im.p": s.left === "r" ? "" : s.left,
      "im.q": s.right === "a" ? "" : s.right,
      "im.ex": s.stops === 0 ? "" : s.stops,
      "im.f": s.falseColour ? "1" : "",
      "im.e": s.error === "signed" ? "" : s.error,
      "im.er": s.range === 1 ? "" : s.range,
      "im.z": camera ? [short(camera.zoom), short(camera.x), short(camera.y)].join(",") : "",
      "im.d": placed === "50,50,0" ? "" : placed,
      "im.s": rectangle ? [rectangle.x, rectangle.y, rectangle.width, rectangle.height].join(",") : "",
      "im.t": s.tool ? "1" : "",
    },
    true,
  );
}

// Within a picture of this size; null where nothing is left.
export function inside(r: Rectangle | null, [width, height]: [number, number]): Rectangle | null {
  if (!r || r.x >= width || r.y >= height) return null;
  return { ...r, width: Math.min(r.width, width - r.x), height: Math.min(r.height, height - r.y) };
}
