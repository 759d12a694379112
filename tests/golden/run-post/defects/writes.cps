description = "Writes as it is loaded, without end";
for (;;) {
  writeln("G0");
}
