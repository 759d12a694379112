// Starts `dotek lsp` and opens what its commands give beside the text.
"use strict";
const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

const languages = ["dotek-macrob", "dotek-mikroprog", "dotek-cycle", "dotek-gibbs", "dotek-compost"];
const commands = { postHere: "post", convertHere: "convert", runHere: "run", verifyHere: "verify", previewHere: "preview" };
let client;

// What a command of the server gives: a page in a web view, a text in an editor of its own.
async function show(result) {
  if (!result) return;
  if (result.status !== 0 && result.messages) vscode.window.showWarningMessage(result.messages.split("\n")[0]);
  if (result.language === "html") {
    const panel = vscode.window.createWebviewPanel("dotek", "Dotek: " + result.title, vscode.ViewColumn.Beside, { enableScripts: true });
    panel.webview.html = result.text;
    return;
  }
  const document = await vscode.workspace.openTextDocument({ language: result.language, content: result.text });
  await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preview: true });
}

// Runs a command on a text. Values that it refuses to do without are asked for, once each.
async function run(command, uri, target, more) {
  const params = { command, textDocument: { uri }, target: target || undefined, ...more };
  const asked = new Set();
  for (;;) {
    const result = await client.sendRequest("dotek/run", params);
    let given = false;
    for (const one of (result && result.missing) || []) {
      const key = one.option + " " + one.name;
      if (asked.has(key)) continue;
      asked.add(key);
      const value = await vscode.window.showInputBox({ title: "Dotek: " + one.name, prompt: one.title, ignoreFocusOut: true });
      if (!value) continue;
      if (one.option === "call") params.call = value;
      else params[one.option] = { ...params[one.option], [one.name]: value };
      given = true;
    }
    if (!given) return show(result);
  }
}

async function start() {
  const command = vscode.workspace.getConfiguration("dotek").get("path") || "dotek";
  const run = { command, args: ["lsp"], transport: TransportKind.stdio };
  client = new LanguageClient("dotek", "Dotek", { run, debug: run }, {
    documentSelector: [...languages.map((language) => ({ scheme: "file", language })), { scheme: "file", pattern: "**/*.cps" }],
    synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/dotek.toml") },
    middleware: {
      executeCommand: async (name, args, next) => {
        const command = name.replace(/^dotek\./, "");
        if (Object.values(commands).includes(command)) return run(command, args[0], args[1], { cycle: args[2] });
        return show(await next(name, args));
      },
    },
  });
  await client.start();
}

exports.activate = async (context) => {
  context.subscriptions.push(
    vscode.commands.registerCommand("dotek.restart", async () => {
      if (client) await client.stop();
      await start();
    }),
  );
  for (const [name, command] of Object.entries(commands)) {
    context.subscriptions.push(
      vscode.commands.registerCommand("dotek." + name, async () => {
        const editor = vscode.window.activeTextEditor;
        if (!editor || !client) return;
        await run(command, client.code2ProtocolConverter.asUri(editor.document.uri), undefined, { position: client.code2ProtocolConverter.asPosition(editor.selection.active) });
      }),
    );
  }
  await start();
};

exports.deactivate = () => client && client.stop();
