#include "sim/device/DeviceReport.h"

#include "sim/machine/Value.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

constexpr double kSame = 5e-7; // mm
constexpr std::size_t kMostFindings = 50;

std::string shown(double value) {
  return isNull(value) ? "-" : numberText(std::round(value * 1e6) / 1e6);
}

// A cell of a table: no bar ends it early.
std::string cellText(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

std::string row(const std::vector<std::string>& cells) {
  std::string out = "|";
  for (const std::string& cell : cells)
    out += " " + cellText(cell) + " |";
  return out + "\n";
}

std::string head(const std::vector<std::string>& cells) {
  std::string out = row(cells) + "|";
  for (std::size_t i = 0; i < cells.size(); ++i)
    out += "---|";
  return out + "\n";
}

void variables(std::string& out, const DeviceReportPlan::Table& table, const Machine& machine) {
  out += fmt::format("## {}\n\n", table.title);
  if (!table.note.empty()) out += table.note + "\n\n";
  std::vector<std::string> titles = {"position"};
  for (const auto& column : table.columns) {
    titles.push_back(fmt::format("{} (#{}..)", column.title, column.first));
    if (!column.expected.empty()) titles.push_back("expected");
  }
  out += head(titles);
  std::string differences;
  for (std::uint32_t i = 0; i < table.rows; ++i) {
    const std::string position = shown(table.from + table.each * i);
    std::vector<std::string> cells = {position};
    for (const auto& column : table.columns) {
      const double value = machine.common(column.first + i * column.step);
      cells.push_back(shown(value));
      if (column.expected.empty()) continue;
      const bool there = i < column.expected.size();
      const bool same = there && !isNull(value) && std::abs(column.expected[i] - value) < kSame;
      cells.push_back(!there ? "-" : shown(column.expected[i]) + (same ? "" : " (differs)"));
      if (!same)
        differences += fmt::format("- {} at {}: the run has {}, `{}` has {}\n", column.title, position,
                                   shown(value), column.source, there ? shown(column.expected[i]) : "no row");
    }
    out += row(cells);
  }
  for (const auto& column : table.columns) {
    if (column.expected.empty()) continue;
    std::uint32_t equal = 0;
    for (std::uint32_t i = 0; i < table.rows && i < column.expected.size(); ++i) {
      const double value = machine.common(column.first + i * column.step);
      if (!isNull(value) && std::abs(column.expected[i] - value) < kSame) ++equal;
    }
    out += fmt::format("\n{}: {} of {} are those of `{}`.\n", column.title, equal, column.expected.size(),
                       column.source);
  }
  if (!differences.empty()) out += "\nWhat differs:\n\n" + differences;
  out += "\n";
}

// Touches at one place, one after the other.
struct Pass {
  double position = 0;
  std::vector<const DeviceTouch*> touches;
};

std::vector<Pass> passes(const Device& device, std::size_t value) {
  std::vector<Pass> out;
  double last = 0;
  for (const DeviceTouch& touch : device.touches()) {
    const double now = touch.values.empty() ? 0 : touch.values[value];
    // Another place, or the search began anew.
    if (out.empty() || std::abs(out.back().position - touch.position) > 1e-4 || now < last)
      out.push_back({touch.position, {}});
    out.back().touches.push_back(&touch);
    last = now;
  }
  return out;
}

void readings(std::string& out, const Device& device, const std::vector<Pass>& all, std::size_t value) {
  const auto& values = device.file().values;
  const std::string unit = values.empty() ? "" : values[value].unit;
  out += fmt::format("## Readings\n\n{} touches: what each read too much, mm, by {}.\n\n",
                     device.touches().size(),
                     values.empty() ? "position"
                     : unit.empty() ? values[value].title
                                    : fmt::format("{} in {}", values[value].title, unit));
  out += head({"position", "touches", "readings"});
  for (const Pass& pass : all) {
    std::string text;
    for (const DeviceTouch* touch : pass.touches)
      text +=
          (text.empty() ? "" : ", ") +
          (values.empty() ? shown(touch->error)
                          : fmt::format("{} {}: {}", shown(touch->values[value]), unit, shown(touch->error)));
    out += row({shown(pass.position), std::to_string(pass.touches.size()), text});
  }
  out += "\n";
}

void taken(std::string& out, const Device& device, std::size_t at) {
  const DeviceTable& table = device.file().tables[at];
  out += fmt::format("## What the device took over: {}\n\n", table.name);
  const auto& rows = device.rows(at);
  if (rows.empty()) {
    out += "Nothing: no strobe came.\n\n";
    return;
  }
  std::vector<std::string> titles = {"row"};
  for (const auto& column : table.columns)
    titles.push_back(column.name);
  out += head(titles);
  for (const auto& [index, values] : rows) {
    std::vector<std::string> cells = {std::to_string(index)};
    for (const double one : values)
      cells.push_back(shown(one));
    out += row(cells);
  }
  const std::size_t wanted = table.last - table.first + 1;
  if (rows.size() < wanted)
    out += fmt::format("\n{} of its {} rows are empty.\n", wanted - rows.size(), wanted);
  out += "\n";
}

// For the title of a section.
std::string_view wayOf(const DeviceRule& rule) {
  return rule.moving == DeviceMoving::Plus    ? ", moving towards plus"
         : rule.moving == DeviceMoving::Minus ? ", moving towards minus"
                                              : "";
}

// What the program chose against what it read in its last search at each place.
void choices(std::string& out, const Device& device, const std::vector<Pass>& all, const DeviceRule& rule) {
  const auto& rows = device.rows(rule.table);
  if (rows.empty()) return;
  out +=
      fmt::format("## Chosen values{}\n\nOf the readings of the last search at each place before the values "
                  "were sent.\n\n",
                  wayOf(rule));
  out += head({"position", "chosen", "its reading", "smallest reading", "read at", "what decides"});
  for (const auto& [index, values] : rows) {
    const double position =
        rule.from + rule.step * (index - static_cast<double>(device.file().tables[rule.table].first));
    const double chosen = values[rule.start];
    const Pass* last = nullptr;
    for (const Pass& pass : all) {
      const bool holds = std::any_of(pass.touches.begin(), pass.touches.end(), [&](const DeviceTouch* touch) {
        return std::abs(touch->values[rule.value] - chosen) < 1e-6;
      });
      if (std::abs(pass.position - position) < 0.5 && (holds || last == nullptr)) last = &pass;
    }
    if (last == nullptr) {
      out += row({shown(position), shown(chosen), "-", "-", "-", "the run has touched nothing there"});
      continue;
    }
    double least = 1e9, own = kNull;
    for (const DeviceTouch* touch : last->touches)
      least = std::min(least, std::abs(touch->error));
    std::string where;
    std::size_t ties = 0;
    for (const DeviceTouch* touch : last->touches) {
      if (std::abs(touch->values[rule.value] - chosen) < 1e-6) own = touch->error;
      if (std::abs(touch->error) > least + kSame) continue;
      where += (where.empty() ? "" : ", ") + shown(touch->values[rule.value]);
      ++ties;
    }
    const bool best = !isNull(own) && std::abs(own) <= least + kSame;
    out += row({shown(position), shown(chosen), shown(own), shown(least), where,
                !best      ? "another reading is smaller"
                : ties > 1 ? "a tie: the program took this one"
                           : "the smallest"});
  }
  out += "\n";
}

void comparison(std::string& out, const Device& device, const DeviceRule& rule) {
  const std::vector<Compared> all = compare(device, rule);
  if (all.empty()) return;
  const DeviceReportPlan& plan = device.file().report;
  const DeviceValue& value = device.file().values[rule.value];
  double before = 0, after = 0, where = all.front().position;
  for (const Compared& one : all) {
    before = std::max(before, std::abs(one.before));
    if (std::abs(one.after) > after) after = std::abs(one.after), where = one.position;
  }
  out += fmt::format("## Before and after{}\n\n", wayOf(rule));
  out += fmt::format("The largest deviation is {} mm before and {} mm after, at {}.", shown(before),
                     fixedText(after, 4), shown(where));
  if (plan.limit > 0)
    out += fmt::format(" The limit of {} mm is {}.", shown(plan.limit),
                       after <= plan.limit ? "kept" : "NOT KEPT");
  if (plan.tolerance > 0)
    out += fmt::format(" The machine's tolerance of {} mm is {}.", shown(plan.tolerance),
                       after <= plan.tolerance ? "kept" : "NOT KEPT");
  out +=
      "\n\n" + head({"position", "before, mm", fmt::format("{}, {}", value.title, value.unit), "after, mm"});
  for (const Compared& one : all)
    out += row(
        {shown(one.position), fixedText(one.before, 4), fixedText(one.value, 3), fixedText(one.after, 4)});
  out += "\n";
}

} // namespace

