#include "tests/unit/RandomMacroB.h"

#include <cctype>
#include <random>
#include <string_view>
#include <vector>

namespace dotek::tests {
namespace {

// Variables by use: #1 to #13, #100 to #109 and #500 to #503 hold anything, or nothing; #14 to #19 and #110
// to #115 ("small") what an axis can go to; #155 and on count loops, six for each program.
class Writer {
public:
  Writer(std::uint32_t seed, bool modern) : random_(seed), modern_(modern) {}

  std::string file() {
    const int callees = number(1, 4);
    for (int i = 1; i <= callees; ++i)
      kinds_.push_back(static_cast<Kind>(number(0, 2)));
    std::string out = chance(2) ? "%\n" : "";
    for (int i = 0; i <= callees; ++i)
      out += program(i);
    return out + (out.front() == '%' ? "%\n" : "");
  }

private:
  enum class Kind { Macro, Subprogram, Jumper }; // Jumper: a macro that may end with M99 P

  // ---- chance

  int number(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint32_t>(high - low + 1));
  }
  bool chance(int of) { return number(1, of) == 1; }
  template <std::size_t n> std::string any(const char* const (&list)[n]) {
    return list[number(0, static_cast<int>(n) - 1)];
  }

  // ---- expressions; `room`: brackets that may still be opened

  std::string literal() {
    static const char* const kNumbers[] = {"0", "1",  "2",   "3",    "4.",  "5",    "10",   ".5",    "2.5",
                                           "7", "8.", "0.1", "12.5", "16.", "1.25", "0.75", "33.333"};
    return any(kNumbers);
  }
  std::string small() { return "#" + std::to_string(chance(2) ? number(14, 19) : number(110, 115)); }
  // A variable with a value, as a minus in a word needs one.
  std::string set() { return chance(200) ? small() : "#" + std::to_string(number(152, 154)); }
  std::string anything() {
    switch (number(1, 6)) {
    case 1:
    case 2: return "#" + std::to_string(number(1, 13));
    case 3:
    case 4: return "#" + std::to_string(number(100, 109));
    case 5: return "#" + std::to_string(number(500, 503));
    default: return small();
    }
  }
  // Sometimes of no variable: small values reach 60.
  std::string subscript(int room) {
    const std::string base = chance(2) ? "100" : "500";
    if (room > 1 && chance(3)) return "#[" + base + "+ABS[" + small() + "]]";
    if (room > 1 && chance(6)) return "#[" + any({"1", "2.4", "99.5"}) + "+ABS[" + small() + "AND15]]";
    if (chance(20)) return "#[" + small() + "]";
    return "#[" + base + "+" + literal() + "]";
  }
  std::string operand(int room) {
    if (room > 0 && chance(9)) return subscript(room);
    return chance(2) ? literal() : anything();
  }
  std::string function(int room) {
    const std::string inner = expression(room - 1);
    static const char* const kPlain[] = {"ABS", "FIX", "FUP", "ROUND", "SIN", "COS", "ATAN", "ABS", "ROUND"};
    switch (number(1, 16)) {
    case 1: return room > 1 ? "SQRT[ABS[" + expression(room - 2) + "]]" : "SQRT[" + literal() + "]";
    case 2: return "ATAN[" + inner + "]/[" + literal() + "+1]";
    case 3: return room > 1 ? "LN[ABS[" + expression(room - 2) + "]+1]" : "LN[2.5]";
    case 4: return "EXP[" + literal() + "/8.]";
    case 5: return "BCD[" + literal() + "*" + literal() + "]";
    case 6: return "BIN[" + std::string(chance(9) ? "10" : any({"1", "18", "33", "153.", "64"})) + "]";
    case 7: return any({"ASIN[.5]", "ACOS[.25]", "ACOS[0]", "TAN[45]", "TAN[10]", "SIN[90]", "COS[180]"});
    case 8: return modern_ ? "ATAN[" + inner + "," + literal() + "+1]" : "COS[" + inner + "]";
    case 10: return modern_ ? any({"ABS", "ROUND", "SIN"}) + anything() : "FIX[" + inner + "]";
    case 9: return modern_ ? "POW[2," + literal() + "]" : "SQRT[" + literal() + "]";
    default: return any(kPlain) + "[" + inner + "]";
    }
  }
  std::string factor(int room) {
    if (room > 0 && chance(4)) return "[" + expression(room - 1) + "]";
    if (room > 0 && chance(4)) return function(room);
    return operand(room);
  }
  std::string expression(int room) {
    std::string out = (chance(8) ? "-" : "") + factor(room);
    for (int terms = number(0, 3) / 2 + (chance(4) ? 1 : 0); terms > 0; --terms) {
      switch (number(1, 14)) {
      case 1:
      case 2:
      case 3:
      case 4: out += "+" + factor(room); break;
      case 5:
      case 6:
      case 7: out += "-" + factor(room); break;
      case 8: out += "*" + factor(room); break;
      case 9: out += "*" + literal(); break;
      case 10: out += "/" + any({"2", "3.", "7", ".5", "16"}); break;
      case 11: out += chance(6) ? "/" + factor(room) : "/4"; break;
      case 12: out += "AND" + any({"7", "255", "12.4", "1"}); break;
      case 13: out += modern_ ? "MOD" + any({"2", "3", "7.6", "10"}) : "-1"; break;
      default: out += (chance(2) ? "OR" : "XOR") + std::to_string(number(0, 16)); break;
      }
    }
    return out;
  }
  // What an axis can go to.
  std::string bounded(int room) {
    switch (number(1, 8)) {
    case 1: return "#0";
    case 2: return room > 1 ? "[" + small() + "+" + literal() + "]/2" : literal();
    case 3: return room > 1 ? "SIN[" + small() + "]*10." : literal();
    case 4: return room > 0 ? any({"ROUND", "FIX", "FUP", "ABS"}) + "[" + small() + "]" : literal();
    case 5: return "-" + literal();
    case 6: return small();
    default: return std::to_string(number(0, 40)) + "." + std::to_string(number(0, 999));
    }
  }

