// Search in pages that are opened as files. Browsers then allow neither fetching the index nor starting a worker: the index
// comes as a script instead, and the worker's script runs in a hidden frame.
if (location.protocol === "file:") {
    const site = new URL("../..", document.currentScript.src);
    window.__search = {
        index: new Promise(resolve => {
            window.take_search_index = resolve;
            const script = document.createElement("script");
            script.src = new URL("search/search_index.js", site);
            document.head.append(script);
        })
    };
    window.IFrameWorker = window.Worker = class extends EventTarget {
        constructor(url) {
            super();
            const frame = document.createElement("iframe");
            frame.hidden = true;
            frame.answer = data => this.dispatchEvent(new MessageEvent("message", { data }));
            frame.srcdoc = `<script>postMessage = data => frameElement.answer(data)</script><script src="${url}"></script>`;
            this.inside = new Promise(resolve => frame.addEventListener("load", () => resolve(frame.contentWindow)));
            document.body.append(frame);
        }
        postMessage(data) {
            this.inside.then(inside => inside.dispatchEvent(new MessageEvent("message", { data })));
        }
    };
}
