function onOpen() {
  while (true) {
    writeln("G4");
  }
}
