// Decimal points and pictures: what the machine reads of what the post prints.
#include "tests/unit/NcHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using dotek::tests::lifted;
using dotek::tests::Nc;

namespace {

// Statements and codes of findings.
std::string both(const std::string& text, const std::string& control, const std::string& set = "easyprobe") {
  Nc nc(control, set);
  if (!nc.lift(text)) return "refused: " + nc.codes();
  return nc.shown() + nc.codes();
}

} // namespace

TEST_CASE("a length without a point counts as the control says, with both values in the warning") {
  CHECK(both("G0 Z50", "fanuc-0i-md") == "rapid Z=work:50\n[decimal-point]");
  CHECK(both("G0 Z50", "fanuc-6m") == "rapid Z=work:0.05\n[decimal-point]");
  CHECK(both("G0 Z-7", "fanuc-6m") == "rapid Z=work:-0.007\n[decimal-point]");
  CHECK(both("G0 Z50.", "fanuc-6m") == "rapid Z=work:50\n");
  CHECK(both("G0 Z0", "fanuc-6m") == "rapid Z=work:0\n");
  CHECK(both("G65 P9770 Z5", "fanuc-0i-md") == "protected Z=work:5\n[decimal-point]");
  CHECK(both("G65 P9023 S56 X10. I0", "fanuc-6m") == "surface X=here:10 sets 56 X=0\n");
  CHECK(both("G65 P9023 S56. X10 I1", "fanuc-6m") ==
        "surface X=here:0.01 sets 56 X=0.001\n[decimal-point], [decimal-point]");
  Nc nc;
  nc.lift("G0 Z-50 F5000");
  REQUIRE(nc.diagnostics.all().size() == 1);
  CHECK(nc.message() == "`Z-50` has no decimal point; the control `fanuc-0i-md` reads -50, with `decimal = "
                        "\"increment\"` it would be -0.05; write the point");
  CHECK(nc.pointedAt() == "Z-50");
}

TEST_CASE("digits of a constant are kept where the number is read as written") {
  const auto digits = [](const std::string& text, const std::string& control) {
    Nc nc(control);
    nc.lift(text);
    const auto& move = std::get<ir::Move>(nc.body.at(0).node);
    return std::get<ir::Constant>(move.axes[2]->value->node).digits;
  };
  CHECK(digits("G0 Z-5.50", "fanuc-0i-md") == "-5.50");
  CHECK(digits("G0 Z50", "fanuc-0i-md") == "50");
  CHECK(digits("G0 Z50", "fanuc-6m") == ""); // 0.05
  CHECK(digits("G0 Z-0.", "fanuc-0i-md") == "0.");
}

TEST_CASE("feeds, speeds, codes, selectors and diameters count whole units") {
  CHECK(both("G1 X1. F200", "fanuc-6m") == "feed X=work:1 F=200\n");
  CHECK(both("S500 M3", "fanuc-6m") == "spindle 1 S=500\n");
  CHECK(both("G65 P9811 X1. S3", "fanuc-6m", "inspection-plus") == "surface X=work:1 sets 56 X=1\n");
  CHECK(both("G65 P9770 Z1. F1000", "fanuc-6m") == "protected Z=work:1 F=1000\n");
  // D has no decimals in an argument of a call.
  CHECK(both("G65 P9023 D30 S56. I0 J0", "fanuc-0i-md") == "bore D=30 sets 56 X=0 Y=0\n");
}

TEST_CASE("the seconds of a dwell count like a length, its milliseconds never") {
  CHECK(both("G4 X5", "fanuc-31i-b") == "dwell 5\n[decimal-point]");
  CHECK(both("G4 X5", "fanuc-6m") == "dwell 0.005\n[decimal-point]");
  CHECK(both("G4 P500", "fanuc-6m") == "dwell 0.5\n");
}

TEST_CASE("words of an opaque block keep their number: only the same control gets them") {
  CHECK(both("G0 G43 H1 Z5", "fanuc-6m") == "opaque G0 G43 H1 Z5\n[opaque-block]");
}

TEST_CASE("a hole of an opaque block is scaled: the target writes it with a point") {
  CHECK(both("G0 G43 H{h|##} Z{a|###}", "fanuc-6m") ==
        "opaque G0 G43 Hh Z(a/1000)\n[decimal-point], [opaque-block]");
}

