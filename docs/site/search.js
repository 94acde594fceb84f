// The search of the site, in place of its theme's: plain English questions, also by words that the pages do not use.
//
// In a page the theme starts this file as a worker, or docs/site/offline_search.js in a frame, and asks it by messages: SETUP with
// the index that docs/site/hooks.py wrote, then QUERY for each text that is typed. tests/site/search_test.mjs loads it in node instead.
//
// A section is found by the stems of its words. Words of one line of `synonyms` count for each other, a little less than themselves.
// Titles count more than text, sections that have all the words more than sections that have some, and rare words more than common
// ones (BM25F: Robertson, Zaragoza, "The Probabilistic Relevance Framework: BM25 and Beyond", 2009, section 3.6). That is multiplied
// by how alike the question and one wording of the section are: its title, what else it is asked for, or a sentence.
(() => {
  // Words that say nothing about what is asked for. "why" is a panel of the editor and stays.
  const stop = new Set(`a about after all also am an and any are as at be because been but by can cannot could did do does doing done for
    from get gets getting got had has have he her him his how i if im in into is isn it its itself just ll make me my no not of on or
    our out over re s she should so some t than that the their them then there these they this those to too us ve very want was
    way we were what when where which while who will with without won would you your character player players game engine
    keep keeps always sometimes every even only really properly correctly weird bug issue problem problems fix fixing use using used add implement
    support feature into onto upon toward towards both controller controllers everything anything something behave behaves behavior behaviour kind go goes going went able
    up off upon like few super slightly quite bit maybe almost already yet else rather often sort movement impossible possible another again still longer anymore while during instead list show tell help thing things lot very
    let lets make makes making want wants need needs anyone someone anybody please try tries tried trying happen happens happening seem seems
    kinematic rigidbody characterbody certain given way ways via per etc am i'm m d my own at all one
    work works working don doesn didn`.split(/\s+/));

  // What English does not form by a rule.
  const irregular = new Map(`stuck stick, fell fall, fallen fall, slid slide, ran run, stood stand, went go, held hold, left leave, lost lose, flew fly, slept sleep,
    threw throw, thrown throw, built build, feet foot, vertices vertex, indices index, axes axis, sped speed, rose rise, risen rise, sank sink,
    sunk sink, froze freeze, frozen freeze, wrote write, written write, faster fast, slower slow, higher high, lower low, wider wide, larger
    large, bigger large, big large, smaller small, taller tall, steeper steep, windows windows, better good, best good, caught catch, kept keep,
    led lead, shot shoot, hid hide, hidden hide, hung hang, swung swing, swam swim, spun spin, struck strike, drove drive, driven drive, rode
    ride, gave give, given give, took take, taken take, came come, saw see, seen see, broke break, broken break, chose choose, chosen choose,
    drew draw, drawn draw, blew blow, blown blow, grew grow, grown grow, sent send, bent bend, felt feel, met meet, brought bring, taught teach,
    sat sit, began begin, begun begin, meant mean, shown show, shook shake, shaken shake, woke wake, torn tear, safety safe, safely safe`
    .split(",").map((pair) => pair.trim().split(" ")));

  // Words for one thing, one thing a line. A word may stand in several lines.
  const synonyms = `
    stick snag catch stuck hang jam trap block wedge stop halt hitch
    fall clip tunnel drop sink phase
    slope ramp incline hill steep slant
    stair stairs step staircase kerb curb ledge
    seam crack edge internal ghost tile triangle gap join
    ground floor grounded land isgrounded onground
    platform lift elevator mover raft ferry train cart vehicle car boat ship
    conveyor belt treadmill walkway escalator travelator
    csharp c# unity
    gdscript gdextension gdnative godot
    threejs react javascript typescript npm node babylon browser web
    blueprint unreal ue4 ue5
    reinforcement learning agent gym neural python numpy
    turntable rotate spin carousel revolve
    jitter shake vibrate stutter twitch tremble jerk wobble flicker glitch bob bumpy
    update approve accept refresh
    contribute contributing pull request patch change
    security vulnerability exploit
    regression difference compare comparison versus vs against benchmark
    jolt physx bullet havok rapier box3d ammo cannon other compare course
    rest settle sleep still idle
    draw display visualize visualise debug see
    limit maximum max cap most
    report send attach share capsule
    count number amount million
    container docker headless offscreen display
    hill cliff mountain
    edge rim ledge border cliff
    bumpy bump bounce
    door gate passage corridor
    tiny small little low
    escape out leave exit
    fast quick run sprint
    slide glide slip drift creep skid
    ice icy slippery slick frictionless
    friction mud swamp quicksand sand grass snow grip traction
    bounce trampoline restitution rebound pogo hop
    ladder climb
    sticky adhesive cling
    hazard lava kill death damage spike die respawn
    trigger volume zone overlap event
    collide collision hit contact touch
    wall cliff obstacle barrier
    ceiling roof overhead head
    corner wedge crevice acute
    deterministic determinism rollback replay repeat bitwise desync netcode lockstep network multiplayer online client server prediction reconciliation
    deterministic diverge differ mismatch different another compiler architecture arm x86 cpu processor bits
    framerate fps rate tick timestep hz delta fixedupdate physicsprocess
    speed velocity fast slow momentum
    gravity weight floaty float heavy
    terrain heightfield heightmap landscape
    origin far precision float large zero km kilometre kilometer
    install download setup apt package start begin
    tutorial start begin introduction guide lesson learn
    unity unreal godot gdextension plugin
    script automate headless batch
    ci continuous github pipeline action automation nightly
    image screenshot picture golden snapshot baseline
    save store autosave
    undo history redo
    paint annotate assign brush apply fill
    uphill up ascend upward climb
    downhill down descend downward downstairs
    slow decrease reduce lose brake
    goal item collectible coin pickup
    collider collision hitbox
    material texture name
    type surface physics
    key shortcut hotkey keybinding rebind remap keymap
    obj gltf glb fbx mesh model geometry
    export write convert
    import open load read
    swap replace exchange switch
    automatic automated automatically ci unattended
    blender maya modelling modeller
    spawn start respawn checkpoint spawnpoint begin initial
    crouch duck crawl sneak prone height radius
    grab hang mantle vault ledge climb pull
    glide glider parachute hover feather wing
    dash dodge roll boost lunge
    hang ledge monkey
    capsule ellipsoid collider body hitbox size radius
    skin margin offset width tolerance
    camera view bookmark
    grid snap
    preset template profile
    setting option parameter property tweak tune
    record recording tape replay demo input
    ghost compare
    reach reachable unreachable
    one-sided oneway backface
    crowd npc npcs enemy characters
    push shove
    crush squash squeeze pinch flatten smash
    invisible phantom ghost hidden unseen
    coyote late forgive grace
    buffer early queue
    jump leap hop kick spacebar
    second double twice triple air midair
    variable short tap hold
    air aerial midair airborne
    browser web wasm webassembly html
    windows exe mingw
    python numpy
    c ffi binding bindings abi
    license licence mit free commercial copyright
    slow performance lag speed fast
    cluster slurm machines kubernetes
    navmesh recast navigation pathfinding links
    light lighting lightmap bake
    why explain reason cause
    autosave crash recover recovery lost
    inside embedded overlap penetrate depenetrate unstick
    teleport warp
    diagonal sideways deflect
    flip inverted normal winding
    hole gap leak
    quake bsp shader
    gamepad controller joystick
    viewport view pane
    object prop entity instance prefab
    zoom focus frame centre center fit
    delete remove erase clear
    duplicate copy clone paste
    compile build make
    library package dependency module sdk
    crash freeze hang
    error fail failure warning
    exit return code status
    ignore mask exclude except region
    machine computer pc
    thread parallel multithread multithreading concurrent core
    ray linecast trace
    layer mask group filter
    callback event listener signal notify
    interpolate interpolation smooth lerp between
    cost expensive price time
    homework assignment exercise grade grading marks student
    route path way shortest fastest speedrun
    finish complete beat win beatable
    bot walker random monkey npc
    mac macos osx apple
    linux debian ubuntu
    phone mobile touch tablet
    credit attribution notices
    font text letter ui gui interface
    dark night black
    default standard factory
    plan top above
    animation clip skeleton rig
    pebble stone rock
    release version update upgrade
    documentation manual help reference
    display screen monitor headless
    delay lag latency
    push shove move
    sheet list overview table
    teach student lecture course lesson
    rust ffi bindings
    precise exact accurate accuracy precision
    align alignment snap
    buggy unreliable inconsistent flicker random intermittent
    flaky nondeterministic unstable random
    attach parent follow carry ride
    kill die death defeat
    hurt damage health
    tile tilemap tileset grid block voxel
    angle degree steepness inclination
    threshold tolerance limit
    approve accept baseline golden
    pipeline workflow job
    template starter sample example demo
    config configuration setting preferences options
    hover float levitate
    transform position rotation orientation
    tick step frame update
    area volume zone region
    stay remain hold
    accelerate acceleration boost
    decelerate deceleration brake stop
    border edge rim ledge
    inherit keep preserve
    momentum inertia velocity
    camera viewpoint eye
    file document format
    folder directory path
    reproduce repeat replay
    headroom ceiling overhead`;

  function stem(word) {
    if (irregular.has(word)) word = irregular.get(word);
    if (word === "windows") return word; // the system's name
    if (word.length < 4) return word;
    if (word.endsWith("ies")) word = word.slice(0, -3) + "y";
    else if (/[^suio]s$/.test(word)) word = word.slice(0, -1);
    else if (/(ss|sh|ch|x)es$/.test(word)) word = word.slice(0, -2);
    else if (/[^s]ies$|[aeo]es$/.test(word)) word = word.slice(0, -1);
    const tail = /^(.*[aeiouy].*?)(ing|ed|ness|ly)$/.exec(word);
    if (tail && tail[1].length > 2) {
      word = tail[1];
      if (/([bdgmnprt])\1$/.test(word)) word = word.slice(0, -1);
    }
    if (word.length > 6) word = word.replace(/([st])ion$/, "$1");
    if (word.length > 5 && /[^aeiou]y$/.test(word)) word = word.slice(0, -1);
    return word.length > 3 ? word.replace(/e$/, "") : word;
  }

  // Two words that are known as one are one: "key bindings", "check point".
  function add(found, each) {
    const before = found[found.length - 1];
    const both = before && stem(before[0] + each[0]);
    if (both && each[0].length > 2 && related.has(both)) found[found.length - 1] = [both, before[1], each[2]];
    else found.push(each);
  }

  // [stem, where the word begins, where it ends] of each word. A name such as step_up is its words, and StepUp, too; Ctrl+Z is one.
  function words_of(text) {
    const found = [];
    for (const { 0: word, index } of text.matchAll(/[Cc](?:trl|ontrol)[ +](?:[Ss]hift[ +])?[A-Za-z\d](?![\p{L}\d])|[Ff]rame[ -]rates?|\p{L}+\.js\b|[cC](?:\+\+|#)|[\p{Lu}\d]?[\p{Ll}\d]+|[\p{Lu}\d]+/gu))
      add(found, [stem(word.toLowerCase().replace(/^control(?=[ +])/, "ctrl").replace(/[ .+-](?!$|\+)/g, "")), index, index + word.length]);
    return found;
  }

  const small = new Set([...stop].map(stem));
  const related = new Map();
  for (const line of synonyms.trim().split("\n")) {
    const stems = line.trim().split(/\s+/).map((word) => stem(word.replace("-", "")));
    for (const each of stems) {
      if (!related.has(each)) related.set(each, new Set());
      for (const other of stems) if (other !== each) related.get(each).add(other);
    }
  }

  // How much a word counts in each field, how much another word of its line counts, and how much the beginning of a word does.
  const fields = { title: 5, asked: 3, page: 0.8, text: 1 };
  const of_synonym = 0.2, of_beginning = 0.6;

  // How much a wording and a sentence count that are the question; how much a small word counts in them.
  const of_wording = 6, of_sentence = 2, of_small = 0.5;

  // How alike the typed words and a wording are, 0 to 1: how much of their weight they have in common. Of a word that stands only
  // for the typed one half counts.
  function likeness(typed, wording) {
    let common = 0;
    for (const [word, weight] of typed.words) {
      if (wording.words.has(word)) common += weight;
      else for (const other of related.get(word) || []) if (wording.words.has(other)) {
        common += 0.5 * Math.min(weight, wording.words.get(other));
        break;
      }
    }
    return 2 * common / Math.max(1, typed.weight + wording.weight);
  }

  // Whether one letter too many, too few, another, or two in the other order make one word the other.
  function is_slip(a, b) {
    if (Math.abs(a.length - b.length) > 1) return false;
    let at = 0;
    while (at < a.length && a[at] === b[at]) ++at;
    const rest = (word, from) => word.slice(from);
    return rest(a, at + 1) === rest(b, at + 1) || rest(a, at + 1) === rest(b, at) || rest(a, at) === rest(b, at + 1) ||
      a[at] === b[at + 1] && a[at + 1] === b[at] && rest(a, at + 2) === rest(b, at + 2);
  }

  class Search {
    constructor(sections) {
      this.sections = sections;
      this.postings = new Map(); // stem -> Map of section -> weighted count
      const lengths = {};
      // What a page is asked for, each of its sections is about.
      const tops = new Map(sections.map((section) => [section.location, section]));
      const about = (section) => (tops.get(section.location.split("#")[0]) || section).asked || "";
      const counted = sections.map((section) => Object.keys(fields).map((field) =>
        [field, words_of(`${section[field] || ""} ${field === "page" ? about(section) : ""}`)]));
      for (const field of Object.keys(fields)) {
        const of_all = counted.map((each) => each.find(([name]) => name === field)[1].length).filter((length) => length > 0);
        lengths[field] = of_all.reduce((sum, length) => sum + length, 0) / Math.max(1, of_all.length);
      }
      counted.forEach((each, index) => {
        for (const [field, words] of each) {
          const long = field === "page" ? 1 : 0.5 + 0.5 * words.length / lengths[field];
          for (const [word] of words) {
            if (!this.postings.has(word)) this.postings.set(word, new Map());
            const posting = this.postings.get(word);
            posting.set(index, (posting.get(index) || 0) + fields[field] / long);
          }
        }
      });
      this.wordings = []; // of each section that was looked at
      this.vocabulary = [...this.postings.keys()].sort();
    }

    rarity(stem) {
      const count = this.postings.has(stem) ? this.postings.get(stem).size : 0;
      return Math.log(1 + (this.sections.length - count + 0.5) / (count + 0.5));
    }

    // A section's title, what else it is asked for, and its sentences.
    wordings_of(index) {
      const { title, asked, text } = this.sections[index];
      const as = (count) => (each) => ({ ...this.wording(words_of(each)), count });
      return this.wordings[index] ||= [title.replace(/ \([\w.]+\)$/, ""), ...(asked || "").split(";")].map(as(of_wording))
        .concat(text.split(/[.:;!?]\s/).map(as(of_sentence)));
    }

    // Words with what each weighs, and all together.
    wording(found) {
      const words = new Map(found.map(([word]) => [word, small.has(word) ? of_small : this.knows(word) ? this.rarity(word) : 0]));
      return { words, weight: [...words.values()].reduce((a, b) => a + b, 0) };
    }

    knows(word) {
      return this.postings.has(word) || related.has(word);
    }

    // A word that no page has is two that are written as one, "autostep", or one with a slip of the finger.
    known(word) {
      if (this.knows(word) || word.length < 5) return [word];
      for (let at = 3; at <= word.length - 3; ++at) {
        const parts = [word.slice(0, at), word.slice(at)].map(stem);
        if (parts.every((part) => this.postings.has(part))) return parts;
      }
      const near = this.vocabulary.filter((other) => other[0] === word[0] && is_slip(word, other))
        .sort((a, b) => this.postings.get(b).size - this.postings.get(a).size);
      return near.length ? [near[0]] : [word];
    }

    // Stems that a typed word stands for, with how much each counts.
    meanings(word, last) {
      const found = new Map([[word, 1]]);
      for (const other of related.get(word) || []) found.set(other, of_synonym);
      if (last && word.length > 1)
        for (const other of this.vocabulary)
          if (other.startsWith(word) && !found.has(other)) found.set(other, of_beginning * word.length / other.length);
      return found;
    }

    // Sections, best first: [{ section, score, stems }].
    find(query) {
      const whole = query.trim().toLowerCase(), text = query.replace(/['’]/g, "");
      const all = words_of(text);
      const meant = all.filter(([, from, to]) => !stop.has(text.slice(from, to).toLowerCase()));
      const typed = meant.length > 0 ? meant : all;
      // The last word may be going on.
      const [last, , end] = typed[typed.length - 1] || [];
      const open = end === text.length && this.vocabulary.some((other) => other.startsWith(last));
      const terms = [...new Set(typed.flatMap(([word]) => open && word === last ? [word] : this.known(word)))];
      if (terms.length === 0) return [];
      const scores = new Map(); // section -> [score of each term]
      const rarities = [];
      terms.forEach((term, at) => {
        const meanings = this.meanings(term, open && at === terms.length - 1);
        // A word is as rare as the commonest of what it may stand for, at most; so a rare synonym gains nothing.
        const rarity = this.postings.has(term) ? this.rarity(term) : Math.max(1, ...[...meanings.keys()].filter((each) => this.postings.has(each))
          .map((each) => this.rarity(each)).sort((a, b) => a - b).slice(0, 1));
        rarities[at] = [...meanings.keys()].some((each) => this.postings.has(each)) ? rarity : 0;
        for (const [stem, weight] of meanings)
          for (const [index, count] of this.postings.get(stem) || []) {
            if (!scores.has(index)) scores.set(index, new Array(terms.length).fill(0));
            const of_terms = scores.get(index);
            of_terms[at] = Math.max(of_terms[at], weight * rarity * count / (count + 1.5));
          }
      });
      const sum = (values) => values.reduce((a, b) => a + b, 0);
      const known = Math.max(1e-9, sum(rarities));
      const asked = this.wording([...terms.map((term) => [term]), ...all.filter(([word]) => small.has(word))]);
      terms.forEach((term, at) => asked.words.set(term, rarities[at]));
      asked.weight = sum([...asked.words.values()]);
      const found = [...scores].map(([index, of_terms]) => {
        const covered = sum(of_terms.map((score, at) => score > 0 ? rarities[at] : 0)) / known;
        return { section: this.sections[index], index, score: sum(of_terms) * (0.3 + 0.7 * covered * covered) * (this.sections[index].weight || 1) };
      });
      const by_score = (a, b) => b.score - a.score || a.index - b.index;
      found.sort(by_score).splice(200);
      for (const each of found) {
        const { title, names } = each.section;
        each.score *= 1 + Math.max(...this.wordings_of(each.index).map((wording) => wording.count * likeness(asked, wording) ** 2));
        if (names && names.includes(whole) || whole.length > 3 && title.toLowerCase().includes(whole)) each.score *= 2.5;
      }
      found.sort(by_score);
      const stems = new Set(terms.flatMap((term, at) => [...this.meanings(term, open && at === terms.length - 1).keys()]));
      return found.map((each) => ({ ...each, stems, terms }));
    }
  }

  const escape = (text) => text.replace(/[&<>"]/g, (sign) => `&${{ "&": "amp", "<": "lt", ">": "gt", '"': "quot" }[sign]};`);

  // At most `room` signs of the text, around the place with the most of the words, as HTML with these marked.
  function excerpt(text, stems, room) {
    const marks = words_of(text).filter(([stem]) => stems.has(stem));
    let from = 0, best = 0;
    for (const [, begin] of marks) {
      const kinds = new Set(marks.filter(([, a, b]) => a >= begin && b < begin + 0.6 * room).map(([stem]) => stem)).size;
      if (kinds > best) [best, from] = [kinds, begin];
    }
    from = from < 0.4 * room ? 0 : text.lastIndexOf(". ", from) + 2 > from - 0.4 * room ? text.lastIndexOf(". ", from) + 2 : text.lastIndexOf(" ", from - 20) + 1;
    let html = from > 0 ? "… " : "", at = from;
    for (const [, begin, end] of marks) {
      if (begin < at) continue;
      const next = `${escape(text.slice(at, begin))}<mark data-md-highlight>${escape(text.slice(begin, end))}</mark>`;
      if (html.length + next.length > room) break;
      html += next;
      at = end;
    }
    let rest = escape(text.slice(at, at + room));
    if (html.length + rest.length > room || at + room < text.length)
      rest = rest.slice(0, Math.max(0, room - html.length)).replace(/&[^;]*$/, "").replace(/\s+\S*$/, "") + " …";
    return html + rest;
  }

  // What the theme shows: groups of a page and its sections, in the order of the sections; hits of one page that follow each other
  // share a group. The theme folds what has a smaller score than the first of its group away, so all of a group have the same.
  function answer(search, query) {
    const items = [];
    for (const { section, stems, terms } of search.find(query).slice(0, 30)) {
      const page = section.location.split("#")[0];
      const shown = ({ location, title, text }) => ({ location, title: excerpt(title, stems, 300), text: excerpt(text, stems, 300), score: 1,
                                                      terms: Object.fromEntries(terms.map((term) => [term, true])) });
      if (items.length === 0 || items[items.length - 1][0].location !== page) {
        const top = search.sections.find(({ location }) => location === page);
        items.push([shown(top === section ? section : { location: page, title: section.page || page, text: "" })]);
      }
      if (section.location !== page) items[items.length - 1].push(shown(section));
    }
    return { items };
  }

  if (typeof module !== "undefined") {
    module.exports = { Search, stem, answer };
    return;
  }
  let search;
  addEventListener("message", ({ data: { type, data } }) => {
    if (type === 0) {
      search = new Search(data.docs);
      postMessage({ type: 1 });
    } else if (type === 2) {
      postMessage({ type: 3, data: search ? answer(search, typeof data === "string" ? data : "") : { items: [] } });
    }
  });
})();
