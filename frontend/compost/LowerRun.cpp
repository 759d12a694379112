#include "frontend/compost/LowerRun.h"

#include "frontend/nc/Parse.h"
#include "support/messages/ComPost.h"
#include "support/messages/Nc.h"

#include <algorithm>

namespace dotek::frontend::compost {
namespace {

// A line as messages show it.
std::string shown(const std::vector<nc::Piece>& line) {
  std::string out;
  for (const nc::Piece& piece : line) {
    if (const auto* text = std::get_if<nc::TextPiece>(&piece))
      out += text->text;
    else
      out += "<" + std::get<nc::HolePiece>(piece).hole.name + ">";
  }
  return out;
}

// Sides of conditions that are compared: each costs a copy of the run's state.
constexpr std::uint32_t kMostCompared = 100;

bool blank(const std::vector<nc::Piece>& line) {
  return std::all_of(line.begin(), line.end(), [](const nc::Piece& piece) {
    const auto* text = std::get_if<nc::TextPiece>(&piece);
    return text != nullptr && text->text.empty();
  });
}

// What stands behind the block number: blanks before it go with it.
std::string withoutNumber(const std::string& text) {
  const std::size_t digits = text.find_first_not_of(' ', text.find('N') + 1);
  const std::size_t behind = std::min(text.find_first_not_of("0123456789", digits), text.size());
  return text.substr(std::min(text.find_first_not_of(' ', behind), text.size()));
}

ir::PrintedBlock printedBlock(const std::vector<nc::Piece>& line, bool numbered, const SourceMap& sources) {
  ir::PrintedBlock out;
  out.numbered = numbered;
  for (const nc::Piece& piece : line) {
    ir::PrintedPiece printed;
    if (const auto* text = std::get_if<nc::TextPiece>(&piece)) {
      printed.range = text->range;
      printed.text = toUtf8(text->text, sources.file(text->range.file).encoding());
    } else {
      const auto& hole = std::get<nc::HolePiece>(piece);
      printed.range = hole.range;
      printed.name = hole.hole.name;
      if (const auto* use = std::get_if<ir::VariableUse>(&hole.hole.value->node))
        printed.variable = use->variable;
      if (hole.hole.picture != nullptr) printed.picture = *hole.hole.picture;
    }
    out.range = out.pieces.empty() ? printed.range : spanning(out.range, printed.range);
    const bool text = !printed.picture;
    if (text && !out.pieces.empty() && !out.pieces.back().picture)
      out.pieces.back().text += printed.text;
    else
      out.pieces.push_back(std::move(printed));
  }
  // The parser took a number: only blanks, the N and digits stand before the rest.
  if (numbered) out.pieces.front().text = withoutNumber(out.pieces.front().text);
  return out;
}

} // namespace

LowerRun::LowerRun(const Program& program, const std::string& cycleId, const LowerSettings& settings,
                   Diagnostics& diagnostics)
    : settings_(settings), diagnostics_(&diagnostics),
      tables_(program, settings.form), state_{Conditions(program, settings.form, settings.assumptions),
                                              {},
                                              {},
                                              {}} {
  state_.conditions.cycle = cycleId;
}

void LowerRun::run(const Routine& routine) {
  call(routine, routine.nameRange);
  if (state_.line.empty() || stopped_) return;
  if (!failed_) diagnostics_->report<diag::UnfinishedLine>(state_.lineRange, shown(state_.line));
  endLine(state_.lineRange);
}

bool LowerRun::step(SourceRange where) {
  if (stopped_) return false;
  if (++steps_ <= settings_.limits.steps) return true;
  refuse<diag::PostRunsForever>(where, settings_.limits.steps);
  stopped_ = true;
  return false;
}

void LowerRun::call(const Routine& routine, SourceRange where) {
  if (stopped_) return;
  if (depth_ >= settings_.limits.callDepth) {
    refuse<diag::CallsTooDeep>(where, routine.name, settings_.limits.callDepth);
    stopped_ = true;
    return;
  }
  ++depth_;
  body(routine.body);
  --depth_;
}

void LowerRun::body(const std::vector<Statement>& statements) {
  for (const Statement& statement : statements) {
    if (const auto* literal = std::get_if<Literal>(&statement)) {
      if (!step(literal->range)) return;
      // Without the apostrophes.
      SourceRange inside = literal->range;
      if (inside.end - inside.begin == literal->text.size() + 2) {
        ++inside.begin;
        --inside.end;
      }
      text(literal->text, inside);
    } else if (const auto* keyword = std::get_if<Word>(&statement)) {
      if (!step(keyword->range)) return;
      word(*keyword);
    } else if (const auto* eol = std::get_if<EndOfLine>(&statement)) {
      if (!step(eol->range)) return;
      endLine(eol->range);
    } else if (const auto* inner = std::get_if<std::unique_ptr<If>>(&statement)) {
      if (!step((*inner)->ifRange)) return;
      branch(**inner);
    }
    if (stopped_) return;
  }
}

void LowerRun::branch(const If& branch) {
  Diagnostics findings;
  const Truth truth = state_.conditions.truth(branch.condition, findings);
  if (!truth) {
    undecided(branch, findings);
    return;
  }
  for (const Diagnostic& one : findings.all()) {
    if (failed_ && one.severity != Severity::Error) continue; // a refused condition may have set the flag
    failed_ = failed_ || one.severity == Severity::Error;
    diagnostics_->add(one);
  }
  body(*truth ? branch.thenBody : branch.elseBody);
}

void LowerRun::undecided(const If& branch, const Diagnostics& findings) {
  failed_ = true;
  if (comparing_) return; // the outer condition comes first
  if (++compared_ > kMostCompared) return;
  const auto whereHolds = modalAfter(branch.thenBody);
  const auto whereNot = modalAfter(branch.elseBody);
  std::string different;
  const auto codeOf = [](const std::map<int, std::string>& modal, int group) {
    const auto found = modal.find(group);
    return found == modal.end() ? std::string("what was before") : "`" + found->second + "`";
  };
  std::set<int> groups;
  for (const auto& modal : {whereHolds, whereNot}) {
    for (const auto& [group, code] : modal)
      groups.insert(group);
  }
  for (const int group : groups) {
    const std::string holds = codeOf(whereHolds, group);
    const std::string not_ = codeOf(whereNot, group);
    if (holds != not_) different += (different.empty() ? "" : "; ") + holds + " or " + not_;
  }
  if (different.empty()) {
    for (const Diagnostic& one : findings.all())
      diagnostics_->add(one);
    return;
  }
  Diagnostic& finding = diagnostics_->report<diag::ModalStateDiffers>(branch.condition.range, different);
  for (const Diagnostic& one : findings.all())
    finding.note(one.range, one.message);
}

std::map<int, std::string> LowerRun::modalAfter(const std::vector<Statement>& statements) {
  const State before = state_;
  Diagnostics elsewhere;
  Diagnostics* const reported = diagnostics_;
  diagnostics_ = &elsewhere;
  comparing_ = true;
  body(statements);
  endLine({});
  comparing_ = false;
  diagnostics_ = reported;
  stopped_ = false; // the next step reports it
  std::map<int, std::string> modal = std::move(state_.modal);
  state_ = before;
  return modal;
}

void LowerRun::grow(std::size_t bytes, SourceRange where) {
  bytes_ += bytes;
  state_.lineRange = state_.line.empty() ? where : spanning(state_.lineRange, where);
  if (bytes_ <= settings_.limits.outputBytes) return;
  refuse<diag::OutputTooLarge>(where, settings_.limits.outputBytes);
  stopped_ = true;
}

void LowerRun::text(std::string_view bytes, SourceRange range) {
  if (bytes.empty()) return;
  grow(bytes.size(), range);
  state_.line.emplace_back(nc::TextPiece{std::string(bytes), range});
}

void LowerRun::hole(std::optional<ir::VariableId> variable, const Picture* picture, const std::string& what,
                    SourceRange range) {
  grow(1, range);
  if (!comparing_ && (!variable || picture == nullptr)) failed_ = true; // reported
  nc::Hole hole{variable ? ir::variable(*variable, range) : ir::constant(0, range), picture, what};
  state_.line.emplace_back(nc::HolePiece{std::move(hole), range});
}

void LowerRun::endLine(SourceRange where) {
  if (state_.line.empty()) {
    // What a refused word would have printed is no empty block.
    if (!failed_) diagnostics_->report<diag::EmptyBlock>(where);
    return;
  }
  const std::vector<nc::Piece> line = std::move(state_.line);
  state_.line.clear();
  if (blank(line)) return;
  std::optional<nc::Block> block = nc::parseBlock(line, settings_.limits, *diagnostics_);
  if (!block) {
    failed_ = true;
    return;
  }
  nc::noteModal(*block, settings_.control, state_.modal);
  if (comparing_) return;
  printed_.push_back(printedBlock(line, block->sequenceNumber.has_value(), settings_.sources));
  blocks_.push_back(std::move(*block));
}

void LowerRun::word(const Word& word) {
  switch (word.kind) {
  case WordKind::Command: command(word); return;
  case WordKind::Numeric: numeric(word); return;
  case WordKind::Boolean: refuse<diag::BooleanAsStatement>(word.range, word.name); return;
  }
}

void LowerRun::command(const Word& word) {
  if (word.name == kSetFlagKeyword || word.name == kClearFlagKeyword) {
    if (word.arguments.size() != 1) failed_ = true;
    state_.conditions.setFlag(word, *diagnostics_);
    return;
  }
  if (word.arguments.empty()) {
    if (const Routine* routine = tables_.routine(word.name)) {
      call(*routine, word.nameRange);
      return;
    }
    const auto& form = settings_.form;
    // Some number: the emitted program counts its own blocks.
    if (const auto entry = form.sequences.find(word.name); entry != form.sequences.end()) {
      text(entry->second.text + "1", word.range);
      return;
    }
    if (const auto entry = form.commands.find(word.name); entry != form.commands.end()) {
      text(entry->second.text, word.range);
      if (entry->second.value.empty()) return;
      if (const SourceRange* format = tables_.commandFormat(word.name)) {
        refuse<diag::FormatOfCommand>(*format, word.name, form.name);
        return;
      }
      auto parsed = Picture::parse(entry->second.picture);
      const Picture* picture = nullptr;
      if (auto* one = std::get_if<Picture>(&parsed))
        picture = &commandPictures_.emplace_back(std::move(*one));
      const std::string& host = entry->second.value;
      hole(comparing_ ? std::nullopt : settings_.host(host, word.range), picture,
           "the host input `" + host + "`", word.range);
      return;
    }
  }
  failed_ = true;
  if (!told_.insert(word.name).second) return;
  refuse<diag::CommandNotInForm>(word.nameRange, word.name, settings_.form.name, settings_.form.origin);
}

void LowerRun::numeric(const Word& word) {
  const Picture* picture = nullptr;
  if (word.name == kFieldKeyword) {
    if (word.arguments.size() != 1 || word.arguments.front().text.empty()) {
      refuse<diag::FieldNeedsName>(word.range);
      return;
    }
    const std::string& field = word.arguments.front().text;
    const auto variable = comparing_ ? std::nullopt : settings_.field(field, word.range);
    picture = tables_.picture(word.name, word.range, *diagnostics_);
    hole(variable, picture,
         "the field `" + toUtf8(field, settings_.sources.file(word.range.file).encoding()) + "`", word.range);
    return;
  }
  const auto entry = settings_.form.numerics.find(word.name);
  if (entry == settings_.form.numerics.end() || entry->second.value.empty()) {
    failed_ = true;
    if (told_.insert(word.name + "#").second)
      refuse<diag::NumericNotInForm>(word.nameRange, word.name, settings_.form.name, settings_.form.origin);
    return;
  }
  const std::string& host = entry->second.value;
  const auto variable = comparing_ ? std::nullopt : settings_.host(host, word.range);
  picture = tables_.picture(word.name, word.range, *diagnostics_);
  hole(variable, picture, "the host input `" + host + "`", word.range);
}

} // namespace dotek::frontend::compost
