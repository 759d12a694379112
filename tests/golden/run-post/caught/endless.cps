description = "Goes on after the limit of its output";
function onOpen() {
  for (var i = 0; i < 2000; ++i) {
    try {
      writeln("G4");
    } catch (e) {
    }
  }
}
