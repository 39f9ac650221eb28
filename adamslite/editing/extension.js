// Starts `adamslite lsp` and translates between it and VS Code; needs no packages.
// Protocol: Language Server Protocol 3.17, JSON-RPC 2.0 over the pipes of a process.
"use strict";

const { spawn } = require("child_process");
const vscode = require("vscode");

const LANGUAGES = ["adams", "adams-command"];
const SELECTOR = LANGUAGES.map((language) => ({ language }));
const TRIGGERS = ["/", ",", "=", "(", " "];

// ---- the connection ---------------------------------------------------------------------------

class Connection {
  constructor(command, onNote, onEnd) {
    this.waiting = new Map();
    this.number = 0;
    this.data = Buffer.alloc(0);
    this.onNote = onNote;
    this.open = true;
    this.process = spawn(command[0], command.slice(1), { stdio: ["pipe", "pipe", "pipe"] });
    this.errors = "";
    const end = (reason) => {
      if (!this.open) return;
      this.open = false;
      for (const { reject } of this.waiting.values()) reject(new Error(reason));
      onEnd(this.errors.trim() || reason);
    };
    this.process.on("error", (fault) => end(String(fault.message)));
    this.process.on("exit", (code) => end(`it ended with exit code ${code}`));
    this.process.stdin.on("error", () => {});
    this.process.stderr.on("data", (data) => { this.errors = (this.errors + data).slice(-2000); });
    this.process.stdout.on("data", (data) => this.receive(data));
  }

  receive(data) {
    this.data = Buffer.concat([this.data, data]);
    for (;;) {
      const end = this.data.indexOf("\r\n\r\n");
      if (end < 0) return;
      const length = /content-length: *(\d+)/i.exec(this.data.toString("ascii", 0, end));
      const stop = end + 4 + Number(length[1]);
      if (this.data.length < stop) return;
      const message = JSON.parse(this.data.toString("utf8", end + 4, stop));
      this.data = this.data.subarray(stop);
      this.handle(message);
    }
  }

  handle(message) {
    if (message.method && message.id !== undefined) {
      this.send({ id: message.id, result: null }); // nothing that the server asks is needed
    } else if (message.method) {
      this.onNote(message.method, message.params);
    } else if (this.waiting.has(message.id)) {
      const { resolve, reject } = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message));
      else resolve(message.result);
    }
  }

  send(message) {
    if (!this.open) return;
    const data = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }), "utf8");
    this.process.stdin.write(`Content-Length: ${data.length}\r\n\r\n`);
    this.process.stdin.write(data);
  }

  notify(method, params) {
    this.send({ method, params });
  }

  request(method, params) {
    if (!this.open) return Promise.resolve(null);
    const id = ++this.number;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.send({ id, method, params });
    });
  }
}

// ---- from the protocol to VS Code ---------------------------------------------------------------

const toPosition = (p) => new vscode.Position(p.line, p.character);
const toRange = (r) => new vscode.Range(toPosition(r.start), toPosition(r.end));
const toLocation = (l) => new vscode.Location(vscode.Uri.parse(l.uri), toRange(l.range));

function toDiagnostic(each) {
  const found = new vscode.Diagnostic(toRange(each.range), each.message, each.severity - 1);
  found.code = each.code;
  found.source = each.source;
  found.relatedInformation = (each.relatedInformation || []).map(
    (related) => new vscode.DiagnosticRelatedInformation(toLocation(related.location), related.message)
  );
  return found;
}

function toItem(each) {
  const item = new vscode.CompletionItem(each.label, each.kind - 1);
  item.detail = each.detail;
  if (each.insertText) item.insertText = each.insertText;
  return item;
}

function toEdit(each) {
  const edit = new vscode.WorkspaceEdit();
  for (const [uri, changes] of Object.entries(each.changes || {})) {
    for (const change of changes) {
      edit.replace(vscode.Uri.parse(uri), toRange(change.range), change.newText);
    }
  }
  return edit;
}

function toSymbol(each) {
  return new vscode.DocumentSymbol(
    each.name, each.detail || "", each.kind - 1, toRange(each.range), toRange(each.selectionRange)
  );
}

function toAction(each) {
  const action = new vscode.CodeAction(each.title, vscode.CodeActionKind.QuickFix);
  action.edit = toEdit(each.edit);
  return action;
}

const fromRange = (r) => ({
  start: { line: r.start.line, character: r.start.character },
  end: { line: r.end.line, character: r.end.character },
});

// ---- the extension ------------------------------------------------------------------------------

