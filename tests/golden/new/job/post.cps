properties = {
  useStop: {title: "Stop between tools", type: "boolean", value: true, scope: "post"},
  home: {title: "Home", type: "enum", value: "G28", values: [{title: "G28", id: "G28"}, {title: "G53", id: "G53"}], scope: "post"}
};
function onOpen() {
  writeln(getProperty("home"));
}
