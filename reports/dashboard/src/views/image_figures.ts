// Figures beside the pictures: legends, the pixel under the pointer, statistics of a rectangle.
import { h } from "../dom";
import { figure } from "../format";
import { table } from "../table";
import type { Page } from "../view";
import { gradient, INFERNO, SIGNED } from "../viewer/ramps";
import { type Kind, type Look, STOPS, valuesAt } from "../viewer/scene";
import { meanOf, type Rectangle, type Statistics, statistics } from "../viewer/statistics";
import { type Chosen, type Decoded, labelOf, type Shot } from "./image_choice";

interface Row {
  name: string;
  mean: [number, number, number] | null;
  smape: number | null;
  rmse: number | null;
  bad: number;
  reported: number | null;
}

function rowsOf(page: Page, chosen: Chosen, decoded: Decoded, own: Statistics | null, part: Rectangle): Row[] {
  const rows: Row[] = [];
  const { reference, a, b, referenceOfB } = decoded;
  if (own) rows.push({ name: "reference", mean: own.mean, smape: null, rmse: null, bad: own.bad, reported: null });
  for (const [name, image, x, r] of [["A", chosen.a, a, reference], ["B", chosen.b, b, referenceOfB]] as const) {
    if (!image || !x?.values) continue;
    const found = r ? statistics(x, r, part) : null;
    const errors = page.digest.reports[image.report].cases.errors.smape;
    const reported = errors?.seeds[image.case]?.[0] ?? errors?.value[image.case] ?? null;
    rows.push({ name: `${name}: ${labelOf(page, image)}`, mean: found?.mean ?? meanOf(x, part), smape: found?.smape ?? null, rmse: found?.rmse ?? null, bad: found?.bad ?? 0, reported });
  }
  return rows;
}

// Of the whole picture where there is no rectangle.
export function statisticsTable(page: Page, chosen: Chosen, decoded: Decoded, rectangle: Rectangle | null): HTMLElement {
  const [width, height] = decoded.size;
  const part = rectangle ?? { x: 0, y: 0, width, height };
  const own = decoded.reference ? statistics(decoded.reference, decoded.reference, part) : null;
  const rows = rowsOf(page, chosen, decoded, own, part);
  if (rows.length === 0) return h("p", { class: "note" }, "PNG pictures have no values: no statistics.");
  const surface = decoded.reference?.values ? (own?.pixels ?? 0) : part.width * part.height;
  const where = `${part.width} × ${part.height} px`;
  const caption = rectangle ? `Rectangle at (${part.x}, ${part.y}), ${where}` : `Whole picture, ${where}`;
  const missing = part.width * part.height - surface;
  const bad = rows.reduce((sum, r) => sum + r.bad, 0);
  const notes = [
    missing > 0 ? `${missing} pixels show no surface and are left out.` : "",
    decoded.reference && !decoded.reference.covered ? "Pixels without a surface count, unlike in the report." : "",
    bad > 0 ? `${bad} pixels hold a NaN or Inf: there is no error.` : "",
    rectangle ? "" : "Drag with Shift, or with Rectangle on, to choose a part.",
  ];
  const mean = (c: 0 | 1 | 2, title: string) => ({
    key: title, title: `mean ${title}`, unit: "W/m²/sr", value: (r: Row) => r.mean?.[c] ?? null, text: (r: Row) => figure(r.mean?.[c], 4),
  });
  return table<Row>({
    caption,
    file: "region",
    rows,
    note: notes.filter((n) => n !== "").join(" "),
    columns: [
      { key: "picture", title: "picture", value: (r) => r.name },
      mean(0, "R"), mean(1, "G"), mean(2, "B"),
      { key: "smape", title: "SMAPE", unit: "%", hint: "100 mean(|x−r| / ((|x|+|r|)/2)) over pixels and channels", value: (r) => r.smape, text: (r) => figure(r.smape, 4) },
      { key: "rmse", title: "RMSE", unit: "W/m²/sr", hint: "√mean((x−r)²) over pixels and channels", value: (r) => r.rmse, text: (r) => figure(r.rmse, 4) },
      ...(rectangle ? [] : [{ key: "reported", title: "SMAPE of the first seed in the report", unit: "%", hint: "the picture is of this seed", value: (r: Row) => r.reported, text: (r: Row) => figure(r.reported, 4) }]),
    ],
  });
}

export function readout(shots: Shot[], pixel: [number, number] | null): HTMLElement {
  const out = h("dl", { class: "readout", id: "im-readout" });
  if (!pixel) {
    out.append(h("div", {}, h("dt", {}, "pixel"), h("dd", {}, "point at one for its values")));
    return out;
  }
  out.append(h("div", {}, h("dt", {}, "pixel"), h("dd", {}, `${pixel[0]}, ${pixel[1]}`)));
  for (const shot of shots) {
    if (!shot.layer || shot.layer.kind === "png") continue;
    const isError = shot.id === "ea" || shot.id === "eb";
    const values = valuesAt(isError ? shot.layer : { ...shot.layer, kind: "colour" }, ...pixel);
    const name = { r: "reference", a: "A", b: "B", ea: "error of A", eb: "error of B" }[shot.id];
    out.append(h("div", {}, h("dt", {}, name), h("dd", {}, values.map((v) => figure(v, 4)).join("  ") + (isError ? " %" : ""))));
  }
  return out;
}

function bar(label: string, stops: Parameters<typeof gradient>[0], ticks: [number, string][]): HTMLElement {
  const strip = h("div", { class: "ramp" });
  strip.style.background = gradient(stops);
  const marks = ticks.map(([at, text]) => {
    const mark = h("span", {}, text);
    mark.style.left = `${100 * at}%`;
    if (at === 0 || at === 1) mark.style.transform = `translateX(${-100 * at}%)`;
    return mark;
  });
  return h("div", { class: "legend" }, h("span", {}, label), h("div", {}, strip, h("div", { class: "ramp-ticks" }, ...marks)));
}

// What the colours on the screen mean.
export function legends(kinds: Set<Kind>, look: Look): HTMLElement[] {
  const out: HTMLElement[] = [];
  const percent = (v: number) => `${figure(100 * v)} %`;
  if (kinds.has("luminance")) {
    const ticks = [0, 0.25, 0.5, 0.75, 1].map((t): [number, string] => [t, figure(2 ** (STOPS.low + t * (STOPS.high - STOPS.low)) / look.exposure, 2)]);
    out.push(bar("luminance, W/m²/sr", INFERNO, ticks));
  }
  if (kinds.has("signed"))
    out.push(bar("error of luminance, too dark to too bright", SIGNED, [[0, `−${percent(look.range)}`], [0.5, "0"], [1, `+${percent(look.range)}`]]));
  if (kinds.has("smape")) out.push(bar("SMAPE of the pixel", INFERNO, [[0, "0"], [0.5, percent(look.range / 2)], [1, percent(look.range)]]));
  return out;
}
