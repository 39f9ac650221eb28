// Runs the extension in a stand-in for VS Code; prints what it registers and what it shows.
// node vscode_host.js EXTENSION.js COMMAND...
"use strict";

const Module = require("module");
const [, , extension, ...command] = process.argv;

class Made { constructor(...args) { Object.assign(this, { args }); } }
class Edit { constructor() { this.changes = []; } replace(uri, range, text) { this.changes.push({ uri, range, text }); } }
const providers = {};
const events = {};
const shown = {};
const languages = new Proxy({
  createDiagnosticCollection: () => ({
    set: (uri, found) => { shown[uri] = found; step(); }, clear: () => {}, dispose: () => {},
  }),
}, { get: (target, name) => target[name] || ((selector, provider) => { providers[name] = provider; return {}; }) });
const lines = ["a title", "PART/1, GROUND", "MARKER/1, PARD=1", "END", ""];
const document = {
  languageId: "adams", version: 1, uri: { toString: () => "file:///nowhere/a.adm" },
  getText: () => lines.join("\n"),
};
const vscode = {
  Position: class { constructor(line, character) { Object.assign(this, { line, character }); } },
  Range: class { constructor(start, end) { Object.assign(this, { start, end }); } },
  Location: Made, Hover: Made, MarkdownString: Made, DocumentSymbol: Made, WorkspaceEdit: Edit,
  Diagnostic: class { constructor(range, message, severity) { Object.assign(this, { range, message, severity }); } },
  DiagnosticRelatedInformation: Made, CodeActionKind: { QuickFix: "quickfix" },
  CodeAction: class { constructor(title, kind) { Object.assign(this, { title, kind }); } },
  CompletionItem: class { constructor(label, kind) { Object.assign(this, { label, kind }); } },
  TextEdit: { replace: (range, text) => ({ range, text }) },
  Uri: { parse: (text) => text },
  languages,
  window: { showErrorMessage: (text) => { console.log(JSON.stringify({ error: text })); } },
  workspace: {
    textDocuments: [document],
    getConfiguration: () => ({ get: () => command }),
    onDidOpenTextDocument: (f) => { events.open = f; return {}; },
    onDidChangeTextDocument: (f) => { events.change = f; return {}; },
    onDidCloseTextDocument: (f) => { events.close = f; return {}; },
  },
};
const load = Module._load;
Module._load = (name, ...rest) => (name === "vscode" ? vscode : load(name, ...rest));
const { activate, deactivate } = require(extension);

let steps = 0;
async function step() {
  steps += 1;
  const told = shown["file:///nowhere/a.adm"].map((each) => [each.code, each.severity, each.range.start.line]);
  if (steps === 1) {
    const at = { line: 2, character: 1 };
    const hover = await providers.registerHoverProvider.provideHover(document, at);
    const items = await providers.registerCompletionItemProvider.provideCompletionItems(document, { line: 2, character: 10 });
    const range = { start: { line: 2, character: 10 }, end: { line: 2, character: 14 } };
    const actions = await providers.registerCodeActionsProvider.provideCodeActions(document, range);
    const symbols = await providers.registerDocumentSymbolProvider.provideDocumentSymbols(document);
    console.log(JSON.stringify({
      told, hover: hover.args[0].args[0].slice(0, 9), labels: items.map((each) => each.label),
      actions: actions.map((each) => [each.title, each.edit.changes[0].text]),
      symbols: symbols.map((each) => each.args[0]),
    }));
    lines[2] = "MARKER/1, PART=1";
    document.version = 2;
    events.change({ document, contentChanges: [{ range, text: "PART" }] });
  } else {
    console.log(JSON.stringify({ told }));
    await deactivate();
  }
}

activate({ subscriptions: [] });
