// Pictures that can be used: below each is a button that opens Slipface as a page in its place, if the site has it in web/
// (scripts/build_web.sh). Without scripts, or without that folder, the pictures stand alone.
(() => {
  // A picture's address, and the link (docs/scripting.md, "Links") that shows what is on it; $1 is the group's text.
  const views = [
    [/\/hacks\/([\w-]+)-on\.png$/, "demo=$1&only=view"],
    [/\/hacks\/([\w-]+)-off\.png$/, "demo=$1&only=view"], // where it stands alone
    [/\/reach\/([\w-]+)\.png$/, "level=$1&camera=iso&reach=15&only=reach"],
    [/\/images\/probe\.png$/, "demo=step-up&camera=5.5,3.2,4.2,0.3,0.7,-0.6&probe=1.2,1.4,2.2,0.2,0.9,-2.2&only=probe"],
  ];
  const script = document.currentScript;
  const web = new URL("../../web/index.html", script.src);

  function add_button(image, link) {
    const button = document.createElement("button");
    button.className = "md-button try";
    button.textContent = "Run it here";
    button.onclick = () => {
      const frame = document.createElement("iframe");
      frame.className = "try";
      frame.title = image.alt + ", running";
      frame.src = web + "#" + link;
      // One at a time: each has a whole editor in it.
      document.querySelectorAll("iframe.try").forEach((other) => other.remove());
      document.querySelectorAll("button.try").forEach((other) => { other.hidden = other === button; });
      const table = image.closest("table");
      (table ? table.closest(".md-typeset__scrollwrap") || table : button).after(frame);
    };
    image.after(button);
  }

  addEventListener("DOMContentLoaded", async () => {
    const found = [];
    for (const image of document.images)
      for (const [picture, link] of views)
        if (picture.test(image.src) && !(image.closest("table") && /-off\.png$/.test(image.src))) found.push([image, link.replace("$1", image.src.match(picture)[1])]);
    if (found.length === 0 || location.protocol === "file:" || !(await fetch(web, { method: "HEAD" })).ok) return;
    for (const [image, link] of found) add_button(image, link);
  });
})();
