// check.mjs PAGE PICTURES MODULES PROGRAM: drives the page in Chromium as a person does, and fails at the first thing that is not as
// it should be. PROGRAM is Slipface on this machine: it makes files that are strange to the page, opens the page's links, and draws the
// same pictures. scripts/check_web.sh runs it.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { randomBytes } from "node:crypto";
import { join, resolve } from "node:path";
import { begin, hands, options, serve } from "./browser.mjs";

const [folder, pictures, modules, program] = process.argv.slice(2).map((each) => resolve(each));
const checks = begin(modules, pictures);
const { check } = checks;
const { address, close } = serve(folder);
const run = (...words) => {
  try {
    return { code: 0, text: execFileSync(program, words, { encoding: "utf8", stdio: "pipe" }) };
  } catch (error) {
    return { code: error.status, text: String(error.stdout) + error.stderr };
  }
};

const browser = await checks.chromium.launchPersistentContext(checks.profile, options);
let me = hands(checks, browser.pages()[0], pictures);
checks.watch(me.page);
// Another person's browser, with an empty store.
async function elsewhere(use, more = {}) {
  const other = await checks.chromium.launch(options);
  const page = await (await other.newContext({ viewport: options.viewport, ...more })).newPage();
  checks.watch(page);
  await use(hands(checks, page, pictures));
  await other.close();
}

async function edits() {
  const cold = await me.go(address);
  console.log(`first picture after ${Math.round(cold)} ms`);
  await me.wait(1500);
  await me.picture("1-welcome");
  await me.open("easy");
  await me.page.keyboard.press("Escape"); // the tour
  await me.picture("2-level");

  await me.paint();
  const painted = await me.until("a stroke paints", (is) => is.unsaved && is.painted > 0);
  await me.picture("3-painted");
  await me.page.keyboard.press("Control+z");
  await me.until("undo takes it back", (is) => is.painted < painted.painted);
  await me.page.keyboard.press("Control+Shift+z");
  await me.until("redo brings it again", (is) => is.painted === painted.painted);

  await me.until("it is autosaved", (is) => is.autosaves > 0);
  await me.stored();
  await me.reload();
  check("after a reload the work is offered", (await me.state()).recoverable === 1, await me.state());
  await me.open("easy");
  await me.picture("4-recover");
  await me.click("Recover/easy.obj/Recover");
  await me.until("recovering brings it back", (is) => is.painted === painted.painted && is.unsaved);
  await me.page.keyboard.press("Control+s");
  await me.until("it is saved", (is) => !is.unsaved);
  await me.stored();
  await me.reload();
  check("after saving nothing is to recover", (await me.state()).recoverable === 0, await me.state());
  await me.open("easy");
  check("the saved paint is there", (await me.state()).painted === painted.painted, await me.state());
  return painted.painted;
}

async function plays() {
  await me.page.keyboard.press("F5");
  const start = await me.until("play starts", (is) => is.playing);
  await me.page.keyboard.down("w");
  const far = (is) => Math.hypot(...[0, 1, 2].map((i) => is.player[i] - start.player[i])) > 1;
  await me.until("W walks", (is) => is.playing && far(is));
  await me.picture("5-play");
  await me.page.keyboard.up("w");
  check("the pointer belongs to the page", await me.page.evaluate(() => document.pointerLockElement !== null));
  await me.page.keyboard.press("Escape");
  const run = await me.until("Escape ends it with a run that repeats", (is) => !is.playing && is.ticks > 5 && is.repeats === true);
  await me.picture("6-why");
  await me.page.keyboard.press("t");
  await me.drag([0.5, 0.6], [0.62, 0.55]);
  await me.until("a drag pulls the probe", (is) => is.probe && Math.hypot(...is.probe) > 0.1);
  await me.picture("7-probe");
  return run;
}

async function links(ran, painted) {
  await me.page.click("#link");
  await me.wait(500);
  const link = me.page.url();
  console.log(`the run's address has ${link.length} characters, with ${painted} painted faces`);
  check("the run is in the address, which is short", link.includes("#capsule=") && link.length < 2000, link.length);
  await elsewhere(async (you) => {
    await you.go(link);
    await you.until("the link opens the same tick elsewhere", (is) => is.tick === ran.tick && is.ticks === ran.ticks && is.repeats === true);
    check("with the paint", (await you.state()).painted === painted, await you.state());
    await you.picture("8-link");
    await you.go(address + "#demo=step-up");
    await you.until("a demo opens by its address", (is) => is.ticks > 0);
    await you.picture("9-demo");
    await you.page.goto(address + "#capsule=12.AAAA");
    await you.wait(500);
    check("a damaged link is refused in words", /cut off or altered/.test(await you.note()), await you.note());
    const file = join(pictures, "run.link");
    writeFileSync(file, link + "\n");
    await you.go(address);
    await you.page.setInputFiles("#picker", [file]);
    await you.until("so does a file with it", (is) => is.tick === ran.tick && is.repeats === true && is.painted === painted);
    const desktop = run("edit", file, "--screenshot", join(pictures, "8-link-desktop.png"));
    check("and on the desktop", desktop.code === 0, desktop.text);
  });
}

