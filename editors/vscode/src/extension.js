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

async function start() {
  const command = vscode.workspace.getConfiguration("dotek").get("path") || "dotek";
  const run = { command, args: ["lsp"], transport: TransportKind.stdio };
  client = new LanguageClient("dotek", "Dotek", { run, debug: run }, {
    documentSelector: languages.map((language) => ({ scheme: "file", language })),
    synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/dotek.toml") },
    middleware: {
      executeCommand: async (name, args, next) => show(await next(name, args)),
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
        const uri = client.code2ProtocolConverter.asUri(editor.document.uri);
        await show(await client.sendRequest("workspace/executeCommand", { command: "dotek." + command, arguments: [uri] }));
      }),
    );
  }
  await start();
};

exports.deactivate = () => client && client.stop();
