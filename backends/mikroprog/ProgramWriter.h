// The state and the steps of writing one program. Private to Program*.cpp.
#pragma once

#include "backends/mikroprog/ProgramState.h"
#include "backends/mikroprog/Programs.h"
#include "backends/mikroprog/Sheet.h"

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::backends::mikroprog {

inline constexpr double kSameNumber = 1e-6;

class ProgramWriter {
public:
  ProgramWriter(const ir::ProgramFile& file, const ProgramOptions& options, Diagnostics& diagnostics)
      : file_(file), options_(options), control_(options.control), source_(options.source),
        diagnostics_(diagnostics) {}

  std::optional<std::vector<EmittedLine>> run();

private:
  // Of a block: what is written before its move, with it, after it.
  struct Parts {
    std::vector<std::string> before, words, after;
    bool moves = false; // a motion is in the block
    bool spindle = false, coolant = false;
    std::optional<SourceRange> order; // of a T, whose place in the block is not certain
  };

  void forget();

  // What subprograms of the file may leave in force.
  struct Leaves {
    bool speed = false, tool = false, feed = false;
    std::set<stdlib::Function> modes;
  };
  const Leaves& leaves();
  const stdlib::CodeInfo* codeOf(const ir::Word& word) const; // of a G or M with a number

  void cannot(SourceRange range, const std::string& what, const std::string& instead);
  void dropped(SourceRange range, const std::string& what, const std::string& why);
  static std::string plain(const std::string& bytes);

  void body(const ir::Program& program, bool subprogram);

  void statement(const ir::ProgramStatement& statement, bool subprogram);

  // The comment of the block goes with its first line.
  void add(const std::string& text) { sheet_->add(text, origin_, std::exchange(comment_, "")); }

  void call(const ir::Call& call, SourceRange range);
  // Its ways count from where the tool is at the call, and coordinates are absolute here.
  bool goesByWays(const ir::Program& program) const;
  void callInPlace(const ir::Program& program, int times, SourceRange range);

  // ---- values

  // Of a word, in mm where it is a length. nullopt: reported.
  std::optional<double> number(const ir::Word& word);

  std::string shown(double value);

  const ir::Word* find(char letter) const;
  std::optional<double> take(char letter);

  // ---- a block

  void block(const ir::NcBlock& block, SourceRange range);

  // false: the block is refused.
  bool code(const ir::Word& word, Parts& parts);

  void unit(bool perRevolution); // of F

  // G50 S. false: refused.
  bool clamp(const ir::Word& word, const std::string& name);

  // G43 H: the correction is in force since M6.
  bool length(const ir::Word& word, const std::string& name);

  void auxiliary(const ir::Word& word, Parts& parts);

  void change(SourceRange range, double number, Parts& parts);

  // T0303 of a lathe: tool 3 with offset 3, which is its line of the table here.
  void tool(const ir::Word& word, Parts& parts);

  void speed(Parts& parts);

  // ---- what takes the axes

  bool hasAxes() const;

  void dwell(SourceRange range, Parts& parts);

  void reference(SourceRange range, Parts& parts);

  // F of the block. false: reported.
  bool feed(std::optional<double>& out);
  void feedDropped(); // one that no move takes

  // Where the block ends along each axis that it names. false: reported.
  bool target(std::array<std::optional<double>, 3>& to, std::string& named);

  std::string placeText(const std::array<std::optional<double>, 3>& to, std::string_view named);

  // Why the motion in force can't be written. false: reported.
  bool motionKnown(SourceRange range);
  void move(SourceRange range, Parts& parts);

  std::string_view arcAxes() const;

  // R of the arc, at most half a turn. nullopt: reported.
  std::optional<double> arcRadius(SourceRange range, const std::array<std::optional<double>, 3>& to);

  void thread(SourceRange range, const std::array<std::optional<double>, 3>& to, const std::string& named,
              std::optional<double> lead, Parts& parts);

  // In, along, out, back to where it began: as blocks.
  void singleCycle(SourceRange range, std::array<std::optional<double>, 3> to, const std::string& named,
                   const std::string& feed, Parts& parts);

  const ir::ProgramFile& file_;
  const ProgramOptions& options_;
  const stdlib::MikroprogControl& control_;
  const stdlib::Control& source_;
  Diagnostics& diagnostics_;
  ProgramState state_;
  std::deque<Sheet> sheets_;
  Sheet* sheet_ = nullptr;
  std::map<std::uint64_t, Mark> marks_; // of subprograms, by number
  std::vector<const ir::Program*> called_;
  std::map<std::uint64_t, Inherited> inherited_; // by subprograms, by number
  std::set<std::uint64_t> written_;
  std::optional<Leaves> leaves_;
  bool callRefused_ = false;
  std::set<std::uint64_t> inPlace_; // numbers of subprograms that are written in place
  std::size_t depth_ = 0;           // of calls in place
  std::size_t blocksInPlace_ = 0;
  bool programEnded_ = false;
  ir::Origin origin_;
  std::string comment_; // of the block, until its first line is written
  const std::vector<ir::Word>* words_ = nullptr;
  std::string taken_; // letters of the block that have a counterpart
  std::vector<std::string> legs_;
  stdlib::Function once_ = stdlib::Function::Other;
  bool ended_ = false;
  bool refused_ = false; // the block that is written has an error
};

} // namespace dotek::backends::mikroprog
