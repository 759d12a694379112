// Alarms and comments: what a control shows of a text.
#include "backends/common/PlainText.h"
#include "backends/fanuc/State.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kFirstAlarm = 100;

bool isShown(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view(" -+.,/*=").find(c) != std::string_view::npos;
}

// Says nothing by itself: a blank stands for it.
bool isPunctuation(char c) {
  return std::string_view("!?;:\"'_`~|").find(c) != std::string_view::npos;
}

bool isBracket(char c) {
  return std::string_view("()[]{}").find(c) != std::string_view::npos;
}

std::string squeezed(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c != ' ' || (!out.empty() && out.back() != ' ')) out += c;
  while (!out.empty() && out.back() == ' ')
    out.pop_back();
  return out;
}

// At most `length` characters, at a word where one ends there.
std::string cut(const std::string& text, std::size_t length) {
  const auto lines = wrapWords(text, length);
  return lines.empty() ? "" : lines.front();
}

std::uint32_t nextNumber(State& state, SourceRange range) {
  const std::uint32_t number = std::max(kFirstAlarm, state.control.alarmFirst) + state.options.alarmsBefore +
                               static_cast<std::uint32_t>(state.alarms.size());
  if (number > state.control.alarmLast)
    state.refuse<diag::TooManyAlarms>(range, state.control.title, state.control.alarmLast);
  return number;
}

// `otherwise` where nothing is left to show.
AlarmText shownText(State& state, const std::string& message, std::string_view otherwise, SourceRange range) {
  AlarmText out;
  const PlainText plain = plainText(message);
  std::string text;
  std::string unknown;
  for (const char c : upperCase(plain.text)) {
    if (isBracket(c)) continue;
    const bool shown = isShown(c);
    if (!shown && !isPunctuation(c) && unknown.find(c) == std::string::npos) unknown += c;
    text += shown ? c : ' ';
  }
  if ((plain.changed || !unknown.empty()) && !state.options.plainMessages)
    state.refuse<diag::MessageCharacters>(range, state.control.title, squeezed(text));
  text = squeezed(text);
  if (text.empty()) text = otherwise;
  out.shown = cut(text, state.control.alarmLength);
  if (out.shown != text)
    state.diagnostics.report<diag::MessageCut>(range, state.control.alarmLength, out.shown);
  // What cannot be shown cannot appear in a comment either.
  if (out.shown != text) out.full = plain.changed || !unknown.empty() ? text : headerText(message);
  return out;
}

// `check`: of a dialog, which rejects values without saying why.
AlarmText messageOf(State& state, const ir::CycleStatement& statement, const std::string& message,
                    bool check) {
  const SourceRange range = statement.origin.range();
  if (message.find_first_not_of(" \t") != std::string::npos)
    return shownText(state, message, "VALUES REFUSED", range);
  AlarmText out;
  if (!check) return out;
  out.shown = "VALUES REFUSED";
  if (range.hasPlace()) out.shown += " LINE " + std::to_string(state.sources.line(range));
  return out;
}

std::string alarmText(const AlarmText& alarm) {
  const std::string number = "#3000=" + std::to_string(alarm.number);
  return alarm.shown.empty() ? number : number + "(" + alarm.shown + ")";
}

} // namespace

std::string headerText(std::string_view utf8) {
  std::string out;
  for (const char c : upperCase(plainText(utf8).text)) {
    if (c == '(' || c == ')' || c == '%') continue;
    out += c == ';' ? ',' : c;
  }
  return squeezed(out);
}

std::string commentText(State& state, std::string_view utf8, SourceRange range) {
  const PlainText plain = plainText(utf8);
  std::string out;
  bool changed = plain.changed;
  for (const char c : plain.text) {
    if (c == '(' || c == ')' || c == '%' || c == ';') {
      changed = true;
      out += c == ';' ? "," : c == '(' ? "[" : c == ')' ? "]" : "";
    } else {
      out += c;
    }
  }
  if (changed) state.diagnostics.report<diag::CommentPlain>(range, out);
  return out;
}

void collectAlarms(State& state) {
  for (const auto* list : {&state.cycle.checks, &state.cycle.body})
    for (const ir::CycleStatement& statement : *list) {
      if (state.options.branch && list == &state.cycle.checks) break; // they are the dialog's business
      const auto* alarm = std::get_if<ir::Alarm>(&statement.node);
      if (alarm == nullptr) continue;
      AlarmText text = messageOf(state, statement, alarm->message, list == &state.cycle.checks);
      text.number = nextNumber(state, statement.origin.range());
      state.sourceAlarms[&statement] = state.alarms.size();
      state.alarms.push_back(std::move(text));
      if (state.failed) return;
    }
}

std::string stopText(State& state, const ir::Stop& stop, const ir::Origin& origin) {
  const AlarmText text = shownText(state, stop.message, "STOP", origin.range());
  if (!text.full.empty()) state.sheet.comment(text.full, origin);
  return "#" + std::to_string(*state.control.variables.message) + "=" + numberText(stop.number) + "(" +
         text.shown + ")";
}

std::string sourceAlarm(State& state, const ir::CycleStatement& statement) {
  const AlarmText& alarm = state.alarms[state.sourceAlarms.at(&statement)];
  if (!alarm.full.empty()) state.sheet.comment(alarm.full, statement.origin);
  return alarmText(alarm);
}

void alarmIf(State& state, const ir::ConditionPtr& condition, std::string_view text,
             const ir::Origin& origin) {
  const std::string shown = cut(std::string(text), state.control.alarmLength);
  const std::size_t source = state.sourceAlarms.size();
  auto found = std::find_if(state.alarms.begin() + static_cast<std::ptrdiff_t>(source), state.alarms.end(),
                            [&](const AlarmText& alarm) { return alarm.shown == shown; });
  if (found == state.alarms.end()) {
    AlarmText alarm;
    alarm.number = nextNumber(state, origin.range());
    alarm.shown = shown;
    state.alarms.push_back(alarm);
    found = state.alarms.end() - 1;
  }
  doIf(state, condition, alarmText(*found), origin);
}

} // namespace dotek::backends::fanuc
