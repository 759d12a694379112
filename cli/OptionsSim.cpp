// Flags of `dotek sim`.
#include "cli/Files.h"
#include "cli/Options.h"
#include "driver/SimMikroprog.h"
#include "support/Decimal.h"
#include "support/FileIdentity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace dotek::cli {

void addPart(CLI::App& command, Raw& raw, const char* what) {
  command.add_option("--part", raw.part, what)->type_name("PART.toml");
  command.add_option("--machine", raw.machine, "probe and travel of the machine")->type_name("MACHINE.toml");
}

void addSetup(CLI::App& command, Raw& raw) {
  command
      .add_option("--job", raw.job, "job file whose [setup] says what an operator sets; flags win over it")
      ->type_name("JOB.toml");
  command.add_option("--tool", raw.tool, "number of the tool in the spindle, and of its offset")
      ->type_name("N");
  command
      .add_option("--length", raw.length,
                  "length of that tool, as its offset says (that of the machine's probe)")
      ->type_name("MM");
  command.add_option("--diameter", raw.diameter, "diameter of the stylus ball, where no --machine says it")
      ->type_name("MM");
  command.add_option("--radius", raw.radius, "its radius, instead of --diameter")->type_name("MM");
  command
      .add_option("--work-offset", raw.workOffsets,
                  "zero of G54 to G59 in coordinates of the machine; `G54=part`: where the part is meant to "
                  "be; repeat it for several")
      ->option_text("G54=X,Y,Z")
      ->allow_extra_args(false);
  command.add_option("--at", raw.at, "where the tool's end is before the program, in the active system")
      ->type_name("X,Y,Z");
  command.add_option("--call", raw.call, "call the program by G65 with these arguments")
      ->type_name("\"D25. S54\"");
}

void addSim(CLI::App& app, Raw& raw) {
  CLI::App* sim = app.add_subcommand("sim", "run an NC program on a machine and print what it does");
  sim->add_option("PROGRAM", raw.inputs, "the program, or a cycle (NAME.cycle)")->expected(1);
  addTarget(*sim, raw);
  addSeveral(
      *sim, "--var", raw.variables,
      "value of a variable before the program begins; of Mikroprog P5=3, an input O1=1, a stored shift "
      "G52.Z=-12",
      "N=VALUE");
  addSeveral(*sim, "--show", raw.shown,
             "common variable that the table of what was measured shows at the end, by this name, beside the "
             "value that is expected, where one is given",
             "N=NAME[=NOMINAL]");
  addSeveral(*sim, "--set", raw.set,
             "value of a parameter of a cycle: diameter=30, diameter=1.2in, system=G55", "NAME=VALUE");
  addSeveral(*sim, "--host", raw.host, "value that a cycle takes from the machine (see `dotek list hosts`)",
             "NAME=VALUE");
  addFolders(*sim, "--programs", raw.programs, "folder of programs that can be called");
  sim->add_option("--probe-macros", raw.probeMacros,
                  "set of probing macros that calls without a program mean (all)")
      ->type_name("SET");
  addPart(*sim, raw,
          "part that the probe touches; a cycle without one gets that which its touches expect (`none`: no "
          "part)");
  sim->add_option(
         "--device", raw.device,
         "device beside the control: what its codes and variables do, its tables, errors of the machine")
      ->type_name("DEVICE.toml");
  sim->add_option("--report", raw.report,
                  "write a page (Markdown) on what the device did, with a picture beside it (OUT with .svg)")
      ->type_name("OUT");
  CLI::Option* stock =
      sim->add_option("--stock", raw.stock, "block that the program cuts, its tools and the finished part");
  stock->type_name("STOCK.toml");
  sim->add_option("--stock-map", raw.stockMap, "write a picture of what is left of the block, from above")
      ->type_name("OUT")
      ->needs(stock);
  addSetup(*sim, raw);
  sim->add_option("--active-system", raw.activeSystem,
                  "work system in force as the program begins, 54 to 59 (54)")
      ->type_name("N");
  sim->add_option("--datum", raw.simDatum,
                  "of Mikroprog: zero of the active system in coordinates of the machine, mm; `part`: where "
                  "the part is meant to be")
      ->type_name("X,Z|X,Y,Z|part");
  sim->add_option("--svg", raw.svgFile, "write a picture of the run, three views")->type_name("OUT");
  sim->add_option("--html", raw.htmlFile, "write a page that shows the run in space")->type_name("OUT");
  sim->add_option("--date", raw.date, "date that the pictures show, as you write it")->type_name("TEXT");
  sim->add_flag("--quiet", raw.quiet, "no trace");
  sim->add_flag("--json", raw.json, "print how the run ended as JSON, and no trace");
  sim->add_option("--trace", raw.traceFile, "write the trace to a file")->type_name("OUT");
  addForce(*sim, raw);
  addIncludes(*sim, raw);
  addCommon(*sim, raw);
}