  std::string comparison(int room) {
    static const char* const kRelations[] = {"EQ", "NE", "GT", "GE", "LT", "LE"};
    if (chance(4)) return anything() + (chance(2) ? "EQ" : "NE") + (chance(2) ? "#0" : "0");
    return expression(room - 2) + any(kRelations) + (chance(2) ? literal() : expression(room - 2));
  }
  std::string condition() {
    if (!chance(4)) return "[" + comparison(4) + "]";
    return "[[" + comparison(3) + "]" + any({"AND", "OR", "AND", "OR", "XOR"}) + "[" + comparison(3) + "]]";
  }

  // ---- blocks

  void put(const std::string& statement, bool deletable = true) {
    std::string out;
    if (deletable && chance(30)) out += chance(2) ? "/" : "/" + std::to_string(number(1, 3));
    if (chance(12)) out += "N" + std::to_string(label());
    out += statement;
    if (statement.find("#3000") == std::string::npos && chance(20)) out += "(NOTE " + literal() + ")";
    if (chance(40)) out.insert(0, "(BEFORE)");
    text_ += spaced(out) + (chance(40) ? ";\n" : "\n");
    if (chance(40)) text_ += chance(2) ? "\n" : "(ALONE)\n";
  }
  void put(int labelNumber, const std::string& statement = "") {
    text_ += spaced("N" + std::string(chance(8) ? "0" : "") + std::to_string(labelNumber) + statement) + "\n";
  }
  // A number for N, rarely one that the program has already.
  int label() {
    if (!labels_.empty() && chance(9))
      return labels_[static_cast<std::size_t>(number(0, static_cast<int>(labels_.size()) - 1))];
    labels_.push_back(number(10, 4999));
    return labels_.back();
  }
  // Blanks where they mean nothing: not in comments, printed text and numbers.
  std::string spaced(const std::string& block) {
    if (!chance(3) || block.find("DPRNT") != std::string::npos) return block;
    const int often = number(2, 12);
    std::string out;
    bool comment = false;
    const auto ofNumber = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; };
    for (std::size_t i = 0; i < block.size(); ++i) {
      comment = comment || block[i] == '(';
      const bool inside = i == 0 || comment || (ofNumber(block[i - 1]) && ofNumber(block[i]));
      if (!inside && block[i - 1] != '/' && chance(often)) out += chance(6) ? "  " : " ";
      out += block[i];
    }
    return out;
  }

