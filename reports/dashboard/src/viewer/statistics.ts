// What a rectangle of a picture holds: the formulas of harness/image/metrics.h, in double precision.
import type { Picture } from "./picture";

export interface Rectangle {
  x: number; // of the left upper pixel
  y: number;
  width: number;
  height: number;
}

export interface Statistics {
  pixels: number; // that show a surface
  bad: number; // with a NaN or Inf in either picture: those are never averaged away
  mean: [number, number, number]; // of each channel
  smape: number; // per cent
  rmse: number;
}

export const luminance = (r: number, g: number, b: number) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

// |x−r| / ((|x|+|r|)/2), 0/0 is 0.
export function symmetricRelative(x: number, r: number): number {
  const sum = Math.abs(x) + Math.abs(r);
  return sum > 0 ? Math.abs(x - r) / (0.5 * sum) : Number.isNaN(sum) ? NaN : 0;
}

// Of one pixel, mean over its channels, in per cent.
export function pixelSmape(x: Float32Array, r: Float32Array, at: number): number {
  let sum = 0;
  for (let c = 0; c < 3; ++c) sum += symmetricRelative(x[at + c], r[at + c]);
  return (100 * sum) / 3;
}

// (x−r) / ((|x|+|r|)/2) of luminance: what harness/image/error_map.h draws.
export function signedError(x: Float32Array, r: Float32Array, at: number): number {
  const a = luminance(x[at], x[at + 1], x[at + 2]);
  const b = luminance(r[at], r[at + 1], r[at + 2]);
  const sum = Math.abs(a) + Math.abs(b);
  return !Number.isFinite(sum) ? NaN : sum > 0 ? (a - b) / (0.5 * sum) : 0;
}

const finite = (v: Float32Array, at: number) => Number.isFinite(v[at]) && Number.isFinite(v[at + 1]) && Number.isFinite(v[at + 2]);

// Of x against r, both of one size, over the pixels where r shows a surface: its channel A is not 0.
export function statistics(x: Picture, r: Picture, part: Rectangle): Statistics | null {
  if (!x.values || !r.values || x.width !== r.width || x.height !== r.height) return null;
  const out: Statistics = { pixels: 0, bad: 0, mean: [0, 0, 0], smape: 0, rmse: 0 };
  for (let row = part.y; row < part.y + part.height; ++row) {
    for (let column = part.x; column < part.x + part.width; ++column) {
      const at = 4 * (row * r.width + column);
      if (r.values[at + 3] === 0) continue;
      ++out.pixels;
      if (!finite(x.values, at) || !finite(r.values, at)) ++out.bad;
      for (let c = 0; c < 3; ++c) {
        const [xc, rc] = [x.values[at + c], r.values[at + c]];
        out.mean[c] += xc;
        out.smape += symmetricRelative(xc, rc);
        out.rmse += (xc - rc) * (xc - rc);
      }
    }
  }
  if (out.pixels === 0) return null;
  for (let c = 0; c < 3; ++c) out.mean[c] /= out.pixels;
  out.smape *= 100 / (3 * out.pixels);
  out.rmse = Math.sqrt(out.rmse / (3 * out.pixels));
  if (out.bad > 0) out.smape = out.rmse = NaN;
  return out;
}

export function meanOf(x: Picture, part: Rectangle): [number, number, number] | null {
  return statistics(x, x, part)?.mean ?? null;
}
