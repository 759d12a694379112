function onOpen() {
  writeBlock("G0" "X1");
}
function onSection() {
  if (isFirstSection()) {
    writeln("G54");
}
function onClose() {
  var list = [1, 2;
}
