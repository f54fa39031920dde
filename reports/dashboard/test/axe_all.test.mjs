// No serious fault of accessibility, by any rule, in any view of any page, light and dark, wide and narrow: minutes.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open } from "./harness.mjs";
import { faults } from "./sound.mjs";

after(close);

for (const name of ["front", "flicker", "generation", "history", "images", "pair"]) {
  for (const dark of [false, true]) {
    for (const width of [1280, 400]) {
      test(`${name}, ${dark ? "dark" : "light"}, ${width} px`, async () => {
        const page = await open(name, { dark, width });
        for (const tab of await page.getByRole("tab").all()) {
          await tab.click();
          await page.waitForTimeout(200);
          assert.deepEqual(await faults(page), [], `${name}: ${await tab.textContent()}`);
        }
      });
    }
  }
}
