// Colours of figures in a picture: stops in even steps, mixed between.
type Rgb = readonly [number, number, number];

const of = (hex: string): Rgb[] =>
  hex.split(" ").map((h) => [0, 2, 4].map((i) => parseInt(h.slice(i, i + 2), 16)) as unknown as Rgb);

// Inferno of matplotlib: lightness rises evenly, in print and for the colour-blind too.
export const INFERNO = of(
  "000004 0b0724 210c4a 3d0965 57106e 71196e 8a226a a32c61 bc3754 d04545 e35933 f1711f f98c0a fcaa0f f9c932 f2e865 fcffa4",
);

// As harness/image/theme.cpp has them for screens: too dark is blue, right is near black, too bright is red.
export const SIGNED: Rgb[] = [
  [190, 232, 255],
  [72, 150, 236],
  [26, 66, 142],
  [14, 14, 18],
  [140, 36, 30],
  [240, 110, 40],
  [255, 232, 150],
];

export const NOT_FINITE: Rgb = [255, 0, 255];
export const NO_SURFACE: Rgb = [70, 70, 74];

// At t in 0 … 1, clamped.
export function mix(stops: readonly Rgb[], t: number): [number, number, number] {
  const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  return [0, 1, 2].map((c) => Math.round(stops[k][c] + (stops[k + 1][c] - stops[k][c]) * (at - k))) as [number, number, number];
}

// 256 RGBA texels of a ramp.
export function texels(stops: readonly Rgb[]): Uint8Array {
  const out = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) out.set([...mix(stops, i / 255), 255], 4 * i);
  return out;
}

// For a legend's bar.
export function gradient(stops: readonly Rgb[]): string {
  return `linear-gradient(to right, ${stops.map((s) => `rgb(${s.join(" ")})`).join(", ")})`;
}
