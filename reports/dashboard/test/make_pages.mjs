// Makes the pages that the tests open, in $VSGLBENCH_DASHBOARD_PAGES, each as NAME.html with the report behind it in
// NAME/report.json: of committed reports, of one that is run here, and of made ones.
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const pages = process.env.VSGLBENCH_DASHBOARD_PAGES;
const program = process.env.VSGLBENCH_PROGRAM;
const source = process.env.VSGLBENCH_SOURCE_DIR;
if (!pages || !program || !source) {
  console.error("make_pages.mjs: set VSGLBENCH_DASHBOARD_PAGES, VSGLBENCH_PROGRAM and VSGLBENCH_SOURCE_DIR");
  process.exit(2);
}

const vsglbench = (...args) => {
  try {
    return execFileSync(program, args, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "pipe"] });
  } catch (e) {
    console.error(`vsglbench ${args.join(" ")}: exit code ${e.status}\n${e.stderr}`);
    process.exit(1);
  }
};
const read = (file) => JSON.parse(readFileSync(file, "utf8"));
const folder = (name) => {
  mkdirSync(join(pages, name), { recursive: true });
  return join(pages, name);
};
const write = (name, report) => writeFileSync(join(folder(name), "report.json"), JSON.stringify(report));
const page = (name, ...args) => console.log(vsglbench("dashboard", ...args, "--out", join(pages, `${name}.html`)).trim());

// Deterministic numbers in (0, 1): mulberry32.
const randoms = (seed) => () => {
  seed = (seed + 0x6d2b79f5) | 0;
  let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
  return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
};

// Every time of a timing, times a factor.
const scaleTiming = (timing, factor) => {
  for (const key of ["median_ms", "min_ms", "q1_ms", "q3_ms", "p95_ms"]) timing[key] *= factor;
  timing.ci95_ms = timing.ci95_ms.map((v) => v * factor);
  timing.samples_ms = timing.samples_ms.map((v) => v * factor);
};
const scaleCase = (c, factor) => {
  for (const pass of c.passes) scaleTiming(pass, factor);
  for (const key of ["span", "method"]) if (c.frame?.[key]) scaleTiming(c.frame[key], factor);
  for (const key of ["span_ms", "sum_ms", "unattributed_ms"]) if (c.frame) c.frame[key] *= factor;
  if (c.generate) {
    scaleTiming(c.generate.total, factor);
    c.generate.gbuffer_ms *= factor;
    c.generate.rsm_ms *= factor;
  }
};

// The report with samples that lie within 1.6 % of their median, however noisy the machine was that measured it.
const steadied = (report) => {
  const steady = (timing) => {
    const m = timing.median_ms, n = timing.samples_ms.length;
    timing.samples_ms = timing.samples_ms.map((_, i) => m * (1 + 0.016 * (n > 1 ? (2 * i) / (n - 1) - 1 : 0)));
    Object.assign(timing, { min_ms: 0.984 * m, q1_ms: 0.992 * m, q3_ms: 1.008 * m, p95_ms: 1.0144 * m, ci95_ms: [0.992 * m, 1.008 * m] });
  };
  for (const c of report.cases) {
    for (const timing of [...c.passes, c.frame?.span, c.frame?.method, c.generate?.total]) if (timing) steady(timing);
  }
  return report;
};

function committed() {
  for (const name of ["front", "flicker"]) {
    copyFileSync(join(source, `reports/${name}-lavapipe/report.json`), join(folder(name), "report.json"));
  }
  // The matrix' shape, at a cost of seconds.
  const stability = vsglbench("stability", "--method", "fis", "--method", "mfis", "--diffuse", "cosine", "--json");
  writeFileSync(join(folder("front"), "stability.json"), stability);
  copyFileSync(join(source, "reports/papers/lavapipe/papers.json"), join(folder("front"), "papers.json"));
  page("front", join(pages, "front"), "--papers", join(pages, "front/papers.json"), "--stability", join(pages, "front/stability.json"));
  page("flicker", join(pages, "flicker"));
  // Without images and errors: generation alone was measured.
  copyFileSync(join(source, "reports/mfis16-table1-lavapipe/report.json"), join(folder("generation"), "report.json"));
  page("generation", join(pages, "generation"));
}

// Two, the second with one case a tenth slower and other kernels.
function pair() {
  const base = steadied(read(join(source, "reports/gate-lavapipe/report.json")));
  write("pair-base", base);
  const now = structuredClone(base);
  now.kernels = "0".repeat(32);
  now.created = "2030-01-01T00:00:00Z";
  scaleCase(now.cases[0], 1.1);
  write("pair", now);
  page("pair", join(pages, "pair-base"), join(pages, "pair"));
}

