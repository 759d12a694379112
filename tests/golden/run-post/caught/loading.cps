description = "Takes its own refusal as it is loaded";
try {
  error("The machine is not chosen.");
} catch (e) {
  description = "goes on";
}
function onClose() {
  writeln("M30");
}
