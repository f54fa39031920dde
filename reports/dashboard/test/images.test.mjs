// The image view against the EXR files of the report: colours on the screen, figures, divider, keys, the URL.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, test } from "node:test";
import { decode, encode, encodeSrgb, expected, looked, luminance, readPicture, signedError } from "./exr.mjs";
import { close, open, report } from "./harness.mjs";
import { digestOf, made } from "./made.mjs";
import { assertSound } from "./sound.mjs";

const told = report("images");
// Two cases of one scene and reference.
const first = told.cases.findIndex((c) => c.images?.indirect);
const second = told.cases.findIndex((c, i) => i > first && c.images?.indirect && c.images.reference === told.cases[first].images.reference && c.method !== told.cases[first].method);
const [caseA, caseB] = [told.cases[first], told.cases[second]];
const exposure = told.scenes.find((s) => s.name === caseA.scene).exposure;
const r = readPicture(caseA.images.reference);
const a = readPicture(caseA.images.indirect);
const b = readPicture(caseB.images.indirect);
const [width, height] = [r.width, r.height];
const chosen = `v=images&c=${first},${second}`;

after(close);

async function look(hash = "", options = {}) {
  const page = await open("images", { hash: chosen + hash, ...options });
  await page.waitForSelector("#im-body[data-ready]");
  return page;
}
function clean(page) {
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.requests, []);
}
const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
// The page writes it a quarter of a second after a change.
// By the page's own clock, which stands still while a busy machine draws.
const written = async (page) => {
  await page.evaluate(() => new Promise((done) => setTimeout(done, 400)));
  await settle(page);
};
const state = async (page, key) => {
  await written(page);
  return page.evaluate((k) => new URLSearchParams(location.hash.slice(1)).get(k), key);
};
const number = (text) => Number(text.replace("−", "-").replace("e−", "e-").replace(/[ %]/g, ""));
const near = (got, want, share, least = 0, what = "") => assert.ok(Math.abs(got - want) <= share * Math.abs(want) + least, `${what}: ${got}, not ${want}`);

// Where the middle of a pixel is in the stage, of the whole picture in one pane.
async function placeOf(page, x, y) {
  const box = await page.locator(".stage").boundingBox();
  const zoom = Math.min(box.width / width, box.height / height);
  return [box.width / 2 + (x + 0.5 - width / 2) * zoom, box.height / 2 + (y + 0.5 - height / 2) * zoom, box];
}
async function point(page, x, y) {
  const [left, top, box] = await placeOf(page, x, y);
  await page.mouse.move(box.x + left, box.y + top);
}
// Pixels away from labels, handles and each other: a raster over the picture, corners of it too.
const raster = [];
for (const v of [0.15, 0.3, 0.62, 0.8, 0.99]) for (const u of [0.03, 0.2, 0.35, 0.7, 0.9, 0.99]) raster.push([Math.floor(u * width), Math.floor(v * height)]);
const shown = (pixel, stops = 0) => pixel.slice(0, 3).map((v) => encodeSrgb(exposure * 2 ** stops * v));
function sameColours(screen, places, wanted, what) {
  places.forEach(([left, top], i) => {
    const got = screen(left, top);
    wanted[i].forEach((v, c) => assert.ok(Math.abs(got[c] - v) <= 3, `${what}, pixel ${raster[i]}: ${got}, not ${wanted[i]}`));
  });
}
async function places(page) {
  const out = [];
  for (const [x, y] of raster) out.push(await placeOf(page, x, y));
  return out;
}
// Rows of the statistics as the CSV has them, every digit.
async function statistics(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#im-body .table button[aria-label^='Save as CSV']").click()]);
  const lines = readFileSync(await download.path(), "utf8").trim().split("\r\n");
  const cells = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map((m) => m[1].replace(/^"|"$/g, ""));
  return { caption: await page.locator("#im-body .table h3").textContent(), rows: lines.slice(1).map((l) => cells(l)) };
}
// What the page holds of a picture of the report: half floats.
async function embedded(page) {
  const list = await page.evaluate(() => [...document.querySelectorAll("script[type='text/plain']")].filter((e) => e.id !== "data").map((e) => e.textContent.trim()));
  return list.map((t) => Buffer.from(t, "base64")).filter((bytes) => bytes.readUInt32LE(0) === 20000630).map(decode);
}
const isRounded = (x, file) => x.width === file.width && x.height === file.height && x.rows.every((row, v) => row.every((p, u) => p.slice(0, 3).every((n, c) => Math.abs(n - file.rows[v][u][c]) <= Math.abs(n) / 1024 + 1e-7)));

