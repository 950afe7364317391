// The paper's equations as MathML with what places them on pages of rustdoc, as FOLDER/doc/equations.js, and what every page has in its head to load it, as FOLDER/header.html.
//   node rustdoc.cjs KATEX EQUATIONS FOLDER
const fs = require("fs");
const katex = require(process.argv[2]);

// A printed equation, or the form that holds where there is one.
const text = fs.readFileSync(process.argv[3], "utf8");
const equations = {};
for (const [, number, kind, , latex] of text.matchAll(/^% \((\d+)\) (\w+)(: .*)?\n((?:[^%\n].*\n|\n)*)/gm)) {
    if ((kind === "printed" || kind === "corrected") && latex.trim()) {
        equations[number] = {
            kind,
            math: katex.renderToString(latex, { displayMode: true, output: "mathml", throwOnError: true }),
        };
    }
}
if (Object.keys(equations).length < 70) throw new Error(`${Object.keys(equations).length} equations: more were there`);

// Runs in the browser.
function place(equations) {
    for (const block of document.querySelectorAll(".docblock > p, .docblock > ul > li")) {
        const named = new Set([...block.textContent.matchAll(/Eqs?\. \((\d+)\)/g)].map(([, number]) => number));
        for (const number of [...named].reverse().filter((number) => equations[number])) {
            const { kind, math } = equations[number];
            const shown = document.createElement("div");
            shown.className = "equation";
            shown.innerHTML = math + `<span>(${number}${kind === "corrected" ? ", corrected" : ""})</span>`;
            block.after(shown);
        }
    }
}
const style =
    ".equation { display: flex; align-items: center; gap: 1em; overflow: auto hidden; padding: 0.3em 0; margin: 0.3em 0 0.6em } " +
    ".equation .katex-error, .equation annotation { display: none } .equation > span:last-child { margin-left: auto }";
const folder = process.argv[4];
fs.mkdirSync(`${folder}/doc`, { recursive: true });
fs.writeFileSync(`${folder}/doc/equations.js`, `(${place})(${JSON.stringify(equations)});\n`);
// Pages know their way to the top.
function load() {
    const script = document.createElement("script");
    script.src = document.querySelector("meta[name=rustdoc-vars]").dataset.rootPath + "equations.js";
    document.head.append(script);
}
fs.writeFileSync(`${folder}/header.html`, `<style>${style}</style>\n<script>addEventListener("DOMContentLoaded", ${load})</script>\n`);
