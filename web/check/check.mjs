// check.mjs PAGE PICTURES PROGRAM LEVELS: drives the page in Chromium as a person does, and fails at the first thing that is not as
// it should be. scripts/check_web.sh runs it.
import { createServer } from "node:http";
import { createReadStream, existsSync, mkdirSync, readdirSync } from "node:fs";
import { extname, join, resolve } from "node:path";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { mkdtempSync, rmSync } from "node:fs";

const [folder, pictures, modules, strange] = process.argv.slice(2).map((each) => resolve(each));
const { chromium } = createRequire(join(modules, "x.js"))("playwright-core");
mkdirSync(pictures, { recursive: true });

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml" };
const server = createServer((request, response) => {
  const path = join(folder, new URL(request.url, "http://x").pathname.replace(/\/$/, "/index.html"));
  if (!existsSync(path)) return response.writeHead(404).end();
  response.writeHead(200, { "Content-Type": types[extname(path)] || "application/octet-stream" });
  createReadStream(path).pipe(response);
}).listen(0);
const address = `http://localhost:${server.address().port}/`;

const profile = mkdtempSync(join(tmpdir(), "slipface-web-"));
const options = {
  executablePath: "/usr/bin/chromium", headless: true, viewport: { width: 1280, height: 800 },
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
};
const browser = await chromium.launchPersistentContext(profile, options);
let page = browser.pages()[0];
const said = []; // on the console

function watch(each) {
  each.on("console", (message) => { if (["error", "warning"].includes(message.type())) said.push(message.text()); });
  each.on("pageerror", (error) => said.push(String(error)));
  each.on("dialog", (dialog) => dialog.accept());
}
watch(page);

let failures = 0;
function check(name, holds, found) {
  console.log(`${holds ? "ok  " : "FAIL"} ${name}${holds || found === undefined ? "" : ": found " + JSON.stringify(found)}`);
  if (!holds) failures += 1;
}
const state = () => page.evaluate(() => JSON.parse(state()));
const note = () => page.textContent("#note");
async function until(name, holds, seconds = 60) {
  const end = Date.now() + 1000 * seconds;
  let found;
  while (Date.now() < end) {
    found = await state();
    if (await holds(found)) return check(name, true), found;
    await page.waitForTimeout(100);
  }
  check(name, false, found);
  return found;
}
async function place(path) {
  for (let tries = 0; tries < 100; ++tries) {
    const box = await page.evaluate((name) => {
      const text = ccall("slipface_widget", "string", ["string"], [name]);
      const canvas = document.getElementById("canvas").getBoundingClientRect();
      const [x, y, width, height] = text.split(" ").map((value) => value / devicePixelRatio);
      return text && { x: x + canvas.left, y: y + canvas.top, width, height };
    }, path);
    if (box) return box;
    await page.waitForTimeout(100);
  }
  check("there is a widget " + path, false);
  throw new Error("no widget " + path);
}
async function click(path) {
  const box = await place(path);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForTimeout(200);
}
// A stroke in the view, in parts of its size.
async function drag(from, to) {
  const view = await place("Viewport/View");
  const at = ([x, y]) => [view.x + x * view.width, view.y + y * view.height];
  await page.mouse.move(...at(from));
  await page.waitForTimeout(300);
  await page.mouse.down();
  for (let i = 1; i <= 10; ++i) {
    await page.mouse.move(...at([from[0] + (to[0] - from[0]) * i / 10, from[1] + (to[1] - from[1]) * i / 10]));
    await page.waitForTimeout(60);
  }
  await page.mouse.up();
  await page.waitForTimeout(300);
}
const picture = async (name) => { await page.waitForTimeout(600); await page.screenshot({ path: join(pictures, name + ".png") }); };
async function ready() {
  await page.waitForFunction(() => performance.getEntriesByName("slipface first picture").length > 0, null, { timeout: 120000 });
  return page.evaluate(() => performance.getEntriesByName("slipface first picture")[0].startTime);
}
async function reload() {
  await page.reload();
  await ready();
}
async function open(level) {
  await click("Welcome/Samples/" + level);
  return until("the level " + level + " opens", (is) => is.level && is.level.endsWith(`/${level}.obj`));
}
async function paint() {
  await page.keyboard.press("2");
  await page.keyboard.press("b");
  await drag([0.42, 0.6], [0.58, 0.62]);
}
const stored = () => page.evaluate(() => store.write());