function activate(context) {
  const diagnostics = vscode.languages.createDiagnosticCollection("adamslite");
  const opened = new Set();
  const command = vscode.workspace.getConfiguration("adamslite").get("command");
  const server = new Connection(
    command,
    (method, params) => {
      if (method === "textDocument/publishDiagnostics") {
        diagnostics.set(vscode.Uri.parse(params.uri), params.diagnostics.map(toDiagnostic));
      }
    },
    (reason) => {
      diagnostics.clear();
      vscode.window.showErrorMessage(`adamslite: the language server does not run: ${reason}`);
    }
  );
  const ready = server
    .request("initialize", { processId: process.pid, rootUri: null, capabilities: {} })
    .then(() => server.notify("initialized", {}), () => {});

  const ours = (document) => LANGUAGES.includes(document.languageId);
  const uriOf = (document) => document.uri.toString();
  const open = (document) => ready.then(() => {
    if (!ours(document) || opened.has(uriOf(document))) return;
    opened.add(uriOf(document));
    server.notify("textDocument/didOpen", {
      textDocument: {
        uri: uriOf(document), languageId: document.languageId,
        version: document.version, text: document.getText(),
      },
    });
  });
  const change = (event) => {
    const { document, contentChanges } = event;
    if (!opened.has(uriOf(document)) || contentChanges.length === 0) return;
    server.notify("textDocument/didChange", {
      textDocument: { uri: uriOf(document), version: document.version },
      contentChanges: contentChanges.map((each) => ({ range: fromRange(each.range), text: each.text })),
    });
  };
  const close = (document) => {
    if (!opened.delete(uriOf(document))) return;
    server.notify("textDocument/didClose", { textDocument: { uri: uriOf(document) } });
  };
  const ask = (method, document, params) =>
    open(document).then(() =>
      server.request(`textDocument/${method}`, { textDocument: { uri: uriOf(document) }, ...params })
    );
  const at = (p) => ({ position: { line: p.line, character: p.character } });
  const many = (make) => (found) => (found || []).map(make);

  const { languages, workspace } = vscode;
  context.subscriptions.push(
    diagnostics,
    { dispose: () => deactivate() },
    workspace.onDidOpenTextDocument(open),
    workspace.onDidChangeTextDocument(change),
    workspace.onDidCloseTextDocument(close),
    languages.registerHoverProvider(SELECTOR, {
      provideHover: (document, position) => ask("hover", document, at(position)).then((found) =>
        found && new vscode.Hover(new vscode.MarkdownString(found.contents.value), toRange(found.range))),
    }),
    languages.registerCompletionItemProvider(SELECTOR, {
      provideCompletionItems: (document, position) => ask("completion", document, at(position))
        .then((found) => many(toItem)(found && found.items)),
    }, ...TRIGGERS),
    languages.registerDefinitionProvider(SELECTOR, {
      provideDefinition: (document, position) =>
        ask("definition", document, at(position)).then(many(toLocation)),
    }),
    languages.registerReferenceProvider(SELECTOR, {
      provideReferences: (document, position, context) =>
        ask("references", document, { ...at(position), context }).then(many(toLocation)),
    }),
    languages.registerRenameProvider(SELECTOR, {
      prepareRename: (document, position) => ask("prepareRename", document, at(position)).then((found) => {
        if (!found) throw new Error("There is no id or name here.");
        return toRange(found);
      }),
      provideRenameEdits: (document, position, newName) =>
        ask("rename", document, { ...at(position), newName }).then(toEdit),
    }),
    languages.registerDocumentSymbolProvider(SELECTOR, {
      provideDocumentSymbols: (document) => ask("documentSymbol", document, {}).then(many(toSymbol)),
    }),
    languages.registerDocumentFormattingEditProvider(SELECTOR, {
      provideDocumentFormattingEdits: (document, options) => ask("formatting", document, { options })
        .then(many((each) => vscode.TextEdit.replace(toRange(each.range), each.newText))),
    }),
    languages.registerCodeActionsProvider(SELECTOR, {
      provideCodeActions: (document, range) =>
        ask("codeAction", document, { range: fromRange(range), context: { diagnostics: [] } })
          .then(many(toAction)),
    })
  );
  running = server;
  workspace.textDocuments.forEach(open);
}

let running;

function deactivate() {
  const server = running;
  running = undefined;
  if (!server || !server.open) return undefined;
  return server.request("shutdown").then(() => {
    server.open = false;
    server.process.stdin.write('Content-Length: 33\r\n\r\n{"jsonrpc":"2.0","method":"exit"}');
  }, () => {});
}

module.exports = { activate, deactivate };