  std::string assignment() {
    if (chance(4)) return small() + "=" + bounded(5);
    const std::string target = chance(8) ? subscript(5) : anything();
    if (target.size() > 2 &&
        (target.starts_with("#11") || (target[1] == '1' && target[2] >= '4' && target.size() == 3)))
      return target + "=" + bounded(5);
    if (chance(6)) return target + "=" + (chance(3) ? "#0" : anything());
    return target + "=" + expression(5);
  }
  std::string word(char axis) {
    std::string out(1, axis);
    switch (number(1, 6)) {
    case 1: return out + small();
    case 2: return out + "-" + set();
    case 3: return out + "[" + bounded(4) + "]";
    case 4: return out + "[ROUND[" + small() + "/3]]";
    default:
      return out + (chance(3) ? "-" : "") + std::to_string(number(0, 60)) + "." +
             std::to_string(number(0, 99));
    }
  }
  std::string move() {
    std::string out;
    if (chance(4)) out += chance(2) ? "G90" : "G91";
    if (chance(4)) out += any({"G0", "G1", "G00", "G01", "G#154"});
    for (const char axis : {'X', 'Y', 'Z'})
      if (chance(2)) out += word(axis);
    if (chance(8)) out += "F" + std::to_string(number(50, 900)) + ".";
    return out.empty() ? "X1." : out;
  }
  std::string given() {
    switch (number(1, 5)) {
    case 1: return anything();
    case 2: return "-" + set();
    case 3: return "[" + bounded(4) + "]";
    default:
      return (chance(4) ? "-" : "") + std::to_string(number(0, 30)) + "." + std::to_string(number(0, 9));
    }
  }
  std::string arguments() {
    std::string out;
    if (chance(3)) { // sets of I J K
      for (const char letter : {'A', 'B', 'C'})
        if (chance(3)) out += letter + given();
      for (int set = number(1, 5); set > 0; --set)
        for (const char letter : {'I', 'J', 'K'})
          if (!chance(3)) out += letter + given();
      if (chance(3)) out += any({"D#0", "E#0", "H#0", "M#0", "Q#0", "E5.", "H-2.5"}); // hits one of the sets
    }
    static const std::string_view kLetters = "ABCDEFHIJKMQRSTUVWXYZ";
    for (int i = number(0, 4); i > 0; --i)
      out += kLetters[static_cast<std::size_t>(number(0, static_cast<int>(kLetters.size()) - 1))] + given();
    return out;
  }

