#include "frontend/compost/Post.h"

#include "frontend/compost/PostRun.h"
#include "support/Decimal.h"
#include "support/messages/ComPost.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::frontend::compost {
namespace {

constexpr double kArithmeticRest = 1e-9; // mm; below what any control counts

// Ends beyond the sixth decimal, as the cosine of an angle does.
bool hasRest(double value) {
  constexpr double kPlaces = 1e6;
  return std::abs(value * kPlaces - std::round(value * kPlaces)) > kArithmeticRest * kPlaces;
}

bool isPrintableAscii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

} // namespace

PostRun::Impl::Impl(const Program& program, const PostSettings& settingsIn, Diagnostics& diagnosticsIn)
    : FormWalk(program, settingsIn.form, settingsIn.assumptions, settingsIn.limits, diagnosticsIn),
      sequence(settingsIn.sequenceStart), sequenceStep(settingsIn.sequenceStep),
      printsRests(settingsIn.printsRests) {}

PostRun::PostRun(const Program& program, const PostSettings& settings, Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>(program, settings, diagnostics)) {}
PostRun::~PostRun() = default;

void PostRun::run(const Routine& routine, const Operation& operation) {
  impl_->run(routine, operation);
}

std::size_t PostRun::lineCount() const {
  return impl_->lineCount();
}

std::vector<PostedLine> PostRun::finish() {
  return impl_->finish();
}

void PostRun::Impl::run(const Routine& routine, const Operation& given) {
  operation = &given;
  conditions_.cycle = given.cycle;
  call(routine, routine.nameRange);
  operation = nullptr;
}

std::vector<PostedLine> PostRun::Impl::finish() {
  if (!line.empty() && !stopped()) {
    if (!diagnostics_->hasErrors()) diagnostics_->report<diag::UnfinishedLine>(lineRange, line);
    endLine(lineRange);
  }
  return std::move(lines);
}

void PostRun::Impl::branch(const If& branch) {
  // An operand that decides nothing may stay unknown; one that decides was reported.
  body(conditions_.truth(branch.condition, *diagnostics_).value_or(false) ? branch.thenBody
                                                                          : branch.elseBody);
}

void PostRun::Impl::literal(const Literal& literal) {
  if (!isPrintableAscii(literal.text)) diagnostics_->report<diag::TextNotAscii>(literal.range);
  text(literal.text, literal.range);
}

void PostRun::Impl::text(std::string_view bytes, SourceRange where) {
  if (bytes.empty() || !grow(bytes.size(), where)) return;
  numberOnly = false;
  lineRange = line.empty() ? where : spanning(lineRange, where);
  line += bytes;
}

void PostRun::Impl::sequenceNumber(const std::string& address, SourceRange range) {
  const bool first = line.empty();
  text(address + std::to_string(sequence), range);
  numberOnly = first;
  sequence += sequenceStep;
}

void PostRun::Impl::endLine(SourceRange where) {
  if (line.empty()) {
    // What a refused word would have printed is no empty block.
    if (!diagnostics_->hasErrors()) diagnostics_->report<diag::EmptyBlock>(where);
    return;
  }
  if (numberOnly) diagnostics_->report<diag::BlockNumberAlone>(lineRange, line);
  numberOnly = false;
  lines.push_back({std::move(line), spanning(lineRange, where)});
  line.clear();
}

std::optional<double> PostRun::Impl::host(const std::string& name, SourceRange where) {
  const auto found = operation->hosts.find(name);
  if (found != operation->hosts.end()) return found->second;
  if (!isNew(diag::HostInputNeeded::code, name)) return std::nullopt;
  const std::string flag = name == "clearance" ? "--clearance Z" : "--host " + name + "=VALUE";
  diagnostics_->report<diag::HostInputNeeded>(where, name, flag);
  return std::nullopt;
}

void PostRun::Impl::value(const PrintedValue& printed, const std::function<const Picture*()>& picture) {
  const Word& word = printed.word;
  const std::string name(printed.name);
  const bool field = printed.from == PrintedValue::From::Field;
  const std::optional<double> number = field ? operation->field(name, word.range) : host(name, word.range);
  const Picture* numberPicture = picture();
  if (!number || numberPicture == nullptr) return;
  const std::string own = word.kind == WordKind::Numeric ? word.name + "#" : word.name;
  printValue(*number, *numberPicture, field ? name : own, word.range);
}

void PostRun::Impl::printValue(double value, const Picture& picture, std::string_view what,
                               SourceRange where) {
  const Picture::Printed printed = picture.print(value);
  switch (printed.fit) {
  case Picture::Fit::DoesNotFit:
    diagnostics_->report<diag::ValueDoesNotFit>(where, what, numberText(value), picture.text(),
                                                value == std::trunc(value) ? "" : " once it is rounded");
    return;
  case Picture::Fit::LosesDecimals:
    if (printsRests && hasRest(value)) {
      text(fmt::format("{:.9f}", value), where);
      return;
    }
    // 15 - 25.4/2 - 3 is -0.7 and a rest of the arithmetic, which nobody typed.
    if (std::abs(value - printed.value.value()) > kArithmeticRest)
      diagnostics_->report<diag::LostDecimals>(where, what, numberText(value), picture.text(),
                                               numberText(printed.value.value()));
    break;
  case Picture::Fit::Exact: break;
  }
  if (printed.text.empty()) diagnostics_->report<diag::BareAddress>(where, what, picture.text());
  text(printed.text, where);
}

} // namespace dotek::frontend::compost
