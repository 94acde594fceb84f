// The page report.html, which needs no other file and no network. The data go between the two halves.
#pragma once

namespace slipface {

// Colours of all reports, dark and light.
inline constexpr const char* page_colours =
    R"html(:root{--bg:#14171c;--panel:#1c2128;--line:#303740;--text:#e6e9ee;--muted:#98a2b0;--accent:#4aa3ff;--bad:#ff6b5e;--warn:#f5b942;--good:#4cc38a;--pick:#26303c}
@media (prefers-color-scheme:light){:root{--bg:#f2f4f7;--panel:#fff;--line:#d5dae1;--text:#1b2129;--muted:#5d6875;--accent:#0b6bcb;--bad:#c62f22;--warn:#9a6700;--good:#1a7f4b;--pick:#e3edf9}}
)html";

inline constexpr const char* report_page_head = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Snapshots</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
)html";
inline constexpr const char* report_page_style = R"html(*{box-sizing:border-box}
body{margin:0;height:100vh;display:grid;grid-template:auto 1fr auto/340px 1fr;background:var(--bg);color:var(--text);font:14px/1.45 Inter,system-ui,sans-serif}
header{grid-column:1/3;display:flex;gap:16px;align-items:baseline;padding:12px 20px;border-bottom:1px solid var(--line);background:var(--panel)}
h1{font-size:17px;margin:0}h2{font-size:16px;margin:0 0 4px;overflow-wrap:anywhere}h3{font-size:13px;margin:20px 0 6px;color:var(--muted);font-weight:600}
.muted{color:var(--muted)}
nav{overflow:auto;border-right:1px solid var(--line);background:var(--panel);display:flex;flex-direction:column}
#filters{padding:12px 12px 8px;display:flex;flex-wrap:wrap;gap:6px;position:sticky;top:0;background:var(--panel)}
#search{width:100%;padding:6px 10px;border:1px solid var(--line);border-radius:6px;background:var(--bg);color:var(--text);font:inherit}
button{font:inherit;color:var(--text);background:var(--bg);border:1px solid var(--line);border-radius:6px;padding:4px 10px;cursor:pointer}
button:hover{border-color:var(--accent)}button.on{background:var(--accent);border-color:var(--accent);color:#fff}
button:focus-visible,input:focus-visible{outline:2px solid var(--accent);outline-offset:1px}
.item{display:grid;grid-template-columns:10px 1fr auto;gap:10px;align-items:center;padding:7px 14px;width:100%;text-align:left;background:none;border:0;border-radius:0;border-left:3px solid transparent}
.item.on{background:var(--pick);border-left-color:var(--accent);color:var(--text)}
.act{padding:12px 14px 6px;border-top:1px solid var(--line)}.act p{margin:0 0 6px;overflow-wrap:anywhere}
.act div{display:flex;gap:8px;align-items:center;justify-content:space-between}
.item .name{overflow-wrap:anywhere}.item .mark{font-weight:700}
.dot{width:10px;height:10px;border-radius:50%;background:var(--bad)}
.dot.same{background:var(--good)}.dot.missing,.dot.orphan{background:var(--warn)}
main{overflow:auto;padding:16px 20px 40px}
#tools{display:flex;flex-wrap:wrap;gap:6px;margin:12px 0;align-items:center}
#stage{display:flex;gap:12px;flex-wrap:wrap;align-items:flex-start}
figure{margin:0;flex:1 1 420px;min-width:0}figcaption{color:var(--muted);margin-bottom:4px}
figure img,figure canvas{width:100%;display:block;border:1px solid var(--line);background:#000;image-rendering:auto}
body.exact figure{flex:0 0 auto}body.exact figure img,body.exact figure canvas{width:auto;image-rendering:pixelated}
#swipe{position:relative}#swipe .top{position:absolute;left:0;top:0;overflow:hidden;border-right:2px solid var(--accent);width:50%;height:100%}
#swipe .top img{position:absolute;left:0;top:0;max-width:none}
#onion{position:relative}#onion img+img{position:absolute;left:0;top:0}
canvas.near{image-rendering:pixelated}
table{border-collapse:collapse;width:100%}td,th{text-align:left;padding:4px 12px 4px 0;border-bottom:1px solid var(--line);vertical-align:top;overflow-wrap:anywhere}
th{color:var(--muted);font-weight:600}
td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
code{font:12.5px/1.5 ui-monospace,"DejaVu Sans Mono",monospace}
.tag{display:inline-block;padding:1px 8px;border-radius:10px;border:1px solid var(--line);font-size:12px;white-space:nowrap}
footer{grid-column:1/3;display:flex;gap:12px;align-items:center;padding:10px 20px;border-top:1px solid var(--line);background:var(--panel)}
footer code{flex:1;overflow-x:auto;white-space:nowrap;background:var(--bg);padding:6px 10px;border:1px solid var(--line);border-radius:6px}
kbd{border:1px solid var(--line);border-bottom-width:2px;border-radius:4px;padding:0 5px;font:12px ui-monospace,monospace}
@media (max-width:800px){body{grid-template:auto minmax(120px,34vh) 1fr auto/1fr}header,footer{grid-column:1;flex-wrap:wrap;gap:6px}footer span,#renderer{display:none}nav{border-right:0;border-bottom:1px solid var(--line)}figure{flex-basis:100%}}
</style></head><body>
<header><h1>Snapshots</h1><span id="totals"></span><span class="muted" id="renderer"></span></header>
<nav aria-label="Snapshots"><div id="filters"><input id="search" placeholder="Find by name or act" aria-label="Find by name or act"></div><div id="list"></div><details id="uncovered" class="act" hidden><summary></summary><p class="muted"></p></details></nav>
<main id="main"></main>
<footer><code id="command"></code><button id="copy">Copy</button><span class="muted"><kbd>j</kbd> <kbd>k</kbd> next, previous&ensp;<kbd>a</kbd> approve&ensp;<kbd>r</kbd> reject&ensp;<kbd>s</kbd> skip&ensp;<kbd>1</kbd>–<kbd>5</kbd> mode&ensp;<kbd>d</kbd> difference&ensp;<kbd>space</kbd> blink&ensp;<kbd>z</kbd> size</span></footer>
<script>
const DATA = )html";

inline constexpr const char* report_page_tail = R"html(;
const $ = id => document.getElementById(id);
const el = (tag, props = {}, ...children) => { const e = Object.assign(document.createElement(tag), props); e.append(...children); return e; };
const states = ["different", "missing", "unreadable", "failed", "nondeterministic", "orphan", "same"];
const approvable = e => ["different", "missing", "unreadable"].includes(e.state);
const store = "slipface snapshots " + DATA.checksum;
const marks = new Map(JSON.parse(localStorage.getItem(store) || "[]"));
// Each entry is listed below the first act that changed it.
const rowOf = new Map();
DATA.rows.forEach(row => row.entries.forEach(name => rowOf.has(name) || rowOf.set(name, row)));
const place = e => rowOf.has(e.name) ? DATA.rows.indexOf(rowOf.get(e.name)) : DATA.rows.length;
let filter = DATA.entries.some(e => e.state !== "same") ? "not the same" : "all", current = 0, mode = "side", showActual = true, threshold = 2, blinking = 0;

const matches = (e, text) => e.name.includes(text) || (rowOf.get(e.name)?.text || "").includes(text);
const shown = () => DATA.entries.filter(e => (filter === "all" || (filter === "not the same" ? e.state !== "same" : e.state === filter)) && matches(e, $("search").value)).sort((a, b) => place(a) - place(b));
const entry = () => shown()[current];
const canApprove = row => row.entries.map(name => DATA.entries.find(e => e.name === name)).filter(approvable);
const quoted = text => "'" + text.replaceAll("'", "'\\''") + "'";

function command() {
  const chosen = [...marks].filter(([, m]) => m === "approve").map(([n]) => n);
  const act = DATA.rows.find(row => canApprove(row).length > 3 && canApprove(row).length === chosen.length && canApprove(row).every(e => chosen.includes(e.name)));
  if (act) return DATA.approve + " --act " + quoted(act.text);
  if (chosen.length) return DATA.approve + " " + chosen.join(" ");
  return DATA.entries.some(approvable) ? DATA.approve : "Nothing to approve";
}
function drawFrame() {
  const count = s => DATA.entries.filter(e => e.state === s).length;
  $("totals").textContent = states.filter(count).map(s => count(s) + " " + s).join(", ");
  $("renderer").textContent = DATA.renderer;
  for (const b of [...$("filters").querySelectorAll("button")]) b.remove();
  for (const f of ["not the same", ...states.filter(count), "all"])
    $("filters").append(el("button", { textContent: f, className: f === filter ? "on" : "", onclick: () => { filter = f; current = 0; draw(); } }));
  $("command").textContent = command();
}
function drawList() {
  const list = shown(), parts = [];
  list.forEach((e, i) => {
    const row = rowOf.get(e.name);
    if (row && (i === 0 || rowOf.get(list[i - 1].name) !== row)) {
      const bar = el("div", {}, el("span", { className: "tag", textContent: row.word }), el("span", { className: "muted", textContent: row.entries.length === 1 ? "1 entry" : row.entries.length + " entries" }));
      if (canApprove(row).length) bar.append(el("button", { textContent: "Approve all", className: "all", onclick: () => { canApprove(row).forEach(e => marks.set(e.name, "approve")); draw(); } }));
      parts.push(el("section", { className: "act" }, el("p", { textContent: row.text }), bar));
    }
    const mark = { approve: "✓", reject: "✗", skip: "–" }[marks.get(e.name)] || "";
    const item = el("button", { className: "item" + (i === current ? " on" : ""), onclick: () => { current = i; draw(); } },
      el("span", { className: "dot " + e.state, title: e.state }), el("span", { className: "name", textContent: e.name }), el("span", { className: "mark", textContent: mark }));
    if (i === current) item.setAttribute("aria-current", "true");
    parts.push(item);
  });
  const focused = document.activeElement?.classList.contains("item");
  $("list").replaceChildren(...parts);
  const on = $("list").querySelector(".on");
  on?.scrollIntoView({ block: "nearest" });
  if (focused) on?.focus();
}
function picture(src, caption) { return el("figure", {}, el("figcaption", { textContent: caption }), el("img", { src, alt: caption })); }
const loaded = new Map();
function load(src) {
  if (!loaded.has(src)) loaded.set(src, new Promise((done, fail) => { const i = new Image(); i.onload = () => done(i); i.onerror = fail; i.src = src; }));
  return loaded.get(src);
}
async function heat(canvas, e) {
  const [a, b] = await Promise.all([load(e.expected), load(e.actual)]);
  const w = Math.max(a.width, b.width), h = Math.max(a.height, b.height);
  canvas.width = w; canvas.height = h;
  const c = canvas.getContext("2d", { willReadFrequently: true });
  const pixels = image => { c.clearRect(0, 0, w, h); c.drawImage(image, 0, 0); return c.getImageData(0, 0, w, h); };
  const x = pixels(a), y = pixels(b), out = c.createImageData(w, h);
  let count = 0;
  for (let i = 0; i < x.data.length; i += 4) {
    const d = Math.max(Math.abs(x.data[i] - y.data[i]), Math.abs(x.data[i + 1] - y.data[i + 1]), Math.abs(x.data[i + 2] - y.data[i + 2]), Math.abs(x.data[i + 3] - y.data[i + 3]));
    const grey = 20 + (x.data[i] * 54 + x.data[i + 1] * 183 + x.data[i + 2] * 19) / 768;
    const on = d > threshold;
    if (on) count++;
    out.data[i] = on ? 255 : grey; out.data[i + 1] = on ? 255 - 255 * Math.min(d - 1, 31) / 31 : grey; out.data[i + 2] = on ? 0 : grey; out.data[i + 3] = 255;
  }
  c.putImageData(out, 0, 0);
  canvas.dataset.count = count;
  $("count").textContent = count + " pixels differ by more than " + threshold;
}
function swipe(e) {
  const box = el("div", { id: "swipe" }, el("img", { src: e.actual, alt: "actual" }));
  const image = el("img", { src: e.expected, alt: "expected" }), top = el("div", { className: "top" }, image);
  box.append(top);
  const at = x => { const r = box.getBoundingClientRect(); image.style.width = r.width + "px"; top.style.width = Math.max(0, Math.min(1, (x - r.left) / r.width)) * 100 + "%"; };
  box.onpointermove = event => at(event.clientX);
  requestAnimationFrame(() => { image.style.width = box.getBoundingClientRect().width + "px"; });
  return el("figure", {}, el("figcaption", { textContent: "Expected left of the line, actual right of it" }), box);
}
function onion(e) {
  const over = el("img", { src: e.actual, alt: "actual", style: "opacity:.5" });
  const slider = el("input", { type: "range", min: 0, max: 100, value: 50, ariaLabel: "Opacity of the actual image", oninput: event => { over.style.opacity = event.target.value / 100; } });
  return el("figure", {}, el("figcaption", {}, "Expected below actual ", slider), el("div", { id: "onion" }, el("img", { src: e.expected, alt: "expected" }), over));
}
// The part around the window that differs most, eight times as large.
function near(src, caption, e) {
  const canvas = el("canvas", { className: "near", width: 96, height: 54 });
  load(src).then(image => canvas.getContext("2d").drawImage(image, 40 - e.pixels.at[0], 19 - e.pixels.at[1]));
  return el("figure", {}, el("figcaption", { textContent: caption + " at " + e.pixels.at.join(", ") }), canvas);
}
function drawStage() {
  clearInterval(blinking);
  const e = entry(), stage = $("stage");
  if (!stage || !e) return;
  if (!e.expected || !e.actual) {
    stage.replaceChildren(...[["expected", "Expected"], ["actual", "Actual"], ["first", "First rendering"], ["second", "Second rendering"]].filter(([k]) => e[k]).map(([k, t]) => picture(e[k], t)));
    return;
  }
  if (mode === "side") stage.replaceChildren(picture(e.expected, "Expected"), picture(e.actual, "Actual"));
  if (mode === "near") stage.replaceChildren(near(e.expected, "Expected", e), near(e.actual, "Actual", e));
  if (mode === "onion") stage.replaceChildren(onion(e));
  if (mode === "swipe") stage.replaceChildren(swipe(e));
  if (mode === "blink") {
    const figure = picture(showActual ? e.actual : e.expected, showActual ? "Actual" : "Expected");
    stage.replaceChildren(figure);
    const flip = () => { showActual = !showActual; figure.querySelector("img").src = showActual ? e.actual : e.expected; figure.querySelector("figcaption").textContent = showActual ? "Actual" : "Expected"; };
    stage.flip = flip;
    blinking = setInterval(flip, 700);
  }
  if (mode === "heat") {
    const canvas = el("canvas", { id: "heat" });
    const slider = el("input", { type: "range", ariaLabel: "Threshold", min: 0, max: 64, value: threshold, oninput: event => { threshold = +event.target.value; heat(canvas, e); } });
    stage.replaceChildren(el("figure", {}, el("figcaption", {}, "Threshold ", slider, " ", el("span", { id: "count" })), canvas));
    heat(canvas, e);
  }
}
function table(head, rows) {
  return el("table", {}, el("tr", {}, ...head.map(h => el("th", { textContent: h }))),
    ...rows.map(r => el("tr", {}, ...r.map(c => c instanceof Node ? el("td", {}, c) : el("td", { textContent: c, className: typeof c === "number" ? "n" : "" })))));
}
// Called by NAME.images.js.
function showImages(name, images) {
  const e = DATA.entries.find(one => one.name === name);
  delete e.script;
  Object.assign(e, images);
  drawMain();
}
function drawMain() {
  const e = entry(), main = $("main");
  if (e) history.replaceState(null, "", "#" + encodeURIComponent(e.name));
  if (e?.script) document.head.append(el("script", { src: e.script.split("/").map(encodeURIComponent).join("/") }));
  if (!e) { main.replaceChildren(el("p", { className: "muted", textContent: "No snapshot here." })); return; }
  const parts = [el("h2", { textContent: e.name }), el("div", {}, el("span", { className: "tag", textContent: e.state }), " ", el("span", { className: "muted", textContent: e.pixels ? e.pixels.verdict : e.message }))];
  if (e.matched) parts.push(el("p", { textContent: e.matched + " fits; the golden itself does not." }));
  if (e.findings) parts.push(el("h3", { textContent: "Why" }), table(["Pixels", "Cause", "What"], e.findings.map(f => [f.pixels, el("span", { className: "tag", textContent: f.cause }), f.text])));
  if (e.expected || e.actual || e.first) {
    const tools = el("div", { id: "tools" });
    if (e.expected && e.actual) for (const [m, t] of [["side", "1 Side by side"], ["swipe", "2 Swipe"], ["blink", "3 Blink"], ["heat", "4 Heat map"], ["onion", "5 Onion skin"], ["near", "d Difference"]])
      tools.append(el("button", { textContent: t, className: m === mode ? "on" : "", onclick: () => { mode = m; drawMain(); } }));
    tools.append(el("button", { textContent: "z Exact pixels", className: document.body.classList.contains("exact") ? "on" : "", onclick: exact }));
    if (approvable(e)) for (const [m, t] of [["approve", "a Approve"], ["reject", "r Reject"], ["skip", "s Skip"]])
      tools.append(el("button", { textContent: t, className: marks.get(e.name) === m ? "on" : "", onclick: () => setMark(m) }));
    parts.push(tools, el("div", { id: "stage" }));
  }
  if (e.history) parts.push(el("h3", { textContent: "History" }), table(["Commit", "Date", "What"], e.history.map(line => line.match(/^(\S+) (\S+) (.*)$/).slice(1))), el("p", {}, el("code", { textContent: "slipface snapshot history " + e.name })));
  if (e.numbers) parts.push(el("h3", { textContent: "Numbers" }), table(["Number", "Expected", "Actual", ""], e.numbers.map(n => [el("code", { textContent: n.path }), n.expected, n.actual, n.decides ? "" : "explains only"])));
  if (e.sweep) parts.push(el("h3", { textContent: "Pixels that would differ at other thresholds" }), table(["Threshold", ...e.sweep.map(r => "> " + r[0])], [["Pixels", ...e.sweep.map(r => r[1])]]));
  main.replaceChildren(...parts);
  drawStage();
}
function draw() { localStorage.setItem(store, JSON.stringify([...marks])); current = Math.max(0, Math.min(current, shown().length - 1)); drawFrame(); drawList(); drawMain(); }
function setMark(m) { const e = entry(); if (!e || !approvable(e)) return; marks.set(e.name, m); if (current < shown().length - 1) current++; draw(); }
function exact() { document.body.classList.toggle("exact"); drawMain(); }
const keys = {
  j: () => { current++; draw(); }, ArrowDown: () => { current++; draw(); }, k: () => { current--; draw(); }, ArrowUp: () => { current--; draw(); },
  a: () => setMark("approve"), r: () => setMark("reject"), s: () => setMark("skip"), z: exact, c: () => $("copy").click(),
  1: () => { mode = "side"; drawMain(); }, 2: () => { mode = "swipe"; drawMain(); }, 3: () => { mode = "blink"; drawMain(); }, 4: () => { mode = "heat"; drawMain(); },
  5: () => { mode = "onion"; drawMain(); }, d: () => { mode = mode === "near" ? "side" : "near"; drawMain(); },
  " ": () => { if (mode !== "blink") { mode = "blink"; drawMain(); } else { clearInterval(blinking); $("stage").flip?.(); } },
};
document.addEventListener("keydown", event => {
  if (event.target.tagName === "INPUT" && event.target.type !== "range") { if (event.key === "Escape") event.target.blur(); return; }
  if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
  if (event.key === " " && ["BUTTON", "SUMMARY"].includes(event.target.tagName) && !event.target.classList.contains("item")) return;
  event.preventDefault(); keys[event.key]();
});
$("search").oninput = () => { current = 0; draw(); };
$("copy").onclick = () => { const range = document.createRange(); range.selectNodeContents($("command")); getSelection().removeAllRanges(); getSelection().addRange(range); navigator.clipboard?.writeText(command()).catch(() => {}); };
$("uncovered").hidden = !DATA.not_reached.length;
$("uncovered").firstChild.textContent = DATA.not_reached.length + " things are reached by no snapshot";
$("uncovered").lastChild.textContent = DATA.not_reached.join(", ");
const linked = shown().findIndex(e => "#" + encodeURIComponent(e.name) === location.hash);
if (linked >= 0) current = linked;
draw();
</script></body></html>
)html";

}  // namespace slipface
