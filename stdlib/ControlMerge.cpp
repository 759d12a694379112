// What a control takes from the one that it extends, and what it takes away.
#include "stdlib/CodeSpan.h"
#include "stdlib/ControlReader.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace dotek::stdlib {
namespace {

template <class Ranges> bool meetsAny(const Ranges& ranges, std::uint32_t first, std::uint32_t last) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto& range) { return range.first <= last && first <= range.last; });
}

bool within(const CallCode& call, char letter, std::uint32_t code) {
  return call.letter == letter && (letter == 'T' || (code >= call.first && code < call.first + call.count));
}

} // namespace

ControlSection ControlReader::optional(std::string_view key) const {
  ControlSection out(roots_.front().range());
  for (std::size_t i = 0; i < roots_.size(); ++i)
    if (const TomlValue found = roots_[i].value(key)) out.add(found.table(), i == 0);
  return out;
}

// remove = { codes = ["G33", "M100-M199"], variables = ["2500-2899"] }
void ControlReader::removals() {
  const TomlValue value = roots_.front().value("remove");
  if (!value) return;
  if (base_ == nullptr) {
    document_.fail(value.range(), "`remove` takes facts of the control that `extends` names; there is none");
    return;
  }
  const TomlTable table = value.table();
  for (const TomlValue& item : table.value("codes").items()) {
    const auto span = codeSpan(item.text());
    if (!span) {
      document_.fail(item.range(),
                     fmt::format("`{}` is no code; `G33`, `G54.1` or `M100-M199` is the form", item.text()));
      continue;
    }
    const auto [letter, first, last] = *span;
    const bool known =
        std::any_of(base_->codes.begin(), base_->codes.end(),
                    [&, letter = letter, first = first, last = last](const CodeInfo& code) {
                      return code.letter == letter && code.tenths >= first && code.tenths <= last;
                    }) ||
        std::any_of(base_->callCodes.begin(), base_->callCodes.end(),
                    [&, letter = letter, first = first, last = last](const CallCode& call) {
                      return call.letter == letter && call.first * 10 <= last &&
                             first <= (call.first + call.count - 1) * 10;
                    });
    if (!known)
      document_.fail(item.range(), fmt::format("`{}` has no code `{}` to remove", base_->name, item.text()));
    removedCodes_.emplace_back(letter, Span{first, last});
  }
  for (const TomlValue& item : table.value("alarms").items()) {
    removedAlarms_.push_back(item.text());
    const std::string& name = removedAlarms_.back();
    if (name != "all" && std::none_of(base_->alarms.begin(), base_->alarms.end(),
                                      [&](const AlarmInfo& alarm) { return alarmName(alarm.alarm) == name; }))
      document_.fail(item.range(),
                     fmt::format("`{}` has no alarm `{}` to remove; `all` removes each", base_->name, name));
  }
  for (const TomlValue& item : table.value("variables").items()) {
    std::string text = item.isText() ? item.text() : std::to_string(item.integer(0, 1, 999999));
    std::string_view rest = text;
    const auto number = [&]() -> std::uint32_t {
      if (rest.starts_with('#')) rest.remove_prefix(1);
      std::uint32_t out = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), out);
      rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
      return error == std::errc() ? out : 0;
    };
    Span span;
    span.first = span.last = number();
    if (rest.starts_with('-')) {
      rest.remove_prefix(1);
      span.last = number();
    }
    if (!rest.empty() || span.first == 0 || span.last < span.first || span.last > 999999)
      document_.fail(item.range(),
                     fmt::format("`{}` is no range of variables; `2500-2899` is the form", text));
    removedVariables_.push_back(span);
  }
}

bool ControlReader::isRemoved(char letter, std::uint32_t tenths) const {
  return std::any_of(removedCodes_.begin(), removedCodes_.end(), [&](const auto& one) {
    return one.first == letter && one.second.meets(tenths, tenths);
  });
}

bool ControlReader::isRemoved(std::uint32_t variable) const {
  return meetsAny(removedVariables_, variable, variable);
}

// Ranges that the control does not state itself, without what it removes.
void ControlReader::inherit(std::vector<VariableRange>& ranges,
                            const std::vector<VariableRange>& base) const {
  const std::size_t stated = ranges.size();
  const auto isStated = [&](const VariableRange& range) {
    return std::any_of(
        ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(stated),
        [&](const VariableRange& own) { return own.first <= range.last && range.first <= own.last; });
  };
  for (const VariableRange& range : base) {
    if (isStated(range)) continue;
    std::vector<VariableRange> parts = {range};
    for (const Span& span : removedVariables_) {
      std::vector<VariableRange> left;
      for (const VariableRange& part : parts) {
        if (!span.meets(part.first, part.last)) {
          left.push_back(part);
          continue;
        }
        if (part.first < span.first) left.push_back({part.first, span.first - 1, part.kept});
        if (part.last > span.last) left.push_back({span.last + 1, part.last, part.kept});
      }
      parts = std::move(left);
    }
    ranges.insert(ranges.end(), parts.begin(), parts.end());
  }
  if (ranges.size() > kMostRanges)
    document_.fail(roots_.front().range(), fmt::format("more than {} ranges", kMostRanges));
}

void ControlReader::inheritStates() {
  const std::size_t stated = control_.state.size();
  const auto isStated = [&](std::uint32_t first, std::uint32_t last) {
    return std::any_of(control_.state.begin(), control_.state.begin() + static_cast<std::ptrdiff_t>(stated),
                       [&](const StateRange& own) {
                         return (own.first <= last && first <= own.last) ||
                                (own.word && first <= *own.word && *own.word <= last);
                       });
  };
  for (const StateRange& range : base_->state) {
    if (isStated(range.first, range.last) || (range.word && isStated(*range.word, *range.word))) continue;
    std::uint32_t removed = 0;
    for (std::uint32_t n = range.first; n <= range.last; ++n)
      removed += isRemoved(n) ? 1 : 0;
    StateRange kept = range;
    if (kept.word && isRemoved(*kept.word)) kept.word.reset();
    if (removed == 0) {
      control_.state.push_back(std::move(kept));
    } else if (removed <= range.last - range.first) {
      document_.fail(
          roots_.front().value("remove").range(),
          fmt::format("#{} to #{} are one state; a part of it cannot be removed: state the rest in a "
                      "[[state]] of this file",
                      range.first, range.last));
    }
  }
}

void ControlReader::inheritCodes() {
  for (const CodeInfo& code : base_->codes) {
    const bool calls =
        code.tenths % 10 == 0 &&
        std::any_of(control_.callCodes.begin(), control_.callCodes.end(), [&](const CallCode& call) {
          return call.program != 0 && within(call, code.letter, code.tenths / 10);
        });
    if (!calls && control_.find(code.letter, code.tenths) == nullptr && !isRemoved(code.letter, code.tenths))
      control_.codes.push_back(code);
  }
}

void ControlReader::inheritCalls() {
  const std::size_t stated = control_.callCodes.size();
  for (const CallCode& call : base_->callCodes) {
    bool replaced = false;
    for (std::uint32_t i = 0; i < call.count && !replaced; ++i) {
      const std::uint32_t code = call.first + i;
      replaced = isRemoved(call.letter, code * 10) || (call.letter != 'T' && call.program != 0 &&
                                                       control_.find(call.letter, code * 10) != nullptr);
      for (std::size_t own = 0; own < stated && !replaced; ++own)
        replaced = within(control_.callCodes[own], call.letter, code);
    }
    if (!replaced) control_.callCodes.push_back(call);
  }
}

} // namespace dotek::stdlib
