function onSection() {
  if (unit == 1) {
    warning("Set the unit.");
  }
  redirectToFile("sub.nc");
  writeln("G0");
  closeRedirection();
  check(tool.number);
}
function check(number) {
  if (number > 5) {
    error("Tool " + number + " is not in the magazine.");
    return;
  }
}
