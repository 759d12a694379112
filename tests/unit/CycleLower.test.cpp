// Cycles of the cycle language as IR: the statements that they come to, what their checks let pass, and what
// is refused. Expected by the rules of docs/cycles.md.
#include "frontend/cycle/Check.h"
#include "frontend/cycle/Lower.h"
#include "frontend/cycle/Parse.h"
#include "ir/CycleNames.h"
#include "ir/Evaluate.h"
#include "ir/Print.h"
#include "ir/Verify.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>

namespace dotek::tests {
namespace {

namespace cycle = frontend::cycle;

using Texts = std::map<std::string, std::string>;

struct Lowering {
  SourceMap sources;
  Diagnostics diagnostics;
  std::map<std::string, std::unique_ptr<cycle::File>> files;
  std::optional<cycle::Lowered> lowered;

  // Text of `main`, and of the cycles that it calls by their names.
  explicit Lowering(const std::string& main, const Texts& others = {}, std::uint32_t programLevels = 0) {
    const auto read = [&](const std::string& name, const std::string& text) {
      const FileId id = sources.add(SourceFile(name, text, Encoding::Utf8));
      return cycle::parse(id, sources, Limits(), diagnostics);
    };
    for (const auto& [name, text] : others)
      files[name] = std::make_unique<cycle::File>(read(name, text));
    const cycle::FindCycle find = [&](const std::string& name) -> const cycle::File* {
      const auto found = files.find(name);
      return found == files.end() ? nullptr : found->second.get();
    };
    for (const auto& [name, one] : files)
      cycle::link(*one, find);
    cycle::File file = read("main", main);
    cycle::link(file, find);
    cycle::check(file, sources, diagnostics);
    REQUIRE_MESSAGE(!diagnostics.hasErrors(), renderText(diagnostics, sources, 0));
    lowered = cycle::lower(file, sources, diagnostics, {programLevels, {}});
    if (!lowered) return;
    for (const cycle::CalledProgram& program : lowered->programs)
      for (const ir::Violation& one : ir::verify(program.cycle))
        FAIL_CHECK(one.message);
    for (const ir::Violation& one : ir::verify(lowered->cycle))
      FAIL_CHECK(one.message);
  }

  // The part of the IR that `title` names, without what follows `;` and without the blanks before.
  std::string list(const std::string& title) const {
    REQUIRE_MESSAGE(lowered, renderText(diagnostics, sources, 0));
    ir::Module module;
    module.cycles.push_back(lowered->cycle);
    const std::string text = ir::print(module, nullptr);
    std::string out;
    bool in = false;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::string line = text.substr(at, end - at);
      at = end + 1;
      line = line.substr(0, line.find(" ;"));
      line.erase(line.find_last_not_of(' ') + 1);
      line.erase(0, line.find_first_not_of(' '));
      if (line == "checks" || line == "body")
        in = line == title;
      else if (in && !line.empty())
        out += line + "\n";
    }
    return out;
  }
  std::string body() const { return list("body"); }

  // What the checks say to the values of the parameters; none: the caller gives nothing.
  bool passes(const std::map<std::string, double>& values) const {
    REQUIRE(lowered);
    const ir::Cycle& all = lowered->cycle;
    ir::Environment environment(all.variables.size());
    for (ir::VariableId id = 0; id < all.variables.size(); ++id) {
      const ir::Variable& variable = all.variable(id);
      const auto given = values.find(variable.name);
      if (given != values.end())
        environment[id] = ir::Scalar::of(given->second);
      else if (variable.defaultValue)
        environment[id] = ir::Scalar::of(*variable.defaultValue);
      else if (variable.role == ir::Role::Parameter)
        environment[id] = ir::Scalar::null();
    }
    const ir::CheckRun run = ir::runChecks(all, environment, 10000);
    CHECK((run.end == ir::CheckRun::End::Passes || run.end == ir::CheckRun::End::Alarm));
    return run.end == ir::CheckRun::End::Passes;
  }
};

std::string refusal(const std::string& text, const Texts& others = {}) {
  const Lowering lowering(text, others);
  CHECK(!lowering.lowered);
  for (const Diagnostic& one : lowering.diagnostics.all())
    if (one.severity == Severity::Error) return std::string(one.code);
  return "";
}

constexpr const char* kBore = R"(cycle bore "Bore, four touches"

parameter diameter   : length               "Nominal diameter" require diameter > 2 * ball_radius
parameter depth      : length = 5 mm        "Depth"            require depth > 0 mm
parameter system     : work_offset optional "Work offset to set"
parameter at_x, at_y : length = 0 mm        "Coordinates that the centre gets"
parameter tolerance  : length optional      "Largest deviation"
result    size               : length "Measured diameter"
result    centre_x, centre_y : length "Measured centre"

spindle off
probe on
protected move by z -depth
touch x by diameter / 2 -> right
touch x by -diameter / 2 -> left
protected move to x (right.at + left.at) / 2
touch y by diameter / 2 -> back
touch y by -diameter / 2 -> front
protected move to start
probe off
centre_x = (right.at + left.at) / 2
centre_y = (back.at + front.at) / 2
size = back.at - front.at
if given tolerance and abs(size - diameter) > tolerance then
  alarm "Diameter out of tolerance"
end
if given system then
  set system: centre_x becomes x at_x, centre_y becomes y at_y
end
)";

