// The grammars on lines whose words are known, and on every example: no line may lose its words.
import { readFileSync, readdirSync, statSync, existsSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import oniguruma from "vscode-oniguruma";
import textmate from "vscode-textmate";

const require = createRequire(import.meta.url);
const root = path.resolve(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), "..");
const wasm = readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async (scope) => {
    const file = path.join(root, "syntaxes", scope.split(".").pop() + ".tmLanguage.json");
    return textmate.parseRawGrammar(readFileSync(file, "utf8"), file);
  },
});

let passed = 0, failed = 0;
const check = (good, what) => {
  if (good) passed++;
  else { failed++; console.log("FAILED: " + what); }
};

// [language, line, word, part of its scope]
const cases = [
  ["macrob", "N10 G65 P9811 X#24 (SIDE)", "G65", "call"],
  ["macrob", "N10 G65 P9811 X#24 (SIDE)", "(SIDE)", "comment"],
  ["macrob", "N10G1X10.", "N10", "label"],
  ["macrob", "IF[#1EQ#0]GOTO40", "GOTO", "control"],
  ["macrob", "IF[#1EQ#0]GOTO40", "EQ", "operator"],
  ["macrob", "#101=ABS[#1]+SQRT[2.]", "SQRT", "function"],
  ["macrob", "WHILE[#1LT5]DO1", "DO1", "control"],
  ["macrob", "O9103(BORE)", "O9103", "program"],
  ["mikroprog", "N30 G31 X4 L90 ;nahore", "L", "control"],
  ["mikroprog", "N30 G31 X4 L90 ;nahore", ";nahore", "comment"],
  ["cycle", "touch x by -depth -> left", "touch", "probing"],
  ["cycle", "parameter depth : length = 5 mm \"How deep\"", "length", "type"],
  ["cycle", "parameter depth : length = 5 mm \"How deep\"", "\"How deep\"", "string"],
  ["cycle", "parameter depth : length = 5 mm \"How deep\"", "mm", "unit"],
  ["gibbs", "if D < 2*radius then wrong = 1 ! too small", "then", "control"],
  ["gibbs", "if D < 2*radius then wrong = 1 ! too small", "! too small", "comment"],
  ["gibbs", ":ask", ":ask", "label"],
  ["compost", "SeqC ' G65 P9023 X'OpFieldData#('X') EOL", "' G65 P9023 X'", "string"],
  ["compost", "SeqC ' G65 P9023 X'OpFieldData#('X') EOL", "EOL", "eol"],
  ["compost", "probe:", "probe", "routine"],
];
for (const [language, line, word, scope] of cases) {
  const grammar = await registry.loadGrammar("source.dotek." + language);
  const { tokens } = grammar.tokenizeLine(line, textmate.INITIAL);
  const at = line.indexOf(word);
  // A word may be one token or several of one scope.
  const hit = tokens.filter((one) => one.startIndex < at + word.length && one.endIndex > at);
  check(hit.length > 0 && hit.every((one) => one.scopes.some((s) => s.includes(scope))), `${language}: ${word} of \`${line}\` is ${JSON.stringify(hit.map((one) => one.scopes))}`);
}

const kinds = { ".nc": "macrob", ".suf": "mikroprog", ".cycle": "cycle", ".mac": "gibbs", ".dlg": "gibbs" };
const folders = [path.join(root, "../../examples"), path.join(root, "../../stdlib"), process.env.DOTEK_CORPUS ?? path.join(root, "../../../shared/corpus")];
const files = [];
const walk = (folder) => {
  for (const name of readdirSync(folder).sort()) {
    const file = path.join(folder, name);
    if (statSync(file).isDirectory()) walk(file);
    else if (kinds[path.extname(name).toLowerCase()]) files.push(file);
  }
};
for (const folder of folders) if (existsSync(folder)) walk(folder);
for (const file of files) {
  const grammar = await registry.loadGrammar("source.dotek." + kinds[path.extname(file).toLowerCase()]);
  let state = textmate.INITIAL, words = 0, plain = 0;
  for (const line of readFileSync(file, "latin1").split(/\r?\n/)) {
    const result = grammar.tokenizeLine(line, state);
    state = result.ruleStack;
    for (const token of result.tokens) {
      if (!/[A-Za-z0-9#]/.test(line.slice(token.startIndex, token.endIndex))) continue;
      words++;
      if (token.scopes.length === 1) plain++;
    }
  }
  check(words === 0 || plain / words < 0.05, `${file}: ${plain} of ${words} words have no scope`);
}
console.log(`${files.length} files`);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