test("the reference stands upright in the colours of the exported PNG", async () => {
  const page = await look("&im.l=one");
  sameColours(await looked(page), await places(page), raster.map(([x, y]) => shown(r.rows[y][x])), "reference");
  assert.equal(await page.locator(".stage-label").textContent(), "reference");
  clean(page);
});

test("flip by number and arrow keys", async () => {
  const page = await look("&im.l=one");
  await page.locator(".stage").focus();
  await page.keyboard.press("2");
  await settle(page);
  sameColours(await looked(page), await places(page), raster.map(([x, y]) => shown(a.rows[y][x])), "A");
  assert.match(await page.locator(".stage-label").textContent(), /^A: /);
  await page.keyboard.press("ArrowRight");
  await settle(page);
  sameColours(await looked(page), await places(page), raster.map(([x, y]) => shown(b.rows[y][x])), "B");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.locator(".stage-label").textContent(), "error of A");
  await page.keyboard.press("5");
  assert.equal(await page.locator(".stage-label").textContent(), "error of B");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.locator(".stage-label").textContent(), "reference");
  clean(page);
});

test("e and E change the exposure", async () => {
  const page = await look("&im.l=one");
  await page.locator(".stage").focus();
  for (const key of ["e", "e", "e", "E"]) await page.keyboard.press(key);
  await settle(page);
  assert.equal(await page.locator("#im-exposure").inputValue(), "1");
  assert.equal(await state(page, "im.ex"), "1");
  sameColours(await looked(page), await places(page), raster.map(([x, y]) => shown(r.rows[y][x], 1)), "a stop brighter");
  await page.locator("#im-exposure").focus();
  await page.keyboard.press("ArrowLeft");
  assert.equal(await state(page, "im.ex"), "0.75");
  clean(page);
});

test("the divider moves in any direction, turns, and obeys keys", async () => {
  const page = await look();
  const at = await places(page);
  const sides = async (isSecond, what) => {
    await page.mouse.move(2, 2);
    await settle(page);
    const wanted = raster.map(([x, y], i) => (isSecond(at[i]) ? shown(a.rows[y][x]) : shown(r.rows[y][x])));
    const screen = await looked(page);
    // The line and its handles hide what is below.
    const free = at.map(([l, t]) => !isSecond([l - 16, t - 16]) === !isSecond([l + 16, t + 16]) && !isSecond([l + 16, t - 16]) === !isSecond([l - 16, t + 16]));
    sameColours(screen, at.map((p, i) => (free[i] ? p : null)).filter((p) => p), wanted.filter((_, i) => free[i]), what);
    assert.ok(free.some((f, i) => f && isSecond(at[i])) && free.some((f, i) => f && !isSecond(at[i])), `${what}: both sides seen`);
  };
  await sides(([l]) => l >= at[0][2].width / 2, "in the middle");
  const box = await page.locator(".stage").boundingBox(); // after the page has scrolled for a screenshot
  // Taken beside its handle, dragged to a place that is elsewhere in both directions.
  const to = [0.27 * box.width, 0.41 * box.height];
  await page.mouse.move(box.x + box.width / 2 + 2, box.y + 0.2 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 0.3 * box.height);
  await page.mouse.move(box.x + to[0], box.y + to[1]);
  await page.mouse.up();
  await sides(([l]) => l >= to[0], "dragged");
  const [x, y, angle] = (await state(page, "im.d")).split(",").map(Number);
  near(x, 27, 0, 0.3, "across"), near(y, 41, 0, 0.3, "down");
  assert.equal(angle, 0);
  // Turned until the second side is below.
  await page.locator(".stage-knob").focus();
  for (let i = 0; i < 6; ++i) await page.keyboard.press("Shift+ArrowRight");
  assert.equal((await state(page, "im.d")).split(",")[2], "90");
  await sides(([, t]) => t >= to[1], "turned");
  await page.locator(".stage-handle").focus();
  await page.keyboard.press("Shift+ArrowDown");
  await sides(([, t]) => t >= to[1] + 0.1 * box.height, "by key");
  // The knob, by mouse: back upright.
  const handle = await page.locator(".stage-handle").boundingBox();
  const knob = await page.locator(".stage-knob").boundingBox();
  await page.mouse.move(knob.x + knob.width / 2, knob.y + knob.height / 2);
  await page.mouse.down();
  await page.mouse.move(handle.x + handle.width / 2, handle.y + handle.height / 2 + 50);
  await page.mouse.up();
  near(Number((await state(page, "im.d")).split(",")[2]), 0, 0, 2, "angle");
  clean(page);
});