TEST_CASE("cycle lowering: a bore is moves, measurements and their results") {
  const Lowering bore(kBore);
  // Down by a depth above 0, so the start is higher: z first. Nothing has moved y.
  CHECK(bore.body() == R"(spindle off
probe on
move protected z = here -depth
measure surface x to here diameter / 2.
set right_at = result x
measure surface x to here -diameter / 2.
set left_at = result x
move protected x = work (right_at + left_at) / 2.
measure surface y to here diameter / 2.
set back_at = result y
measure surface y to here -diameter / 2.
set front_at = result y
move protected z = start {0}
move protected x = start {0}
probe off
set centre_x = (right_at + left_at) / 2.
set centre_y = (back_at + front_at) / 2.
set size = back_at - front_at
if tolerance is null goto otherwise
if abs(size - diameter) <= tolerance goto otherwise
cycle "results": centre_x = centre_x, centre_y = centre_y, size = size
alarm "Diameter out of tolerance"
label otherwise
if "system" is null goto otherwise_2
cycle "set-offset": measured x = centre_x, measured y = centre_y, set system "system": x = at_x, y = at_y
label otherwise_2
cycle "results": size = size, centre_x = centre_x, centre_y = centre_y
)");
  const double radius = 3;
  CHECK(bore.passes({{"diameter", 30}, {"tool_radius", radius}}));
  CHECK(!bore.passes({{"diameter", 6}, {"tool_radius", radius}}));
  CHECK(!bore.passes({{"diameter", 30}, {"tool_radius", radius}, {"depth", 0}}));
}

TEST_CASE("cycle lowering: the way to the start") {
  const auto way = [](const std::string& moves) {
    return Lowering("cycle way \"Way\"\nparameter up : length \"Up\"\n" + moves + "move to start\n").body();
  };
  // Lower than here: x and y first.
  CHECK(
      way("move by z 5 mm\nmove by x up\n") ==
      "move rapid z = here 5.\nmove rapid x = here up\nmove rapid x = start {0}\nmove rapid z = start {0}\n");
  CHECK(way("move by z up\n") == "move rapid z = here up\nmove rapid z = start {0}\n");
  CHECK(way("") == "");
  // Back at the height of the start, by a coordinate.
  CHECK(way("move by z up\nmove to z start.z\nmove by x up\n") ==
        "move rapid z = here up\nmove rapid z = work start_z point lowest\nmove rapid x = here up\n"
        "move rapid x = start {0}\n");
  // The sign is known when it runs.
  CHECK(way("move by x 1 mm, z up\n") == R"(move rapid x = here 1., z = here up
if up > {0} goto start_is_lower
move rapid z = start {0}
move rapid x = start {0}
goto at_start
label start_is_lower
move rapid x = start {0}
move rapid z = start {0}
label at_start
)");
  CHECK(way("move to x 1 mm, z up\n").find("if up - start_z > {0} goto start_is_lower") != std::string::npos);
  CHECK(refusal("cycle way \"Way\"\nmove to machine z 0 mm\nmove by x 1 mm\nmove to start\n") ==
        "place-unknown");
}

