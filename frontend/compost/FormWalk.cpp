#include "frontend/compost/FormWalk.h"

#include "frontend/compost/Slips.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"
#include "support/messages/ComPost.h"

namespace dotek::frontend::compost {

FormWalk::FormWalk(const Program& program, const stdlib::Form& form, const std::set<std::string>& assumptions,
                   const Limits& limits, Diagnostics& diagnostics)
    : form_(form), limits_(limits), diagnostics_(&diagnostics), tables_(program, form),
      conditions_(program, form, assumptions), program_(program) {}

bool FormWalk::step(SourceRange where) {
  if (stopped_) return false;
  if (++steps_ <= limits_.steps) return true;
  refuse<diag::PostRunsForever>(where, limits_.steps);
  stopped_ = true;
  return false;
}

bool FormWalk::enter(const Routine& routine, SourceRange where) {
  if (stopped_) return false;
  if (depth_ >= limits_.callDepth) {
    refuse<diag::CallsTooDeep>(where, routine.name, limits_.callDepth);
    stopped_ = true;
    return false;
  }
  ++depth_;
  return true;
}

bool FormWalk::grow(std::size_t bytes, SourceRange where) {
  bytes_ += bytes;
  if (bytes_ <= limits_.outputBytes) return true;
  refuse<diag::OutputTooLarge>(where, limits_.outputBytes);
  stopped_ = true;
  return false;
}

const Routine* FormWalk::routineOf(const Word& word) const {
  const bool plain = word.kind == WordKind::Command && word.arguments.empty() &&
                     word.name != kSetFlagKeyword && word.name != kClearFlagKeyword;
  return plain ? tables_.routine(word.name) : nullptr;
}

void FormWalk::word(const Word& word) {
  switch (word.kind) {
  case WordKind::Command: command(word); return;
  case WordKind::Numeric: numeric(word); return;
  case WordKind::Boolean: refuse<diag::BooleanAsStatement>(word.range, word.name); return;
  }
}

namespace {

// "; or did you mean ..": "" for "".
std::string orDidYouMean(const std::string& meant, std::string_view suffix = "") {
  return meant.empty() ? "" : fmt::format("; or did you mean `{}{}`?", meant, suffix);
}

} // namespace

// A word that the form or the Prog knows; "": none is near.
std::string FormWalk::meantCommand(const std::string& name) const {
  NearestName nearest(name);
  for (const auto& [known, entry] : form_.commands)
    nearest.offer(known);
  for (const auto& [known, entry] : form_.sequences)
    nearest.offer(known);
  for (const std::string_view known : {kSetFlagKeyword, kClearFlagKeyword})
    nearest.offer(known);
  for (const Item& item : program_.items)
    if (const auto* routine = std::get_if<Routine>(&item)) nearest.offer(routine->name);
  return isSlip(name, nearest.result()) ? nearest.result() : "";
}

std::string FormWalk::meantNumeric(const std::string& name) const {
  NearestName nearest(name);
  nearest.offer(kFieldKeyword);
  for (const auto& [known, entry] : form_.numerics)
    nearest.offer(known);
  return isSlip(name, nearest.result()) ? nearest.result() : "";
}

void FormWalk::command(const Word& word) {
  if (word.name == kSetFlagKeyword || word.name == kClearFlagKeyword) {
    if (word.arguments.size() != 1) failed();
    conditions_.setFlag(word, *diagnostics_);
    return;
  }
  if (word.arguments.empty()) {
    if (const auto entry = form_.sequences.find(word.name); entry != form_.sequences.end()) {
      tables_.noteAssumed(word.name, entry->second, word.range, *diagnostics_);
      sequenceNumber(entry->second.text, word.range);
      return;
    }
    if (const auto entry = form_.commands.find(word.name); entry != form_.commands.end()) {
      tables_.noteAssumed(word.name, entry->second, word.range, *diagnostics_);
      text(entry->second.text, word.range);
      if (entry->second.value.empty()) return;
      if (const SourceRange* format = tables_.commandFormat(word.name)) {
        refuse<diag::FormatOfCommand>(*format, word.name, form_.name);
        return;
      }
      value({PrintedValue::From::Host, entry->second.value, word},
            [&, &form = entry->second] { return commandPicture(word.name, form.picture); });
      return;
    }
  }
  failed();
  if (!isNew(diag::CommandNotInForm::code, word.name)) return;
  const std::string meant = meantCommand(word.name);
  refuse<diag::CommandNotInForm>(word.nameRange, word.name, form_.name, form_.origin, orDidYouMean(meant))
      .fix = writeInstead(word.nameRange, meant);
}

const Picture* FormWalk::commandPicture(const std::string& name, const std::string& text) {
  const auto known = commandPictures_.find(name);
  if (known != commandPictures_.end()) return &known->second;
  auto parsed = Picture::parse(text);
  auto* picture = std::get_if<Picture>(&parsed);
  return picture == nullptr ? nullptr : &commandPictures_.emplace(name, std::move(*picture)).first->second;
}

void FormWalk::numeric(const Word& word) {
  PrintedValue::From from = PrintedValue::From::Field;
  std::string_view name;
  if (word.name == kFieldKeyword) {
    if (word.arguments.size() != 1 || word.arguments.front().text.empty()) {
      refuse<diag::FieldNeedsName>(word.range);
      return;
    }
    name = word.arguments.front().text;
  } else {
    const auto entry = form_.numerics.find(word.name);
    if (entry == form_.numerics.end() || entry->second.value.empty()) {
      failed();
      if (!isNew(diag::NumericNotInForm::code, word.name)) return;
      const std::string meant = meantNumeric(word.name);
      refuse<diag::NumericNotInForm>(word.nameRange, word.name, form_.name, form_.origin,
                                     orDidYouMean(meant, "#"))
          .fix = writeInstead(word.nameRange, meant);
      return;
    }
    tables_.noteAssumed(word.name, entry->second, word.range, *diagnostics_);
    from = PrintedValue::From::Host;
    name = entry->second.value;
  }
  value({from, name, word}, [&] { return tables_.picture(word.name, word.range, *diagnostics_); });
}

} // namespace dotek::frontend::compost
