// Builds bundle.js and licenses.txt: node build.mjs (npm run build).
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

// So that a test without a build tool finds a bundle that is older than its sources.
const made = [...readdirSync(join(here, "src")).sort().map((name) => join("src", name)), "package-lock.json", "build.mjs"];
const sum = createHash("sha256");
for (const name of made) sum.update(readFileSync(join(here, name), "utf8").replaceAll("\r\n", "\n"));

await build({
    entryPoints: [join(here, "src", "main.js")],
    outfile: join(here, "bundle.js"),
    bundle: true,
    minify: true,
    format: "iife",
    target: ["chrome90", "firefox90", "safari15"],
    charset: "ascii",
    banner: { js: `/* adamslite; SHA-256 of the sources: ${sum.digest("hex")} */` },
    legalComments: "none", // whole licences are in licenses.txt and in every page
    logLevel: "warning",
});

// A page holds the bundle between <script> and </script>.
const bundle = readFileSync(join(here, "bundle.js"), "utf8");
if (/<\/script|<!--/i.test(bundle)) throw new Error("the bundle would end its script element");

const { dependencies } = JSON.parse(readFileSync(join(here, "package.json"), "utf8"));
const licences = Object.keys(dependencies).map((name) => {
    const text = readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8").trim();
    return `${name} ${dependencies[name]}\n\n${text.replaceAll("\r\n", "\n")}\n`;
});
writeFileSync(join(here, "licenses.txt"), licences.join(`\n${"-".repeat(60)}\n\n`));
