#include "sim/geometry/PartFile.h"

#include "stdlib/Toml.h"
#include "support/Ascii.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

using Action = PartBuilder::Action;

constexpr double kThrough = 5000; // mm: how far a through hole goes, both paths

class Reader {
public:
  Reader(const TomlDocument& document, const ReadMesh& readMesh, Diagnostics& diagnostics)
      : document_(document), readMesh_(readMesh), diagnostics_(diagnostics) {}

  Placement placement(const TomlTable& table) {
    Placement out;
    out.shift = point(table.value("shift"), {});
    out.turn = point(table.value("rotate"), {});
    return out;
  }

  void list(const std::vector<TomlTable>& tables) {
    for (const TomlTable& table : tables)
      shape(table, std::nullopt);
  }

  PartBuilder builder;

private:
  void fail(const TomlTable& table, const std::string& what) { document_.fail(table.range(), what); }

  Point3 point(const TomlValue& value, const Point3& fallback) {
    if (!value) return fallback;
    const std::vector<double> n = value.numbers();
    if (value.isArray() && n.size() == 3) return {n[0], n[1], n[2]};
    if (value.isArray()) document_.fail(value.range(), "three numbers [x, y, z] are expected");
    return fallback;
  }
  Point3 needPoint(const TomlTable& table, std::string_view key) {
    return point(table.require(key, "a point [x, y, z]"), {});
  }
  Point3 direction(const TomlTable& table, std::string_view key, const Point3& fallback) {
    const TomlValue value = table.value(key);
    const Point3 d = point(value, fallback);
    const double length = d.length();
    if (length > 1e-6 && length < 1e6) return d * (1 / length);
    document_.fail(value.range(), fmt::format("`{}` is no direction; write [0, 0, 1], say", key));
    return fallback;
  }
  double size(const TomlTable& table, std::string_view key) {
    const TomlValue value = table.require(key, "a size in mm");
    const double out = value.number(1);
    if (value.isNumber() && !(out >= PartBuilder::kLeastSize))
      document_.fail(value.range(),
                     fmt::format("`{}` is below {} mm, which makes no solid", key, PartBuilder::kLeastSize));
    return out;
  }
  // Half of `diameter`, or `radius`.
  double radius(const TomlTable& table, const std::string& prefix = "", bool zero = false) {
    const std::string diameter = prefix + "diameter", radiusKey = prefix + "radius";
    if (table.has(diameter) && table.has(radiusKey)) {
      fail(table, fmt::format("`{}` and `{}` are together; write one of them", diameter, radiusKey));
      table.value(diameter);
      table.value(radiusKey);
      return 1;
    }
    const std::string& key = table.has(radiusKey) ? radiusKey : diameter;
    if (zero && table.value(key).isNumber() && table.value(key).number() == 0) return 0;
    return size(table, key) / (table.has(radiusKey) ? 1 : 2);
  }
  // Depth of what is cut; `before` is what is cut in front of the mouth.
  double depth(const TomlTable& table, double& before) {
    before = 0;
    const TomlValue through = table.value("through");
    if (!through.flag(false)) return size(table, "depth");
    if (const TomlValue value = table.value("depth"))
      document_.fail(value.range(), "`depth` and `through` are together; write one of them");
    before = kThrough;
    return kThrough;
  }

  Action action(const TomlTable& table, std::optional<Action> forced) {
    const TomlValue value = table.value("action");
    if (value && forced)
      document_.fail(value.range(), "a member of a difference or an intersection has no `action`");
    const std::string name = value.choice({"add", "remove", "keep"}, "add");
    if (forced) return *forced;
    return name == "add" ? Action::Add : name == "remove" ? Action::Remove : Action::Keep;
  }

  void shape(const TomlTable& table, std::optional<Action> forced) {
    if (builder.shapeCount() >= PartBuilder::kMostShapes) {
      table.entries(); // its keys are none of the matter
      if (!tooMany_) fail(table, fmt::format("the part has more than {} shapes", PartBuilder::kMostShapes));
      tooMany_ = true;
      return;
    }
    const std::string before = builder.fault();
    const TomlValue kind = table.require("kind", "the kind of the shape");
    const std::string name = kind.choice({"box", "cylinder", "cone", "sphere", "half-space", "hole", "slot",
                                          "pocket", "boss", "union", "difference", "intersection", "mesh"});
    const bool cut = name == "hole" || name == "slot" || name == "pocket";
    if (cut && forced)
      document_.fail(kind.range(), fmt::format("a {} removes by itself; a member of a difference or an "
                                               "intersection is a solid",
                                               name));
    if (name == "union" || name == "difference" || name == "intersection")
      group(table, name, action(table, forced));
    else if (name == "mesh")
      mesh(table, forced);
    else if (cut)
      cutter(table, name);
    else if (name.empty())
      table.entries(); // without a kind no key is known
    else
      solid(table, name, action(table, forced));
    if (before.empty() && !builder.fault().empty()) fail(table, builder.fault());
  }

