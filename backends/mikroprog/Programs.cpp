#include "backends/mikroprog/ProgramWriter.h"

#include "backends/common/PlainText.h"
#include "ir/Match.h"
#include "support/Decimal.h"
#include "support/Source.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace dotek::backends::mikroprog {

using stdlib::Function;

namespace {

constexpr std::uint32_t kStep = 10; // of block numbers

ir::Origin originOf(const ir::ProgramStatement& statement) {
  ir::Origin out;
  static_cast<ir::BlockOrigin&>(out) = statement.origin;
  return out;
}

} // namespace

std::optional<std::vector<EmittedLine>> ProgramWriter::run() {
  const ir::Program& main = file_.programs.front();
  const bool lathe = source_.turning.has_value();
  if (lathe == control_.hasAxis('Y')) {
    cannot(main.range,
           fmt::format("`{}` is the control of a {}, and `{}` that of a {}", source_.name,
                       lathe ? "lathe" : "mill", control_.name, lathe ? "mill" : "lathe"),
           fmt::format("take `--control {}`", lathe ? stdlib::kMikroprogLathe : stdlib::kMikroprogMill));
    return std::nullopt;
  }
  state_.plane = lathe ? Function::PlaneZX : Function::PlaneXY;
  bool perRevolution = false;
  if (lathe)
    for (const std::uint32_t tenths : source_.turning->startCodes)
      if (const stdlib::CodeInfo* code = source_.find('G', tenths))
        perRevolution = perRevolution || code->function == Function::FeedPerRevolution;
  state_.perRevolution = perRevolution;
  Sheet& sheet = sheets_.emplace_back();
  sheet_ = &sheet;
  sheet.comment(plainText("FROM " + options_.name + ", FOR " + source_.name).text, {});
  for (const std::string& title : main.titleComments)
    sheet.comment(plain(title), {});
  sheet.add(fmt::format("{} G90 {}", lathe ? "G18" : "G17", perRevolution ? "G95" : "G94"), {});
  body(main, false);
  for (std::size_t i = 0; i < called_.size(); ++i) { // may grow
    const ir::Program* const program = called_[i];
    sheet_ = &sheets_.emplace_back();
    sheet_->place(marks_.at(program->number));
    for (const std::string& title : program->titleComments)
      sheet_->comment(plain(title), {});
    static_cast<Inherited&>(state_) = inherited_.at(program->number);
    forget();
    written_.insert(program->number);
    body(*program, true);
  }
  for (const ir::Program& program : file_.programs)
    if (!callRefused_ && &program != &main && !marks_.contains(program.number) &&
        !inPlace_.contains(program.number))
      cannot(program.range, "this program is not called by the first one of its file",
             "convert it from a file of its own");
  if (diagnostics_.hasErrors()) return std::nullopt;
  std::map<Mark, std::uint32_t> numbers;
  std::uint32_t first = kStep;
  for (Sheet& one : sheets_) {
    one.number(first, kStep, numbers);
    first = (first + static_cast<std::uint32_t>(one.blocks()) * kStep) / 1000 * 1000 + 1000;
  }
  std::vector<EmittedLine> out;
  for (const Sheet& one : sheets_)
    one.print(numbers, out);
  return out;
}

// After a subprogram, and at its beginning. A lathe has no modes of distance.
void ProgramWriter::forget() {
  state_.forget();
  if (source_.turning) state_.incremental = false;
}

void ProgramWriter::cannot(SourceRange range, const std::string& what, const std::string& instead) {
  refused_ = true;
  diagnostics_.report<diag::MikroprogCannot>(range, what, instead);
}

void ProgramWriter::dropped(SourceRange range, const std::string& what, const std::string& why) {
  diagnostics_.report<diag::ModeDropped>(range, what, why);
}

std::string ProgramWriter::plain(const std::string& bytes) {
  return plainText(isUtf8(bytes) ? bytes : toUtf8(bytes, Encoding::Cp1250)).text;
}

void ProgramWriter::body(const ir::Program& program, bool subprogram) {
  ended_ = false;
  if (depth_ == 0) programEnded_ = false;
  const auto& body = program.body;
  for (std::size_t i = 0; i < body.size();) {
    const std::uint32_t block = body[i].origin.block;
    std::size_t end = i;
    std::string comment;
    bool alone = true;
    for (; end < body.size() && body[end].origin.block == block; ++end) {
      const auto* text = std::get_if<ir::Comment>(&body[end].node);
      if (text != nullptr) comment += (comment.empty() ? "" : " ") + plainText(text->text).text;
      alone = alone && (text != nullptr || std::holds_alternative<ir::Label>(body[end].node));
    }
    const ir::Origin origin = originOf(body[i]);
    if (ended_ && !alone) {
      dropped(origin.range(), "the block", "the program has ended before it");
      i = end;
      continue;
    }
    if (alone) sheet_->comment(comment, origin);
    comment_ = alone ? "" : comment;
    for (; i < end; ++i)
      statement(body[i], subprogram);
  }
  if (!ended_)
    cannot(program.range, subprogram ? "the subprogram has no M99" : "the program has no M30",
           "write it at the end");
}

