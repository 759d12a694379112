// What two runs leave: work offsets, tool offsets, variables, modes.
#include "verify/CompareLeft.h"
#include "verify/RadiusTable.h"

#include "sim/machine/Value.h"
#include "support/Decimal.h"
#include "verify/CompareParts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace dotek::verify {

namespace {

constexpr int kShown = 6; // decimals

class LeftComparison {
public:
  LeftComparison(const Record& source, const Record& target, const CompareRules& rules)
      : source_(source), target_(target), rules_(rules) {}

  std::vector<Difference> values() {
    zeros();
    otherZeros();
    tools();
    stores();
    return std::move(out_);
  }
  std::vector<Difference> modalGroups() {
    modes();
    return std::move(out_);
  }

private:
  void add(Aspect aspect, std::string text, SourceRange source, SourceRange target) {
    addFirst(out_, {aspect, std::move(text), source, target});
  }

  // Where a side wrote it last. Where that is not known, what follows the last measure made it.
  template <class Key>
  static SourceRange writtenIn(const Record& record, const std::map<Key, SourceRange>& places,
                               const Key& key) {
    const auto found = places.find(key);
    return found == places.end() ? lastMeasure(record) : found->second;
  }
  static SourceRange zeroIn(const Record& record, const std::pair<std::uint32_t, std::uint32_t>& key) {
    const char axis = "XYZ"[key.second];
    const std::string name = fmt::format("{} {}", systemName(key.first), axis);
    return writtenIn(record, record.offsetAt,
                     record.offsetAt.contains(name) ? name : fmt::format("external {}", axis));
  }
  static SourceRange toolIn(const Record& record, std::uint32_t number) {
    const bool radius = number > kRadiusTable;
    return writtenIn(
        record, record.offsetAt,
        fmt::format("{}tool {}", radius ? "radius of " : "", radius ? number - kRadiusTable : number));
  }

  void zeros() {
    for (const auto& [key, value] : source_.zeros) {
      const auto other = target_.zeros.find(key);
      const double equal = std::max(rules_.results, rules_.relative * std::abs(value));
      if (other != target_.zeros.end() && std::abs(other->second - value) <= equal) continue;
      const bool shift = key.first == 52 || key.first == 92;
      const std::string what = fmt::format("{} {} along {}", shift ? "what" : "the zero of",
                                           systemName(key.first), "XYZ"[key.second]);
      const std::string where = fixedText(value, kShown);
      add(Aspect::Offset,
          other == target_.zeros.end()
              ? fmt::format("the source moves {} to {}, the translation does not", what, where)
              : fmt::format("{} {} {}{} against {}", what,
                            shift ? "has shifted all work systems by is" : "lies at", where,
                            shift ? "" : " of the machine", fixedText(other->second, kShown)),
          zeroIn(source_, key), zeroIn(target_, key));
      return;
    }
  }

  // Of additional systems only those are there that were changed.
  void otherZeros() {
    for (const auto& [key, value] : target_.zeros) {
      if (key.first <= kExtendedSystem || source_.zeros.contains(key)) continue;
      add(Aspect::Offset,
          fmt::format("the translation moves the zero of {} along {} to {}, the source does not",
                      systemName(key.first), "XYZ"[key.second], fixedText(value, kShown)),
          zeroIn(source_, key), zeroIn(target_, key));
      return;
    }
  }

