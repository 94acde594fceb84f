// Beside each picture pair of a hack's demo: a button that runs the demo in the page, if the site has Slipface as a page in web/.
// Without scripts, or without that folder, the pictures stand alone.
(() => {
  const script = document.currentScript;
  const web = new URL("../../web/index.html", script.src);
  addEventListener("DOMContentLoaded", async () => {
    const pairs = [...document.querySelectorAll('img[src*="/hacks/"][src$="-on.png"]')];
    if (pairs.length === 0 || location.protocol === "file:") return;
    if (!(await fetch(web, { method: "HEAD" })).ok) return;
    for (const image of pairs) {
      const demo = image.getAttribute("src").match(/([\w-]+)-on\.png$/)[1];
      const table = image.closest("table");
      const button = document.createElement("button");
      button.className = "md-button try";
      button.textContent = "Run it here";
      button.onclick = () => {
        const frame = document.createElement("iframe");
        frame.className = "try";
        frame.title = "The demo " + demo + ", running";
        frame.src = web + "#demo=" + demo;
        // One at a time: each has a whole editor in it.
        document.querySelectorAll("iframe.try").forEach((other) => { other.previousSibling.hidden = false; other.remove(); });
        button.hidden = true;
        button.after(frame);
      };
      (table.closest(".md-typeset__scrollwrap") || table).after(button);
    }
  });
})();