void ProgramWriter::statement(const ir::ProgramStatement& statement, bool subprogram) {
  origin_ = originOf(statement);
  const SourceRange range = statement.origin.range();
  if (statement.blockDelete != 0)
    return cannot(range, "no source describes blocks that can be switched off here", "take the `/` away");
  const auto macro = [&] {
    cannot(range, "this is a statement of macros, and values are fixed when the program is written",
           "`--var N=VALUE` runs the program with that value, and writes the blocks of the run");
  };
  ir::match(
      statement, [](const ir::OneOf<ir::Label, ir::Comment> auto&) {},
      [&](const ir::NcBlock& block) { this->block(block, range); },
      [&](const ir::Call& call) { this->call(call, range); },
      [&](const ir::Exit& exit) {
        if (exit.block || !subprogram)
          return cannot(range,
                        exit.block ? "M17 goes back to after its call alone"
                                   : "M99 of a main program begins it anew",
                        exit.block ? "take the P away" : "end it by M30");
        if (depth_ == 0) add("M17");
        if (!comment_.empty()) sheet_->comment(std::exchange(comment_, ""), origin_);
        ended_ = true;
      },
      [&](const ir::OneOf<ir::Jump, ir::Branch, ir::Store, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Raise,
                          ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) { macro(); });
}

std::optional<double> ProgramWriter::number(const ir::Word& word) {
  const double* const value = ir::constantValue(word.value);
  if (value == nullptr) {
    cannot(word.range, "the value of this word is computed, and values are fixed when the program is written",
           "`--var N=VALUE` runs the program with that value, and writes the blocks of the run");
    return std::nullopt;
  }
  const bool bare = ir::numberWithoutPoint(word.value) != nullptr;
  return bare && source_.countsIncrements(word.address) ? *value * source_.increment : *value;
}

std::string ProgramWriter::shown(double value) {
  const double scaled = value * 1000;
  if (std::abs(scaled - std::round(scaled)) > kSameNumber)
    cannot(
        origin_.range(),
        fmt::format("{} has more decimals than the {} of this control", numberText(value), control_.decimals),
        "round it in the source");
  return numberText(std::round(scaled) / 1000 + 0.0);
}

const ir::Word* ProgramWriter::find(char letter) const {
  const auto at = std::find_if(words_->begin(), words_->end(),
                               [&](const ir::Word& one) { return one.address == letter; });
  return at == words_->end() ? nullptr : &*at;
}

std::optional<double> ProgramWriter::take(char letter) {
  const ir::Word* const word = find(letter);
  if (word == nullptr) return std::nullopt;
  taken_ += letter;
  return number(*word);
}

void ProgramWriter::block(const ir::NcBlock& block, SourceRange range) {
  words_ = &block.words;
  taken_ = "";
  Parts parts;
  bool good = true;
  once_ = Function::Other;
  refused_ = false;
  for (const ir::Word& word : block.words)
    if (word.address == 'G') good = code(word, parts) && good;
  if (!good) return; // its other words would be refused for want of the code
  if (find('S') != nullptr)
    if (const double* const value = ir::constantValue(find('S')->value); value != nullptr && *value < 0)
      return cannot(find('S')->range, "a speed below 0", "write the speed, and M4 for the other way");
  if (source_.turning && find('T') != nullptr) tool(*find('T'), parts);
  for (const ir::Word& word : block.words)
    if (word.address == 'M') auxiliary(word, parts);
  if (find('S') != nullptr) speed(parts);
  if (once_ == Function::ReferenceReturn)
    reference(range, parts);
  else if (once_ == Function::Dwell)
    dwell(range, parts);
  else
    move(range, parts);
  for (const ir::Word& word : block.words)
    if (!refused_ && std::string_view("GM").find(word.address) == std::string_view::npos &&
        taken_.find(word.address) == std::string::npos)
      cannot(word.range, fmt::format("nothing of the block that has a counterpart takes `{}`", word.address),
             "take the word away, or write what it does as blocks");
  if (parts.order && parts.moves)
    cannot(*parts.order, "whether the tool is changed before the move of its block is not certain",
           "write T in a block of its own");
  // What the operator reads at a stop is the comment of its block.
  std::string read;
  if (std::find(parts.after.begin(), parts.after.end(), "M0") != parts.after.end())
    read = std::exchange(comment_, "");
  for (const std::string& one : parts.before)
    add(one);
  std::string text;
  for (const std::string& one : parts.words)
    text += (text.empty() ? "" : " ") + one;
  if (!text.empty()) add(text);
  for (const std::string& one : std::exchange(legs_, {}))
    add(one);
  for (const std::string& one : parts.after) {
    if (one == "M0") comment_ = std::exchange(read, "");
    add(one);
  }
  if (ended_) feedDropped();
  if (!comment_.empty())
    sheet_->comment(std::exchange(comment_, ""), origin_); // of a block that wrote nothing
}

std::optional<std::vector<EmittedLine>> emitProgram(const ir::ProgramFile& file,
                                                    const ProgramOptions& options, Diagnostics& diagnostics) {
  return ProgramWriter(file, options, diagnostics).run();
}

} // namespace dotek::backends::mikroprog
