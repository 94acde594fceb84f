// node check.js MODULES PICTURES: opens three.html in a headless Chromium with the playwright-core of MODULES, waits until the character has
// walked up the stairs, and leaves a picture.
import { join, resolve } from "node:path";
import { begin, options, serve } from "../../web/check/browser.mjs";

const [modules, pictures] = process.argv.slice(2);
const checks = begin(resolve(modules), pictures);
const server = serve(new URL("..", import.meta.url).pathname);
const browser = await checks.chromium.launch(options);
const page = await browser.newPage({ viewport: { width: 960, height: 600 } });
checks.watch(page);
await page.goto(server.address + "examples/three.html?auto");
await page.waitForFunction(() => window.slipface_state?.time > 3.5, null, { timeout: 120000 });
const state = await page.evaluate(() => window.slipface_state);
checks.check("the character climbed the stairs and stands on the bridge", state.grounded && Math.abs(state.y - 3.302) < 0.05 && state.z < -6, state);
await page.screenshot({ path: join(pictures, "three.png") });
await browser.close();
server.close();
process.exit(checks.end());
