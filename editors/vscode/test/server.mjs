// A client on the pipe, by vscode-jsonrpc: what Visual Studio Code says and gets.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import rpc from "vscode-jsonrpc/node.js";

const dotek = process.env.DOTEK ?? path.resolve(path.dirname(new URL(import.meta.url).pathname), "../../../build/release/dotek");
let passed = 0, failed = 0;
const check = (good, what) => {
  if (good) passed++;
  else { failed++; console.log("FAILED: " + what); }
};

const folder = mkdtempSync(path.join(tmpdir(), "dotek-server-"));
const file = path.join(folder, "O7301.nc");
const text = "O7301(SIDE)\nG65P9811X10.S54.\nIF[#1EQ#0]GOTO40\nN30M99\n";
writeFileSync(file, text);
const uri = pathToFileURL(file).href;

const server = spawn(dotek, ["lsp", "--stdio"]);
const exit = new Promise((resolve) => server.on("exit", resolve));
const connection = rpc.createMessageConnection(new rpc.StreamMessageReader(server.stdout), new rpc.StreamMessageWriter(server.stdin));
const waiting = [];
connection.onNotification("textDocument/publishDiagnostics", (params) => waiting.splice(0).forEach((done) => done(params)));
const findings = () => new Promise((resolve) => waiting.push(resolve));
connection.listen();

const initialized = await connection.sendRequest("initialize", { processId: process.pid, rootUri: null, capabilities: { general: { positionEncodings: ["utf-16"] } } });
check(initialized.capabilities.positionEncoding === "utf-16", "position encoding");
connection.sendNotification("initialized", {});
let next = findings();
connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "dotek-macrob", version: 1, text } });
let found = await next;
check(found.uri === uri && found.diagnostics.some((one) => one.code === "goto-target-missing"), "the jump to a block that is missing: " + JSON.stringify(found));
next = findings();
connection.sendNotification("textDocument/didChange", { textDocument: { uri, version: 2 }, contentChanges: [{ range: { start: { line: 3, character: 1 }, end: { line: 3, character: 3 } }, text: "40" }] });
found = await next;
check(found.version === 2 && !found.diagnostics.some((one) => one.code === "goto-target-missing"), "the repaired jump");
const hover = await connection.sendRequest("textDocument/hover", { textDocument: { uri }, position: { line: 1, character: 1 } });
check(/macro call/.test(hover.contents.value), "hover");
const hints = await connection.sendRequest("textDocument/inlayHint", { textDocument: { uri }, range: { start: { line: 0, character: 0 }, end: { line: 9, character: 0 } } });
check(hints.length === 2, "hints");
const run = await connection.sendRequest("workspace/executeCommand", { command: "dotek.explain", arguments: ["goto-target-missing"] });
check(run.language === "markdown" && run.text.length > 100, "explain");
const page = await connection.sendRequest("dotek/run", { command: "run", textDocument: { uri } });
check(page.language === "html" && /<html/.test(page.text) && Array.isArray(page.missing), "the page of a run");
let refused = false;
await connection.sendRequest("textDocument/noSuch", {}).catch(() => (refused = true));
check(refused, "an unknown method");
await connection.sendRequest("shutdown");
connection.sendNotification("exit");
check((await exit) === 0, "exit status");
connection.dispose();
rmSync(folder, { recursive: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
