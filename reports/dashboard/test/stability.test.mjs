// The stability matrix, with cells that are known.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open } from "./harness.mjs";
import { made } from "./made.mjs";
import { assertSound } from "./sound.mjs";

after(close);

const cell = (name, method, diffuse, status, error, where = "", why = "no difference") => ({ case: name, method, diffuse, status, error, where, why });
const cells = [
  cell("gentle", "mfis", "cosine", "ok", 1e-6), cell("gentle", "mfis", "polynomial", "ok", 2e-6), cell("gentle", "vpl", "-", "ok", 0),
  cell("sharpness", "mfis", "cosine", "bias", 0.004, "light 3: variance", "light 3: variance: 0.25 instead of 0.249"), cell("sharpness", "mfis", "polynomial", "ok", 1e-5), cell("sharpness", "vpl", "-", "left out", 0),
  cell("mirror-half", "mfis", "cosine", "ok", 1e-6), cell("mirror-half", "mfis", "polynomial", "bad", "infinite", "pixel (3,1)", "pixel (3,1): NaN"), cell("mirror-half", "vpl", "-", "bad", 0.3, "light 0: flux", "light 0: flux: 2 instead of 1.4"),
];
const page = (options) => open(made("front", (d) => {
  d.stability = { counts: { ok: 5, bias: 1, bad: 2, "left out": 1 }, ok_error: 1e-3, bad_error: 0.05, cells };
}), { hash: "v=stability", ...options });

const rowsOf = (p) => p.locator(".matrix tbody tr").evaluateAll((trs) => trs.map((tr) => [...tr.cells].map((c) => c.textContent)));

test("failures come first, and a cell says how many diffuse models fail", async () => {
  const p = await page();
  assert.deepEqual(await rowsOf(p), [["mirror-half", "✗ bad 1 of 2", "✗ bad"], ["sharpness", "≈ bias 1 of 2", "– left out"], ["gentle", "✓ ok", "✓ ok"]]);
  assert.deepEqual(await p.locator(".counts .status").allTextContents(), ["✗ 2 bad", "≈ 1 bias", "✓ 5 ok", "– 1 left out"]);
  await p.getByLabel("Failures first").uncheck();
  assert.deepEqual((await rowsOf(p)).map((r) => r[0]), ["gentle", "sharpness", "mirror-half"]);
  await assertSound(p);
});

test("pointing at a cell, or going to it with the keys, shows where and why", async () => {
  const p = await page();
  await p.locator(".matrix td").first().hover();
  const text = await p.locator(".detail").innerText();
  assert.match(text, /mirror-half, mfis/);
  assert.match(text, /✗ bad, diffuse model polynomial: worst relative error infinite at pixel \(3,1\)\. NaN/);
  await p.locator(".matrix td").first().focus();
  await p.keyboard.press("ArrowRight");
  assert.match(await p.locator(".detail").innerText(), /mirror-half, vpl[\s\S]*0\.300 at light 0: flux\. 2 instead of 1\.4/);
  await p.keyboard.press("ArrowDown");
  assert.match(await p.locator(".detail").innerText(), /sharpness, vpl/);
});

test("filters by model, method and failure; the URL holds them", async () => {
  const p = await page();
  await p.getByLabel("Diffuse model").selectOption("cosine");
  assert.deepEqual(await rowsOf(p), [["mirror-half", "✓ ok", "✗ bad"], ["sharpness", "≈ bias", "– left out"], ["gentle", "✓ ok", "✓ ok"]]);
  await p.getByLabel("Only cases with a failure").check();
  assert.deepEqual((await rowsOf(p)).map((r) => r[0]), ["mirror-half", "sharpness"]);
  await p.reload();
  await p.waitForSelector(".matrix");
  assert.deepEqual((await rowsOf(p)).map((r) => r[0]), ["mirror-half", "sharpness"]);
  await p.getByLabel("Case or method").fill("nothing like it");
  await p.getByText("No case is left by these filters.").waitFor();
  assert.deepEqual(p.errors, []);
});

test("all cells stand in a table, the worst above; dark and narrow are sound", async () => {
  const p = await page({ dark: true, width: 400 });
  const rows = await p.locator("section.table tbody tr").evaluateAll((trs) => trs.map((tr) => [...tr.cells].map((c) => c.textContent)));
  assert.equal(rows.length, cells.length);
  assert.deepEqual(rows.slice(0, 3).map((r) => [r[0], r[4]]), [["mirror-half", "infinite"], ["mirror-half", "0.300"], ["sharpness", "0.00400"]]);
  await assertSound(p);
});

test("boxes are of the methods of the matrix alone", async () => {
  const p = await open("front", { hash: "v=stability" });
  assert.deepEqual(await p.locator(".methods .check").allTextContents(), ["fis", "mfis"]);
});
