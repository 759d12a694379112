// Files of parts, machines and meshes: what is read, and what is refused at its place.
#include "sim/geometry/PartFile.h"

#include "sim/geometry/Probe.h"
#include "support/Files.h"
#include "support/messages/Part.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"
#include "tests/unit/PartHelper.h"

#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <sys/stat.h>

using namespace dotek;
using namespace dotek::sim;
using namespace dotek::tests;

namespace {

struct Read {
  std::optional<PartFile> part;
  std::string findings; // "line:column code: message", one a line
};

std::string findingsOf(const Diagnostics& diagnostics, const SourceMap& sources) {
  std::string out;
  for (const Diagnostic& d : diagnostics.all()) {
    const LineColumn place =
        d.range.hasPlace() ? sources.file(d.range.file).place(d.range.begin) : LineColumn{0, 0};
    out += fmt::format("{}:{} {}: {}\n", place.line, place.column, d.code, d.message);
  }
  return out;
}

Read read(const std::string& text, const std::map<std::string, std::string>& meshes = {}) {
  SourceMap sources;
  Diagnostics diagnostics;
  const FileId id = sources.add(SourceFile("part.toml", "schema = 1\n" + text, Encoding::Utf8));
  const ReadMesh mesh = [&](const std::string& name, SourceRange) -> std::optional<std::string> {
    const auto found = meshes.find(name);
    return found == meshes.end() ? std::nullopt : std::optional(found->second);
  };
  Read out;
  out.part = readPart(id, sources, mesh, diagnostics);
  out.findings = findingsOf(diagnostics, sources);
  return out;
}

std::string shape(const std::string& keys) {
  return read("shape = [{" + keys + "}]\n").findings;
}

std::string machine(const std::string& text) {
  SourceMap sources;
  Diagnostics diagnostics;
  const FileId id = sources.add(SourceFile("machine.toml", "schema = 1\n" + text, Encoding::Utf8));
  const auto out = readMachine(id, sources, diagnostics);
  CHECK(out.has_value() == diagnostics.empty());
  return findingsOf(diagnostics, sources);
}

// The corners of the twelve triangles of a box, as STL states them.
std::vector<Point3> boxCorners(const Point3& a, const Point3& b) {
  std::vector<Point3> out;
  const auto corner = [&](int n) {
    return Point3{(n & 1) != 0 ? b.x : a.x, (n & 2) != 0 ? b.y : a.y, (n & 4) != 0 ? b.z : a.z};
  };
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    for (const int n : {0, 1, 2, 0, 2, 3})
      out.push_back(corner(f[n]));
  }
  return out;
}

std::string textStl(const std::vector<Point3>& corners) {
  std::string out = "solid box\n";
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (std::size_t k = n; k < n + 3; ++k)
      out += fmt::format("   vertex {} {} {:e}\n", corners[k].x, corners[k].y, corners[k].z);
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid box\n";
}

std::string binaryStl(const std::vector<Point3>& corners) {
  std::string out("solid written by a CAD, and yet binary");
  out.resize(80, ' ');
  const auto put = [&](const void* data, std::size_t size) {
    out.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(corners.size() / 3);
  put(&count, 4);
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    out.append(12, '\0');
    for (std::size_t k = n; k < n + 3; ++k) {
      const float v[3] = {static_cast<float>(corners[k].x), static_cast<float>(corners[k].y),
                          static_cast<float>(corners[k].z)};
      put(v, sizeof v);
    }
    out.append(2, '\0');
  }
  return out;
}

constexpr const char* kMesh = "shape = [{ kind = \"mesh\", file = \"box.stl\", unit = \"mm\" }]\n";

std::string meshFault(const std::string& stl) {
  const Read out = read(kMesh, {{"box.stl", stl}});
  CHECK(!out.part);
  return out.findings;
}

} // namespace

