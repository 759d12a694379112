description = "Properties of each type";
minimumRevision = 45917;
capabilities = CAPABILITY_MILLING;
properties = {
  notes: {title: "Notes", type: "boolean", value: false, scope: "post"},
  step: {title: "Step", type: "integer", value: 5, range: [1, 100], scope: "post"},
  safe: {title: "Safe height", type: "spatial", value: 5, scope: "post"},
  method: {title: "Method", type: "enum", value: "G28", values: [{title: "G28", id: "G28"}, {title: "G53", id: "G53"}], scope: ["post", "operation"]},
  text: {title: "Text", type: "string", value: "", scope: "post"}
};
function onOpen() {
  writeln([getProperty("notes"), getProperty("step"), getProperty("safe"), getProperty("text")].join(" "));
}
function onSection() {
  writeln(currentSection.getProperty("method"));
}