test("statistics of a dragged rectangle are those of the EXR", async () => {
  const page = await look("&im.l=one");
  const part = { x: Math.floor(0.3 * width), y: Math.floor(0.25 * height), width: Math.floor(0.4 * width), height: Math.floor(0.35 * height) };
  await page.keyboard.down("Shift");
  await point(page, part.x, part.y);
  await page.mouse.down();
  await point(page, part.x + 3, part.y + 2);
  await point(page, part.x + part.width - 1, part.y + part.height - 1);
  await page.mouse.up();
  await page.keyboard.up("Shift");
  assert.equal(await state(page, "im.s"), [part.x, part.y, part.width, part.height].join(","));
  const found = await statistics(page);
  assert.equal(found.caption, `Rectangle at (${part.x}, ${part.y}), ${part.width} × ${part.height} px`);
  const halves = await embedded(page);
  const half = (file) => halves.find((h) => isRounded(h, file)) ?? assert.fail("the page has no such EXR");
  const reference = half(r);
  [r, a, b].forEach((file, i) => {
    const [name, ...cells] = found.rows[i];
    const values = cells.map(number);
    // To every digit those of the half floats; to their rounding those of the report's file.
    const exact = expected(half(file), reference, part, reference.covered);
    const whole = expected(file, r, part, reference.covered);
    for (const [want, share, least] of [[exact, 1e-9, 1e-12], [whole, 1e-3, 1e-6]]) {
      want.mean.forEach((m, c) => near(values[c], m, share, least, `${name}: mean of channel ${c}`));
      if (i === 0) continue;
      near(values[3], want.smape, share, least === 1e-6 ? 0.05 : 1e-9, `${name}: SMAPE`);
      near(values[4], want.rmse, share, least, `${name}: RMSE`);
    }
  });
  // What is shown is what is saved, in four digits.
  const text = await page.locator("#im-body .table tbody tr").nth(1).locator("td").allTextContents();
  text.forEach((t, i) => near(number(t), number(found.rows[1][i + 1]), 6e-4, 0, "shown"));
  clean(page);
});

test("the whole picture has the report's SMAPE of its seed", async () => {
  const page = await look();
  const { caption, rows } = await statistics(page);
  assert.equal(caption, `Whole picture, ${width} × ${height} px`);
  const halves = await embedded(page);
  const masked = (halves.find((h) => isRounded(h, r)) ?? assert.fail("the page has no reference")).covered;
  [[a, caseA], [b, caseB]].forEach(([file, told], i) => {
    const want = expected(file, r, { x: 0, y: 0, width, height }, masked);
    near(number(rows[i + 1][4]), want.smape, 1e-3, 0.05, told.id);
    near(number(rows[i + 1][5]), want.rmse, 1e-3, 0, told.id);
    // The report's own figure, where it is of these pictures.
    const seed = told.seeds?.[0]?.smape;
    const counted = expected(file, r, { x: 0, y: 0, width, height }, true).smape;
    if (masked && seed !== undefined && Math.abs(counted - seed) < 1e-3) {
      near(number(rows[i + 1][4]), seed, 1e-3, 0.05, "the report's");
      near(number(rows[i + 1][6]), seed, 1e-6, 0, "said of the report");
    }
  });
  clean(page);
});