TEST_CASE("part file: the shipped examples are read and can be probed") {
  SourceMap sources;
  Diagnostics diagnostics;
  const auto part = loadPart((root() / "examples/plate-part.toml").string(), {}, {}, sources, diagnostics);
  const auto limits =
      loadMachine((root() / "examples/probe-machine.toml").string(), {}, sources, diagnostics);
  CHECK(findingsOf(diagnostics, sources) == "");
  REQUIRE(part);
  REQUIRE(limits);
  CHECK(limits->probe.effectiveRadius == 2.99);
  CHECK(limits->probe.centreLength() == 177);
  CHECK(limits->limits.travel[2]->least == -500);
  CHECK(!limits->probe.on);
  // Each shape where the file says it is.
  const Part& p = part->part;
  const auto depth = [&](const Point3& at) { return p.distance(p.toMachine(at)); };
  CHECK(depth({15, 20, -10}) < 0);
  CHECK(depth({30, 40, -10}) == doctest::Approx(15));            // bore
  CHECK(depth({70, 25, 11}) == doctest::Approx(-1));             // boss
  CHECK(depth({58, 60, -1}) == doctest::Approx(6));              // slot
  CHECK(depth({102, 40, 1}) == doctest::Approx(7));              // floor of the pocket
  CHECK(depth({8, 8, -10}) == doctest::Approx(3));               // hole
  CHECK(depth({8, 8, 20}) == doctest::Approx(std::sqrt(436.0))); // its countersink
  CHECK(lengthOf(p.toMachine({0, 0, 0}) - Point3{-299.88, -200.08, -399.97}) < 1e-9);
}

TEST_CASE("part file: each kind of shape") {
  const auto distance = [](const std::string& keys, const Point3& p) {
    const Read out = read("shape = [" + keys + "]\n");
    INFO(keys << "\n" << out.findings);
    REQUIRE(out.part);
    return out.part->part.distance(p);
  };
  CHECK(distance("{kind='half-space', at=[1,0,0], normal=[2,0,0]}", {4, 0, 0}) == doctest::Approx(3));
  CHECK(distance("{kind='sphere', at=[1,0,0], radius=2}", {6, 0, 0}) == doctest::Approx(3));
  CHECK(distance("{kind='cylinder', at=[0,0,0], diameter=4, height=10, axis=[1,0,0]}", {5, 5, 0}) ==
        doctest::Approx(3));
  CHECK(distance("{kind='cone', at=[0,0,0], diameter=6, top_diameter=0, height=4}", {0, 0, 6}) ==
        doctest::Approx(2));
  CHECK(distance("{kind='box', min=[-1,-1,-1], max=[1,1,1], corner=0.5, rotate=[0,0,45]}", {5, 0, 0}) ==
        doctest::Approx(5 - std::sqrt(0.5) - 0.5));
  CHECK(distance("{kind='boss', at=[0,0,0], size=[4,8], height=2, side=[0,1,0]}", {7, 0, 1}) ==
        doctest::Approx(3));
  CHECK(distance("{kind='box', min=[0,0,-9], max=[9,9,0]}, {kind='hole', at=[4,4,0], diameter=2, depth=3}",
                 {4, 4, -1}) == doctest::Approx(1));
  CHECK(distance("{kind='box', min=[0,0,-9], max=[9,9,0]}, {kind='hole', at=[4,9,-4], diameter=2, depth=3, "
                 "axis=[0,-1,0]}",
                 {4, 7, -4}) == doctest::Approx(1));
  CHECK(distance("{kind='intersection', of=[{kind='sphere', at=[0,0,0], radius=5}, {kind='half-space', "
                 "at=[0,0,1], normal=[0,0,1]}]}",
                 {0, 0, 3}) == doctest::Approx(2));
  CHECK(distance("{kind='difference', of=[{kind='sphere', at=[0,0,0], radius=5}, {kind='sphere', at=[0,0,0], "
                 "radius=3}]}",
                 {0, 0, 0}) == doctest::Approx(3));
  CHECK(distance("{kind='sphere', at=[0,0,0], radius=5}, {kind='box', min=[-9,-9,-9], max=[9,9,0], "
                 "action='keep'}",
                 {0, 0, 2}) == doctest::Approx(2));
}

