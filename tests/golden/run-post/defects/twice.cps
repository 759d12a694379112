description = "Declares twice";
let feed = 100;
let feed = 200;
function onOpen(size) {
  const size = feed;
  writeln("F" + size);
}
const inner = function inner() { let inner = 1; return inner; };
