description = "The same within a buffer, which it drops";
function onOpen() {
  redirectToBuffer();
  try {
    for (;;) {
      write("G4");
    }
  } catch (e) {
    closeRedirection();
  }
}