// Long work leaves the page its turns; what it finds is what the desktop finds.
async function works() {
  await me.go(address + "#level=playground");
  await me.page.keyboard.press("Escape");
  const longest = () => me.page.evaluate(() => new Promise((done) => {
    let before = performance.now(), most = 0;
    const end = before + 3000;
    const frame = (now) => { most = Math.max(most, now - before); before = now; now < end ? requestAnimationFrame(frame) : done(most); };
    requestAnimationFrame(frame);
  }));
  const idle = await longest();
  await me.click("Menu/Lab");
  await me.click("Menu/Lab/Search reach");
  await me.until("a search shows how far it is", (is) => is.reach && is.reach.running && is.reach.fraction > 0.05);
  await me.picture("10-search");
  const busy = await longest();
  console.log(`longest time between two frames: ${Math.round(idle)} ms, during a search ${Math.round(busy)} ms`);
  check("the page answers meanwhile", busy < idle + 400, [idle, busy]);
  await me.until("it ends", (is) => is.reach && !is.reach.running && is.reach.found > 100);
  await me.click("Menu/Lab");
  await me.click("Menu/Lab/Run audit");
  const done = await me.until("an audit ends", (is) => is.audit && !is.audit.running, 300);
  const same = run("audit", "assets/levels/playground.obj", "--walkers", "60", "--seconds", "30", "--json");
  const there = JSON.parse(same.text || "{}");
  check("with the findings of the desktop", there.findings && there.findings.length === done.audit.found, [done.audit, same.text.slice(0, 300)]);
  await me.click("Menu/Lab");
  await me.click("Menu/Lab/Search reach");
  await me.until("another search begins", (is) => is.reach && is.reach.running);
  await me.page.evaluate(() => { location.hash = "#level=hard"; });
  await me.until("another level opens during it", (is) => is.level.endsWith("/hard.obj"));
  await me.wait(1500);
  await me.click("Menu/Lab");
  await me.click("Menu/Lab/Run audit");
  await me.until("and the page goes on", (is) => is.audit && is.audit.running === false && is.level.endsWith("/hard.obj"), 120);
}

async function takes_files() {
  const strange = join(pictures, "strange");
  rmSync(strange, { recursive: true, force: true });
  run("demo", "keep-energy", "--out", strange);
  const files = readdirSync(strange).map((name) => join(strange, name));
  check("the program wrote a demo", files.length > 1, files);
  await me.go(address);
  // As the browser's own process sends it when files are dragged over the page.
  const devtools = await me.page.context().newCDPSession(me.page);
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) await devtools.send("Input.dispatchDragEvent", { type, x: 600, y: 400, data });
  await me.until("files of a stranger open where they are dropped", (is) => is.level && is.level.includes("/levels/") && !is.level.includes("assets"));
  await me.picture("11-dropped");
  await me.stored();
  await me.reload();
  check("and stay", await me.page.evaluate(() => [...walk(levels)].length) === files.length);
  await me.page.click("#take");
  for (const file of files) {
    const name = file.split("/").pop();
    const [download] = await Promise.all([me.page.waitForEvent("download"), me.page.click(`#files a >> text=${name}`)]);
    const same = readFileSync(await download.path()).equals(readFileSync(file));
    check(`${name} is downloaded as it was`, same && download.suggestedFilename() === name, download.suggestedFilename());
  }
  await me.picture("12-files");
  await me.page.click("#files form button");
}