namespace {

constexpr double kFarthest = 20000; // mm

std::array<double, 3> pointOf(const std::string& flag, const std::string& text) {
  std::array<double, 3> out{};
  std::size_t count = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++count) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<double> value = parseNumber(std::string_view(text).substr(begin, end - begin));
    if (count == 3 || !value || !(std::abs(*value) <= kFarthest)) {
      count = 0;
      break;
    }
    out[count] = *value;
    begin = end + 1;
  }
  if (count != 3) throw UsageError(flag + " takes X,Y,Z in mm, three numbers, not `" + text + "`");
  return out;
}

sim::Setup setupOf(const Raw& raw) {
  sim::Setup out;
  constexpr std::uint64_t kMostTool = 999;
  if (!raw.tool.empty()) out.tool = static_cast<std::uint32_t>(countOf("--tool", raw.tool, 1, 1, kMostTool));
  if (!raw.length.empty()) {
    if (!out.tool && raw.machine.empty() && raw.job.empty())
      throw UsageError("--length is the length of a tool; --tool N says of which");
    out.length = numberOf("--length", raw.length, 0, -kFarthest, kFarthest);
  }
  if (!raw.radius.empty() && !raw.diameter.empty())
    throw UsageError("--radius and --diameter say the same of the stylus; give one of them");
  if (!raw.radius.empty()) out.ballDiameter = 2 * numberOf("--radius", raw.radius, 0, 0.005, 50);
  if (!raw.diameter.empty()) out.ballDiameter = numberOf("--diameter", raw.diameter, 0, 0.01, 100);
  for (const std::string& text : raw.workOffsets) {
    const auto [name, place] = splitPair("--work-offset", text);
    const auto system = stdlib::systemByName(name);
    if (!system)
      throw UsageError("--work-offset takes G54 to G59, not `" + name +
                       "`; `--var N=VALUE` sets the variables of others");
    sim::Setup one;
    if (place == "part")
      one.zeros.push_back({*system, true, {}});
    else
      one.zeros.push_back({*system, false, pointOf("--work-offset " + name, place)});
    out.override(one);
  }
  if (!raw.at.empty()) out.at = pointOf("--at", raw.at);
  out.call = raw.call;
  return out;
}

} // namespace

namespace {

// Two numbers are those of a lathe, three those of a mill.
sim::Setup::Zero datumOf(const std::string& text) {
  if (text == "part") return {stdlib::kDatum, true, {}};
  const auto commas = std::count(text.begin(), text.end(), ',');
  const std::size_t comma = text.find(',');
  if (commas != 1 && commas != 2)
    throw UsageError("--datum takes X,Z of a lathe, X,Y,Z of a mill or `part`, not `" + text + "`");
  if (commas == 2) return {stdlib::kDatum, false, pointOf("--datum", text)};
  std::array<double, 3> out = pointOf("--datum", text.substr(0, comma) + ",0" + text.substr(comma));
  out[1] = stdlib::kNoCoordinate;
  return {stdlib::kDatum, false, out};
}

} // namespace

driver::SimOptions simOf(const Raw& raw) {
  driver::SimOptions out;
  out.setup = setupOf(raw);
  out.activeSystem = static_cast<std::uint8_t>(countOf("--active-system", raw.activeSystem, 54, 54, 59) - 54);
  if (!raw.simDatum.empty()) out.setup.zeros.push_back(datumOf(raw.simDatum));
  out.svg = !raw.svgFile.empty();
  out.html = !raw.htmlFile.empty();
  if (!raw.stock.empty()) out.stock = raw.stock;
  out.stockMap = !raw.stockMap.empty();
  if (!raw.part.empty()) out.part = raw.part;
  if (!raw.machine.empty()) out.machine = raw.machine;
  out.control = raw.control;
  out.json = raw.json;
  out.date = raw.date;
  out.programs = withoutRepeats(raw.programs);
  if (!raw.probeMacros.empty()) out.probeMacros = raw.probeMacros;
  out.variables = pairsOf("--var", raw.variables);
  out.shown = pairsOf("--show", raw.shown);
  return out;
}

sim::DeviceOptions deviceOf(const Raw& raw) {
  sim::DeviceOptions out;
  if (!raw.device.empty()) out.device = raw.device;
  out.report = !raw.report.empty();
  out.picture = std::filesystem::path(pictureBeside(raw.report)).filename().string();
  return out;
}

} // namespace dotek::cli