try {
  await page.goto(address);
  const cold = await ready();
  console.log(`first picture after ${Math.round(cold)} ms`);
  await page.waitForTimeout(1500);
  await picture("1-welcome");
  await open("easy");
  await page.keyboard.press("Escape"); // the tour
  await picture("2-level");

  await paint();
  const painted = await until("a stroke paints", (is) => is.unsaved && is.painted > 0);
  await picture("3-painted");
  await page.keyboard.press("Control+z");
  await until("undo takes it back", (is) => is.painted < painted.painted);
  await page.keyboard.press("Control+Shift+z");
  await until("redo brings it again", (is) => is.painted === painted.painted);

  await until("it is autosaved", (is) => is.autosaves > 0);
  await stored();
  await reload();
  check("after a reload the work is offered", (await state()).recoverable === 1, await state());
  await open("easy");
  await picture("4-recover");
  await click("Recover/easy.obj/Recover");
  await until("recovering brings it back", (is) => is.painted === painted.painted && is.unsaved);
  await page.keyboard.press("Control+s");
  await until("it is saved", (is) => !is.unsaved);
  await stored();
  await reload();
  check("after saving nothing is to recover", (await state()).recoverable === 0, await state());
  await open("easy");
  check("the saved paint is there", (await state()).painted === painted.painted, await state());

  await page.keyboard.press("F5");
  const start = await until("play starts", (is) => is.playing);
  await page.keyboard.down("w");
  await page.waitForTimeout(2500);
  await picture("5-play");
  const walked = await state();
  await page.keyboard.up("w");
  const way = Math.hypot(...[0, 1, 2].map((i) => walked.player[i] - start.player[i]));
  check("W walks", way > 1, way);
  check("the pointer belongs to the page", await page.evaluate(() => document.pointerLockElement !== null));
  await page.keyboard.press("Escape");
  const run = await until("Escape ends it with a run that repeats", (is) => !is.playing && is.ticks > 5 && is.repeats === true);
  await picture("6-why");

  await page.click("#link");
  await page.waitForTimeout(500);
  const link = page.url();
  console.log(`the run's address has ${link.length} characters`);
  check("the run is in the address", link.includes("#capsule="), link.slice(0, 60));

  await page.keyboard.press("t");
  await drag([0.5, 0.6], [0.62, 0.55]);
  await picture("7-probe");

  // Elsewhere, with an empty store.
  const other = await chromium.launch(options);
  const before = page;
  page = await (await other.newContext({ viewport: options.viewport })).newPage();
  watch(page);
  await page.goto(link);
  await ready();
  await until("the link opens the same tick elsewhere", (is) => is.tick === run.tick && is.ticks === run.ticks && is.repeats === true);
  check("with the paint", (await state()).painted === painted.painted, await state());
  await picture("8-link");
  await page.goto(address + "#demo=step-up");
  await page.reload();
  await ready();
  await until("a demo opens by its address", (is) => is.ticks > 0);
  await picture("9-demo");
  await page.goto(address + "#capsule=12.AAAA");
  await page.waitForTimeout(500);
  check("a damaged link is refused in words", /cut off or altered/.test(await note()), await note());
  await other.close();
  page = before;
  await page.goto(address);
  await ready();

  if (strange) {
    const files = readdirSync(strange).map((name) => join(strange, name));
    await page.setInputFiles("#picker", files);
    await until("files of a stranger open", (is) => is.level && is.level.includes("/levels/") && !is.level.includes("assets"));
    await picture("10-added");
    await stored();
    await reload();
    check("and stay", await page.evaluate(() => [...walk(levels)].length) === files.length);
  }

  const second = await browser.newPage();
  watch(second);
  await second.goto(address);
  await second.waitForFunction(() => /another tab/.test(document.getElementById("note").textContent), null, { timeout: 60000 });
  check("a second tab says that it stores nothing", true);
  await second.close();

  await open("hard");
  await page.evaluate(() => {
    IDBObjectStore.prototype.put_now = IDBObjectStore.prototype.put;
    IDBObjectStore.prototype.put = () => { throw new DOMException("full", "QuotaExceededError"); };
  });
  await paint();
  await page.keyboard.press("Control+s");
  await stored();
  check("a full store is said", /NOT stored: the browser's store is full/.test(await note()), await note());
  await picture("11-full");
  await page.evaluate(() => { IDBObjectStore.prototype.put = IDBObjectStore.prototype.put_now; });
  await stored();
  check("and so is that it has room again", /stored again/.test(await note()), await note());

  await paint();
  await page.keyboard.press("3");
  await drag([0.45, 0.5], [0.55, 0.5]);
  const left = await state();
  await page.close({ runBeforeUnload: true });
  await new Promise((done) => setTimeout(done, 1500));
  page = await browser.newPage();
  watch(page);
  await page.goto(address);
  await ready();
  check("a closed tab loses nothing", !left.unsaved || (await state()).recoverable === 1, await state());

  await open("playground");
  await page.keyboard.press("Escape");
  await paint();
  await page.evaluate(() => document.getElementById("canvas").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext());
  await page.waitForTimeout(1000);
  check("lost graphics are said", /taken the graphics/.test(await page.textContent("#progress")));
  await picture("12-lost");
  await reload();
  check("and lose nothing", (await state()).recoverable >= 1, await state());
} catch (error) {
  check("no step fails: " + error.message, false);
  await page.screenshot({ path: join(pictures, "failure.png") }).catch(() => {});
}
const errors = said.filter((text) => !/favicon|GPU stall|GroupMarkerNotSet|software WebGL|beforeunload/.test(text));
check("nothing on the console", errors.length === 0, errors.slice(0, 5));
await browser.close();
server.close();
rmSync(profile, { recursive: true, force: true });
console.log(failures === 0 ? "all as it should be" : failures + " failures");
process.exit(failures === 0 ? 0 : 1);