test("a pixel that is no number is told and never averaged away, nor kept from parts without it", async () => {
  const rows = a.rows.map((row) => row.map((p) => [...p]));
  const [x, y] = [Math.floor(0.5 * width), Math.floor(0.5 * height)];
  rows[y][x][1] = Infinity; // of which a difference squared would stay Inf, no NaN
  const { element } = digestOf("images").images.find((i) => i.kind === "indirect" && i.case === first);
  const name = made("images", () => {}, { [element]: encode({ width, height, rows }) });
  const figures = async (part) => {
    const page = await open(name, { hash: `${chosen}&im.l=one&im.s=${part.join(",")}` });
    await page.waitForSelector("#im-body[data-ready]");
    const found = await statistics(page);
    clean(page);
    return { note: (await page.locator("#im-body .table .note").allTextContents()).join(), rows: found.rows.map((r) => r.slice(1, 6).map(Number)) };
  };
  const hit = await figures([x - 2, y - 2, 5, 5]);
  assert.match(hit.note, /1 pixels hold a NaN or Inf: there is no error/);
  assert.ok(Number.isNaN(hit.rows[1][3]) && Number.isNaN(hit.rows[1][4]), `${hit.rows[1]}`);
  assert.ok(hit.rows[2][3] > 0, "B has none");
  const part = [x + 1, y + 1, 6, 5], clear = await figures(part);
  const want = expected(a, r, { x: part[0], y: part[1], width: part[2], height: part[3] }, r.covered);
  near(clear.rows[1][3], want.smape, 1e-3, 0.05, "SMAPE beside it");
  assert.doesNotMatch(clear.note, /NaN/);
});

test("a rectangle by keys", async () => {
  const page = await look("&im.l=one");
  await page.locator(".stage").focus();
  await page.keyboard.press("r");
  const part = [width >> 2, height >> 2, width >> 1, height >> 1];
  assert.equal(await state(page, "im.s"), part.join(","));
  for (const key of ["ArrowRight", "ArrowDown", "ArrowDown", "Shift+ArrowLeft", "Shift+ArrowUp"]) await page.keyboard.press(key);
  assert.equal(await state(page, "im.s"), [part[0] + 1, part[1] + 2, part[2] - 1, part[3] - 1].join(","));
  await page.keyboard.press("Escape");
  assert.equal(await state(page, "im.s"), null);
  clean(page);
});

test("zoom to pixels with their values", async () => {
  const page = await look("&im.l=one");
  const spot = [Math.floor(0.6 * width), Math.floor(0.4 * height)];
  await point(page, ...spot);
  const read = async () => Object.fromEntries(await page.locator("#im-readout div").evaluateAll((all) => all.map((e) => [e.querySelector("dt").textContent, e.querySelector("dd").textContent])));
  await settle(page);
  const found = await read();
  assert.equal(found.pixel, `${spot[0]}, ${spot[1]}`);
  for (const [name, file] of [["reference", r], ["A", a], ["B", b]])
    found[name].split(/\s+/).forEach((t, c) => near(number(t), file.rows[spot[1]][spot[0]][c], 1.5e-3, 1e-6, `${name} channel ${c}`));
  near(number(found["error of A"]), 100 * signedError(a.rows[spot[1]][spot[0]], r.rows[spot[1]][spot[0]]), 5e-3, 0.2, "error of A");
  const printed = () => page.evaluate(() => {
    const canvas = document.querySelectorAll(".stage canvas")[1];
    const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    let count = 0;
    for (let i = 3; i < data.length; i += 4) count += data[i] > 0 ? 1 : 0;
    return count / (canvas.width * canvas.height);
  });
  assert.ok((await printed()) < 0.01, "no values while pixels are small");
  for (let i = 0; i < 8; ++i) await page.mouse.wheel(0, -240);
  await settle(page);
  assert.ok(Number((await state(page, "im.z")).split(",")[0]) >= 44, "zoomed");
  // What was under the pointer has stayed there, and figures stand in the pixels.
  await settle(page);
  assert.equal((await read()).pixel, `${spot[0]}, ${spot[1]}`);
  assert.ok((await printed()) > 0.03, "values are printed");
  await page.locator("#im-fit").click();
  assert.equal(await state(page, "im.z"), null);
  await page.locator("#im-in").click();
  assert.ok(await state(page, "im.z"));
  clean(page);
});

