description = "A private member";
class Tools { #count = 1; next() { return this.#count; } }
function onOpen() { writeln(new Tools().next()); }
