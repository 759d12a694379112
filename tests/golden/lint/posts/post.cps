// A post with defects of several kinds, and one that is suppressed.
properties = {
  stops: {title: "Stops", type: "boolean", value: true, scope: "post"}
};
var xyzFormat = createFormat({decimals:3, forceDecimal:true});
var zOutput = createVariable({onChange:function () {}, prefix:"Z"}, xyzFormat);
function onSection() {
  if (properties.stops) {
    writeln("M1");
  }
  writeHeader();
  writeTail(); // dotek: ignore post-undefined-name -- of another file
}
