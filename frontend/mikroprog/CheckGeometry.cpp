#include "frontend/mikroprog/CheckGeometry.h"

#include "support/Decimal.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

namespace dotek::frontend::mikroprog {

namespace {

using stdlib::MikroprogFunction;

constexpr std::string_view kAxes = "XYZ";
constexpr double kRounding = 0.005; // mm, of words with three decimals; also what an arc may be off

class Geometry {
public:
  Geometry(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources,
           Diagnostics& diagnostics)
      : program_(program), control_(control), sources_(sources), diagnostics_(diagnostics) {
    if (control.isDiameter('X')) plane_ = "XZ"; // of a lathe, from the start
  }

  void run() {
    for (const Line& line : program_.lines)
      if (const Word* target = line.find('L'); target != nullptr && target->value.number)
        targets_.insert(*target->value.number);
    for (const Line& line : program_.lines) {
      if (line.number && targets_.contains(static_cast<double>(*line.number))) forget();
      if (!line.unread)
        one(line);
      else
        forget();
    }
  }

private:
  std::vector<const MikroprogFunction*> functionsOf(const Line& line) {
    std::vector<const MikroprogFunction*> out;
    for (const Word& word : line.words) {
      if ((word.address != 'G' && word.address != 'M') || !word.value.number) continue;
      const double number = *word.value.number;
      const bool whole = number >= 0 && number <= 999 && number == std::floor(number);
      const MikroprogFunction* found =
          whole ? control_.find(word.address, static_cast<std::uint32_t>(number)) : nullptr;
      if (found == nullptr)
        forget(); // nobody knows what it does
      else
        out.push_back(found);
    }
    return out;
  }

  void forget() {
    at_ = {};
    absolute_.reset();
    radius_.reset();
    compensated_ = false;
  }

  void one(const Line& line) {
    const auto functions = functionsOf(line);
    const auto has = [&](std::string_view what) {
      return std::any_of(functions.begin(), functions.end(),
                         [&](const MikroprogFunction* one) { return one->function == what; });
    };
    if (line.find('F') != nullptr) feed_ = true;
    if (has("plane-xy")) plane_ = "XY";
    if (has("plane-zx")) plane_ = "XZ";
    if (has("plane-yz")) plane_ = "YZ";
    if (has("radius")) radius_ = true;
    if (has("absolute")) {
      absolute_ = true;
      radius_ = false; // G90 ends G24
    }
    if (has("incremental")) absolute_ = false;
    if (has("compensation-off")) compensated_ = false;
    if (has("compensation-left") || has("compensation-right")) compensated_ = true;
    for (const MikroprogFunction* one : functions)
      if (one->group == "motion") motion_ = one->function;

    for (const MikroprogFunction* one : functions) {
      compensation(line, *one);
      if (one->code() == "G62" || one->code() == "G63") quarter(line, *one);
      if (one->code() == "G83") peck(line);
      if (one->code() == "G78" && !feed_) diagnostics_.report<diag::SufThreadFeed>(line.range);
    }
    const bool moves = std::all_of(functions.begin(), functions.end(), [](const MikroprogFunction* one) {
      return one->group == "motion" || one->addresses.empty();
    });
    if (moves && motion_.starts_with("arc-")) arc(line);
    follow(line, functions, moves);
  }

  // The coordinate at the end of the block along an axis that it names; nothing: not known.
  std::optional<double> targetOf(const Line& line, std::size_t axis) const {
    const Word* word = line.find(kAxes[axis]);
    if (word == nullptr || !word->value.number || !absolute_) return std::nullopt;
    double value = *word->value.number;
    if (control_.isDiameter(kAxes[axis])) {
      if (!radius_ || !*absolute_) return std::nullopt; // how a distance counts is not known (Q9)
      if (!*radius_) value /= 2;
    }
    if (*absolute_) return value;
    return at_[axis] ? std::optional(*at_[axis] + value) : std::nullopt;
  }
  std::optional<double> travel(const Line& line, char letter) const {
    const std::size_t axis = kAxes.find(letter);
    const std::optional<double> to = targetOf(line, axis);
    return to && at_[axis] ? std::optional(*to - *at_[axis]) : std::nullopt;
  }

