description = "Calls itself without end";
function deep(n) {
  return 1 + deep(n + 1);
}
function onSection() {
  deep(0);
}
