// The private functions of a fragment, ES5. PREFIX stands for its prefix.
#include "backends/fusion/State.h"

#include <array>

namespace dotek::backends::fusion {

namespace {

struct HelperText {
  Helper which;
  std::string_view name;
  std::string_view text;
};

// What the names of shared functions begin with.
constexpr std::string_view kShared = "dotekShared";

constexpr std::array<HelperText, 24> kHelpers = {{
    {Helper::Given, "given",
     R"(// The decimal that was typed: a job keeps numbers in 32 bits, so 5.08 arrives as 5.079999923706055.
function PREFIX_given(value) {
  if (typeof value !== "number" || !isFinite(value) || value === 0) {
    return value;
  }
  var exponent = Math.floor(Math.log(Math.abs(value)) / Math.LN2);
  return value * Math.pow(2, 24 - exponent) % 1 === 0 ? Number(value.toPrecision(7)) : value;
}
)"},
    {Helper::IsNumber, "isNumber", R"(function PREFIX_isNumber(value) {
  return typeof value === "number" && isFinite(value);
}
)"},
    {Helper::Digits, "units",
     R"(// Digits of |value| in units of the last of `places` decimals, "" for 0: half away from zero on the
// shortest decimal text, to a multiple of `step`.
function PREFIX_units(value, places, step) {
  var parts = String(Math.abs(value)).split("e");
  var mantissa = parts[0].split(".");
  var digits = mantissa[0] + (mantissa.length > 1 ? mantissa[1] : "");
  var keep = mantissa[0].length + (parts.length > 1 ? Number(parts[1]) : 0) + places;
  while (digits.length <= keep) {
    digits += "0";
  }
  var units = keep > 0 ? digits.substring(0, keep).split("") : [];
  var half = keep >= 0 && digits.charAt(keep) >= "5";
  var rest = 0;
  var i;
  for (i = 0; i < units.length; ++i) {
    rest = (rest * 10 + Number(units[i])) % step;
  }
  var carry = (2 * rest >= step || (2 * rest + 1 === step && half) ? step : 0) - rest;
  for (i = units.length - 1; carry !== 0 && i >= 0; --i) {
    var sum = Number(units[i]) + carry;
    var digit = ((sum % 10) + 10) % 10;
    units[i] = String(digit);
    carry = (sum - digit) / 10;
  }
  return ((carry > 0 ? String(carry) : "") + units.join("")).replace(/^0+/, "");
}
)"},
    {Helper::Picture, "picture",
     R"(// Text of the value in a number picture, `body;zero;step`; null where it does not fit.
function PREFIX_picture(picture, value) {
  var parts = picture.split(";");
  var body = parts[0];
  var point = body.search(/[.^]/);
  var places = point < 0 ? body : body.substring(0, point);
  var decimals = point < 0 ? "" : body.substring(point + 1);
  var units = PREFIX_units(value, decimals.length, parts.length > 2 ? Number(parts[2]) : 1);
  var sign = value < 0 && units !== "" ? "-" : "";
  if (units.length - decimals.length > places.length) {
    return null;
  }
  if (units === "" && (parts.length > 1 || body.indexOf("0") < 0)) {
    return parts.length > 1 ? parts[1] : "";
  }
  while (units.length < decimals.length) {
    units = "0" + units;
  }
  var whole = units.substring(0, units.length - decimals.length);
  var fraction = units.substring(units.length - decimals.length).replace(/0+$/, "");
  var shown = places.indexOf("0") < 0 ? 0 : places.length - places.indexOf("0");
  while (whole.length < shown) {
    whole = "0" + whole;
  }
  while (fraction.length < decimals.lastIndexOf("0") + 1) {
    fraction += "0";
  }
  if (point >= 0 && body.charAt(point) === "^" && whole === "") {
    var drop = decimals.indexOf("0") < 0 ? fraction.length : Math.min(decimals.indexOf("0"), fraction.length);
    while (drop > 0 && fraction.charAt(0) === "0") {
      fraction = fraction.substring(1);
      --drop;
    }
  }
  return sign + whole + (point >= 0 && body.charAt(point) === "." ? "." : "") + fraction;
}
)"},
    {Helper::Shown, "shown", R"(// The number that the picture prints for the value.
function PREFIX_shown(picture, value) {
  var parts = picture.split(";");
  var point = parts[0].search(/[.^]/);
  var decimals = point < 0 ? 0 : parts[0].length - point - 1;
  var units = PREFIX_units(value, decimals, parts.length > 2 ? Number(parts[2]) : 1);
  return Number((value < 0 ? "-0" : "0") + units + "e-" + decimals);
}
)"},
    {Helper::Number, "number",
     R"(// Macro arguments go through a format without state: three decimals, always a point.
var PREFIX_format = createFormat({decimals: 3, forceDecimal: true});

// Text of the value; null where the control has not digits enough.
function PREFIX_number(value) {
  if (!(Math.abs(PREFIX_format.getResultingValue(value)) < LIMIT)) {
    return null;
  }
  return PREFIX_format.format(value);
}
)"},
    {Helper::Fine, "fine",
     R"(// A value in a formula of the control that no number of digits holds.
var PREFIX_fineFormat = createFormat({decimals: 6, forceDecimal: true});

// Text of the value; null where the control has not digits enough.
function PREFIX_fine(value) {
  if (!(Math.abs(value) < LIMIT)) {
    return null;
  }
  return PREFIX_fineFormat.format(value);
}
)"},
    {Helper::Loses, "warnOfDigits", R"(// Says where what is printed is another value than the one given.
function PREFIX_warnOfDigits(name, value, printed) {
  if (Math.abs(value - printed) > 1e-9) {
    warning(name + ": " + value + " has more digits than are printed; the machine gets " + printed);
  }
}
)"},
    {Helper::Comment, "comment", R"~(// A comment, as the post writes its own.
function PREFIX_comment(text) {
  if (typeof writeComment === "function") {
    writeComment(text);
  } else {
    writeln("(" + text + ")");
  }
}
)~"},
    {Helper::Truncate, "truncate", R"(function PREFIX_truncate(value) {
  return value < 0 ? Math.ceil(value) : Math.floor(value);
}
)"},
    {Helper::RoundUp, "roundUp", R"(function PREFIX_roundUp(value) {
  return value < 0 ? Math.floor(value) : Math.ceil(value);
}
)"},
    {Helper::Round, "round", R"(// To the nearest whole number, half away from zero.
function PREFIX_round(value) {
  var whole = Math.floor(Math.abs(value));
  if (Math.abs(value) - whole >= 0.5) {
    ++whole;
  }
  return value < 0 ? -whole : whole;
}
)"},
    {Helper::Divide, "divide", R"(function PREFIX_divide(a, b) {
  return b === 0 ? NaN : a / b;
}
)"},
    {Helper::Modulo, "modulo", R"(// Sign of the dividend.
function PREFIX_modulo(a, b) {
  return b === 0 ? NaN : a % b;
}
)"},
    {Helper::SquareRoot, "squareRoot", R"(function PREFIX_squareRoot(value) {
  return value < 0 ? NaN : Math.sqrt(value);
}
)"},
    {Helper::Sine, "sine", R"(// Degrees; exact at multiples of 90.
function PREFIX_sine(degrees) {
  var rest = degrees % 360;
  var quarter = (rest < 0 ? rest + 360 : rest) / 90;
  return quarter === Math.floor(quarter) ? [0, 1, 0, -1][quarter % 4] : Math.sin(degrees * Math.PI / 180);
}
)"},
    {Helper::Cosine, "cosine", R"(// Degrees; exact at multiples of 90.
function PREFIX_cosine(degrees) {
  var rest = degrees % 360;
  var quarter = (rest < 0 ? rest + 360 : rest) / 90;
  return quarter === Math.floor(quarter) ? [1, 0, -1, 0][quarter % 4] : Math.cos(degrees * Math.PI / 180);
}
)"},
    {Helper::Tangent, "tangent", R"(// Degrees.
function PREFIX_tangent(degrees) {
  var quarter = (degrees % 180) / 90;
  if (quarter === Math.floor(quarter)) {
    return quarter === 0 ? 0 : NaN;
  }
  return Math.tan(degrees * Math.PI / 180);
}
)"},
    {Helper::ArcSine, "arcSine", R"(function PREFIX_arcSine(value) {
  return Math.asin(value) * 180 / Math.PI;
}
)"},
    {Helper::ArcCosine, "arcCosine", R"(function PREFIX_arcCosine(value) {
  return Math.acos(value) * 180 / Math.PI;
}
)"},
    {Helper::ArcTangent, "arcTangent", R"(function PREFIX_arcTangent(value) {
  return Math.atan(value) * 180 / Math.PI;
}
)"},
    {Helper::Direction, "direction", R"(// Angle of the direction (x, y), degrees above -180 up to 180.
function PREFIX_direction(x, y) {
  return x === 0 && y === 0 ? NaN : Math.atan2(y === 0 ? 0 : y, x) * 180 / Math.PI;
}
)"},
    {Helper::Logarithm, "logarithm", R"(function PREFIX_logarithm(value) {
  return value > 0 ? Math.log(value) : NaN;
}
)"},
    {Helper::Bits, "bits", R"(// Bitwise, of whole numbers of 32 bits.
function PREFIX_bits(operation, a, b) {
  if (a !== (a | 0) || b !== (b | 0)) {
    return NaN;
  }
  return operation === "and" ? a & b : operation === "or" ? a | b : a ^ b;
}
)"},
}};