  void compensation(const Line& line, const MikroprogFunction& function) {
    static constexpr std::array<std::string_view, 5> kOthers = {"probe-move", "thread-pass", "cycle",
                                                                "reference", "tool-change"};
    if (!compensated_ || std::find(kOthers.begin(), kOthers.end(), function.function) == kOthers.end())
      return;
    diagnostics_.report<diag::SufCompensationOn>(line.range, function.code());
    compensated_ = false; // told once
  }

  void arc(const Line& line) {
    const Word* word = line.find('R');
    if (word == nullptr || !word->value.number) return;
    const double radius = *word->value.number;
    const std::string text = sources_.textUtf8(word->range);
    if (radius <= 0) {
      diagnostics_.report<diag::SufArcRadius>(word->range, text, "a radius has no sign and is not 0");
      return;
    }
    if (plane_.empty()) return;
    const auto first = travel(line, plane_[0]), second = travel(line, plane_[1]);
    if (!first || !second) return;
    const double chord = std::hypot(*first, *second);
    if (chord == 0)
      diagnostics_.report<diag::SufArcRadius>(word->range, text,
                                              "the arc ends where it begins; a full circle needs its centre");
    else if (chord > 2 * radius + kRounding)
      diagnostics_.report<diag::SufArcRadius>(word->range, text,
                                              "its ends lie " + numberText(std::round(chord * 1000) / 1000) +
                                                  " mm apart, more than the diameter");
  }

  void quarter(const Line& line, const MikroprogFunction& function) {
    const auto x = travel(line, 'X'), z = travel(line, 'Z');
    if (!x || !z || std::abs(std::abs(*x) - std::abs(*z)) <= kRounding) return;
    const auto text = [](double value) { return numberText(std::round(std::abs(value) * 1000) / 1000); };
    diagnostics_.report<diag::SufQuarterCircle>(line.range, function.code(), text(*x), text(*z));
  }

  void peck(const Line& line) {
    const auto depth = travel(line, 'Z');
    const Word* step = line.find('W');
    if (!depth || step == nullptr || !step->value.number || *step->value.number <= std::abs(*depth)) return;
    diagnostics_.report<diag::SufPeckDepth>(step->range, sources_.textUtf8(step->range),
                                            numberText(std::round(std::abs(*depth) * 1000) / 1000));
  }

  // Where the tool stands behind the block.
  void follow(const Line& line, const std::vector<const MikroprogFunction*>& functions, bool moves) {
    for (const MikroprogFunction* one : functions) {
      const std::string_view what = one->function;
      if (what == "jump" || what == "return" || what == "end" || what == "leave" || what == "call" ||
          what == "run-program" || what == "run-macro")
        return forget();
      if (what == "reference" || what == "tool-change" || what.starts_with("system-")) at_ = {};
    }
    const bool sets = std::any_of(functions.begin(), functions.end(), [](const MikroprogFunction* one) {
      return one->function == "set-position";
    });
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      if (line.find(kAxes[axis]) == nullptr) continue;
      // A contact, a cycle: no source says where the tool stands behind it.
      at_[axis] = moves || (sets && absolute_.value_or(false)) ? targetOf(line, axis) : std::nullopt;
    }
  }

  const Program& program_;
  const stdlib::MikroprogControl& control_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::set<double> targets_;                // N numbers that a jump names
  std::array<std::optional<double>, 3> at_; // mm, X of a lathe as a radius
  std::optional<bool> absolute_ = true;     // G90; nothing: not known
  std::optional<bool> radius_ = false;      // G24
  std::string motion_ = "rapid", plane_;
  bool feed_ = false, compensated_ = false;
};

} // namespace

void checkGeometry(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources,
                   Diagnostics& diagnostics) {
  Geometry(program, control, sources, diagnostics).run();
}

} // namespace dotek::frontend::mikroprog
