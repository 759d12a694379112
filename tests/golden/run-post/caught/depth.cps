description = "Takes what the engine says of its calls";
function deep(n) {
  return 1 + deep(n + 1);
}
function onClose() {
  var text = "G0";
  try {
    deep(0);
  } catch (e) {
    text = "G4";
  }
  writeln(text);
}
function onCyclePoint() {}
