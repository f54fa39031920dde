// No serious fault of accessibility in any view: each once, on the first page that has it. By all rules in light and wide;
// dark by the rules of colour, narrow by those that the layout can break. axe_all has every view of every page.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open } from "./harness.mjs";
import { faults } from "./sound.mjs";

after(close);
const ofColour = ["color-contrast", "link-in-text-block"];
const ofLayout = ["color-contrast", "scrollable-region-focusable", "target-size"];
const seen = new Set();

for (const name of ["front", "flicker", "history", "images", "pair"]) {
  test(name, async () => {
    const page = await open(name);
    const tabs = await page.getByRole("tab").all();
    const fresh = [];
    for (const tab of tabs) {
      const id = await tab.getAttribute("id");
      if (!seen.has(id)) fresh.push(id);
      seen.add(id);
    }
    assert.ok(fresh.length > 0, `${name} has no view that the pages before lack`);
    for (const [rules, look] of [[undefined, () => {}], [ofColour, () => page.emulateMedia({ colorScheme: "dark" })],
                                 [ofLayout, async () => { await page.emulateMedia({ colorScheme: "light" }); await page.setViewportSize({ width: 400, height: 900 }); }]]) {
      await look();
      for (const id of fresh) {
        await page.locator(`#${id}`).click();
        await page.waitForTimeout(100);
        assert.deepEqual(await faults(page, rules), [], `${name}: ${id}`);
      }
    }
  });
}
