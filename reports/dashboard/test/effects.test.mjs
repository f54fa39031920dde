// The ledger of effects against the report, and prices against those that were planted.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, report } from "./harness.mjs";
import { made } from "./made.mjs";
import { assertSound } from "./sound.mjs";

after(close);

test("every effect of every scene stands in its ledger, as the report has it", async () => {
  const page = await open("front", { hash: "v=effects" });
  for (const scene of report("front").scenes) {
    const ledger = page.locator("section.table", { has: page.locator("h3", { hasText: new RegExp(`^${scene.name}: `) }) });
    assert.match(await ledger.locator("h3").textContent(), new RegExp(`: ${scene.effects.filter((e) => e.needed).length} of ${scene.effects.length} effects`));
    const rows = await ledger.locator("tbody tr").evaluateAll((trs) => trs.map((tr) => [...tr.cells].map((c) => c.textContent)));
    assert.deepEqual(rows, scene.effects.map((e) => [e.name.replaceAll("_", " "), e.needed ? "● needed" : "○ skipped", e.reason, e.passes.join(", ")]));
  }
  await assertSound(page);
});

test("scenes stand beside each other", async () => {
  const page = await open("front", { hash: "v=effects" });
  const { scenes } = report("front");
  const rows = await page.locator(".effects-overview tbody tr").evaluateAll((trs) => trs.map((tr) => [...tr.cells].map((c) => c.textContent)));
  assert.deepEqual(rows, scenes[0].effects.map((e) => [e.name.replaceAll("_", " "), ...scenes.map((s) => (s.effects.find((k) => k.name === e.name).needed ? "● yes" : "○ no"))]));
});

test("prices have interval and memory, and the frame its ratio", async () => {
  const page = await open(made("front", (d) => {
    const [scene] = d.reports[0].scenes;
    scene.priced = { case: "cornell/mfis", ratio: 1.234, ratio_ci95: [1.2, 1.27] };
    Object.assign(scene.effects[2], { ms: 0.41, ms_ci95: [0.38, 0.44], bytes: 2_500_000 });
  }), { hash: "v=effects" });
  const ledger = page.locator("section.table.figures").first();
  assert.match(await ledger.textContent(), /With all effects a frame of cornell\/mfis takes 1\.23 \[1\.20 … 1\.27\] times as long/);
  const cells = await ledger.locator("tbody tr").nth(2).locator("th, td").allTextContents();
  assert.deepEqual(cells.slice(2, 6), ["+0.410", "0.380", "0.440", "2.50"]);
  assert.match(await ledger.locator("tbody tr").nth(2).locator("svg").getAttribute("aria-label"), /\+0\.410 ms \[0\.380 … 0\.440\]/);
  await assertSound(page);
});