test("error maps are red where it is too bright, blue where it is too dark", async () => {
  const page = await look("&im.l=one&im.p=ea&im.er=0.2");
  const screen = await looked(page);
  const counts = [0, 0];
  for (const [i, place] of (await places(page)).entries()) {
    const [x, y] = raster[i];
    if (r.rows[y][x][3] === 0) continue;
    const error = signedError(a.rows[y][x], r.rows[y][x]);
    const [red, , blue] = screen(place[0], place[1]);
    if (Math.abs(error) < 0.03) continue;
    counts[error > 0 ? 0 : 1] += 1;
    assert.ok(error > 0 ? red > blue : blue > red, `pixel ${raster[i]}: error ${error}, red ${red}, blue ${blue}`);
  }
  assert.ok(counts[0] + counts[1] > 3, "errors were seen");
  // SMAPE of the pixel is brighter where it is larger.
  await page.locator("#im-error").selectOption("smape");
  await page.locator("#im-range").selectOption("2");
  await settle(page);
  const smape = await looked(page);
  const seen = [];
  for (const [i, place] of (await places(page)).entries()) {
    const [x, y] = raster[i];
    if (r.rows[y][x][3] === 0) continue;
    seen.push([expected(a, r, { x, y, width: 1, height: 1 }, false).smape, luminance(smape(place[0], place[1]).map((v) => (v / 255) ** 2.2))]);
  }
  seen.sort((p, q) => p[0] - q[0]);
  seen.slice(1).forEach((p, i) => assert.ok(p[0] - seen[i][0] < 2 || p[1] >= seen[i][1], `SMAPE ${p[0]} is darker than ${seen[i][0]}`));
  clean(page);
});

test("false colours grow with luminance, and have a legend", async () => {
  const page = await look("&im.l=one");
  assert.equal(await page.locator(".legend").count(), 0);
  await page.locator("#im-false").check();
  await settle(page);
  assert.match(await page.locator(".legend").textContent(), /luminance, W\/m²\/sr/);
  // Ends of the scale: 2^-8 and 4 over the exposure.
  const ticks = await page.locator(".ramp-ticks span").allTextContents();
  near(number(ticks[0]), 2 ** -8 / exposure, 0.05, 0, "lower end"), near(number(ticks.at(-1)), 4 / exposure, 0.05, 0, "upper end");
  const screen = await looked(page);
  const seen = (await places(page)).map((p, i) => [luminance(r.rows[raster[i][1]][raster[i][0]]), luminance(screen(p[0], p[1]).map((v) => (v / 255) ** 2.2))]);
  seen.sort((p, q) => p[0] - q[0]);
  seen.slice(1).forEach((p, i) => assert.ok(p[0] < 1.1 * seen[i][0] || p[1] >= seen[i][1], `luminance ${p[0]} is darker than ${seen[i][0]}`));
  assert.ok(seen.at(-1)[1] > seen[0][1] + 0.02);
  clean(page);
});

