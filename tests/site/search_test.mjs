// search_test.mjs INDEX: the site's search (docs/site/search.js) puts the right place first for 85 % of the questions of
// tests/site/questions.txt, and among the first two for 85 % of each set, also of those that nothing was tuned on. No result has an entity of HTML in it that it
// should not have. INDEX is search/search_index.json of a site that scripts/build_docs.sh built.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const { Search, stem, answer } = createRequire(import.meta.url)(join(here, "../../docs/site/search.js"));
const search = new Search(JSON.parse(readFileSync(process.argv[2])).docs);
const places = new Set(search.sections.map(({ location }) => place(location)));
let failed = 0;

function place(location) {
  return location.replace(/^docs\//, "").replace(".html", "");
}

function check(text, holds, found) {
  if (holds) return;
  failed += 1;
  console.log(`FAILED: ${text}${found === undefined ? "" : `: found ${found}`}`);
}

const sets = {};
let set, first = 0;
for (const line of readFileSync(join(here, "questions.txt"), "utf8").split("\n")) {
  if (/^\[/.test(line)) set = sets[line.slice(1, -1)] = [];
  else if (line && !line.startsWith("#")) set.push([line.slice(0, line.lastIndexOf(" = ")), line.slice(line.lastIndexOf(" = ") + 3).split(", ")]);
}
for (const [name, questions] of Object.entries(sets)) {
  let right = 0;
  for (const [question, wanted] of questions) {
    for (const each of wanted) check(`${question}: the site has ${each}`, places.has(each));
    const found = search.find(question).slice(0, 2).map(({ section }) => place(section.location));
    const is_right = (each) => wanted.some((one) => each === one || one.startsWith("tutorials/") && each.startsWith(one + "#"));
    if (found.slice(0, 1).some(is_right)) first += 1;
    if (found.some(is_right)) right += 1;
    else console.log(`${name}: "${question}" found ${found.join(", ") || "nothing"}`);
  }
  console.log(`${name}: ${right} of ${questions.length} have the right place among the first two`);
  check(`${name}: 85 %`, right >= 0.85 * questions.length, right / questions.length);
}
const all = Object.values(sets).flat().length;
console.log(`${first} of all ${all} have it first`);
check("85 % first", first >= 0.85 * all, first / all);
check("60 questions", all >= 60);

// Forms of one word are one word, and other words are not.
for (const line of ["seam seams", "slope slopes sloped sloping", "stick sticks sticking stuck", "fall falls falling fell fallen", "step steps stepped stepping",
                    "slide slides sliding slid", "bounce bounces bouncing bounced bouncy", "body bodies", "box boxes", "edge edges", "run running ran",
                    "type types typed", "catch catches catching", "platform platforms", "jump jumps jumped jumping"])
  check(line, new Set(line.split(" ").map(stem)).size === 1, line.split(" ").map(stem));
for (const line of ["step stop", "ice ices_", "wall walk", "press preset", "spin spawn", "skin sky", "size side", "ramp rate"])
  check(line, new Set(line.split(" ").map(stem)).size === 2, line.split(" ").map(stem));

// What is shown is plain text with marks: every ninth section, by its own title.
const shown = search.sections.filter((each, at) => at % 9 === 0).flatMap(({ title }) => answer(search, title).items.slice(0, 3).flat());
const marks = /<mark data-md-highlight>|<\/mark>/g;
for (const { location, title, text } of shown) {
  check(`${location} shows no tags`, !/[<>]/.test((title + text).replace(marks, "")), title + text);
  check(`${location} shows no entities`, !/&amp;(amp|lt|gt|quot|#\d+);/.test(title + text), title + text);
  check(`${location} is short`, Math.max(title.length, text.length) <= 320, text.length);
  check(`${location} closes its marks`, text.split("<mark").length === text.split("</mark>").length, text);
}
// What a stranger may type breaks nothing.
for (const query of ["", " ", "*", "+-~^:", "(((", "<b>&amp;", "the", "a b c", "ÄÖ ß", "x".repeat(5000), "step_up=", "C++", "\u0000", "🙂"])
  check(`"${query.slice(0, 20)}" is answered`, Array.isArray(answer(search, query).items));
console.log(failed ? `${failed} checks failed` : "The search finds what is asked for");
process.exit(failed ? 1 : 0);
