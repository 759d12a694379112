#include "frontend/compost/Post.h"

#include "frontend/compost/PostRun.h"
#include "support/Decimal.h"
#include "support/messages/ComPost.h"

#include <algorithm>
#include <cmath>

namespace dotek::frontend::compost {
namespace {

bool isPrintableAscii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

} // namespace

PostRun::Impl::Impl(const Program& program, const PostSettings& settingsIn, Diagnostics& diagnosticsIn)
    : settings(settingsIn), diagnostics(diagnosticsIn), tables(program, settingsIn.form),
      conditions(program, settingsIn.form, settingsIn.assumptions), sequence(settingsIn.sequenceStart) {}

PostRun::PostRun(const Program& program, const PostSettings& settings, Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>(program, settings, diagnostics)) {}
PostRun::~PostRun() = default;

void PostRun::run(const Routine& routine, const Operation& operation) {
  impl_->operation = &operation;
  impl_->conditions.cycle = operation.cycle;
  impl_->call(routine, routine.nameRange);
  impl_->operation = nullptr;
}

std::size_t PostRun::lineCount() const {
  return impl_->lines.size() + (impl_->line.empty() ? 0 : 1);
}

std::vector<PostedLine> PostRun::finish() {
  if (!impl_->line.empty() && !impl_->stopped) {
    if (!impl_->diagnostics.hasErrors())
      impl_->diagnostics.report<diag::UnfinishedLine>(impl_->lineRange, impl_->line);
    impl_->endLine(impl_->lineRange);
  }
  return std::move(impl_->lines);
}

bool PostRun::Impl::tell(std::string_view code, std::string_view cause) {
  return told.insert(std::string(code) + ' ' + std::string(cause)).second;
}

bool PostRun::Impl::step(SourceRange where) {
  if (stopped) return false;
  if (++steps > settings.limits.steps) {
    diagnostics.report<diag::PostRunsForever>(where, settings.limits.steps);
    stopped = true;
  }
  return !stopped;
}

void PostRun::Impl::call(const Routine& routine, SourceRange where) {
  if (stopped) return;
  if (depth >= settings.limits.callDepth) {
    diagnostics.report<diag::CallsTooDeep>(where, routine.name, settings.limits.callDepth);
    stopped = true;
    return;
  }
  ++depth;
  body(routine.body);
  --depth;
}

void PostRun::Impl::body(const std::vector<Statement>& statements) {
  for (const Statement& statement : statements) {
    if (const auto* literal = std::get_if<Literal>(&statement)) {
      if (!step(literal->range)) return;
      if (!isPrintableAscii(literal->text)) diagnostics.report<diag::TextNotAscii>(literal->range);
      print(literal->text, literal->range);
    } else if (const auto* keyword = std::get_if<Word>(&statement)) {
      if (!step(keyword->range)) return;
      word(*keyword);
    } else if (const auto* eol = std::get_if<EndOfLine>(&statement)) {
      if (!step(eol->range)) return;
      endLine(eol->range);
    } else if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement)) {
      if (!step((*branch)->ifRange)) return;
      // An operand that decides nothing may stay unknown; one that decides was reported.
      body(conditions.truth((*branch)->condition, diagnostics).value_or(false) ? (*branch)->thenBody
                                                                               : (*branch)->elseBody);
    }
    if (stopped) return;
  }
}

void PostRun::Impl::print(std::string_view text, SourceRange where) {
  if (text.empty()) return;
  bytes += text.size();
  if (bytes > settings.limits.outputBytes) {
    diagnostics.report<diag::OutputTooLarge>(where, settings.limits.outputBytes);
    stopped = true;
    return;
  }
  numberOnly = false;
  lineRange = line.empty() ? where : spanning(lineRange, where);
  line += text;
}

void PostRun::Impl::endLine(SourceRange where) {
  if (line.empty()) {
    // What a refused word would have printed is no empty block.
    if (!diagnostics.hasErrors()) diagnostics.report<diag::EmptyBlock>(where);
    return;
  }
  if (numberOnly) diagnostics.report<diag::BlockNumberAlone>(lineRange, line);
  numberOnly = false;
  lines.push_back({std::move(line), spanning(lineRange, where)});
  line.clear();
}

