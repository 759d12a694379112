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

bool sameWrite(const Write& a, const Write& b, const CompareRules& rules) {
  if (sim::isUnknown(a.value) || sim::isUnknown(b.value)) return true;
  if (sim::isNull(a.value) || sim::isNull(b.value)) return sim::isNull(a.value) == sim::isNull(b.value);
  return std::abs(a.value - b.value) <=
         std::max({rules.results, rules.angles, rules.relative * std::abs(a.value)});
}

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
    turn();
    return std::move(out_);
  }

private:
  using Writes = std::vector<Write>;
  using Zero = std::pair<std::uint32_t, std::uint32_t>; // key of Record::zeros

  struct Written {
    const Writes *source = nullptr, *target = nullptr; // nullptr: nothing
    bool known = true;                                 // else only that it was written
    bool offset = true;                                // no variable
    bool bySource() const { return source != nullptr; }
    bool byTarget() const { return target != nullptr; }
  };

  // false: there are enough of the aspect.
  bool add(Aspect aspect, std::string subject, std::string text, const Written& written) {
    const auto [source, target] = apart(written);
    // What the source writes instead is another difference of the same statement.
    if (written.byTarget() && !written.bySource()) subject.insert(0, "only ");
    addFirst(out_, {aspect, std::move(text), source, target, std::move(subject)});
    return static_cast<std::size_t>(std::count_if(out_.begin(), out_.end(), [&](const Difference& one) {
             return one.aspect == aspect;
           })) < kMostOfAspect;
  }

  template <class Key> static const Writes* writesOf(const std::map<Key, Writes>& all, const Key& key) {
    const auto found = all.find(key);
    return found == all.end() ? nullptr : &found->second;
  }
  Written writtenOffset(const std::string& name) const {
    return {writesOf(source_.offsetWrites, name), writesOf(target_.offsetWrites, name)};
  }
  Written writtenZero(const Zero& key) const {
    const Written out = writtenOffset(subjectOf(key));
    return out.bySource() || out.byTarget()
               ? out
               : writtenOffset(fmt::format("external {}", sim::kAxisLetters[key.second]));
  }
  static std::string subjectOf(const Zero& key) {
    return fmt::format("{} {}", systemName(key.first), sim::kAxisLetters[key.second]);
  }
  Written writtenStore(std::uint32_t number) const {
    return {writesOf(source_.storeWrites, number), writesOf(target_.storeWrites, number),
            source_.knowsStores && target_.knowsStores, false};
  }

  // Where the two first write it differently. Of what nobody writes by itself, what follows the last measure
  // made it.
  std::pair<SourceRange, SourceRange> apart(const Written& written) const {
    if (!written.known || (!written.bySource() && !written.byTarget()))
      return {written.bySource() ? written.source->back().range : lastMeasure(source_),
              written.byTarget() ? written.target->back().range : lastMeasure(target_)};
    static const Writes kNone;
    const Writes& a = written.bySource() ? *written.source : kNone;
    const Writes& b = written.byTarget() ? *written.target : kNone;
    std::size_t n = 0;
    while (n < std::min(a.size(), b.size()) && sameWrite(a[n], b[n], rules_))
      ++n;
    const bool here = n < a.size(), there = n < b.size();
    if (!here && !there) return {a.back().range, b.back().range};
    if (!there) return {a[n].range, instead(written, a[n].range, true)};
    if (!here) return {instead(written, b[n].range, false), b[n].range};
    if (a.size() == b.size()) return {a[n].range, b[n].range};
    // One side writes more often. What it writes here may be what the other lacks, as far as measures or the
    // places that lines stem from show it; else what comes last counts.
    const bool more = a.size() > b.size();
    const SourceRange own = more ? a[n].range : b[n].range, paired = more ? b[n].range : a[n].range;
    const SourceRange beside = more ? alongside(source_, target_, own) : alongside(target_, source_, own);
    if (beside.hasPlace() ? beside == paired : mayPair(a[n], b[n])) return {a.back().range, b.back().range};
    return more ? std::pair(own, beside) : std::pair(beside, own);
  }

  bool mayPair(const Write& a, const Write& b) const {
    return !rules_.samePlace || !a.range.hasPlace() || rules_.samePlace(a.range, b.range);
  }

  // Where the other side, in the place of a write, writes what this one does not write at all; else what it
  // measures there. `ofSource`: whose write it is.
  SourceRange instead(const Written& written, SourceRange range, bool ofSource) const {
    const Record &one = ofSource ? source_ : target_, &other = ofSource ? target_ : source_;
    const auto find = [&](const auto& mine, const auto& theirs) -> SourceRange {
      for (const auto& [name, writes] : theirs)
        for (const Write& write : writes)
          if (!mine.contains(name) && write.range.hasPlace() &&
              (ofSource ? rules_.samePlace(range, write.range) : rules_.samePlace(write.range, range)))
            return write.range;
      return {};
    };
    const SourceRange found = !rules_.samePlace || !range.hasPlace() ? SourceRange{}
                              : written.offset ? find(one.offsetWrites, other.offsetWrites)
                                               : find(one.storeWrites, other.storeWrites);
    return found.hasPlace() ? found : alongside(one, other, range);
  }

  // What the other side does in the place of a measure that writes something.
  static SourceRange alongside(const Record& one, const Record& other, SourceRange range) {
    for (std::size_t i = 0; i < std::min(one.measures.size(), other.measures.size()); ++i)
      if (one.measures[i].range == range) return other.measures[i].range;
    return {};
  }

  void zeros() {
    for (const auto& [key, value] : source_.zeros) {
      const auto other = target_.zeros.find(key);
      const double equal =
          std::max({rules_.results, rules_.relative * std::abs(value), key.second > 2 ? rules_.angles : 0});
      if (other != target_.zeros.end() && std::abs(other->second - value) <= equal) continue;
      const bool shift = key.first == 52 || key.first == 92;
      const std::string what = fmt::format("{} {} along {}", shift ? "what" : "the zero of",
                                           systemName(key.first), sim::kAxisLetters[key.second]);
      const Written written = writtenZero(key);
      const std::string where = fixedText(value, kShown);
      std::string text;
      if (other == target_.zeros.end() || (!shift && written.bySource() && !written.byTarget()))
        text = fmt::format("the source moves {} to {}{}, the translation does not", what, where,
                           other == target_.zeros.end() ? "" : " of the machine");
      else if (!shift && written.byTarget() && !written.bySource())
        text = fmt::format("the translation moves {} to {} of the machine, the source does not", what,
                           fixedText(other->second, kShown));
      else
        text = fmt::format("{} {} {}{} against {}", what,
                           shift ? "has shifted all work systems by is" : "lies at", where,
                           shift ? "" : " of the machine", fixedText(other->second, kShown));
      if (!add(Aspect::Offset, subjectOf(key), std::move(text), written)) return;
    }
  }

  // Of additional systems, and along axes beside X, Y and Z, only those are there that were changed.
  void otherZeros() {
    for (const auto& [key, value] : target_.zeros) {
      if ((key.first <= kExtendedSystem && key.second < 3) || source_.zeros.contains(key)) continue;
      if (!add(Aspect::Offset, subjectOf(key),
               fmt::format("the translation moves the zero of {} along {} to {}, the source does not",
                           systemName(key.first), sim::kAxisLetters[key.second], fixedText(value, kShown)),
               writtenZero(key)))
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
      const std::string_view radius = number > kRadiusTable ? "radius of " : "";
      const std::uint32_t tool = number > kRadiusTable ? number - kRadiusTable : number;
      const std::string subject = fmt::format("{}tool {}", radius, tool);
      if (!add(Aspect::Tool, subject,
               fmt::format("{}tool offset {}: the source {}, the translation {}", radius, tool, tell(one),
                           tell(other)),
               writtenOffset(subject)))
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
        return add(Aspect::Variable, fmt::format("#{}", number),
                   fmt::format("#{} is {} against {}", number, shown.source, shown.target),
                   writtenStore(number));
      }
      const auto left = [&](const std::map<std::uint32_t, double>& stores, const auto& found) {
        if (found == stores.end()) return std::string("does not write it");
        if (sim::isUnknown(found->second)) return std::string("leaves a value that is not known");
        if (sim::isNull(found->second)) return std::string("leaves it null");
        return "leaves it at " + shownNumbers(found->second, found->second + 1).source;
      };
      return add(Aspect::Variable, fmt::format("#{}", number),
                 fmt::format("#{}: the source {}, the translation {}", number, left(source_.stores, one),
                             left(target_.stores, other)),
                 writtenStore(number));
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
      if (!differ(number)) return;
    }
    if (!rules_.sameProgram) return;
    for (const auto& [number, value] : target_.stores) {
      if (!source_.stores.contains(number) && !differ(number)) return;
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
      addFirst(out_, {Aspect::Modal,
                      fmt::format("G{} of group {} against G{}", numberText(one / 10.0), group,
                                  numberText(other / 10.0)),
                      {},
                      {}});
      return;
    }
  }

  // Coordinates that the source leaves turned: a program does not put them back, and it turns them alike.
  void turn() {
    const auto one = source_.turn.value_or(std::array<double, 4>{}),
               other = target_.turn.value_or(std::array<double, 4>{});
    bool same = std::abs(one[0] - other[0]) <= std::max(rules_.results, rules_.angles);
    // The zero lies the farther away from the centre, the more the angle moves it.
    const double equal = rules_.results + rules_.angles / 57 * std::hypot(one[1], one[2], one[3]);
    for (std::size_t i = 1; i < one.size(); ++i)
      same = same && std::abs(one[i] - other[i]) <= equal;
    if (same) return;
    const auto text = [](const std::array<double, 4>& turned) {
      return turned == std::array<double, 4>{}
                 ? std::string("not turned")
                 : fmt::format("turned by {} degrees, with the zero at X{} Y{} Z{}",
                               fixedText(turned[0], kShown), fixedText(turned[1], kShown),
                               fixedText(turned[2], kShown), fixedText(turned[3], kShown));
    };
    addFirst(out_, {Aspect::Modal, fmt::format("coordinates {} against {}", text(one), text(other)), {}, {}});
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
      addFirst(out_, {Aspect::Modal,
                      fmt::format("G{} of group {} against G{}", numberText(one / 10.0), group,
                                  numberText(other / 10.0)),
                      {},
                      {}});
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
  const bool there = std::any_of(list.begin(), list.end(), [&](const Difference& other) {
    return other.aspect == one.aspect && other.subject == one.subject;
  });
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

std::optional<Difference> earlierOffset(const Record& source, const Record& target, const CompareRules& rules,
                                        std::size_t sourcePieces, std::size_t targetPieces) {
  std::optional<Difference> out;
  std::size_t first = 0; // pieces before it
  for (const auto& [name, a] : source.offsetWrites) {
    const auto found = target.offsetWrites.find(name);
    if (found == target.offsetWrites.end()) continue;
    const std::vector<Write>& b = found->second;
    const auto until = [](const std::vector<Write>& all, std::size_t pieces) {
      return std::count_if(all.begin(), all.end(), [&](const Write& one) { return one.pieces <= pieces; });
    };
    const auto count = static_cast<std::size_t>(until(a, sourcePieces));
    if (until(b, targetPieces) != static_cast<std::ptrdiff_t>(count)) continue;
    for (std::size_t n = 0; n < count; ++n) {
      if (sameWrite(a[n], b[n], rules)) continue;
      if (out && first <= a[n].pieces) break;
      first = a[n].pieces;
      const bool ofTool = name.find("tool") != std::string::npos;
      out = {ofTool ? Aspect::Tool : Aspect::Offset,
             fmt::format("{} is {} {} against {}", name, ofTool ? "changed by" : "set to",
                         fixedText(a[n].value, kShown), fixedText(b[n].value, kShown)),
             a[n].range, b[n].range, name};
      break;
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