std::vector<Compared> compare(const Device& device, const DeviceRule& rule) {
  const DeviceReportPlan& plan = device.file().report;
  std::vector<Compared> out;
  if (plan.step == 0 || device.rows(rule.table).empty()) return out;
  for (const DeviceError& error : device.file().errors) {
    if (error.value != rule.value || error.along.axis != rule.along.axis) continue;
    if (rule.moving != DeviceMoving::Any && error.moving != DeviceMoving::Any && error.moving != rule.moving)
      continue;
    const auto count = static_cast<std::size_t>(std::floor((plan.to - plan.from) / plan.step + 1e-9));
    std::vector<double> positions;
    for (std::size_t i = 0; i <= count; ++i)
      positions.push_back(plan.from + plan.step * static_cast<double>(i));
    if (std::abs(positions.back() - plan.to) > kSame) positions.push_back(plan.to); // not a whole step on
    for (const double position : positions) {
      Compared one;
      one.position = position;
      one.value = device.ruled(rule, one.position).value_or(0);
      one.before =
          error.table.at(one.position, device.limited(rule.value, device.file().values[rule.value].initial));
      one.after = error.table.at(one.position, one.value);
      out.push_back(one);
    }
    break;
  }
  return out;
}

std::string deviceReport(const DeviceReportHead& head, const Device& device, const Machine& machine) {
  const DeviceFile& file = device.file();
  std::string out = fmt::format("# {}\n\n", file.title.empty() ? "Device" : file.title);
  out += fmt::format(
      "| | |\n|---|---|\n| Program | `{}` |\n| Control | {} |\n| Device | `{}` |\n| Run | {} |\n",
      cellText(head.program), cellText(head.control), cellText(head.device), cellText(head.ending));
  if (!head.date.empty()) out += fmt::format("| Date | {} |\n", cellText(head.date));
  out += fmt::format("| Dwells | {} s |\n\n", shown(machine.seconds()));
  if (!head.complete) out += "**The program did not come to its end: what follows is not complete.**\n\n";
  if (!head.findings.empty()) {
    out += "**The run was not clean: the numbers below come from a run in which this happened.**\n\n";
    for (std::size_t i = 0; i < std::min(head.findings.size(), kMostFindings); ++i)
      out += "- " + head.findings[i] + "\n";
    if (head.findings.size() > kMostFindings)
      out += fmt::format("- and {} more\n", head.findings.size() - kMostFindings);
    out += "\n";
  }
  for (const std::string& note : file.report.notes)
    out += note + "\n\n";
  for (const DeviceRule& rule : file.rules)
    comparison(out, device, rule);
  if (!head.picture.empty())
    out += fmt::format("![Deviation and value over the position](<{}>)\n\n", head.picture);
  for (const auto& table : file.report.tables)
    variables(out, table, machine);
  const std::size_t value = file.rules.empty() ? 0 : file.rules.front().value;
  const std::vector<Pass> all = passes(device, value);
  for (const DeviceRule& rule : file.rules)
    choices(out, device, all, rule);
  for (std::size_t i = 0; i < file.tables.size(); ++i)
    taken(out, device, i);
  if (!all.empty()) readings(out, device, all, value);
  while (out.ends_with("\n\n"))
    out.pop_back();
  return out;
}

} // namespace dotek::sim