std::string filled(std::string_view text, const std::string& prefix, const std::string& limit) {
  std::string out(text);
  for (const auto& [mark, value] :
       {std::pair<std::string_view, const std::string&>{"PREFIX", prefix}, {"LIMIT", limit}})
    for (std::size_t at = out.find(mark); at != std::string::npos; at = out.find(mark, at + value.size()))
      out.replace(at, mark.size(), value);
  return out;
}

// Above what a word of the control holds.
std::string limitOf(const stdlib::Control& control) {
  return "1" + std::string(static_cast<std::size_t>(control.integerDigits), '0');
}

} // namespace

std::string State::helper(Helper which) {
  helpers.insert(which);
  if (which == Helper::Picture || which == Helper::Shown) helpers.insert(Helper::Digits);
  for (const HelperText& one : kHelpers)
    if (one.which == which)
      return (options.helpersApart ? std::string(kShared) : prefix) + "_" + std::string(one.name);
  return "";
}

std::string sharedHelpers(const stdlib::Control& control) {
  Script script;
  script.comment(
      "What the parts of a post share that Dotek writes with --helpers. Paste it once, before them.");
  for (const HelperText& one : kHelpers) {
    script.blank();
    script.text(filled(one.text, std::string(kShared), limitOf(control)));
  }
  std::string out;
  for (const EmittedLine& line : script.lines())
    out += line.text + "\n";
  return out;
}

void writeHelpers(State& state) {
  if (state.options.helpersApart) return;
  const std::string limit = limitOf(state.options.control);
  for (const HelperText& one : kHelpers) {
    if (!state.helpers.contains(one.which)) continue;
    state.script.text(filled(one.text, state.prefix, limit));
    state.script.blank();
  }
}

} // namespace dotek::backends::fusion