  void tools() {
    if (rules_.atMeasures) return;
    using Entry = sim::Machine::ToolOffset;
    const auto same = [&](double one, double other) {
      return std::abs(one - other) <= std::max(rules_.results, rules_.relative * std::abs(one));
    };
    const auto entry = [](const Record& record, std::uint32_t number) {
      const auto at = record.tools.find(number);
      return at == record.tools.end() ? std::optional<Entry>() : at->second;
    };
    const auto tell = [&](const std::optional<Entry>& tool) {
      if (!tool) return std::string("does not write it");
      if (!rules_.toolParts) return "makes it " + fixedText(tool->geometry + tool->wear, kShown);
      return fmt::format("makes it {} with a wear of {}", fixedText(tool->geometry, kShown),
                         fixedText(tool->wear, kShown));
    };
    const auto differs = [&](const std::optional<Entry>& a, const std::optional<Entry>& b) {
      if (!a || !b) return true;
      return !(rules_.toolParts ? same(a->wear, b->wear) && same(a->geometry, b->geometry)
                                : same(a->wear + a->geometry, b->wear + b->geometry));
    };
    std::set<std::uint32_t> numbers;
    for (const Record* record : {&source_, &target_})
      for (const auto& [number, changed] : record->tools)
        numbers.insert(number);
    for (const std::uint32_t number : numbers) {
      const std::optional<Entry> one = entry(source_, number), other = entry(target_, number);
      if (!differs(one, other)) continue;
      add(Aspect::Tool,
          fmt::format("{}tool offset {}: the source {}, the translation {}",
                      number > kRadiusTable ? "radius of " : "",
                      number > kRadiusTable ? number - kRadiusTable : number, tell(one), tell(other)),
          toolIn(source_, number), toolIn(target_, number));
      return;
    }
  }

  static bool isNumber(double value) { return !sim::isNull(value) && !sim::isUnknown(value); }

  void stores() {
    const auto differ = [&](std::uint32_t number) {
      const auto one = source_.stores.find(number), other = target_.stores.find(number);
      const bool both = one != source_.stores.end() && other != target_.stores.end();
      if (both && isNumber(one->second) && isNumber(other->second)) {
        const ShownNumbers shown = shownNumbers(one->second, other->second);
        add(Aspect::Variable, fmt::format("#{} is {} against {}", number, shown.source, shown.target),
            writtenIn(source_, source_.storedAt, number), writtenIn(target_, target_.storedAt, number));
        return;
      }
      const auto left = [&](const std::map<std::uint32_t, double>& stores, const auto& found) {
        if (found == stores.end()) return std::string("does not write it");
        if (sim::isUnknown(found->second)) return std::string("leaves a value that is not known");
        if (sim::isNull(found->second)) return std::string("leaves it null");
        return "leaves it at " + shownNumbers(found->second, found->second + 1).source;
      };
      add(Aspect::Variable,
          fmt::format("#{}: the source {}, the translation {}", number, left(source_.stores, one),
                      left(target_.stores, other)),
          writtenIn(source_, source_.storedAt, number), writtenIn(target_, target_.storedAt, number));
    };
    for (const auto& [number, value] : source_.stores) {
      const auto other = target_.stores.find(number);
      if (other != target_.stores.end()) {
        const bool null = sim::isNull(value), otherNull = sim::isNull(other->second);
        const bool unknown = sim::isUnknown(value) || sim::isUnknown(other->second);
        if (unknown ? sim::isUnknown(value) && sim::isUnknown(other->second)
                    : null == otherNull && (null || std::abs(value - other->second) <=
                                                        std::max({rules_.results, rules_.angles,
                                                                  rules_.relative * std::abs(value)})))
          continue;
      }
      differ(number);
      return;
    }
    if (!rules_.sameProgram) return;
    for (const auto& [number, value] : target_.stores) {
      if (source_.stores.contains(number)) continue;
      differ(number);
      return;
    }
  }

  void modes() {
    if (rules_.sourceControl != rules_.targetControl) {
      modesByMeaning();
      return;
    }
    for (std::size_t group = 1; group < source_.modalAfter.size(); ++group) {
      const std::uint32_t one = source_.modalAfter[group], other = target_.modalAfter[group];
      if (one == other || (rules_.mayRestoreModes && other == target_.modalBefore[group])) continue;
      add(Aspect::Modal,
          fmt::format("G{} of group {} against G{}", numberText(one / 10.0), group, numberText(other / 10.0)),
          {}, {});
      return;
    }
  }

