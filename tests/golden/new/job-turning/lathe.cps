description = "A lathe";
capabilities = CAPABILITY_TURNING;
function onSection() {
  writeln("T" + tool.number + (isTurning() ? " turning" : ""));
}
function onRapid(x, y, z) {
  writeWords("G0", "X" + x * 2, "Z" + z);
}
function onLinear(x, y, z, feed) {
  writeWords("G1", "X" + x * 2, "Z" + z);
}
function onCircular(clockwise, cx, cy, cz, x, y, z, feed) {
  if (getCircularPlane() != PLANE_ZX) {
    error("only arcs in ZX");
    return;
  }
  writeWords(clockwise ? "G2" : "G3", "X" + x * 2, "Z" + z);
}
