#include "stdlib/ControlReader.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace dotek::stdlib {
namespace {

constexpr std::string_view kPlain[] = {
    "decimal",   "lengths",          "words",   "language",   "alarm",  "programs", "motion",
    "rotation",  "with_tool_length", "nesting", "read_ahead", "output", "window",   "turning",
    "variables", "macro_package",    "dwell"};

std::string shown(const TomlValue& value) {
  if (value.isText()) return value.text();
  if (value.isFlag()) return value.flag() ? "true" : "false";
  if (value.isNumber()) return numberText(value.number());
  std::string out;
  if (value.isArray())
    for (const TomlValue& item : value.items())
      out += (out.empty() ? "" : ", ") + shown(item);
  return out;
}

std::string spanText(std::uint32_t first, std::uint32_t last) {
  return first == last ? fmt::format("#{}", first) : fmt::format("#{}-#{}", first, last);
}

std::string codeName(const std::string& item) {
  return item.substr(0, std::min({item.find(' '), item.find(':'), item.size()}));
}

} // namespace

std::vector<ControlFact> ControlReader::facts(std::vector<ControlFact> base, const std::string& file) const {
  std::vector<ControlFact> out;
  const TomlTable& root = roots_.front();
  const auto inherited = [&](std::string_view section, const auto& fits) -> const ControlFact* {
    const auto at = std::find_if(base.begin(), base.end(), [&](const ControlFact& fact) {
      return fact.section == section && fits(fact);
    });
    return at == base.end() ? nullptr : &*at;
  };
  const auto add = [&](std::string_view section, std::string key, std::string text,
                       const Origin& from) -> auto& {
    return out.emplace_back(ControlFact{std::string(section), std::move(key), std::move(text), from.grade,
                                        from.source, file, 0, 0});
  };
  if (root.has("title"))
    add("title", "", control_.title, {});
  else if (const auto* title = inherited("title", [](const ControlFact&) { return true; }))
    out.push_back(*title);

  for (const std::string_view section : kPlain) {
    const TomlTable table = root.value(section).table();
    const std::size_t begin = out.size();
    for (const ControlFact& fact : base)
      if (fact.section == section &&
          std::find(removedKeys_.begin(), removedKeys_.end(), section == "window" ? "window" : fact.key) ==
              removedKeys_.end())
        out.push_back(fact);
    if (!root.has(section)) continue;
    const Origin from = origin(table);
    for (const TomlEntry& entry : table.entries()) {
      if (entry.key == "grade" || entry.key == "source") continue;
      std::erase_if(out, [&](const ControlFact& fact) {
        return &fact >= out.data() + begin && fact.section == section && fact.key == entry.key;
      });
      add(section, entry.key, shown(entry.value), from);
    }
  }

  const auto ranges = [&](std::string_view section, const auto& all, const auto& text) {
    for (const auto& range : all) {
      const TomlTable* stated = nullptr;
      const std::vector<TomlTable> tables = own(section);
      for (const TomlTable& table : tables) {
        const std::int64_t first = table.value("first").integer();
        if (first == range.first && table.value("last").integer(first) == range.last) stated = &table;
      }
      std::string key = spanText(range.first, range.last);
      if (stated != nullptr) {
        add(section, std::move(key), text(range), origin(*stated));
      } else if (const auto* fact = inherited(section, [&](const ControlFact& one) {
                   return one.first <= range.first && range.last <= one.last;
                 })) {
        out.push_back(*fact);
        out.back().key = std::move(key);
      }
      out.back().first = range.first;
      out.back().last = range.last;
    }
  };
  ranges("common", control_.common, [](const VariableRange& range) {
    return std::string(range.kept ? "kept at power off" : "lost at power off");
  });
  const auto nothing = [](const VariableRange&) { return std::string(); };
  ranges("read_only", control_.readOnly, nothing);
  ranges("tool_offsets", control_.toolOffsets, nothing);
  ranges("state", control_.state, [](const StateRange& range) { return range.title; });

  std::set<std::string> named;
  for (const TomlTable& table : own("codes"))
    for (const TomlValue& item : table.value("list").items())
      named.insert(codeName(item.text()));
  for (const TomlTable& table : own("alarms"))
    for (const TomlValue& item : table.value("list").items())
      named.insert(codeName(item.text()));
  const auto listed = [&](std::string_view section, const std::string& key, const std::string& text,
                          const auto& info) {
    const auto* fact = named.contains(key) ? nullptr : inherited(section, [&](const ControlFact& one) {
      return one.key == key && one.text == text;
    });
    if (fact != nullptr)
      out.push_back(*fact);
    else
      add(section, key, text, {info.grade, info.source});
  };
  for (const CodeInfo& code : control_.codes) {
    std::string text(code.function == Function::Other ? "" : functionName(code.function));
    if (code.group) text += fmt::format("{}group {}", text.empty() ? "" : ", ", *code.group);
    listed("codes", codeText(code.letter, code.tenths), text + (text.empty() ? "" : ": ") + code.title, code);
  }
  for (const CallCode& call : control_.callCodes)
    listed("calls",
           call.letter == 'T' ? "T"
           : call.count == 1  ? codeText(call.letter, call.first * 10)
                              : fmt::format("{}-{}", codeText(call.letter, call.first * 10),
                                            codeText(call.letter, (call.first + call.count - 1) * 10)),
           call.program == 0
               ? fmt::format("block {} of the same program as subprogram", static_cast<char>(*call.holds))
               : fmt::format("O{} as {}", call.program, call.macro ? "macro" : "subprogram"),
           call);
  for (const AlarmInfo& alarm : control_.alarms)
    listed("alarms", std::string(alarmName(alarm.alarm)), fmt::format("{} {}", alarm.number, alarm.text),
           alarm);
  return out;
}

} // namespace dotek::stdlib
