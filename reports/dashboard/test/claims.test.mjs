// The ledger of claims against papers.json of `vsglbench reproduce`.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, open } from "./harness.mjs";
import { made } from "./made.mjs";
import { assertSound } from "./sound.mjs";

after(close);

const papers = JSON.parse(readFileSync(join(process.env.VSGLBENCH_DASHBOARD_PAGES, "front/papers.json")));
const trials = papers.exhibits.flatMap((e) => e.trials ?? []);
const shown = (ruling) => (ruling === "in part" ? "holds in part" : ruling);

// The page of papers.json, whatever claims the page under test has.
const page = (options) => open(made("front", (d) => {
  d.claims = trials.map((t) => ({ claim: t.claim, text: t.text, source: t.source, how: t.how, exhibit: t.exhibit, place: t.place ?? "", metric: t.metric ?? "", ruling: shown(t.ruling),
                                  ratio: t.ratio ?? null, lo: t.ci95?.[0] ?? null, hi: t.ci95?.[1] ?? null, pairs: 0, why: t.figures ?? "" }));
  d.reports[0].claims = [];
}), options);

test("every claim is there, with what its trials come to", async () => {
  const p = await page({ hash: "v=claims" });
  const names = [...new Set(trials.map((t) => t.claim))];
  assert.equal(await p.locator(".claim").count(), names.length);
  for (const name of names) {
    const mine = trials.filter((t) => t.claim === name), has = (r) => mine.some((t) => t.ruling === r);
    const whole = has("in part") || (has("holds") && has("does not hold")) ? "holds in part" : ["holds", "does not hold", "undecided", "not run"].find(has);
    const text = await p.locator(`[id="claim-${name}"] summary`).textContent();
    assert.ok(text.includes(whole) && text.includes(mine[0].text) && text.includes(mine[0].source), text);
  }
  await assertSound(p);
});

test("an opened claim shows how it was tried, and each trial's ratio", async () => {
  const p = await page({ hash: "v=claims" });
  const name = "mfis-against-kmeans", mine = trials.filter((t) => t.claim === name);
  await p.locator(`[id="claim-${name}"] summary`).click();
  const claim = p.locator(`[id="claim-${name}"]`);
  assert.equal(await claim.locator(".how").first().textContent(), mine[0].how);
  const rows = await claim.locator("tbody tr").evaluateAll((trs) => trs.map((tr) => [...tr.cells].map((c) => c.textContent)));
  assert.equal(rows.length, mine.length);
  rows.forEach((cells, i) => {
    assert.deepEqual(cells.slice(0, 3), [mine[i].place, mine[i].metric, mine[i].exhibit]);
    assert.ok(cells[3].endsWith(shown(mine[i].ruling)));
    const [ratio, lo, hi] = cells[5].match(/[\d.]+/g).map(Number);
    [[ratio, mine[i].ratio], [lo, mine[i].ci95[0]], [hi, mine[i].ci95[1]]].forEach(([is, was]) => assert.ok(Math.abs(is / was - 1) < 0.006, `${is} for ${was}`));
  });
  // What is promised, below 0.143, is shaded from the left end to the rule at 0.143; all ratios lie right of it.
  const [shade, point] = await claim.locator("tbody tr svg").first().evaluate((s) => [s.querySelector(".promised").getBoundingClientRect().right, s.querySelector(".point").getBoundingClientRect().left]);
  assert.ok(shade < point);
  await assertSound(p);
});

test("a filter by ruling leaves those trials alone, and the URL holds it", async () => {
  const p = await page({ hash: "v=claims" });
  await p.getByLabel("Ruling of a trial").selectOption("does not hold");
  const lost = trials.filter((t) => t.ruling === "does not hold");
  assert.equal(await p.locator(".claim").count(), new Set(lost.map((t) => t.claim)).size);
  assert.match(await p.locator(".tablehead .count").last().textContent(), new RegExp(`^${lost.length} rows`));
  await p.reload();
  await p.waitForSelector(".claim");
  assert.equal(await p.locator(".claim").count(), new Set(lost.map((t) => t.claim)).size);
  await p.getByLabel("Source").selectOption("SGL22");
  assert.equal(await p.locator(".claim").count(), 0);
});

test("a filter hides trials, but a claim's ruling is of all of them", async () => {
  const p = await page({ hash: "v=claims" });
  const names = [...new Set(trials.map((t) => t.claim))];
  const chips = async () => Object.fromEntries(await Promise.all(names.map(async (n) => [n, (await p.locator(`[id="claim-${n}"] .ruling`).first().textContent({ timeout: 1000 }).catch(() => ""))])));
  const before = await chips();
  const mixed = names.filter((n) => new Set(trials.filter((t) => t.claim === n).map((t) => t.ruling)).size > 1);
  assert.ok(mixed.length > 0);
  await p.getByLabel("Ruling of a trial").selectOption("holds");
  for (const name of mixed.filter((n) => trials.some((t) => t.claim === n && t.ruling === "holds"))) {
    assert.equal(await p.locator(`[id="claim-${name}"] .ruling`).first().textContent(), before[name], name);
    assert.match(await p.locator(`[id="claim-${name}"] summary`).textContent(), new RegExp(`of ${trials.filter((t) => t.claim === name).length} trials`));
  }
});

test("words filter, too; dark and narrow are sound", async () => {
  const p = await page({ hash: "v=claims", dark: true, width: 400 });
  await p.getByLabel("Words").fill("splotches");
  const found = new Set(trials.filter((t) => Object.values(t).some((v) => String(v).includes("splotches"))).map((t) => t.claim));
  await p.locator(".rulings", { hasText: new RegExp(`^${found.size} claims?:`) }).waitFor();
  assert.equal(await p.locator(".claim").count(), found.size);
  await assertSound(p);
});
