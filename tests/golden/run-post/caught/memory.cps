description = "Takes what the engine says of its memory";
function onClose() {
  var text = "G4";
  try {
    for (;;) {
      text += text;
    }
  } catch (e) {
    text = "G0";
  }
  writeln(text);
}
function onCyclePoint() {}