void PostRun::Impl::word(const Word& word) {
  switch (word.kind) {
  case WordKind::Command: command(word); return;
  case WordKind::Numeric: numeric(word); return;
  case WordKind::Boolean: diagnostics.report<diag::BooleanAsStatement>(word.range, word.name); return;
  }
}

void PostRun::Impl::command(const Word& word) {
  if (word.name == kSetFlagKeyword || word.name == kClearFlagKeyword) {
    conditions.setFlag(word, diagnostics);
    return;
  }
  if (word.arguments.empty()) {
    if (const Routine* routine = tables.routine(word.name)) {
      call(*routine, word.nameRange);
      return;
    }
    const auto& form = settings.form;
    if (const auto entry = form.sequences.find(word.name); entry != form.sequences.end()) {
      const bool first = line.empty();
      print(entry->second.text + std::to_string(sequence), word.range);
      numberOnly = first;
      sequence += settings.sequenceStep;
      return;
    }
    if (const auto entry = form.commands.find(word.name); entry != form.commands.end()) {
      print(entry->second.text, word.range);
      if (entry->second.value.empty()) return;
      if (const SourceRange* format = tables.commandFormat(word.name)) {
        diagnostics.report<diag::FormatOfCommand>(*format, word.name, settings.form.name);
        return;
      }
      auto parsed = Picture::parse(entry->second.picture);
      const std::optional<double> value = host(entry->second.value, word.range);
      if (const auto* numberPicture = std::get_if<Picture>(&parsed); numberPicture != nullptr && value)
        printValue(*value, *numberPicture, word.name, word.range);
      return;
    }
  }
  if (!tell(diag::CommandNotInForm::code, word.name)) return;
  diagnostics.report<diag::CommandNotInForm>(word.nameRange, word.name, settings.form.name,
                                             settings.form.origin);
}

std::optional<double> PostRun::Impl::host(const std::string& name, SourceRange where) {
  const auto found = operation->hosts.find(name);
  if (found != operation->hosts.end()) return found->second;
  if (!tell(diag::HostInputNeeded::code, name)) return std::nullopt;
  const std::string flag = name == "clearance" ? "--clearance Z" : "--host " + name + "=VALUE";
  diagnostics.report<diag::HostInputNeeded>(where, name, flag);
  return std::nullopt;
}

void PostRun::Impl::numeric(const Word& word) {
  std::optional<double> value;
  std::string what = word.name + "#";
  if (word.name == kFieldKeyword) {
    if (word.arguments.size() != 1 || word.arguments.front().text.empty()) {
      diagnostics.report<diag::FieldNeedsName>(word.range);
      return;
    }
    what = word.arguments.front().text;
    value = operation->field(what, word.range);
  } else {
    const auto entry = settings.form.numerics.find(word.name);
    if (entry == settings.form.numerics.end() || entry->second.value.empty()) {
      if (tell(diag::NumericNotInForm::code, word.name))
        diagnostics.report<diag::NumericNotInForm>(word.nameRange, word.name, settings.form.name,
                                                   settings.form.origin);
      return;
    }
    value = host(entry->second.value, word.range);
  }
  const Picture* numberPicture = tables.picture(word.name, word.range, diagnostics);
  if (value && numberPicture != nullptr) printValue(*value, *numberPicture, what, word.range);
}

void PostRun::Impl::printValue(double value, const Picture& picture, std::string_view what,
                               SourceRange where) {
  const Picture::Printed printed = picture.print(value);
  switch (printed.fit) {
  case Picture::Fit::DoesNotFit:
    diagnostics.report<diag::ValueDoesNotFit>(where, what, numberText(value), picture.text(),
                                              value == std::trunc(value) ? "" : " once it is rounded");
    return;
  case Picture::Fit::LosesDecimals:
    diagnostics.report<diag::LostDecimals>(where, what, numberText(value), picture.text(),
                                           numberText(printed.value.value()));
    break;
  case Picture::Fit::Exact: break;
  }
  if (printed.text.empty()) diagnostics.report<diag::BareAddress>(where, what, picture.text());
  print(printed.text, where);
}

} // namespace dotek::frontend::compost