  void group(const TomlTable& table, const std::string& name, Action does) {
    const TomlValue of = table.require("of", "a list of shapes");
    if (++depth_ > PartBuilder::kMostDepth) {
      document_.fail(of.range(), fmt::format("groups are nested deeper than {}", PartBuilder::kMostDepth));
    } else {
      builder.beginGroup(does);
      bool first = true;
      for (const TomlTable& member : of.tables()) {
        std::optional<Action> forced;
        if (name == "difference") forced = first ? Action::Add : Action::Remove;
        if (name == "intersection") forced = first ? Action::Add : Action::Keep;
        shape(member, forced);
        first = false;
      }
      builder.endGroup();
    }
    --depth_;
  }

  void mesh(const TomlTable& table, std::optional<Action> forced) {
    if (forced)
      fail(table, "a mesh cannot be a member of a difference or an intersection; model it in the CAD");
    const TomlValue file = table.require("file", "the name of an STL file");
    const std::string unit =
        table.require("unit", "\"mm\" or \"inch\", since STL does not say it").choice({"mm", "inch"}, "mm");
    const Placement placed = placement(table);
    if (!file.isText()) return;
    const std::optional<std::string> bytes = readMesh_(file.text(), file.range());
    if (!bytes) return failed_();
    const std::string fault = builder.mesh(*bytes, unit == "inch" ? 25.4 : 1, placed);
    if (fault.empty()) return;
    diagnostics_.report<diag::PartMesh>(file.range(), file.text(), fault);
    failed_();
  }

  void cutter(const TomlTable& table, const std::string& name) {
    const Point3 axis = direction(table, "axis", {0, 0, -1}); // into the material
    double before = 0;
    const double deep = depth(table, before);
    if (name == "hole") {
      const Point3 at = needPoint(table, "at");
      const double r = radius(table);
      if (document_.ok()) builder.cylinder(at - axis * before, at + axis * deep, r, Action::Remove);
      return;
    }
    Point3 mouth, side, half{1, 1, (deep + before) / 2};
    double corner = 0;
    if (name == "slot") {
      const Point3 from = needPoint(table, "from"), to = needPoint(table, "to");
      const double width = size(table, "width"), length = (to - from).length();
      mouth = (from + to) * 0.5;
      side = to - from;
      half.x = (length + width) / 2;
      half.y = corner = width / 2;
      if (document_.ok() && !(length >= PartBuilder::kLeastSize))
        fail(table, "`from` and `to` of the slot are the same point; write a hole");
      else if (document_.ok() && std::abs(side.dot(axis)) > 1e-6 * length)
        fail(table, "`from` and `to` of the slot lie at different depths along `axis`");
    } else {
      mouth = needPoint(table, "at");
      sides(table, axis, side, half, corner);
    }
    if (document_.ok())
      builder.block(mouth + axis * ((deep - before) / 2), axis, side, half, corner, Action::Remove);
  }

  // `size`, `side`, `corner` of a rectangle across `axis`.
  void sides(const TomlTable& table, const Point3& axis, Point3& side, Point3& half, double& corner) {
    const TomlValue value = table.require("size", "two lengths [along `side`, across it]");
    const std::vector<double> lengths = value.numbers();
    if (value.isArray() && lengths.size() != 2) document_.fail(value.range(), "two lengths are expected");
    if (lengths.size() == 2) half = {lengths[0] / 2, lengths[1] / 2, half.z};
    const bool upright = std::abs(axis.x) < 0.9;
    side = direction(table, "side", upright ? Point3{1, 0, 0} : Point3{0, 1, 0});
    if (std::abs(side.dot(axis)) > 1e-6)
      document_.fail(table.value("side").range(), "`side` is not square to `axis`");
    corner = table.value("corner").number(0);
  }