  // A callee after this program; 0: there is none that fits.
  int callee(bool macro) {
    for (int tries = 0; tries < 4; ++tries) {
      const int to = number(1, static_cast<int>(kinds_.size()));
      if (to > program_ && (kinds_[static_cast<std::size_t>(to) - 1] != Kind::Subprogram) == macro) return to;
    }
    return 0;
  }
  std::string target(int to) {
    if (!chance(6)) return "P" + std::to_string(8000 + to);
    put("#148=" + std::to_string(8000 + to), false);
    return "P#148";
  }
  std::string repeats() { return chance(8) ? "L" + std::to_string(number(1, 3)) : ""; }
  void call() {
    const bool macro = !chance(3);
    const int to = callee(macro);
    if (to == 0) return put(assignment());
    const bool jumper = kinds_[static_cast<std::size_t>(to) - 1] == Kind::Jumper;
    const std::string count = jumper ? "" : repeats();
    const std::string where = target(to);
    const std::string given = macro ? arguments() : "";
    if (macro)
      put("G65" + (chance(3) ? given + where + count : where + count + given));
    else
      put((chance(4) ? "G0X" + literal() : "") + "M98" + where + count);
    if (jumper) {
      put(assignment());
      put(7000 + to);
    }
  }
  void modal() {
    const int to = callee(true);
    if (to == 0 || kinds_[static_cast<std::size_t>(to) - 1] == Kind::Jumper) return put(move());
    put("G66" + target(to) + repeats() + arguments());
    for (int i = number(1, 3); i > 0; --i) {
      if (chance(4) && modals_ < 2) {
        ++modals_;
        modal();
        --modals_;
      } else {
        switch (number(1, 6)) {
        case 1: call(); break;
        case 2:
        case 3: put(assignment()); break;
        default: put(move()); break;
        }
      }
    }
    put("G67");
  }
  void print() {
    std::string out = "DPRNT[";
    for (int i = number(1, 3); i > 0; --i) {
      if (chance(2)) out += any({"X", "A*B", "N12", "-", "**", "R/2"});
      if (!chance(4))
        out += anything() + "[" + std::to_string(number(1, 6)) + std::to_string(number(0, 4)) + "]";
    }
    put((chance(4) ? "IF" + condition() + "THEN" : "") + out + "]");
  }
  void error() {
    static const char* const kErrors[] = {"#1=1/0",
                                          "#2=5/[#100-#100]",
                                          "#3=SQRT[-1]",
                                          "#0=1",
                                          "#4001=5",
                                          "#5041=1",
                                          "#[34]=1",
                                          "#200=1",
                                          "#1=#[-1]",
                                          "#1=#99",
                                          "#1=ASIN[2]",
                                          "#1=LN[0]",
                                          "#1=EXP[1000]",
                                          "#1=BIN[10]",
                                          "#1=BCD[-1]",
                                          "#1=[65536*65536]AND1",
                                          "#1=TAN[90]",
                                          "G65P7777A1.",
                                          "M98P7777",
                                          "GOTO[9000+#1-#1]",
                                          "GOTO[-5]",
                                          "#3000=5(STOPS HERE)",
                                          "#3000=#110AND31(COMPUTED)",
                                          "#1=1AND[0-65536*65536]",
                                          "#[#0]=1",
                                          "M30",
                                          "M2",
                                          "GOTO9998",
                                          "G65P#0",
                                          "M98P#0",
                                          "G67"};
    const std::string what = any(kErrors);
    if (what[0] == '#' && chance(2)) return put("IF" + condition() + "THEN" + what);
    put(what);
  }

  std::string counter() const {
    return "#" + std::to_string(155 + 6 * program_ + static_cast<int>(loops_.size()));
  }
  void loop() {
    int m = number(1, 3);
    for (const int used : loops_)
      if (used == m) return put(move());
    if (groups_ > 2) return put(assignment());
    const std::string count = counter();
    const std::string times = std::to_string(number(0, 4));
    const int out = label();
    const bool left = chance(3);
    const bool endless = chance(4);
    put(count + "=0", false);
    put((endless ? "" : "WHILE[" + count + "LT" + times + "]") + "DO" + std::to_string(m), false);
    loops_.push_back(m);
    put(count + "=" + count + "+1", false);
    groups(number(1, 3));
    if (endless) put("IF[" + count + "GE" + times + "]GOTO" + std::to_string(out), false);
    if (left) put("IF" + condition() + "GOTO" + std::to_string(out));
    if (chance(2)) groups(1);
    loops_.pop_back();
    put("END" + std::to_string(m), false);
    if (endless || left || chance(2)) put(out);
  }
  void backwards() {
    if (loops_.size() > 1 || groups_ > 2) return put(assignment());
    const std::string count = counter();
    const int to = label();
    put(count + "=0", false);
    put(to);
    put(count + "=" + count + "+1", false);
    loops_.push_back(0); // its counter is taken
    groups(number(1, 2));
    loops_.pop_back();
    put("IF[" + count + "LT" + std::to_string(number(1, 4)) + "]GOTO" + std::to_string(to), false);
  }
  void forwards() {
    const int to = label();
    put("IF" + condition() + (modern_ && chance(5) ? "THENGOTO" : "GOTO") + (chance(8) ? "0" : "") +
        std::to_string(to));
    groups(number(1, 2));
    put(to);
  }
  // One of some blocks, by a number at run time; now and then there is none.
  void computed() {
    const int base = 5000 + 10 * number(0, 99);
    put("#149=" + std::string(chance(2) ? literal() : small()) + "AND3", false);
    put("GOTO" + std::string(chance(2) ? "[" + std::to_string(base) + "+#149]"
                                       : "[#149+" + std::to_string(base) + ".2]"));
    const int places = chance(6) ? 2 : 3;
    for (int i = 0; i <= places; ++i) {
      put(base + i, assignment());
      if (chance(3)) put(move());
    }
  }
  void groups(int count) {
    ++groups_;
    for (; count > 0; --count)
      group();
    --groups_;
  }
  void group() {
    switch (number(1, 43)) {
    case 1:
    case 2: return put("IF" + condition() + "THEN" + assignment());
    case 39:
    case 40:
    case 41: return program_ == 0 ? call() : put(assignment());
    case 3:
    case 4:
    case 5: return groups_ > 3 ? put(assignment()) : forwards();
    case 6:
    case 7:
    case 8: return loop();
    case 9: return backwards();
    case 10:
    case 11: return computed();
    case 12:
    case 13:
    case 14:
    case 15: return put(move());
    case 16:
    case 17:
    case 18:
    case 19: return call();
    case 20:
    case 21: return program_ == 0 ? modal() : put(move());
    case 22:
    case 23:
    case 24: return print();
    case 25: return chance(3) ? error() : put("#3006=1(LOOK)");
    case 26: return put(small() + "=#" + std::to_string((chance(2) ? 5001 : 5041) + number(0, 2)));
    case 27: return put(anything() + "=#" + any({"4001", "4003"}));
    case 28: return put(label());
    case 29: return put(any({"M8", "M9", "G90", "G91", "G0", "G1", "M[8]"}));
    default: return put(assignment());
    }
  }

