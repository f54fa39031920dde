// Passes: bars, hover and table say what report.json says of each pass.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { casesOf, frontOf, passMs, sumOf } from "./figures.mjs";
import { axisOf, close, isFigure, numbers, open, report, rowsOf, saved, tipsAt } from "./harness.mjs";

after(close);
const front = report("front");
const group = front.analysis.groups[0];
const bySum = (cases) => [...cases].sort((a, b) => sumOf(a) - sumOf(b));
const shown = bySum(frontOf(casesOf(front, group)));

// Pieces of the bars, in the window.
const pieces = (page) => page.locator(".chart g.pieces rect").evaluateAll((all) => all.map((e) => {
  const b = e.getBoundingClientRect();
  return { left: b.x, width: b.width, x: b.x + b.width / 2, y: b.y + b.height / 2 };
}));
const look = async (hash = "", options = {}) => {
  const page = await open("front", { hash: "v=passes" + hash, ...options });
  await page.waitForSelector(".chart g.pieces rect");
  return page;
};

test("the table has the median of every pass, and their sum", async () => {
  const page = await look();
  const rows = await saved(page, "Medians of the passes");
  assert.equal(rows.length, shown.length);
  rows.forEach((row, i) => {
    assert.ok(row.case.startsWith(shown[i].method), `${row.case}: ${shown[i].id}`);
    assert.ok(Math.abs(Number(row["all passes (ms)"]) / sumOf(shown[i]) - 1) < 1e-6, shown[i].id);
    const passes = Object.fromEntries(Object.entries(row).filter(([k, v]) => k.endsWith(" (ms)") && k !== "all passes (ms)" && v !== "").map(([k, v]) => [k.slice(0, -5), Number(v)]));
    assert.deepEqual(Object.keys(passes).sort(), shown[i].passes.map((p) => p.name).sort());
    for (const p of shown[i].passes) assert.ok(Math.abs(passes[p.name] / passMs(p) - 1) < 1e-6, `${shown[i].id} ${p.name}`);
  });
  // In three digits on the screen.
  const first = (await rowsOf(page, "Medians of the passes"))[0];
  for (const p of shown[0].passes) assert.ok(isFigure(numbers(first[`${p.name}, ms`])[0], passMs(p)), `${p.name}: ${first[`${p.name}, ms`]}`);
  assert.deepEqual([page.errors, page.requests], [[], []]);
});

test("bars are as long as their passes on the axis, and tell them with their intervals", async () => {
  const page = await look();
  const x = await axisOf(page, ".chart", "x", "linear");
  const all = await pieces(page);
  assert.equal(all.length, shown.reduce((n, c) => n + c.passes.length, 0));
  const told = shown.flatMap((c) => {
    let at = 0;
    return c.passes.map((pass) => ({ c, pass, from: at, to: (at += passMs(pass)) }));
  });
  told.forEach(({ c, pass, from, to }, i) => {
    assert.ok(Math.abs(all[i].left - x(from)) < 2 && Math.abs(all[i].left + all[i].width - x(to)) < 2, `${c.id} ${pass.name}: ${all[i].left} to ${all[i].left + all[i].width}, not ${x(from)} to ${x(to)}`);
  });
  const wide = told.map((t, i) => ({ ...t, ...all[i] })).filter((t) => t.width > 4).slice(0, 12);
  assert.ok(wide.length > 6);
  (await tipsAt(page, wide.map((t) => [t.x, t.y]))).forEach((text, i) => {
    const { c, pass } = wide[i];
    const [name, figures, share] = text.split("\n");
    assert.equal(name, pass.name);
    [passMs(pass), ...pass.ci95_ms].forEach((exact, k) => assert.ok(isFigure(numbers(figures)[k] ?? numbers(figures)[0], exact), `${pass.name} ${figures}: ${exact}`));
    assert.ok(isFigure(numbers(share)[0], (100 * passMs(pass)) / sumOf(c)), `${share}: ${(100 * passMs(pass)) / sumOf(c)}`);
  });
});

test("as shares every bar is as long, and a cell is a pass over the sum", async () => {
  const page = await look();
  await page.getByLabel("as shares").check();
  await page.waitForSelector(".chart g.pieces rect");
  const rows = await saved(page, "Shares of the passes");
  rows.forEach((row, i) => shown[i].passes.forEach((p) => {
    assert.ok(Math.abs(Number(row[`${p.name} (%)`]) - (100 * passMs(p)) / sumOf(shown[i])) < 1e-4, `${shown[i].id} ${p.name}`);
  }));
  const x = await axisOf(page, ".chart", "x", "linear"), all = await pieces(page);
  let k = 0;
  for (const c of shown) {
    k += c.passes.length;
    assert.ok(Math.abs(all[k - 1].left + all[k - 1].width - x(100)) < 2, c.id);
  }
});

test("methods, time and choice of cases change which bars there are", async () => {
  const page = await look();
  const gone = shown.at(-1).method;
  await page.getByLabel(gone, { exact: true }).uncheck();
  const left = bySum(frontOf(casesOf(front, group).filter((c) => c.method !== gone)));
  const sums = async () => (await saved(page, "Medians of the passes")).map((r) => Number(r["all passes (ms)"]));
  const same = (got, wanted) => {
    assert.equal(got.length, wanted.length);
    got.forEach((v, i) => assert.ok(Math.abs(v / sumOf(wanted[i]) - 1) < 1e-6, `${v}: ${wanted[i].id}`));
  };
  same(await sums(), left);
  await page.getByRole("button", { name: "All", exact: true }).click();
  await page.locator("#time").selectOption("frame");
  await page.locator("#metric").selectOption("rmse");
  same(await sums(), bySum(frontOf(casesOf(front, group), "rmse", "frame")));
  await page.locator("#pa-of").selectOption("all");
  same(await sums(), bySum(casesOf(front, group)));
  assert.match(await page.locator(".note").first().textContent(), new RegExp(`The 40 fastest of ${group.points} cases`));
});

test("arrow keys read the pieces; a tap's reading stays until the next", async () => {
  const page = await look();
  await page.locator(".chart").focus();
  await page.keyboard.press("ArrowRight");
  assert.ok((await page.locator(".tip").innerText()).startsWith(shown[0].passes[0].name));
  await page.keyboard.press("Escape");
  const touch = (type, place) => page.evaluate(([kind, [clientX, clientY]]) => {
    document.elementFromPoint(clientX, clientY).dispatchEvent(new PointerEvent(kind, { bubbles: kind !== "pointerleave", pointerType: "touch", pointerId: 7, isPrimary: true, clientX, clientY }));
    if (kind === "pointerup") document.querySelector(".chart").dispatchEvent(new PointerEvent("pointerleave", { pointerType: "touch", pointerId: 7 }));
  }, [type, place]);
  const all = await pieces(page), widest = all.indexOf(all.reduce((a, b) => (a.width > b.width && a.y < 800 ? a : b)));
  const at = [all[widest].x, all[widest].y];
  await touch("pointerdown", at);
  await touch("pointerup", at);
  assert.equal(await page.locator(".tip").isVisible(), true);
  const heading = await page.locator("h1").boundingBox();
  await touch("pointerdown", [heading.x + 4, heading.y + 4]);
  assert.equal(await page.locator(".tip").isVisible(), false);
});
