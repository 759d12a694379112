description = "Takes its own refusal";
function onSection() {
  try {
    error("The option is missing.");
  } catch (e) {
    writeln("(caught)");
  }
}
function onClose() {
  writeln("M30");
}
