function onOpen() {
  for (;;) {
  }
}
