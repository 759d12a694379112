#include "project/ControlDraft.h"

#include "support/Printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace dotek::project {
namespace {

// A line of a list of codes.
std::string code(const std::string& text, bool on) {
  const auto parsed = stdlib::codeOf(text);
  const std::string name = parsed ? fmt::format("{}{}", parsed->first, parsed->second / 10) : text;
  return fmt::format("\"{} {}: probe {}\"", name, on ? "probe-on" : "probe-off", on ? "on" : "off");
}

} // namespace

std::string draftControl(const std::string& name, const stdlib::Control& base,
                         const stdlib::ProbeCodes& probe) {
  std::string out =
      fmt::format("# {}: what differs from the control `{}`, whose file states the rest.\n"
                  "# What the sections mean: docs/data-files.md. Tables merge key by key; a "
                  "range of variables\n"
                  "# replaces each one there that it overlaps; codes, calls and alarms are taken one by one. "
                  "What the machine lacks:\n"
                  "# remove = {{ codes = [\"G33\"], variables = [\"2500-2899\"] }}\n\n"
                  "schema = 1\n"
                  "title = \"{}\"\n"
                  "extends = \"{}\"\n\n",
                  name, printable(base.name), name, printable(base.name));
  std::vector<std::string> codes;
  if (!probe.on.empty()) codes.push_back(code(probe.on, true));
  if (!probe.off.empty()) codes.push_back(code(probe.off, false));
  const std::string mark = codes.empty() ? "# " : "";
  if (codes.empty()) codes = {code("M31", true), code("M32", false)};
  out += "# Codes of the machine's builder: his manual has them.\n";
  out += mark + "[[codes]]\n";
  out += mark + "grade = \"documented\"\n";
  out += mark + "source = \"the manual of the machine's builder\"\n";
  out += mark + fmt::format("list = [{}]\n", fmt::join(codes, ", "));
  return out;
}

} // namespace dotek::project
