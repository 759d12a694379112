// Cycles go into a buffer, and the program has them at its end.
description = "Subprograms at the end";
var subprogram = "";
function onOpen() {
  writeln("%");
}
function onCycle() {
  redirectToBuffer();
}
function onCyclePoint(x, y, z) {
  if (cycleType != "probing-x" && cycleType != "probing-x-wall") {
    error("only one axis is probed");
    return;
  }
  writeWords("G65", "P9811", "X" + x);
  write("G80");
}
function onCycleEnd() {
  subprogram += getRedirectionBuffer() + EOL;
  closeRedirection();
  writeln("M98 P1");
}
function onClose() {
  writeln("O1");
  write(subprogram);
  writeln("M99");
}
