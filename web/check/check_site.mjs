// check_site.mjs SITE PICTURES MODULES: the documents as a site with the page in it: each kind of picture that can be used is used, and
// without scripts the pictures stand alone. scripts/check_web.sh runs it.
import { resolve } from "node:path";
import { begin, hands, options, serve } from "./browser.mjs";

const [folder, pictures, modules] = process.argv.slice(2).map((each) => resolve(each));
const checks = begin(modules, pictures);
const { check } = checks;
const { address, close } = serve(folder);
const browser = await checks.chromium.launch(options);

// Presses the button below a picture, and gives the hands for the frame that opens.
async function use(page, picture) {
  await page.locator(`img[src$="${picture}"] + button.try`).click();
  check(`${picture}: one view at a time`, await page.locator("iframe.try").count() === 1);
  const element = await page.locator("iframe.try").elementHandle();
  await element.scrollIntoViewIfNeeded();
  const view = await element.contentFrame();
  const me = hands(checks, page, pictures, view);
  await me.ready();
  return me;
}

try {
  const page = await (await browser.newContext({ viewport: options.viewport })).newPage();
  checks.watch(page);
  await page.goto(address + "docs/movement.html");
  await page.locator("button.try").first().waitFor({ timeout: 20000 });
  const pairs = await page.locator('img[src*="/hacks/"][src$="-on.png"]').count();
  check("each of the pairs has its button", pairs > 15 && await page.locator("button.try").count() === pairs, pairs);
  await use(page, "hacks/ground-velocity-on.png");
  const me = await use(page, "hacks/step-up-on.png");
  await me.until("the demo runs", (is) => is.ticks > 0);
  const frame = page.frameLocator("iframe.try");
  check("its switch is on", /on$/.test(await frame.locator("#switch").textContent()));
  await me.picture("site-1-demo");
  await frame.locator("#switch").click();
  check("pressing it turns it off", /off$/.test(await frame.locator("#switch").textContent()));
  const tick = (await me.state()).tick;
  await me.until("and the run goes on", (is) => is.tick !== tick && is.ticks > 0, 20);
  await me.picture("site-2-off");

  await page.goto(address + "docs/sweep.html");
  await page.locator("button.try").first().waitFor({ timeout: 20000 });
  const probe = await use(page, "images/probe.png");
  const before = await probe.until("the sweep page has its probe", (is) => is.probe);
  await probe.wait(1500);
  await probe.picture("site-3-probe");
  await probe.drag([0.4, 0.7], [0.7, 0.6]);
  await probe.until("which a drag pulls", (is) => is.probe && is.probe.join() !== before.probe.join());
  await probe.picture("site-4-pulled");

  await page.goto(address + "docs/reach.html");
  await page.locator("button.try").first().waitFor({ timeout: 20000 });
  const reach = await use(page, "reach/easy.png");
  await reach.until("the reach page searches", (is) => is.reach && is.reach.running && is.reach.fraction > 0.1);
  await reach.picture("site-5-search");
  await reach.until("and has its map", (is) => is.reach && !is.reach.running && is.reach.found > 100, 120);
  await reach.picture("site-6-map");

  const asked = await (await browser.newContext({ viewport: options.viewport })).newPage();
  checks.watch(asked);
  await asked.goto(address + "index.html");
  await asked.locator(".md-search__input").click();
  await asked.keyboard.type("player falls through floor");
  await asked.locator(".md-search-result__item").first().waitFor({ timeout: 20000 });
  const first = asked.locator(".md-search-result__link").nth(1); // below its page's title
  check("the search puts the symptom first", /^\s*Player falls through the floor/.test(await first.textContent()), await first.textContent());
  await first.click();
  await asked.waitForURL(/symptoms\.html.*#player-falls-through-the-floor$/, { timeout: 20000 });

  const plain = await (await browser.newContext({ viewport: options.viewport, javaScriptEnabled: false })).newPage();
  for (const name of ["movement", "sweep", "reach"]) {
    await plain.goto(`${address}docs/${name}.html`);
    const images = await plain.locator("article img").count();
    check(`without scripts ${name} has its pictures alone`, images > 0 && await plain.locator("button.try, iframe").count() === 0, images);
  }
} catch (error) {
  check("no step fails: " + error.message, false);
}
await browser.close();
close();
process.exit(checks.end());