test("side by side, all panes show the same pixels", async () => {
  const page = await look(`&im.l=all&im.z=8,${(0.5 * width).toFixed(2)},${(0.4 * height).toFixed(2)}`);
  assert.deepEqual((await page.locator(".stage-label").allTextContents()).map((t) => t.replace(/:.*/, "")), ["reference", "A", "B", "error of A", "error of B"]);
  const box = await page.locator(".stage").boundingBox();
  const paneWidth = (box.width - 4) / 3, paneHeight = (box.height - 2) / 2;
  const pixelUnder = async (column, row) => {
    await page.mouse.move(box.x + column * (paneWidth + 2) + 0.6 * paneWidth, box.y + row * (paneHeight + 2) + 0.6 * paneHeight);
    await settle(page);
    return (await page.locator("#im-readout dd").first().textContent()).split(", ").map(Number);
  };
  const [x, y] = await pixelUnder(0, 0);
  near(x, Math.floor(0.5 * width + (0.1 * paneWidth) / 8), 0, 1, "x"), near(y, Math.floor(0.4 * height + (0.1 * paneHeight) / 8), 0, 1, "y");
  for (const [column, row] of [[1, 0], [2, 0], [1, 1], [2, 1]]) (await pixelUnder(column, row)).forEach((v, i) => near(v, [x, y][i], 0, 1, `pane ${column}, ${row}`));
  // A drag in one pans all; the error map still stands under its image.
  await page.mouse.move(box.x + 0.5 * paneWidth, box.y + 0.5 * paneHeight);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * paneWidth + 40, box.y + 0.5 * paneHeight - 16, { steps: 2 });
  await page.mouse.up();
  const [, cx, cy] = (await state(page, "im.z")).split(",").map(Number);
  near(cx, 0.5 * width - 5, 0, 0.1, "panned across"), near(cy, 0.4 * height + 2, 0, 0.1, "panned down");
  clean(page);
});

test("the URL restores what was chosen", async () => {
  const page = await look();
  await page.locator("#im-right").selectOption("b");
  await page.locator("#im-false").check();
  await page.locator("#im-error").selectOption("smape");
  await page.locator(".stage").focus();
  for (const key of ["e", "+", "+"]) await page.keyboard.press(key);
  await settle(page);
  const before = await looked(page);
  await written(page);
  const text = await page.evaluate(() => location.hash.slice(1));
  const again = await open("images", { hash: text });
  await again.waitForSelector("#im-body[data-ready]");
  await settle(again);
  assert.equal(await again.locator("#im-right").inputValue(), "b");
  assert.equal(await again.locator("#im-error").inputValue(), "smape");
  assert.equal(await again.locator("#im-false").isChecked(), true);
  assert.equal(await again.locator("#im-exposure").inputValue(), "0.5");
  const after = await looked(again);
  for (const [u, v] of [[0.2, 0.3], [0.4, 0.7], [0.8, 0.6]]) assert.deepEqual(after(u * after.width, v * after.height), before(u * before.width, v * before.height));
  clean(page), clean(again);
});

test("without WebGL2 the same picture is drawn, and the page says so", async () => {
  const page = await look("&im.l=one");
  await page.context().addInitScript(() => {
    const own = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind === "webgl2" ? null : own.call(this, kind, ...rest);
    };
  });
  await page.reload();
  await page.waitForSelector("#im-body[data-ready]");
  assert.match(await page.locator("#im-body .warning").textContent(), /WebGL2 is missing/);
  sameColours(await looked(page), await places(page), raster.map(([x, y]) => shown(r.rows[y][x])), "without WebGL2");
  clean(page);
});

test("on paper the stage is white beside the pictures, with and without WebGL2", async () => {
  for (const without of [false, true]) {
    const page = await look("", { dark: true });
    if (without) {
      await page.context().addInitScript(() => {
        const own = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
          return kind === "webgl2" ? null : own.call(this, kind, ...rest);
        };
      });
      await page.reload();
      await page.waitForSelector("#im-body[data-ready]");
    }
    await settle(page);
    const corner = async () => {
      const screen = await looked(page);
      return screen(20, screen.height / 2).join();
    };
    assert.equal(await corner(), "22,23,27");
    await page.emulateMedia({ media: "print" });
    await settle(page);
    assert.equal(await corner(), "255,255,255");
    const place = raster[7]; // left of the divider
    const [left, top] = await placeOf(page, ...place);
    (await looked(page))(left, top).forEach((v, c) => assert.ok(Math.abs(v - shown(r.rows[place[1]][place[0]])[c]) <= 3, "the picture is as it was"));
    clean(page);
  }
});

test("no serious accessibility fault", async () => {
  for (const dark of [false, true]) await assertSound(await look("&im.l=all&im.f=1&im.s=2,2,9,9", { dark }));
});