TEST_CASE("part file: what is refused, and where") {
  CHECK(read("").findings == "1:1 toml-value: `shape` is missing; a list of shapes, [[shape]] is expected\n");
  CHECK(read("shape = []\n").findings ==
        "2:9 part-refused: the part cannot be used: the part has no shape\n");
  CHECK(shape("kind='sphere', at=[0,0,0], radius=1, colour='red'")
            .find("2:48 toml-unknown-key: unknown key `colour`") == 0);
  CHECK(shape("kind='ball', at=[0,0,0]").find("2:16 toml-value: `kind` is \"ball\"; one of \"box\"") == 0);
  CHECK(shape("kind='sphere', at=[0,0], radius=1") ==
        "2:29 toml-value: three numbers [x, y, z] are expected\n");
  CHECK(shape("kind='sphere', at=[0,0,0], radius=1, diameter=2") ==
        "2:10 toml-value: `diameter` and `radius` are together; write one of them\n");
  CHECK(shape("kind='sphere', at=[0,0,0], radius=-1") ==
        "2:45 toml-value: `radius` is below 0.001 mm, which makes no solid\n");
  CHECK(shape("kind='sphere', at=[0,0,0], radius=nan") == "2:45 toml-value: `radius` is no finite number\n");
  CHECK(shape("kind='sphere', at=[0,0,0]").find("`diameter` is missing") != std::string::npos);
  CHECK(shape("kind='sphere', at=[0,0,1e9], radius=1") ==
        "2:10 toml-value: a sphere reaches beyond 20000 mm\n");
  CHECK(shape("kind='box', min=[0,0,0], max=[1,1,0]") ==
        "2:10 toml-value: `min` of the box is not below `max` in each axis\n");
  CHECK(shape("kind='box', min=[0,0,0], max=[1,1,1], corner=0.6") ==
        "2:10 toml-value: the corners of a box are rounder than its sides are wide\n");
  CHECK(shape("kind='half-space', at=[0,0,0], normal=[0,0,0]").find("`normal` is no direction") !=
        std::string::npos);
  CHECK(shape("kind='cone', at=[0,0,0], diameter=0, top_diameter=0, height=1") ==
        "2:10 toml-value: both ends of the cone are points\n");
  CHECK(shape("kind='slot', from=[0,0,0], to=[0,0,0], width=1, depth=1") ==
        "2:10 toml-value: `from` and `to` of the slot are the same point; write a hole\n");
  CHECK(shape("kind='slot', from=[0,0,0], to=[5,0,1], width=1, depth=1") ==
        "2:10 toml-value: `from` and `to` of the slot lie at different depths along `axis`\n");
  CHECK(shape("kind='hole', at=[0,0,0], diameter=1, depth=1, through=true") ==
        "2:54 toml-value: `depth` and `through` are together; write one of them\n");
  CHECK(shape("kind='pocket', at=[0,0,0], size=[1], depth=1").find("two lengths are expected") !=
        std::string::npos);
  CHECK(shape("kind='pocket', at=[0,0,0], size=[1,1], depth=1, side=[1,0,1]").find("not square to `axis`") !=
        std::string::npos);
  CHECK(shape("kind='union', of=[]").find("a group is empty") != std::string::npos);
  CHECK(shape("kind='difference', of=[{kind='hole', at=[0,0,0], diameter=1, depth=1}]")
            .find("a hole removes by itself") != std::string::npos);
  CHECK(shape("kind='hole', at=[0,0,0], diameter=1, depth=1") ==
        "2:9 part-refused: the part cannot be used: the first shape of a list removes or keeps, and nothing "
        "is there "
        "yet\n");
  CHECK(read("shape = 3\n").findings.find("a list of tables is expected") != std::string::npos);
  CHECK(
      read("shape = [{kind='sphere', at=[0,0,0], radius=1}]\nplace = { shift = 4 }\n").findings.find("3:") ==
      0);
  CHECK(read("shape = [{kind='sphere', at=[0,0,0], radius=1}]\nshape = []\n").findings.find("toml-syntax") !=
        std::string::npos);
  std::string deep = "{kind='sphere', at=[0,0,0], radius=1}";
  for (int n = 0; n < 40; ++n)
    deep = "{kind='union', of=[" + deep + "]}";
  CHECK(read("shape = [" + deep + "]\n").findings.find("groups are nested deeper than 16") !=
        std::string::npos);
  std::string many;
  for (int n = 0; n < 5000; ++n)
    many += "[[shape]]\nkind='sphere'\nat=[0,0,0]\nradius=1\n";
  CHECK(read(many).findings.find("more than 200 shapes") != std::string::npos);
}

TEST_CASE("part file: codes") {
  const auto starts = [](const std::string& findings, std::string_view code) {
    return findings.find(fmt::format(" {}: ", code)) != std::string::npos;
  };
  CHECK(starts(read("shape = []\n").findings, diag::PartRefused::code));
  CHECK(starts(meshFault("solid"), diag::PartMesh::code));
}

