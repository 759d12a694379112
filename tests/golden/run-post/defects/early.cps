description = "Refuses as it is loaded";
function onOpen() {
  writeln("%");
}
error("The option of the five-axis head is missing.");
