function onOpen() {
  var later = [];
  for (let i = 0, last = function () { return i; }; i < 3; ++i) {
    later.push(last);
  }
}