TEST_CASE("mesh: a cube of triangles is a box") {
  PartBuilder builder;
  builder.box({-5, -4, -3}, {5, 6, 7});
  const auto box = finish(builder);
  const std::vector<Point3> corners = boxCorners({-5, -4, -3}, {5, 6, 7});
  for (const std::string& stl : {textStl(corners), binaryStl(corners)}) {
    const Read out = read(kMesh, {{"box.stl", stl}});
    INFO(out.findings);
    REQUIRE(out.part);
    PartRandom random(3);
    for (int n = 0; n < 3000; ++n) {
      const Point3 p = random.point(12);
      CHECK(std::abs(out.part->part.distance(p) - box->distance(p)) < 1e-9);
      if (n % 20 != 0) continue;
      const Point3 from = random.direction() * 40, to = random.point(6);
      const auto here = firstContact(*box, 2, from, to), there = firstContact(out.part->part, 2, from, to);
      REQUIRE(here.has_value() == there.has_value());
      const double length = lengthOf(to - from);
      if (here) CHECK(std::abs(here->share - there->share) * length < 1e-8);
      // The stem may lie almost along its path: within 1 um it is some more of it.
      const Capsule stem{from, from + Point3{0, 0, 20}, 1};
      const auto a = firstCollision(*box, stem, to - from);
      const auto b = firstCollision(out.part->part, stem, to - from);
      REQUIRE(a.has_value() == b.has_value());
      if (a) CHECK(std::abs(*a - *b) * length < 0.05);
    }
  }
  // Inches, placed, and beside a shape.
  const Read out =
      read("shape = [{kind='mesh', file='box.stl', unit='inch', shift=[10,0,0], rotate=[0,0,90]}, "
           "{kind='sphere', at=[0,0,500], radius=1}]\n",
           {{"box.stl", textStl(corners)}});
  REQUIRE(out.part);
  CHECK(out.part->part.distance({10 - 6 * 25.4 - 2, 0, 0}) == doctest::Approx(2));
  CHECK(out.part->part.distance({0, 0, 503}) == doctest::Approx(2));
}

TEST_CASE("mesh: what is refused") {
  std::vector<Point3> corners = boxCorners({0, 0, 0}, {1, 1, 1});
  CHECK(meshFault("") ==
        "2:34 part-mesh: the mesh `box.stl` is not read: it is no STL: it has 0 bytes and does not "
        "begin with `solid`\n");
  CHECK(meshFault("solid a\nendsolid a\n").find("it holds no triangle") != std::string::npos);
  CHECK(meshFault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x\n")
            .find("line 4: a number is expected, found `x`") != std::string::npos);
  CHECK(meshFault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 1e300\n").find("beyond") !=
        std::string::npos);
  CHECK(meshFault("solid a\nfacet").find("found the end of the file") != std::string::npos);
  const std::string binary = binaryStl(corners);
  CHECK(meshFault(binary.substr(0, 400)).find("solid") != std::string::npos);
  std::string header(80, 'x');
  CHECK(meshFault(header + "\xff\xff\xff\xff").find("announces 4294967295 triangles") != std::string::npos);
  std::string nan = binary;
  std::memcpy(nan.data() + 84 + 12, "\x00\x00\xc0\x7f", 4);
  CHECK(meshFault(nan).find("triangle 1 has a coordinate that is no number") != std::string::npos);
  std::vector<Point3> open(corners.begin(), corners.end() - 3);
  CHECK(meshFault(textStl(open)).find("it is not closed: 3 edges") != std::string::npos);
  std::vector<Point3> inward = corners;
  for (std::size_t n = 0; n < inward.size(); n += 3)
    std::swap(inward[n], inward[n + 1]);
  CHECK(meshFault(textStl(inward)).find("face inward") != std::string::npos);
  std::vector<Point3> turned = corners;
  std::swap(turned[0], turned[1]);
  CHECK(meshFault(textStl(turned)).find("face opposite sides") != std::string::npos);
  std::vector<Point3> twice = corners;
  twice.insert(twice.end(), corners.begin(), corners.end());
  CHECK(meshFault(textStl(twice)).find("more than two triangles") != std::string::npos);
  const Read cut =
      read("shape = [{kind='mesh', file='b', unit='mm'}, {kind='hole', at=[0,0,0], diameter=1, depth=1}]\n",
           {{"b", textStl(corners)}});
  CHECK(cut.findings.find("model it in the CAD") != std::string::npos);
  CHECK(read("shape = [{kind='mesh', file='b'}]\n", {{"b", textStl(corners)}})
            .findings.find("`unit` is missing") != std::string::npos);
  // A file that is not there is reported by who reads it.
  SourceMap sources;
  Diagnostics diagnostics;
  CHECK(!loadPart("no-such-part.toml", {}, {}, sources, diagnostics));
  CHECK(diagnostics.hasErrors());
}