  std::string program(int index) {
    program_ = index;
    labels_.clear();
    text_.clear();
    if (index == 0) {
      text_ = chance(2) ? "O1(MAIN)\n" : "O0001\n";
      text_ += "POPEN\nG90G1X0.Y0.Z5.F200.\n#152=2.5\n#153=-7.125\n#154=1\n";
      for (int i = number(2, 8); i > 0; --i)
        put(chance(3) ? anything() + "=" + literal() : small() + "=" + bounded(5));
      groups(number(6, 16));
      if (chance(8)) { // from the start again
        put("#147=#147+1", false);
        put("IF[#147GE3]GOTO9000", false);
        // Whether locals are null then is open, so they are.
        for (const char* block :
             {"#146=1", "WHILE[#146LE19]DO1", "#[#146]=#0", "#146=#146+1", "END1", "PCLOS", "M99"})
          put(block, false);
        put(9000);
      }
      put("PCLOS");
      if (!chance(6)) put(chance(5) ? "M2" : "M30", false);
      return text_;
    }
    text_ = (chance(4) ? ":" : "O") + std::to_string(8000 + index) + "\n";
    for (int i = number(0, 4); i > 0; --i) // what it was given shows in the end
      put("#" + std::to_string(number(510, 530)) + "=#" + std::to_string(number(1, 26)), false);
    groups(number(2, 5));
    const Kind kind = kinds_[static_cast<std::size_t>(index) - 1];
    if (chance(20))
      put((kind == Kind::Subprogram ? "M98P" : "G65P") + std::to_string(8000 + index)); // for ever
    if (kind == Kind::Jumper) put("IF" + condition() + "GOTO9001", false);
    put((chance(8) ? move() : "") + "M99", false);
    if (kind == Kind::Jumper) put(9001, "M99P" + std::to_string(7000 + index));
    return text_;
  }

  std::mt19937 random_;
  bool modern_;
  std::vector<Kind> kinds_;
  std::string text_;
  std::vector<int> labels_;
  std::vector<int> loops_; // numbers of those around; 0: one by GOTO
  int program_ = 0;
  int groups_ = 0;
  int modals_ = 0;
};

} // namespace

std::string randomMacroB(std::uint32_t seed, bool modern) {
  return Writer(seed, modern).file();
}

} // namespace dotek::tests