async function fills_the_store() {
  await elsewhere(async (you) => {
    const devtools = await you.page.context().newCDPSession(you.page);
    const origin = new URL(address).origin;
    await devtools.send("Storage.overrideQuotaForOrigin", { origin, quotaSize: 300000 });
    await you.go(address);
    await you.open("hard");
    await you.page.keyboard.press("Escape");
    await you.paint();
    await you.page.keyboard.press("Control+s");
    await you.stored();
    check("there is room for a little", await you.note() === "", await you.note());
    const large = join(pictures, "large.bin");
    writeFileSync(large, randomBytes(3000000));
    await you.page.setInputFiles("#picker", [large]);
    await you.wait(3000);
    check("a full store is said", /NOT stored: the browser's store is full/.test(await you.note()), await you.note());
    await you.picture("13-full");
    await devtools.send("Storage.overrideQuotaForOrigin", { origin });
    // The browser asks itself only now and then how much room there is.
    await you.page.waitForFunction(() => /stored again/.test(document.getElementById("note").textContent), null, { timeout: 90000 });
    check("and so is that it has room again", true);
  });
}

async function loses_nothing() {
  const second = await browser.newPage();
  checks.watch(second);
  await second.goto(address);
  await second.waitForFunction(() => /another tab/.test(document.getElementById("note").textContent), null, { timeout: 60000 });
  check("a second tab says that it stores nothing", true);
  await second.close();

  await me.go(address);
  await me.open("hard");
  await me.paint();
  await me.page.keyboard.press("3");
  await me.drag([0.45, 0.5], [0.55, 0.5]);
  const left = await me.state();
  await me.page.close({ runBeforeUnload: true });
  await new Promise((done) => setTimeout(done, 1500));
  me = hands(checks, await browser.newPage(), pictures);
  checks.watch(me.page);
  await me.go(address);
  check("a closed tab loses nothing", left.unsaved && (await me.state()).recoverable === 1, [left, await me.state()]);

  await me.open("playground");
  await me.page.keyboard.press("Escape");
  await me.paint();
  const painted = await me.until("another stroke paints", (is) => is.unsaved);
  await me.page.evaluate(() => {
    window.graphics = document.getElementById("canvas").getContext("webgl2").getExtension("WEBGL_lose_context");
    graphics.loseContext();
  });
  await me.page.waitForFunction(() => /taken the graphics/.test(document.getElementById("progress").textContent), null, { timeout: 20000 });
  check("lost graphics are said", true);
  await me.picture("14-lost");
  await Promise.all([me.page.waitForNavigation({ timeout: 60000 }), me.page.evaluate(() => { graphics.restoreContext(); })]);
  await me.ready();
  await me.until("when they come back the level opens again", (is) => is.level && is.level.endsWith("/playground.obj"));
  await me.picture("15-restored");
  await me.click("Recover/playground.obj/Recover");
  await me.until("and nothing is lost", (is) => is.unsaved && is.painted === painted.painted);
}

// The same view by the page's driver and by the desktop's. The gate of the snapshots forgives what one rasteriser does differently on
// two processors. Two rasterisers give edges and letters other shades as well; so many of the pixels, in parts of all, may differ by more
// than 4 of 255.
async function compares() {
  const views = [
    ["scene", "level=easy&camera=-5.2,6.4,10.2,1.6,1.2,-14&only=view", 0.02],
    ["ui", "level=easy&camera=-5.2,6.4,10.2,1.6,1.2,-14&only=movement", 0.01],
  ];
  await elsewhere(async (you) => {
    for (const [profile, link, limit] of views) {
      const page = join(pictures, `16-${profile}.png`), desktop = join(pictures, `16-${profile}-desktop.png`);
      await you.go(address + "#" + link);
      await you.until(`${link} is shown`, (is) => is.level !== undefined);
      await you.page.mouse.move(640, 10);
      await you.wait(2500);
      await you.page.locator("#canvas").screenshot({ path: page });
      const { width, height } = await you.page.evaluate(() => { const { width, height } = document.getElementById("canvas"); return { width, height }; });
      const drawn = run("edit", "#" + link, "--size", `${width}x${height}`, "--screenshot", desktop);
      const gate = run("snapshot", "diff", desktop, page, "--profile", profile, "--out", join(pictures, `16-${profile}-difference.png`));
      console.log(gate.text.trim());
      const differ = gate.code === 0 ? 0 : Number((gate.text.match(/by more than +4: (\d+)/) || [])[1]) / (width * height);
      check(`${profile}: the page's picture is the desktop's, but for ${(100 * differ).toFixed(2)} % of the pixels`,
        drawn.code === 0 && differ <= limit, drawn.text);
    }
  });
}

async function is_sharp() {
  await elsewhere(async (you) => {
    await you.go(address + "#demo=step-up");
    await you.until("a demo opens on a fine screen", (is) => is.ticks > 0);
    const size = await you.page.evaluate(() => [document.getElementById("canvas").width, innerWidth * 2]);
    check("which has all its pixels", size[0] === size[1], size);
    await you.page.keyboard.press("t");
    await you.drag([0.5, 0.6], [0.62, 0.55]);
    await you.until("and where the mouse is right", (is) => is.probe && Math.hypot(...is.probe) > 0.1);
    await you.picture("17-fine");
  }, { deviceScaleFactor: 2, viewport: { width: 900, height: 600 } });
}

try {
  const painted = await edits();
  const ran = await plays();
  await links(ran, painted);
  await works();
  await takes_files();
  await fills_the_store();
  await loses_nothing();
  await compares();
  await is_sharp();
} catch (error) {
  check("no step fails: " + error.message, false);
  await me.page.screenshot({ path: join(pictures, "failure.png") }).catch(() => {});
}
await browser.close();
close();
process.exit(checks.end());