  void solid(const TomlTable& table, const std::string& name, Action does) {
    if (name == "box") {
      const Point3 least = needPoint(table, "min"), most = needPoint(table, "max");
      const double corner = table.value("corner").number(0);
      const Point3 turn = point(table.value("rotate"), {});
      if (document_.ok() && !(least.x < most.x && least.y < most.y && least.z < most.z))
        fail(table, "`min` of the box is not below `max` in each axis");
      if (document_.ok()) builder.box(least, most, does, corner, turn);
      return;
    }
    const Point3 at = needPoint(table, "at");
    if (name == "half-space") {
      const TomlValue normal = table.require("normal", "a direction [x, y, z] out of the material");
      const Point3 n = normal ? direction(table, "normal", {0, 0, 1}) : Point3{0, 0, 1};
      if (document_.ok()) builder.halfSpace(at, n, does);
      return;
    }
    if (name == "sphere") {
      const double r = radius(table);
      if (document_.ok()) builder.sphere(at, r, does);
      return;
    }
    const Point3 axis = direction(table, "axis", {0, 0, 1});
    const double height = size(table, "height");
    const Point3 top = at + axis * height;
    if (name == "boss" && table.has("size")) {
      Point3 side, half{1, 1, height / 2};
      double corner = 0;
      sides(table, axis, side, half, corner);
      if (document_.ok()) builder.block((at + top) * 0.5, axis, side, half, corner, does);
      return;
    }
    const double r = radius(table, "", name == "cone");
    if (name != "cone") {
      if (document_.ok()) builder.cylinder(at, top, r, does);
      return;
    }
    const double over = radius(table, "top_", true);
    if (document_.ok() && r == 0 && over == 0) fail(table, "both ends of the cone are points");
    if (document_.ok()) builder.cone(at, r, top, over, does);
  }

  // The document is not read on: what is wrong has been reported.
  void failed_() { meshFailed = true; }

public:
  bool meshFailed = false;

private:
  const TomlDocument& document_;
  const ReadMesh& readMesh_;
  Diagnostics& diagnostics_;
  std::size_t depth_ = 0;
  bool tooMany_ = false;
};

} // namespace

std::optional<PartFile> readPart(FileId file, const SourceMap& sources, const ReadMesh& readMesh,
                                 Diagnostics& diagnostics) {
  const std::optional<TomlDocument> document = TomlDocument::parse(file, sources, diagnostics);
  if (!document) return std::nullopt;
  Reader reader(*document, readMesh, diagnostics);
  const TomlTable root = document->root();
  const Placement nominal = reader.placement(root.value("place").table());
  const Placement error = reader.placement(root.value("error").table());
  const TomlValue shapes = root.require("shape", "a list of shapes, [[shape]]");
  reader.list(shapes.tables());
  if (!document->finish() || reader.meshFailed) return std::nullopt;
  std::string fault;
  const std::unique_ptr<Part> part = reader.builder.finish(fault);
  if (!part) {
    diagnostics.report<diag::PartRefused>(shapes.range(), fault);
    return std::nullopt;
  }
  return PartFile{part->placed(nominal, error), nominal, error};
}

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

namespace {

// Models that somebody takes for a part file: what to do instead; "": it is none by its name.
std::string modelAdvice(const std::string& path) {
  const std::size_t point = path.rfind('.');
  const std::string end = point == std::string::npos ? "" : upperCase(std::string_view(path).substr(point));
  const std::string name = path.substr(folderOf(path).size());
  constexpr std::array<std::string_view, 8> kModels = {".STEP", ".STP", ".IGES", ".IGS",
                                                       ".3MF",  ".OBJ", ".DXF",  ".X_T"};
  if (end == ".STL")
    return fmt::format(
        "`{0}` is a mesh, and a part is a TOML file that names it: beside it, part.toml with the lines "
        "`schema = 1`, `[[shape]]`, `kind = \"mesh\"`, `file = \"{0}\"`, `unit = \"mm\"`",
        name);
  if (std::find(kModels.begin(), kModels.end(), end) != kModels.end())
    return fmt::format(
        "`{}` is a model that Dotek does not read; export it as STL, which a part file (TOML) names, or "
        "describe it by its shapes",
        name);
  return "";
}

} // namespace

std::optional<PartFile> loadPart(const std::string& path, const Limits& limits, const ReadBounds& bounds,
                                 SourceMap& sources, Diagnostics& diagnostics) {
  if (const std::string advice = modelAdvice(path); !advice.empty()) {
    diagnostics.report<diag::PartRefused>({}, advice);
    return std::nullopt;
  }
  const std::optional<FileId> id = readText(path, Encoding::Utf8, std::nullopt, limits, sources, diagnostics);
  if (!id) return std::nullopt;
  const auto readMesh = [&](const std::string& name, SourceRange where) -> std::optional<std::string> {
    const std::string mesh = name.starts_with('/') ? name : folderOf(path) + name;
    if (!bounds.allow(mesh)) {
      diagnostics.report<diag::IncludeOutside>(where, mesh, bounds.text(), folderName(mesh));
      return std::nullopt;
    }
    if (isStream(mesh)) { // a FIFO would block, and nobody named it on the command line
      diagnostics.report<diag::FileNotReadable>(where, mesh, "it is no regular file");
      return std::nullopt;
    }
    sources.add(SourceFile(mesh, "", Encoding::Utf8)); // no text, but a file that was read
    return readBytes(mesh, limits, diagnostics);
  };
  return readPart(*id, sources, readMesh, diagnostics);
}

} // namespace dotek::sim
