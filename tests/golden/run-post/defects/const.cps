description = "Assigns to what is const";
const speed = 100;
function onOpen() {
  writeln("S" + speed);
  speed += 50;
  writeln("S" + speed);
}
