#include "sim/mikroprog/Dialect.h"

#include "ir/Match.h"
#include "sim/mikroprog/Functions.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace dotek::sim::mikroprog {

using stdlib::Function;

namespace {

// What the machine does by itself; Acts.cpp has the rest.
constexpr std::pair<std::string_view, Function> kEffects[] = {
    {"rapid", Function::Rapid},
    {"feed", Function::Feed},
    {"arc-clockwise", Function::ArcClockwise},
    {"arc-counter-clockwise", Function::ArcCounterClockwise},
    {"dwell", Function::Dwell},
    {"plane-xy", Function::PlaneXY},
    {"plane-zx", Function::PlaneZX},
    {"plane-yz", Function::PlaneYZ},
    {"probe-move", Function::Skip},
    {"compensation-off", Function::CutterCompOff},
    {"compensation-right", Function::CutterCompLeft}, // the surface is right of the path, the tool left
    {"compensation-left", Function::CutterCompRight},
    {"absolute", Function::Absolute},
    {"incremental", Function::Incremental},
    {"set-position", Function::SetPosition},
    {"feed-per-minute", Function::FeedPerMinute},
    {"feed-per-revolution", Function::FeedPerRevolution},
    {"end", Function::ProgramEnd},
    {"leave", Function::ProgramEnd},
    {"tool-change", Function::ToolChange},
    {"spindle-right", Function::SpindleClockwise},
    {"spindle-left", Function::SpindleCounterClockwise},
    {"spindle-off", Function::SpindleOff},
    {"coolant-on", Function::CoolantFlood},
    {"coolant-off", Function::CoolantOff},
};

constexpr int kGrid = 6;                // decimals: sums of coordinates lie on a grid of a nanometre
constexpr double kArcTolerance = 0.005; // mm that the centre of an arc may be off

class Blocks {
public:
  Blocks(const ir::Program& program, const stdlib::MikroprogControl& control)
      : program_(program), control_(control) {
    for (std::size_t i = 0; i < program.body.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&program.body[i].node))
        numbers_.emplace(program.labels[label->label].number, i);
  }

  bool does(const ir::NcBlock& block, std::string_view what) const {
    return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
      const auto number = word.address == 'G' || word.address == 'M' ? wholeOf(word) : std::nullopt;
      const auto* function = number ? control_.find(word.address, *number) : nullptr;
      return function != nullptr && function->function == what;
    });
  }

  // The statement of the block that L names.
  std::optional<std::size_t> target(const ir::NcBlock& block) const {
    const ir::Word* const word = find(block, 'L');
    const auto number = word == nullptr ? std::nullopt : wholeOf(*word);
    const auto found = number ? numbers_.find(*number) : numbers_.end();
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

  // From this statement on nothing happens but jumps, up to a stop: its place.
  std::optional<std::size_t> stop(std::size_t at) const { return reach(at, "stop", false); }
  // After this stop the program ends; before that it may go up.
  bool ends(std::size_t stop) const { return reach(stop + 1, "end", true).has_value(); }

private:
  // The block of this function that `at` leads to by jumps alone; `moves`: and by at most one move in feed.
  std::optional<std::size_t> reach(std::size_t at, std::string_view function, bool moves) const {
    for (std::size_t steps = 0; at < program_.body.size() && steps < program_.body.size(); ++steps) {
      bool there = false;
      const bool goesOn = ir::match(
          program_.body[at],
          [&](const ir::OneOf<ir::Label, ir::Comment> auto&) {
            ++at;
            return true;
          },
          [&](const ir::NcBlock& block) {
            there = does(block, function);
            if (there) return false;
            if (moves && does(block, "feed")) {
              moves = false;
              ++at;
              return true;
            }
            const auto to = target(block);
            if (!does(block, "jump") || !to) return false;
            at = *to;
            return true;
          },
          [](const ir::OneOf<ir::Jump, ir::Branch, ir::Store, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Call,
                             ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
            return false;
          });
      if (!goesOn) return there ? std::optional(at) : std::nullopt;
    }
    return std::nullopt;
  }

  const ir::Program& program_;
  const stdlib::MikroprogControl& control_;
  std::map<std::uint64_t, std::size_t> numbers_; // N to the first block that has it
};

} // namespace

std::optional<std::uint32_t> wholeOf(const ir::Word& word) {
  const double* const number = ir::constantValue(word.value);
  if (number == nullptr || !(*number >= 0 && *number < 1e9) || *number != std::floor(*number))
    return std::nullopt;
  return static_cast<std::uint32_t>(*number);
}

const ir::Word* find(const ir::NcBlock& block, char address) {
  const auto at = std::find_if(block.words.begin(), block.words.end(),
                               [&](const ir::Word& word) { return word.address == address; });
  return at == block.words.end() ? nullptr : &*at;
}