TEST_CASE("machine file: what is refused, and where") {
  const std::string good = "ball_diameter = 6\nlength = 100\nlength_to = \"tip\"\non = true\n";
  CHECK(machine("[probe]\n" + good) == "");
  // A mill without a probe; a tool setter is pushed by a tool or the probe.
  CHECK(machine("[travel]\nx = [-600.0, 0.0]\n") == "");
  CHECK(machine("[tool_setter]\n").find("`probe` is missing") != std::string::npos);
  CHECK(machine("[probe]\nball_diameter = 6\n").find("`length_to` is missing") != std::string::npos);
  CHECK(machine("[probe]\n" + good + "stem_diameter = 4\n")
            .find("`stem_diameter` and `stem_length` go together") != std::string::npos);
  CHECK(machine("[probe]\n" + good + "stem_diameter = 6\nstem_length = 9\n")
            .find("not thinner than the ball") != std::string::npos);
  CHECK(machine("[probe]\n" + good + "body_diameter = 6\nbody_length = 9\n").find("sits on the stem") !=
        std::string::npos);
  CHECK(machine("[probe]\n" + good + "effective_radius = 3.1\n")
            .find("7:20 toml-value: `effective_radius` is 3.1") == 0);
  CHECK(machine("[probe]\n" + good + "pre_travel = 0.1\novertravel = 0.1\n")
            .find("would break before the signal") != std::string::npos);
  CHECK(machine("[probe]\n" + good + "noise = 1\n").find("0 to 0.1 mm is expected") != std::string::npos);
  CHECK(machine("[probe]\n" + good + "nois = 1\n").find("toml-unknown-key") != std::string::npos);
  CHECK(machine("[travel]\nx = [5, 5]\n[probe]\n" + good).find("3:5 toml-value: two ends of the travel") ==
        0);
}

TEST_CASE("mesh: a file on disk is read below the folder of the part, or where the bounds say") {
  const DataFolder folder;
  const std::string at = folder.path();
  const std::string stl = textStl(boxCorners({0, 0, 0}, {1, 2, 3}));
  folder.write("models/bracket.stl", stl);
  folder.write("jobs/own/flange.stl", stl);
  const auto load = [&](const std::string& mesh, const ReadBounds& bounds) {
    SourceMap sources;
    Diagnostics diagnostics;
    const std::string path =
        folder.write("jobs/own/part.toml",
                     "schema = 1\nshape = [{ kind = \"mesh\", file = \"" + mesh + "\", unit = \"mm\" }]\n");
    const auto part = loadPart(path, {}, bounds, sources, diagnostics);
    CHECK(part.has_value() == !diagnostics.hasErrors());
    return part ? std::string() : findingsOf(diagnostics, sources);
  };
  const ReadBounds own{{at + "/jobs/own"}};
  CHECK(load("flange.stl", own).empty());
  CHECK(load("../own/flange.stl", own).empty());
  CHECK(load("../../models/bracket.stl", {{at + "/jobs/own", at + "/models"}}).empty());
  CHECK(load(at + "/models/bracket.stl", {{at}}).empty());
  const std::string outside = load("../../models/bracket.stl", own);
  CHECK(outside.starts_with("2:34 include-outside: `" + at +
                            "/jobs/own/../../models/bracket.stl` is not in `" + at + "/jobs/own`"));
  CHECK(load("/etc/hostname", own).starts_with("2:34 include-outside: "));
  std::filesystem::create_symlink(at + "/models/bracket.stl", at + "/jobs/own/linked.stl");
  CHECK(load("linked.stl", own).starts_with("2:34 include-outside: "));
  REQUIRE(mkfifo((at + "/jobs/own/pipe.stl").c_str(), 0600) == 0);
  CHECK(load("pipe.stl", own).find("it is no regular file") != std::string::npos);
}

TEST_CASE("part file: a model in its place") {
  const auto told = [](const std::string& path) {
    SourceMap sources;
    Diagnostics diagnostics;
    CHECK(!loadPart(path, {}, {}, sources, diagnostics));
    return findingsOf(diagnostics, sources);
  };
  CHECK(told("models/Flange.STL").find("`file = \"Flange.STL\"`") != std::string::npos);
  CHECK(told("flange.stp").find("export it as STL") != std::string::npos);
  CHECK(told("flange.toml").starts_with("0:0 file-not-found"));
}