TEST_CASE("a picture without a point prints increments where the control counts them") {
  CHECK(both("G0 X{a|###}", "fanuc-0i-md") ==
        "rapid X=work:a\n[decimal-point], [picture-zero], [picture-decimals]");
  CHECK(both("G0 X{a|###}", "fanuc-6m") ==
        "rapid X=work:(a/1000)\n[decimal-point], [picture-zero], [picture-decimals]");
  CHECK(both("G0 X{a|###.###;0}", "fanuc-6m") == "rapid X=work:a\n"); // 0 is 0 either way
  CHECK(both("G0 X{a|}", "fanuc-6m") == "rapid X=work:a\n");
  CHECK(both("G1 X1. F{f|####}", "fanuc-6m") == "feed X=work:1 F=f\n");
  CHECK(both("G65 P9023 S{g|##} X1. I0.", "fanuc-6m") == "surface X=here:1 sets g X=0\n");
  // The point is implied: 5 prints 5000.
  CHECK(both("G0 X{a|###^000}", "fanuc-6m") == "rapid X=work:a\n[decimal-point]");
  CHECK(both("G0 X{a|###^000}", "fanuc-0i-md") == "rapid X=work:(a*1000)\n[decimal-point]");
  CHECK(both("G0 X{a|###^00}", "fanuc-6m") ==
        "rapid X=work:((a*100)/1000)\n[decimal-point], [picture-decimals]");
}

TEST_CASE("the warning of a hole without a point says both factors") {
  Nc nc("fanuc-6m");
  nc.lift("G0 X{a|###^00}");
  REQUIRE(nc.diagnostics.all().size() == 2);
  CHECK(nc.diagnostics.all()[0].message ==
        "what is printed for the field `a` has no decimal point; the control `fanuc-6m` reads 0.1 times its "
        "value, with `decimal = \"calculator\"` it would be 100 times its value; write the point");
  Nc zero;
  zero.fixed["a"] = 0;
  zero.lift("G0 X{a|##0}");
  CHECK(zero.codes() == "[picture-decimals]"); // 0 is 0 either way
}

TEST_CASE("a value that does not fit its picture is an error where it is fixed") {
  Nc nc;
  nc.fixed["a"] = 12345;
  CHECK_FALSE(nc.lift("G0 X{a|###.##;0}"));
  CHECK(nc.codes() == "[value-does-not-fit]");
  CHECK(nc.pointedAt() == "{a|###.##;0}");
  Nc fits;
  fits.fixed["a"] = 123;
  CHECK(fits.lift("G0 X{a|###.###;0}"));
  CHECK(fits.codes() == "");
  Nc open;
  CHECK(open.lift("G0 X{a|#.###;0}")); // any value may come
  CHECK(open.codes() == "");
  Nc bare;
  bare.fixed["a"] = 0;
  CHECK(bare.lift("G0 X{a|###.###}"));
  CHECK(bare.codes() == "[bare-address]");
}

TEST_CASE("a picture with fewer decimals than the control is one note with all that it prints") {
  Nc nc;
  CHECK(nc.lift("G0 X{a|###.##;0} Y{b|###.##;0}\nG0 X{a|###.##;0}\nG1 X1. F{f|###.##;0}"));
  CHECK(nc.codes() == "[picture-decimals]");
  CHECK(nc.message() == "the fields `a` and `b` are printed with the picture `###.##;0` of 2 decimals; the "
                        "converted program keeps up to 3");
  Nc several;
  CHECK(several.lift("G0 X{a|###.##;0} Y{b|###.#;0} Z{c|###.##;0}\nG0 X{d|###.##;0}"));
  CHECK(several.codes() == "[picture-decimals], [picture-decimals]");
  CHECK(several.diagnostics.all()[0].message.starts_with("the fields `a`, `c` and `d` are printed"));
  Nc one;
  CHECK(one.lift("G0 X{a|###.##;0}"));
  CHECK(one.message().starts_with("the field `a` is printed"));
  Nc selector;
  CHECK(selector.lift("G65 P9023 S{G|##.;0} X1. I0.")); // a system is no length
  CHECK(selector.codes() == "");
}