Profile::Profile(const stdlib::MikroprogControl& of) : control(of) {
  machine.name = of.name;
  machine.title = of.title;
  machine.origin = of.origin;
  machine.increment = 1e-6;
  machine.decimals = kGrid;
  machine.integerDigits = 9; // what fits a word is for the checks
  machine.locals = 0;
  machine.arcTolerance = kArcTolerance;
  machine.common = {{variableOf(0), variableOf(kLastKept), false}};
  machine.sequenceLast = 999'999'999;
  machine.alarms = {{stdlib::Alarm::NoFeed, 0, "a feed move with F0", "", ""},
                    {stdlib::Alarm::ArcRadius, 0, "the end of the arc is not on it", "", ""},
                    {stdlib::Alarm::NoSuchSequence, 0, "no block has this number", "", ""}};
  for (const stdlib::MikroprogFunction& function : of.functions) {
    const auto effect = std::find_if(std::begin(kEffects), std::end(kEffects),
                                     [&](const auto& one) { return one.first == function.function; });
    if (effect == std::end(kEffects) || !function.usable) continue;
    machine.codes.push_back(
        {function.letter, function.number * 10, effect->second, {}, function.title, "", ""});
    if (function.start && function.letter == 'G') dialect.startCodes.push_back(function.number * 10);
  }
  dialect.wordDecimals = of.decimals;
  dialect.skipsAtOwnSpeed = true;
  dialect.numbersAlarms = false;
  dialect.firstParameter = variableOf(0);
  dialect.lastParameter = variableOf(kLastParameter);
  dialect.isLathe = !of.hasAxis('Y');
  dialect.showsDiameters = of.isDiameter('X');
  dialect.dwellLetter = 'E';
  dialect.holdsTool = true;
}

bool preset(Machine& machine, const Profile& profile, std::string_view name, double value) {
  const auto number = [](std::string_view digits) -> std::optional<std::uint32_t> {
    std::uint32_t out = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return out;
  };
  if (name.starts_with('P')) {
    const auto parameter = number(name.substr(1));
    return parameter && *parameter <= kLastParameter && machine.preset(variableOf(*parameter), value);
  }
  if (name.starts_with('O')) {
    const auto condition = number(name.substr(1));
    const bool computed = condition && *condition >= 10 && *condition <= 16; // from P90 and a place
    return condition && *condition < kStored - kCondition && !computed && (value == 0 || value == 1) &&
           profile.control.condition(*condition) != nullptr &&
           machine.preset(variableOf(kCondition + *condition), value);
  }
  const std::size_t point = name.find('.');
  if (!name.starts_with('G') || point == std::string_view::npos || name.size() != point + 2) return false;
  const auto code = number(name.substr(1, point - 1));
  const stdlib::MikroprogFunction* const function = code ? profile.control.find('G', *code) : nullptr;
  const char axis = name.back();
  if (function == nullptr || function->function != "system-stored" || !profile.control.hasAxis(axis))
    return false;
  const std::size_t at = std::string_view(kAxisLetters).find(axis);
  return machine.preset(variableOf(storedShift(*code, at)),
                        profile.control.isDiameter(axis) ? value / 2 : value);
}

std::vector<SkipMoveUse> skipMoves(const ir::Program& program, const stdlib::MikroprogControl& control) {
  std::vector<SkipMoveUse> out;
  const Blocks blocks(program, control);
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&program.body[i].node);
    if (block == nullptr || !blocks.does(*block, "probe-move")) continue;
    SkipMoveUse one{i};
    if (const auto to = blocks.target(*block); !to) {
      one.use = SkipUse::Blind;
    } else {
      const auto contact = blocks.stop(i + 1), missed = blocks.stop(*to);
      // Where the next block stops anyway, as for what the operator enters, the tail is the one that ends.
      const bool both = contact && missed;
      const bool ends = both ? blocks.ends(*contact) : contact.has_value(),
                 misses = both ? blocks.ends(*missed) : missed.has_value();
      if (ends != misses) {
        one.use = ends ? SkipUse::Protected : SkipUse::Search;
        one.stop = ends ? contact : missed;
      }
    }
    out.push_back(one);
  }
  return out;
}

std::string textBeside(const ir::Program& program, std::size_t statement) {
  const auto& body = program.body;
  for (std::size_t i = statement; i < body.size() && body[i].origin.block == body[statement].origin.block;
       ++i)
    if (const auto* text = std::get_if<ir::Comment>(&body[i].node)) return text->text;
  return "";
}

std::vector<std::string> programsRunBy(const ir::Program& program, const stdlib::MikroprogControl& control) {
  std::vector<std::string> out;
  for (const auto& statement : program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    const ir::Word* const file = find(*block, '@');
    const auto* named = file == nullptr ? nullptr : std::get_if<ir::Constant>(&file->value->node);
    for (const ir::Word& word : block->words) {
      const bool isCode = word.address == 'G' || word.address == 'M';
      const auto number = isCode ? wholeOf(word) : std::nullopt;
      const auto* function = number ? control.find(word.address, *number) : nullptr;
      if (function == nullptr) continue;
      std::string name;
      if (function->function == "run-program" && named != nullptr) name = named->digits;
      if (function->function == "run-macro") name = macroFile(*function);
      if (!name.empty() && std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    }
  }
  return out;
}

std::vector<std::string> functionsFirst(const ir::Program& program, const stdlib::MikroprogControl& control) {
  std::vector<std::string> out;
  for (const auto& statement : program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    for (const ir::Word& word : block->words) {
      if (control.hasAxis(word.address)) return out;
      const auto number = word.address == 'G' || word.address == 'M' ? wholeOf(word) : std::nullopt;
      const auto* function = number ? control.find(word.address, *number) : nullptr;
      if (function != nullptr) out.push_back(function->function);
    }
  }
  return out;
}

} // namespace dotek::sim::mikroprog