TEST_CASE("cycle lowering: places as values") {
  CHECK(Lowering("cycle demo \"C\"\nmove by x 5 mm\nmove to y here.x - start.x\n").body() ==
        "move rapid x = here 5.\nset here_x = start_x + 5.\nmove rapid y = work here_x - start_x\n");
  CHECK(refusal("cycle demo \"C\"\nset G54: 0 mm becomes x 1 mm\nmove to y start.x\n") == "start-shifted");
  CHECK(refusal("cycle demo \"C\"\nset G54: 0 mm becomes x 1 mm\nmove to y here.x\n") == "place-unknown");
}

constexpr const char* kEdge = R"(cycle edge "Edge"
parameter distance : length "To the surface" require distance > 0 mm
parameter back     : length = 2 * distance "Default of another"
parameter limit    : length optional "Largest error"
result position : length "Surface"
probe on
touch x by distance -> surface
probe off
position = surface.at
move by x -back
if given limit and abs(surface.error) > limit then
  alarm "Too far"
end
move to start
)";

TEST_CASE("cycle lowering: a called cycle is written in the place of its call") {
  const Texts others = {{"edge", kEdge}};
  // The caller has switched the probe on: the called cycle leaves it. Nothing gives `limit`.
  CHECK(Lowering(R"(cycle demo "C"
parameter d : length "D" require d > 0 mm
result found : length "At"
probe on
call edge distance = d -> first
probe off
found = first.position
)",
                 others)
            .body() == R"(probe on
set first_back = 2. * d
measure surface x to here d
set first_surface_at = result x
set first_position = first_surface_at
move rapid x = here -first_back
move rapid x = work start_x
probe off
set found = first_position
cycle "results": found = found
)");
  const std::string alone =
      Lowering("cycle demo \"C\"\ncall edge distance = 5 mm, limit = 1 mm\n", others).body();
  CHECK(alone.find("probe on\n") != std::string::npos);
  CHECK(alone.find("probe off\n") != std::string::npos);
  CHECK(alone.find("if abs(edge_surface_error) <= 1. goto") != std::string::npos);
}

