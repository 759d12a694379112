description = "Manual NC without onManualNC";
capabilities = CAPABILITY_MILLING;
function onParameter(name, value) {
  if (name == "action" || name == "print" || name == "display") {
    writeln("(" + name + " " + value + ")");
  }
}
function onComment(text) { writeln("(" + text + ")"); }
function onPassThrough(text) { writeln(text); }
function onDwell(seconds) { writeln("G4 X" + seconds); }
function onCommand(command) { writeln(command == COMMAND_STOP ? "M0" : getCommandStringId(command)); }
function onOpen() { FileSystem.copyFile("a", "b"); }
class Tool { constructor(number) { this.number = number; } }
function onClose() { writeln("T" + new Tool(3).number); try { Tool(4); } catch (e) { writeln(e.message); } }
