// node fusion-run.js KERNEL POST PREFIX JSON: runs a whole post on the kernel's double, prints NC text and errors.
// JSON: {"properties": .., "points": .., "tool": .., "cycle": ..}
"use strict";
const fs = require("fs");
const vm = require("vm");
const [kernel, post, prefix, json] = process.argv.slice(2);
vm.runInThisContext(fs.readFileSync(kernel, "utf8"));
vm.runInThisContext(fs.readFileSync(post, "utf8"));
const input = JSON.parse(json);
input.properties = Object.assign({dotekCycle: prefix}, input.properties);
let result;
try {
  result = vm.runInThisContext("dotekRun")(input);
} catch (failure) {
  console.log("failure: " + failure);
  process.exit(1);
}
process.stdout.write(result.text);
for (const error of [].concat(result.errors)) if (error !== "") console.log("error: " + error);
if (result.afterError) console.log("defect: written after an error");
