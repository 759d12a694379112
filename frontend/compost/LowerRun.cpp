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

// What follows the block number: blanks before it go with it.
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
  // The parser took a number: only blanks, the N and digits are before the rest.
  if (numbered) out.pieces.front().text = withoutNumber(out.pieces.front().text);
  return out;
}

} // namespace

LowerRun::LowerRun(const Program& program, const std::string& cycleId, const LowerSettings& settings,
                   Diagnostics& diagnostics)
    : FormWalk(program, settings.form, settings.assumptions, settings.limits, diagnostics),
      settings_(settings) {
  conditions_.cycle = cycleId;
}

void LowerRun::run(const Routine& routine) {
  call(routine, routine.nameRange);
  if (state_.line.empty() || stopped()) return;
  if (!failed_) diagnostics_->report<diag::UnfinishedLine>(state_.lineRange, shown(state_.line));
  endLine(state_.lineRange);
}

void LowerRun::literal(const Literal& literal) {
  // Without the apostrophes.
  SourceRange inside = literal.range;
  if (inside.end - inside.begin == literal.text.size() + 2) {
    ++inside.begin;
    --inside.end;
  }
  text(literal.text, inside);
}

void LowerRun::branch(const If& branch) {
  Diagnostics findings;
  const Truth truth = conditions_.truth(branch.condition, findings);
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
  const Conditions conditions = conditions_;
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
  conditions_ = conditions;
  return modal;
}

void LowerRun::add(nc::Piece piece, std::size_t bytes, SourceRange where) {
  state_.lineRange = state_.line.empty() ? where : spanning(state_.lineRange, where);
  grow(bytes, where);
  state_.line.push_back(std::move(piece));
}

// 0, which no GOTO names: the emitted program counts its own blocks.
void LowerRun::sequenceNumber(const std::string& address, SourceRange range) {
  text(address + "0", range);
}

void LowerRun::text(std::string_view bytes, SourceRange range) {
  if (!bytes.empty()) add(nc::TextPiece{std::string(bytes), range}, bytes.size(), range);
}

void LowerRun::value(const PrintedValue& value, const std::function<const Picture*()>& picture) {
  const SourceRange range = value.word.range;
  const std::string name(value.name);
  const bool field = value.from == PrintedValue::From::Field;
  std::optional<ir::VariableId> variable;
  if (!comparing_) variable = field ? settings_.field(name, range) : settings_.host(name, range);
  const Picture* numberPicture = picture();
  if (!comparing_ && (!variable || numberPicture == nullptr)) failed_ = true; // reported
  const std::string what =
      field ? "the field `" + toUtf8(name, settings_.sources.file(range.file).encoding()) + "`"
            : "the host input `" + name + "`";
  nc::Hole hole{variable ? ir::variable(*variable, range) : ir::constant(0, range), numberPicture, what};
  add(nc::HolePiece{std::move(hole), range}, 1, range);
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
  std::optional<nc::Block> block = nc::parseBlock(line, limits_, *diagnostics_);
  if (!block) {
    failed_ = true;
    return;
  }
  nc::noteModal(*block, settings_.control, state_.modal);
  if (comparing_) return;
  const bool own = block->sequenceNumber && *block->sequenceNumber != 0;
  printed_.push_back(printedBlock(line, block->sequenceNumber && !own, settings_.sources));
  blocks_.push_back(std::move(*block));
}

std::vector<ir::PrintedBlock> LowerRun::takePrinted() {
  // A number that the Prog itself writes is a target of its jumps, or one like any other.
  const bool jumps = std::any_of(blocks_.begin(), blocks_.end(),
                                 [](const nc::Block& block) { return block.statement.has_value(); });
  for (std::size_t i = 0; i < printed_.size() && !jumps; ++i) {
    if (!blocks_[i].sequenceNumber || printed_[i].numbered) continue;
    printed_[i].numbered = true;
    printed_[i].pieces.front().text = withoutNumber(printed_[i].pieces.front().text);
  }
  return std::move(printed_);
}

} // namespace dotek::frontend::compost