  // The code of the target's control that means what this one of the source's does; nullptr: it has none.
  const stdlib::CodeInfo* asTarget(std::uint32_t tenths, std::size_t group) const {
    const stdlib::CodeInfo* const code = rules_.sourceControl->find('G', tenths);
    // 0 may be G0, or no code of the group.
    if (code == nullptr || !code->group || static_cast<std::size_t>(*code->group) != group) return nullptr;
    const stdlib::CodeInfo* const same = rules_.targetControl->find('G', tenths);
    if (same != nullptr && same->function == code->function) return same;
    return code->function == stdlib::Function::Other ? nullptr : rules_.targetControl->find(code->function);
  }

  // Groups that only one of the controls has say nothing.
  void modesByMeaning() {
    for (std::size_t group = 1; group < source_.modalAfter.size(); ++group) {
      const std::uint32_t one = source_.modalAfter[group];
      const stdlib::CodeInfo* const meant = asTarget(one, group);
      const std::size_t theirs =
          meant != nullptr && meant->group ? static_cast<std::size_t>(*meant->group) : 0;
      if (theirs == 0 || theirs >= target_.modalAfter.size()) continue;
      const std::uint32_t other = target_.modalAfter[theirs];
      if (other == meant->tenths || (rules_.mayRestoreModes && other == target_.modalBefore[theirs]))
        continue;
      add(Aspect::Modal,
          fmt::format("G{} of group {} against G{}", numberText(one / 10.0), group, numberText(other / 10.0)),
          {}, {});
      return;
    }
  }

  const Record& source_;
  const Record& target_;
  const CompareRules& rules_;
  std::vector<Difference> out_;
};

} // namespace

void addFirst(std::vector<Difference>& list, Difference one) {
  const bool there = std::any_of(list.begin(), list.end(),
                                 [&](const Difference& other) { return other.aspect == one.aspect; });
  if (!there) list.push_back(std::move(one));
}

std::string systemName(std::uint32_t system) {
  return system > kExtendedSystem ? fmt::format("G54.1 P{}", system - kExtendedSystem)
                                  : fmt::format("G{}", system);
}

std::vector<Difference> compareIdleMoves(const Record& source, const Record& target,
                                         const CompareRules& rules) {
  const std::vector<IdleMove>&a = source.idle, &b = target.idle;
  std::vector<Difference> out;
  if (a.size() != b.size()) return out; // a translation may leave out what moves nothing
  const auto word = [](const std::optional<double>& value) {
    return value ? numberText(*value) : std::string("nothing");
  };
  const auto same = [&](const std::optional<double>& one, const std::optional<double>& other) {
    return one && other ? std::abs(*one - *other) <= std::max(rules.results, rules.relative * std::abs(*one))
                        : one.has_value() == other.has_value();
  };
  const auto valueOf = [](const IdleMove& move, std::uint32_t local) {
    const auto found = move.given.find(local);
    return found == move.given.end() ? std::nullopt : std::optional(found->second);
  };
  for (std::size_t i = 0; i < a.size() && out.empty(); ++i) {
    if (a[i].program == 0 || b[i].program == 0) return out;
    if (!same(a[i].feed, b[i].feed) && a[i].feed && b[i].feed)
      addFirst(out, {Aspect::Path,
                     fmt::format("a protected move that stays where it is, at F{} against F{}",
                                 word(a[i].feed), word(b[i].feed)),
                     a[i].range, b[i].range});
    if (!rules.sameAlarmNumbers || a[i].program != b[i].program) continue;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      const std::uint32_t local = stdlib::localOf(letter);
      if (local == 0 || same(valueOf(a[i], local), valueOf(b[i], local))) continue;
      addFirst(out, {Aspect::Path,
                     fmt::format("P{} called with {} {} against {}", a[i].program, letter,
                                 word(valueOf(a[i], local)), word(valueOf(b[i], local))),
                     a[i].range, b[i].range});
    }
  }
  return out;
}

std::vector<Difference> compareValues(const Record& source, const Record& target, const CompareRules& rules) {
  return LeftComparison(source, target, rules).values();
}

std::vector<Difference> compareModes(const Record& source, const Record& target, const CompareRules& rules) {
  return LeftComparison(source, target, rules).modalGroups();
}

} // namespace dotek::verify
