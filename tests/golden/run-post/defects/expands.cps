function onCyclePoint(x, y, z) {
  expandCyclePoint(x, y, z);
}
