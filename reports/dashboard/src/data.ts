// What the page shows: made by `vsglbench dashboard` (harness/dashboard/), a zlib stream in base64 in the
// element #data. Numbers have seven significant digits. Times are in ms, errors in their metric's unit.

// A column of numbers and both ends of its 95 % intervals; null where a case has none.
export interface Estimates {
  value: (number | null)[];
  lo: (number | null)[];
  hi: (number | null)[];
}

export interface Metric {
  name: string; // "smape", as reports have it
  title: string; // "SMAPE"
  unit: string; // " %" or ""
}

// Cases that can be compared: of one scene, and one reference.
export interface Group {
  scene: number; // index in scenes
  visibility: "none" | "full";
  reference: string; // its hash
  noise: Record<string, number>; // by time: the A/A pair's floor, relative; absent: not known
  floor: Record<string, number>; // by metric: the error of an exact image, from the reference's noise
}

export interface Effect {
  name: string;
  needed: boolean;
  reason: string;
  passes: string[];
  ms: number | null; // priced; null: not
  ms_ci95: [number, number] | null;
  bytes: number | null;
}

export interface Scene {
  name: string;
  hash: string;
  triangles: number;
  exposure: number; // that the scene's images are shown with
  warnings: string[];
  notes: string[];
  effects: Effect[];
  priced: { case: string; ratio: number; ratio_ci95: [number, number] } | null; // frame with all effects over the case's
}

// Of a case, an entry a pass. Large pages consist of these: the ends of an interval are whole ten-thousandths of the median.
export interface Passes {
  pass: number[]; // index in Report.passes
  ms: number[]; // the median
  below: number[]; // its 95 % interval reaches so far below
  above: number[];
}

// One entry a case in every column.
export interface Cases {
  id: string[];
  label: string[]; // method and what distinguishes it from its neighbours: "mfis N=256"
  group: number[]; // index in groups; -1: no error
  scene: number[];
  method: number[];
  status: string[]; // "ok", or the kind of failure
  message: string[]; // why, where not ok
  parameters: Record<string, (string | number | null)[]>; // by key; null: the case has no such key
  times: Record<string, Estimates>; // by name of Report.times; medians over frames
  errors: Record<string, Estimates & { heavy: (0 | 1)[]; seeds: (number[] | null)[] }>; // by metric
  extra: Record<string, (number | null)[]>; // by name of Report.extra
  passes: Passes[]; // of each case
}

export interface BudgetPart {
  name: string; // "SG lobes"
  case: number; // index that has this error; -1: none
  missing: string; // what would have to be run; empty: there
  error: [number, number, number] | null; // value, and its interval
  increment: number | null; // over the nearest part above that is there
}

// All pairs of one method that differ in a knob alone, added up.
export interface PairSums {
  method: string;
  pairs: number;
  error: number; // of ln(after / before)
  times: Record<string, number>; // the same, of each time that all pairs have
  passes: Record<string, number>; // that pay, by the pairs in which they do; "": none does
}

export interface Knob {
  group: number;
  metric: string;
  key: string;
  methods: PairSums[];
  // the first pairs, from one value to the next; ms is of the method's time
  prices: { from: string; to: string; before: number; after: number; error: number; ms: number; pass: string; pass_ms: number }[];
}

export interface Temporal {
  case: number;
  derivative: Flicker | null;
  static: Flicker | null;
  detail: { value: number; lo: number; hi: number; gain: number } | null;
  noise_floor: number | null; // of derivative: the references' own noise
  unlit: number | null; // derivative of a black image
  profile: number; // index in Digest.images: -1: none
  worst: number; // the worst crop over time
}

export interface Flicker {
  value: number;
  lo: number;
  hi: number;
  p99: number;
  worst_frame: number; // index of the later frame; of static, a seed
  series: number[]; // of derivative: between frames; of static: per seed
}

