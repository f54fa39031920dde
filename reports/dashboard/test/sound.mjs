// What every view must be, whatever it shows: no error, nothing asked of the network, no serious fault for who can't see or point.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

// Serious faults of the page as it is, a line each. `rules`: those alone; all by default.
export async function faults(page, rules) {
  if (!(await page.evaluate(() => "axe" in globalThis))) await page.evaluate(axe);
  const { violations } = await page.evaluate((only) => globalThis.axe.run(document, { resultTypes: ["violations"], ...(only ? { runOnly: { type: "rule", values: only } } : {}) }), rules);
  const serious = violations.filter((v) => v.impact === "serious" || v.impact === "critical");
  return serious.flatMap((v) => v.nodes.slice(0, 3).map((n) => `${v.id}: ${n.html.slice(0, 160)} ${n.failureSummary.split("\n").slice(0, 3).join(" ")}`));
}

export async function assertSound(page, rules) {
  assert.deepEqual(await faults(page, rules), []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true, "the page is wider than its window");
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.requests, []);
}