TEST_CASE("cycle lowering: a loop may read the start beside calls that are not asked to set an offset") {
  const Texts others = {{"edge", R"(cycle edge "Edge"
parameter system : work_offset optional "System"
probe on
touch x by 5 mm -> surface
probe off
if given system then
  set system: surface.at becomes x 0 mm
end
)"}};
  const std::string head =
      "cycle demo \"C\"\nparameter mine : work_offset optional \"Mine\"\nfor i = 1 to 3\n"
      "  move to y start.x\n  call edge";
  CHECK(Lowering(head + "\nend\n", others).body().find("move rapid y = work start_x") != std::string::npos);
  CHECK(refusal(head + " system = G55\nend\n", others) == "start-shifted");
  CHECK(refusal(head + " system = mine\nend\n", others) == "start-shifted");
}

TEST_CASE("cycle lowering: values that need steps") {
  const auto holds = [](const std::string& condition, double a) {
    return Lowering("cycle demo \"C\"\nparameter p : ratio \"A\"\nparameter q : ratio optional \"B\"\n"
                    "parameter side : choice of near, far = far \"Side\"\nparameter ask : flag = no \"Ask\"\n"
                    "require " +
                    condition + "\nstop \"b\"\n")
        .passes({{"p", a}});
  };
  for (const auto& [a, down, up] : {std::tuple(-1.5, -2, -1), std::tuple(1.5, 1, 2), std::tuple(-2.0, -2, -2),
                                    std::tuple(0.0, 0, 0), std::tuple(3.0, 3, 3)}) {
    CHECK(holds("down(p) is " + std::to_string(down), a));
    CHECK(!holds("down(p) is " + std::to_string(down + 1), a));
    CHECK(holds("up(p) is " + std::to_string(up), a));
  }
  CHECK(holds("min(p, 2) is 1 and max(p, 2) is 2", 1));
  CHECK(holds("min(p, 2) is 2 and max(p, 2) is 3", 3));
  CHECK(holds("square(p) is 9", 3));
  CHECK(holds("atan(p, 0) is 90 deg", 2));
  CHECK(holds("side is far and not ask", 0));
  CHECK(!holds("side is near or ask", 0));
  // `q` is read only where it is given.
  CHECK(holds("not given q or q > p", 1));
  CHECK(!holds("given q and q > p", 1));
  CHECK(holds("not (given q and q > p) and p is 1", 1));
}

TEST_CASE("cycle lowering: what is not among the choices is an alarm") {
  const Lowering c("cycle demo \"C\"\nparameter side : choice of near, far \"Side\"\n"
                   "parameter ask : flag = yes \"Ask\"\nparameter d : length \"D\" range 1 mm to 2 mm\n"
                   "if side is far or ask then\n  stop \"b\"\nend\nmove by x d\n");
  CHECK(c.passes({{"side", 1}, {"d", 1}}));
  CHECK(c.passes({{"side", 2}, {"d", 2}, {"ask", 0}}));
  CHECK(!c.passes({{"side", 3}, {"d", 1}}));
  CHECK(!c.passes({{"side", 1}, {"d", 1}, {"ask", 2}}));
  CHECK(!c.passes({{"side", 1}, {"d", 0.9}}));
  CHECK(!c.passes({{"side", 1}, {"d", 2.1}}));
}

TEST_CASE("cycle lowering: loops") {
  CHECK(Lowering("cycle demo \"C\"\nparameter n : count \"N\"\nrepeat n times\n  move by x 1 mm\nend\n")
            .body() ==
        R"(set times = n
set runs = {0}
label loop
if runs >= times goto loop_end
move rapid x = here 1.
set runs = runs + {1}
goto loop
label loop_end
)");
  CHECK(Lowering("cycle demo \"C\"\nfor i = 6 mm to 2 mm step -2 mm\n  move to x i\nend\n").body() ==
        R"(set i = 6.
label loop
if i < 2. goto loop_end
move rapid x = work i
set i = i + -2.
goto loop
label loop_end
)");
}

TEST_CASE("cycle lowering: touches that say how they search") {
  const std::string text = Lowering(R"(cycle demo "C"
result z_at : length "Z"
probe on
touch once z to -5 mm overtravel 3 mm -> top else
  z_at = 0 mm
end
touch along x 1, y 1 by 20 mm -> p
probe off
z_at = p.at_x + p.error
)")
                               .body();
  CHECK(text.find("cycle \"surface\" z: target z = work -5., overtravel = 3., once = {1}, miss = {1}\n"
                  "if result probe-error <> {0} goto not_found\n") != std::string::npos);
  CHECK(text.find("cycle \"surface-along\": direction x = 1., direction y = 1., travel = 20.\n"
                  "set p_at_x = result x\nset p_error = result main\n") != std::string::npos);
  CHECK(text.find("p_at_y") == std::string::npos); // nothing reads it
}

// Upward the ball is hidden by its stem.
TEST_CASE("cycle lowering: given NAME says whether a touch found anything") {
  const std::string head = "cycle search \"Search\"\nresult face : length \"F\"\nneeds probe\nface = 0 mm\n";
  CHECK(Lowering(head + "touch x by 9 mm -> wall else\n  move by y 1 mm\nend\n"
                        "if given wall and wall.at > 2 mm then\n  face = wall.at\nend\n")
            .body() == R"(set wall_found = {0}
set face = 0.
cycle "surface" x: target x = here 9., miss = {1}
if result probe-error <> {0} goto not_found
set wall_at = result x
set wall_found = {1}
goto found
label not_found
set wall_found = {0}
move rapid y = here 1.
label found
if wall_found = {0} goto otherwise
if wall_at <= 2. goto otherwise
set face = wall_at
label otherwise
cycle "results": face = face
)");
  // A search in steps; `given` stands before the touch.
  const Lowering search(head + "while not given wall at most 9 times\n  touch x by 5 mm -> wall else\n"
                               "    move by x 5 mm\n  end\nend\nif not given wall then\n"
                               "  alarm \"Nothing\"\nend\nface = wall.at\n");
  CHECK(search.body().find("if wall_found <> {0} goto loop_end") != std::string::npos);
}

TEST_CASE("cycle lowering: after a set the start of a called cycle is a place and no coordinate") {
  const Texts two = {{"pair",
                      "cycle pair \"Pair\"\nresult wide : length \"W\"\nneeds probe\n"
                      "touch x by 9 mm -> aa\nmove to x aa.at - 9 mm\nmove to start\nwide = aa.at\n"}};
  const std::string head = "cycle main \"M\"\nresult wide : length \"W\"\nneeds probe\n"
                           "touch x by 5 mm -> edge\nset G54: edge.at becomes x 0 mm\n";
  const std::string rest = "call pair -> found\nwide = found.wide\n";
  const Lowering good(head + "move to start\nmove by x 50 mm\n" + rest, two);
  CHECK(good.body().find("move rapid x = start 50.") != std::string::npos);
  // A touch comes back, so the place is known from the start, whatever its coordinates are now.
  const Lowering beside(head + "move by x 50 mm\n" + rest, two);
  CHECK(beside.body().find("move rapid x = start 50.") != std::string::npos);
  const Texts reads = {{"pair", "cycle pair \"Pair\"\nresult wide : length \"W\"\nneeds probe\n"
                                "touch x by 9 mm -> aa\nwide = start.x\n"}};
  CHECK(refusal(head + "move to start\n" + rest, reads) == "start-shifted");
}

TEST_CASE("cycle lowering: a move there and back again is no move") {
  CHECK(
      Lowering("cycle back \"B\"\nparameter down : length \"D\"\nneeds probe\nrepeat 2 times\n"
               "  move by z -down\n  touch x by 5 mm\n  move by z down\nend\nmove by x 3 mm\nmove to start\n")
          .lowered);
}

TEST_CASE("cycle lowering: coordinates from before a set and from after it are not mixed") {
  const auto codes = [](const std::string& text) {
    const Lowering lowering("cycle main \"M\"\nparameter system : work_offset optional \"S\"\n"
                            "result wide : length \"W\"\nneeds probe\ntouch x by 5 mm -> aa\n" +
                            text);
    std::string out;
    for (const Diagnostic& one : lowering.diagnostics.all())
      out += std::string(one.code) + " " + std::to_string(lowering.sources.line(one.range)) + " ";
    return out;
  };
  const std::string set = "if given system then\n  set system: aa.at becomes x 0 mm\nend\n";
  CHECK(codes(set + "touch x by 6 mm -> bb\nwide = bb.at - aa.at\n") == "coordinates-mixed 10 ");
  CHECK(codes(set + "touch x by 6 mm -> bb\nwide = 0 mm\nif bb.at > aa.at then\n  wide = 1 mm\nend\n") ==
        "coordinates-mixed 11 ");
  CHECK(codes(set + "wide = 0 mm\nprotected move to x aa.at - 5 mm\n") == "coordinates-mixed 10 ");
  // Distances stay, also from both sides of the `set`; other axes stay; before it all is one system.
  CHECK(codes("touch x by -6 mm -> bb\nwide = aa.at - bb.at\n" + set +
              "touch x by 7 mm -> cc\n"
              "touch x by -7 mm -> dd\nwide = (cc.at - dd.at) - wide\n")
            .empty());
  CHECK(codes(set + "touch y by 6 mm -> bb\nprotected move to y bb.at - 9 mm\nwide = aa.at\n").empty());
  CHECK(codes("touch x by 6 mm -> bb\nwide = bb.at - aa.at\n" + set).empty());
}

TEST_CASE("cycle lowering: a touch in z leads downward, or an alarm comes first") {
  const auto cycleOf = [](const std::string& clause, const std::string& touch) {
    return Lowering("cycle demo \"C\"\nparameter w : length \"W\"" + clause + "\nspindle off\nprobe on\n" +
                    touch + "\nprobe off\n");
  };
  const std::string alarm = "alarm \"touch leads upward\"\n";
  // What the caller gives is asked for before anything moves.
  const Lowering by = cycleOf("", "touch z by w -> p");
  CHECK(by.list("checks") == "if w < {0} goto downward\n" + alarm + "label downward\n");
  CHECK(by.body().find(alarm) == std::string::npos);
  CHECK(cycleOf(" require w < 0 mm", "touch z by w -> p").list("checks").find(alarm) == std::string::npos);
  CHECK(cycleOf(" require w > 0 mm", "touch z by -w -> p").list("checks").find(alarm) == std::string::npos);
  // A coordinate is compared with where the probe is then.
  const std::string to = cycleOf("", "move by z -3 mm\ntouch z to w -> p").body();
  CHECK(to.find("if w < start_z + -3. goto downward\n" + alarm) != std::string::npos);
  CHECK(cycleOf(" require w > 0 mm", "top = start.z - w\ntouch z to top -> p").body().find(alarm) ==
        std::string::npos);
  CHECK(cycleOf(" require w > 0 mm", "move by z -w\ntouch z to start.z - 2 * w -> p").body().find(alarm) ==
        std::string::npos);
  // What runs only now and then is asked for there.
  CHECK(cycleOf("", "if w is not 1 mm then\n  touch z by w -> p\nend").body().find(alarm) !=
        std::string::npos);
  CHECK(refusal("cycle demo \"C\"\nprobe on\ntouch z to start.z + 5 mm -> p\nprobe off\n") == "touch-upward");
  CHECK(refusal("cycle demo \"C\"\nprobe on\nmove to machine z 0 mm\ntouch z to 5 mm -> p\nprobe off\n") ==
        "place-unknown");
}

TEST_CASE("cycle lowering: what has no form yet is refused where it is written") {
  const std::string head = "cycle demo \"C\"\n";
  CHECK(refusal(head + "parameter t : text \"T\"\nrequire t is \"a\"\nstop \"b\"\n") == "text-parameter");
  CHECK(refusal(head + "set G54.1 P7: 0 mm becomes x 1 mm\n") == "offset-extended");
  CHECK(refusal(head + "move to a 30 deg\n") == "rotary-axis");
  CHECK(refusal(head + "probe on\ntouch along x 1, y 1 to 20 mm -> p\nprobe off\n") == "touch-along-to");
  CHECK(refusal(head + "probe on\ntouch z by 5 mm -> p\nprobe off\n") == "touch-upward");
  const Texts needs = {{"edge", kEdge}};
  CHECK(refusal(head + "parameter f : flag \"F\"\nif f then\n  probe on\nend\ncall edge distance = 1 mm\n"
                       "probe off\n",
                needs) == "probe-uncertain");
  std::string many = head;
  for (int i = 0; i < 20100; ++i)
    many += "spindle off\n";
  CHECK(refusal(many) == "cycle-too-long");
}

TEST_CASE("cycle lowering: calls that move the probe are calls of programs") {
  const Texts others = {{"edge", kEdge},
                        {"twice", "cycle twice \"T\"\nparameter w : length \"W\"\nresult v : length \"V\"\n"
                                  "v = 2 * w\n"}};
  const std::string main = "cycle demo \"C\"\nparameter far : length \"F\"\nresult p : length \"P\"\n"
                           "spindle off\n"
                           "call edge distance = 10 mm -> first_edge\n"
                           "call edge distance = far -> second_edge\n"
                           "call twice w = far -> doubled\n"
                           "p = first_edge.position + second_edge.position + doubled.v\n";
  const Lowering inlined(main, others), apart(main, others, 2);
  REQUIRE(apart.lowered);
  CHECK(inlined.lowered->programs.empty());
  // One program for both calls; what moves nothing is in its place.
  REQUIRE(apart.lowered->programs.size() == 1);
  CHECK(apart.lowered->programs[0].cycle.name == "edge");
  CHECK(apart.lowered->programs[0].readResults == std::set<std::string>{"position"});
  std::size_t calls = 0, results = 0;
  for (const ir::CycleStatement& one : apart.lowered->cycle.body) {
    CHECK(!std::holds_alternative<ir::Measure>(one.node));
    if (const auto* call = std::get_if<ir::CallCycle>(&one.node))
      calls += call->cycle == ir::kProgram ? 1 : 0;
    if (const auto* assign = std::get_if<ir::Assign>(&one.node))
      results += ir::handedBackOf(*assign->value) == 0 ? 1 : 0;
  }
  CHECK(calls == 2);
  CHECK(results == 2);
  CHECK(apart.lowered->inPlace.empty());
}

} // namespace
} // namespace dotek::tests