export interface Report {
  file: string;
  name: string; // of its config
  description: string;
  measure: "frame" | "generation";
  created: string; // ISO 8601, UTC
  commit: string; // empty: not known
  dirty: boolean;
  complete: boolean;
  command: string;
  device: string;
  device_type: string;
  driver: string;
  host: string;
  width: number;
  height: number;
  wall_s: number;
  settings: Record<string, string>; // shared by all cases
  scenes: Scene[];
  methods: string[];
  metrics: Metric[];
  times: { name: string; words: string }[]; // "method", "all passes but the raster of the two halves"
  passes: string[]; // "generate.rsm.sort", in the frame's order
  extra: { name: string; unit: string; words: string }[]; // "lights", "memory_bytes", …
  groups: Group[];
  cases: Cases;
  budgets: { case: number; metric: string; parts: BudgetPart[]; flux_lost: number | null }[];
  knobs: Knob[];
  temporal: Temporal[];
  claims: Claim[];
}

export interface Claim {
  claim: string;
  text: string;
  source: string; // "[MFIS16 §5]"
  how: string;
  exhibit: string; // empty: tried on this report alone
  place: string; // scene
  metric: string;
  ruling: string; // "holds", "holds in part", "does not hold", "undecided", "not run"
  ratio: number | null;
  lo: number | null;
  hi: number | null;
  pairs: number;
  why: string;
}

// A picture in the page. An EXR has half floats, channels R, G, B and, where it is known, A: 1 where a surface is; a PNG was tone-mapped with the scene's exposure.
export interface Image {
  report: number; // index in Digest.reports
  scene: number;
  case: number; // index of the case; -1: the group's reference, or a picture of the scene
  group: number; // -1: none
  kind: "indirect" | "reference" | "profile" | "flicker";
  format: "exr" | "png";
  width: number;
  height: number;
  element: string; // id of the element that holds it in base64
}

export interface Change {
  report: number; // index in History.reports: what changed from the one before
  series: number; // index in History.series
  column: string; // a time, or a metric
  change: "faster" | "slower" | "better" | "worse";
  ratio: number; // now over before
  lo: number;
  hi: number;
  until: number | null; // of what crept, with no step that shows it: from a quarter of the change, in `report`, to three quarters
  persistent: boolean; // every report since is as much beyond the noise, on the same side; so is what crept
}

export interface History {
  reports: { file: string; name: string; created: string; commit: string; dirty: boolean; device: string; refusal: string }[]; // in order; refusal: why it was not compared with the one before
  columns: { name: string; title: string; unit: string; time: boolean }[];
  series: { id: string; scene: string; method: string; label: string; values: Record<string, Estimates>; noise: Record<string, number> }[]; // values: one entry a report; noise: by time, relative
  changes: Change[];
}

export interface Comparison {
  base: number;
  now: number; // indices in Digest.reports
  refusal: string;
  exit_code: number;
  summary: string; // the text of `vsglbench compare`
  // method: "", where it is over all of them
  rows: { case: string; method: string; what: string; base: number | null; now: number | null; ratio: number; lo: number; hi: number; noise: number | null; change: string }[];
}

export interface Stability {
  ok_error: number;
  bad_error: number;
  cells: { case: string; method: string; diffuse: string; status: "ok" | "bias" | "bad" | "left out"; error: number | "infinite"; where: string; why: string }[];
}

export interface Digest {
  schema: "vsglbench.dashboard/1";
  created: string;
  commit: string; // of the programme
  reports: Report[]; // one, or two: the base first; of a history the newest
  comparison: Comparison | null;
  history: History | null;
  stability: Stability | null;
  claims: Claim[]; // of papers.json: what `reproduce` found
  images: Image[];
  notes: string[]; // what a reader must know of how the page was made
}

export function bytesOf(element: string): Uint8Array<ArrayBuffer> {
  const text = atob(document.getElementById(element)?.textContent?.trim() ?? "");
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Handed over and taken back in the page itself: a Blob's or a Response's stream would go by way of another process.
export async function readDigest(): Promise<Digest> {
  const inflate = new DecompressionStream("deflate"), decoder = new TextDecoder(), input = inflate.writable.getWriter();
  const written = input.write(bytesOf("data")).then(() => input.close());
  let text = "";
  for (const output = inflate.readable.getReader(); ; ) {
    const { value, done } = await output.read();
    if (done) break;
    text += decoder.decode(value, { stream: true });
  }
  await written;
  return JSON.parse(text);
}