// 300 reports with 0.4 % of noise: from the 181st the first case is 3 % slower, from the 241st another is 8 % faster,
// and a third creeps from the 61st to the 201st, 0.04 % a report. history/report.json is the newest;
// history/steps.json says which.
function history() {
  const base = steadied(read(join(source, "reports/gate-lavapipe/report.json")));
  const random = randoms(1);
  const steps = [
    { case: base.cases[0].id, report: 180, ratio: 1.03 },
    { case: base.cases[1].id, report: 240, ratio: 0.92 },
  ];
  const crept = { case: base.cases[2].id, from: 60, to: 200, ratio: 1.06 };
  for (const pair of base.aa) {
    for (const t of pair.times) Object.assign(t, { ratio: 1, ci95: [0.995, 1.005], noise_floor: 0.005 });
  }
  const files = [];
  for (let i = 0; i < 300; ++i) {
    const report = structuredClone(base);
    report.created = new Date(Date.UTC(2026, 0, 1 + i)).toISOString().replace(".000", "");
    report.git.commit = i.toString(16).padStart(40, "0");
    report.kernels = i.toString(16).padStart(32, "0");
    delete report.analysis;
    for (const c of report.cases) {
      const noise = 1 + 0.004 * (random() + random() + random() - 1.5);
      const step = steps.find((s) => s.case === c.id);
      const share = c.id === crept.case ? Math.min(1, Math.max(0, (i - crept.from) / (crept.to - crept.from))) : 0;
      scaleCase(c, noise * (step && i >= step.report ? step.ratio : 1) * crept.ratio ** share);
    }
    const name = `history-${String(i).padStart(3, "0")}`;
    write(join("history-reports", name), report);
    if (i === 299) write("history", report);
    files.push(join(pages, "history-reports", name));
  }
  writeFileSync(join(folder("history"), "steps.json"), JSON.stringify({ steps, crept }));
  page("history", ...files);
}

// Run here: small, with pictures that have values, and with the prices of effects.
function images() {
  const out = folder("images");
  rmSync(out, { recursive: true, force: true });
  const config = {
    name: "images",
    description: "two methods on a small frame, for the dashboard's tests",
    scenes: ["cornell"],
    methods: [{ method: "vpl" }, { method: "mfis" }],
    frame: { width: 64, height: 48 },
    rsm: 64,
    N: 64,
    importance_lights: 64,
    visibility: "none",
    seeds: 2,
    reference: { samples: 32 },
    timing: { min_samples: 3, max_samples: 3 },
    price_effects: 1,
  };
  const file = join(pages, "images-config.json");
  writeFileSync(file, JSON.stringify(config));
  vsglbench("-q", "run", file, "--out", out);
  page("images", out, "--case", "*");
}

// Run here: every part of an error budget, and one that lacks the case with exact visibility.
function budget() {
  const out = folder("budget");
  rmSync(out, { recursive: true, force: true });
  const config = {
    name: "budget",
    description: "every approximation by itself on a small frame, for the dashboard's tests",
    scenes: ["cornell"],
    methods: [
      { method: "all-texels", shading: ["exact", "vsgl16"], visibility: "none" },
      { method: "mfis", visibility: ["none", "exact", "ism"] },
      { method: "vpl", visibility: ["none", "ism"] },
    ],
    frame: { width: 64, height: 36 },
    rsm: 16,
    N: 32,
    importance_lights: 64,
    seeds: 2,
    reference: { samples: 64 },
    timing: { min_samples: 2, max_samples: 2 },
  };
  const file = join(pages, "budget-config.json");
  writeFileSync(file, JSON.stringify(config));
  vsglbench("-q", "run", file, "--out", out);
  page("budget", out, "--images", "none");
}

// More than 10,000 cases, from copies of those of the front's report under other values of N.
function large() {
  const report = read(join(source, "reports/front-lavapipe/report.json"));
  const random = randoms(2);
  const cases = [];
  for (let k = 0; k < 20; ++k) {
    for (const c of report.cases) {
      const copy = structuredClone(c);
      if (k > 0) {
        copy.id += `,copy=${k}`;
        copy.parameters.copy = k;
        scaleCase(copy, 0.5 + random());
        for (const key of ["smape", "rmse", "flip"]) {
          const m = copy.accuracy[key];
          const factor = 0.5 + 0.5 * random();
          m.value *= factor;
          m.ci95 = m.ci95?.map((v) => v * factor);
        }
      }
      cases.push(copy);
    }
  }
  report.cases = cases;
  delete report.analysis;
  write("large", report);
  page("large", join(pages, "large"));
}

const all = { committed, pair, history, images, budget, large };
const wanted = process.argv.slice(2);
mkdirSync(pages, { recursive: true });
for (const [name, make] of Object.entries(all)) {
  if (wanted.length === 0 || wanted.includes(name)) make();
}
