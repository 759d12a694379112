// What a run was given beside its program, as the pictures list it.
#include "sim/run/SimReport.h"
#include "sim/run/SimWorld.h"
#include "stdlib/SetupDatum.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::sim {

void SimWorld::addWarnings() {
  PictureList list{"warnings", "Warnings", {}};
  for (const Diagnostic& one : session_.diagnostics().all()) {
    if (one.severity != Severity::Warning) continue;
    std::string place;
    if (one.range.hasPlace()) {
      const SourceFile& file = session_.sources().file(one.range.file);
      place = fmt::format("{}:{}: ", file.name(), file.place(one.range.begin).line);
    }
    list.lines.push_back(fmt::format("{}{} [{}]", place, one.message, one.code));
  }
  addList(std::move(list));
}

void SimWorld::addInputs() {
  PictureList list{"inputs", "Inputs", {}};
  const auto add = [&](std::string_view name, const std::string& value) {
    list.lines.push_back(toUtf8Text(fmt::format("{:<12}{}", name, value)));
  };
  const auto place = [](const std::array<double, 3>& at) {
    return fmt::format("X{} Y{} Z{}", numberText(at[0]), numberText(at[1]), numberText(at[2]));
  };
  const project::CommonOptions& common = options_.common;
  if (options_.part) add("part", *options_.part);
  if (options_.machine) add("machine", *options_.machine);
  if (common.job) add("job", *common.job);
  for (const std::string& folder : options_.programs)
    add("programs", folder);
  if (!setup_.call.empty()) add("called with", setup_.call);
  for (const auto& [name, value] : common.set)
    add(name, value);
  for (const auto& [name, value] : common.host)
    add(name, value);
  if (setup_.tool)
    add("tool", setup_.length ? fmt::format("{}, length {} mm", *setup_.tool, numberText(*setup_.length))
                              : fmt::format("{}", *setup_.tool));
  for (Setup::Zero zero : setup_.zeros) {
    if (zero.place[1] == stdlib::kNoCoordinate) zero.place[1] = 0; // of a lathe
    add(zero.system == stdlib::kDatum ? "datum" : fmt::format("G{}", 54 + zero.system),
        zero.ofPart ? "where the part is meant to be" : place(zero.place));
  }
  if (options_.activeSystem != 0) add("active", fmt::format("G{}", 54 + options_.activeSystem));
  if (setup_.at) add("begins at", place(*setup_.at));
  for (const auto& [number, value] : options_.variables)
    add("#" + number, value);
  addList(std::move(list));
}

// A run without a part is as good as one with it where nothing measures; where the zero is then, its numbers
// do not show.
void SimWorld::tellZeroLeftOut(const Machine& machine) {
  if (!machine_ || partZero_) return;
  std::string names;
  for (const Setup::Zero& zero : machine_->setup.zeros) {
    const bool said = std::any_of(setup_.zeros.begin(), setup_.zeros.end(),
                                  [&](const Setup::Zero& one) { return one.system == zero.system; });
    if (zero.ofPart && !said && zero.system < 6 && machine.zeroOf(zero.system) == Position{})
      names += fmt::format("{}G{}", names.empty() ? "" : ", ", 54 + zero.system);
  }
  if (!names.empty())
    session_.diagnostics().report<diag::ZeroLeftOut>({}, options_.machine.value_or("[setup]"), names,
                                                     names.substr(0, names.find(',')));
}

} // namespace dotek::sim
