description = "Replaces what the kernel works with";
Array.prototype.push = function () { return 0; };
function onOpen() {
  writeln("G21");
}
