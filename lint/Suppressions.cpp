#include "lint/Suppressions.h"

#include "lint/Posts.h"
#include "support/Ascii.h"
#include "support/NearestName.h"
#include "support/messages/Lint.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <numeric>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kLastLine = std::numeric_limits<std::uint32_t>::max();

struct Remark {
  SourceRange range;
  std::string_view text; // all of the comment, with its marks
};

std::vector<Remark> remarksOf(const Project& project) {
  std::vector<Remark> out;
  const auto take = [&](const auto& comments) {
    for (const auto& comment : comments)
      out.push_back({comment.range, project.sources.text(comment.range)});
  };
  for (const compost::Program* prog : project.progs)
    take(prog->comments);
  for (const gibbs::Macro* macro : project.allMacros())
    take(macro->comments);
  for (const gibbs::Dialog* dialog : project.allDialogs())
    take(dialog->comments);
  for (const gibbs::Cycle* cycle : project.cycles)
    if (cycle->defineData) take(cycle->defineData->comments);
  for (const gibbs::DefineData* data : project.defines)
    take(data->comments);
  for (const NcFile& nc : project.programs) {
    for (const macrob::Program& program : nc.file->programs) {
      take(program.comments);
      for (const macrob::Block& block : program.blocks)
        take(block.comments);
    }
  }
  for (const mikroprog::Reading* reading : project.sufPrograms)
    for (const mikroprog::Line& line : reading->program.lines)
      if (line.comment) out.push_back({line.commentRange, project.sources.text(line.commentRange)});
  for (const PostFile* post : postsOf(project))
    take(post->tree.tokens.comments);
  std::sort(out.begin(), out.end(), [](const Remark& a, const Remark& b) {
    return std::pair(a.range.file, a.range.begin) < std::pair(b.range.file, b.range.begin);
  });
  return out;
}

bool isWordCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
}

struct DirectiveWord {
  std::string text; // lower case
  SourceRange range;
};

// The words after `dotek:`; empty: the comment is none of ours.
std::vector<DirectiveWord> wordsOf(const Remark& remark) {
  const std::string lower = lowerCase(std::string_view(remark.text));
  std::size_t at = lower.find_first_not_of("{!(;/* \t");
  if (at == std::string::npos || lower.compare(at, 5, "dotek") != 0) return {};
  at = lower.find_first_not_of(" \t", at + 5);
  if (at == std::string::npos || lower[at] != ':') return {};
  std::vector<DirectiveWord> out;
  for (++at; at < lower.size();) {
    if (!isWordCharacter(lower[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < lower.size() && isWordCharacter(lower[end]))
      ++end;
    if (lower.compare(at, 2, "--") == 0) break; // a reason follows
    const auto begin = static_cast<std::uint32_t>(remark.range.begin + at);
    out.push_back({lower.substr(at, end - at),
                   {remark.range.file, begin, static_cast<std::uint32_t>(begin + end - at)}});
    at = end;
  }
  return out;
}

class Reader {
public:
  Reader(const SourceMap& sources, Diagnostics& diagnostics) : sources_(sources), diagnostics_(diagnostics) {}

  void read(const Remark& remark) {
    const std::vector<DirectiveWord> words = wordsOf(remark);
    if (words.empty()) return;
    const std::string& verb = words.front().text;
    if (verb != "ignore" && verb != "ignore-file" && verb != "ignore-start" && verb != "ignore-end") {
      diagnostics_.report<diag::SuppressionForm>(
          words.front().range, "`" + verb +
                                   "` is no directive; `ignore`, `ignore-file`, `ignore-start` and "
                                   "`ignore-end` are");
      return;
    }
    if (words.size() == 1)
      diagnostics_.report<diag::SuppressionForm>(
          words.front().range, "no code follows `" + verb + "`; write the codes that are meant");
    for (std::size_t i = 1; i < words.size(); ++i)
      take(verb, words[i], remark);
  }

  std::vector<Suppression> finish() {
    for (const Suppression& one : out_) {
      if (one.lastLine == kOpen)
        diagnostics_.report<diag::SuppressionForm>(one.range, "nothing ends the region of `" + one.code +
                                                                  "`; write `dotek: ignore-end " + one.code +
                                                                  "` after it");
    }
    return std::move(out_);
  }

private:
  static constexpr std::uint32_t kOpen = kLastLine - 1;

  void take(const std::string& verb, const DirectiveWord& word, const Remark& remark) {
    if (!known(word)) return;
    const SourceFile& file = sources_.file(remark.range.file);
    const std::uint32_t first = file.lineOf(remark.range.begin);
    const std::uint32_t last = file.lineOf(remark.range.end > 0 ? remark.range.end - 1 : 0);
    if (verb == "ignore-end") {
      std::vector<std::size_t>& open = open_[{word.range.file, word.text}];
      if (open.empty()) {
        diagnostics_.report<diag::SuppressionForm>(word.range,
                                                   "no region of `" + word.text + "` is open here");
        return;
      }
      out_[open.back()].lastLine = last;
      open.pop_back();
      return;
    }
    Suppression one{word.text, word.range, first, last, false};
    if (verb == "ignore-file") {
      one.firstLine = 0;
      one.lastLine = kLastLine;
    } else if (verb == "ignore-start") {
      one.lastLine = kOpen;
      open_[{word.range.file, word.text}].push_back(out_.size());
    } else if (alone(file, remark, first, last)) {
      one.lastLine = nextLine(file, last);
    }
    out_.push_back(std::move(one));
  }

  bool known(const DirectiveWord& word) {
    const auto table = codeTable();
    const auto at =
        std::lower_bound(table.begin(), table.end(), word.text,
                         [](const CodeInfo& info, const std::string& key) { return info.code < key; });
    if (at != table.end() && at->code == word.text) return true;
    NearestName nearest(word.text);
    for (const CodeInfo& info : table)
      nearest.offer(info.code);
    diagnostics_.report<diag::SuppressionUnknown>(
        word.range, word.text, nearest.result().empty() ? "" : "; did you mean `" + nearest.result() + "`?");
    return false;
  }

  // Nothing but the comment is on its lines.
  static bool alone(const SourceFile& file, const Remark& remark, std::uint32_t first, std::uint32_t last) {
    const std::string_view before =
        std::string_view(file.bytes())
            .substr(file.lineStart(first), remark.range.begin - file.lineStart(first));
    const std::string_view line = file.line(last);
    const std::size_t behind = remark.range.end - file.lineStart(last);
    const auto blank = [](std::string_view text) {
      return text.find_first_not_of(" \t\r") == std::string_view::npos;
    };
    return blank(before) && (behind >= line.size() || blank(line.substr(behind)));
  }

  // The next line that is not blank.
  static std::uint32_t nextLine(const SourceFile& file, std::uint32_t line) {
    std::uint32_t next = line + 1;
    while (next < file.lineCount() && file.line(next).find_first_not_of(" \t\r") == std::string_view::npos)
      ++next;
    return next;
  }

  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::vector<Suppression> out_;
  std::map<std::pair<FileId, std::string>, std::vector<std::size_t>> open_; // regions, by file and code
};

// The suppressions of one code in one file, asked line by line from the first on.
class Lines {
public:
  void add(Suppression& one) { waiting_.push_back(&one); }
  void sort() {
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [](const Suppression* a, const Suppression* b) { return a->firstLine < b->firstLine; });
  }
  // Whether one holds there; all that do are used.
  bool suppress(std::uint32_t line) {
    for (; next_ < waiting_.size() && waiting_[next_]->firstLine <= line; ++next_) {
      unused_.push_back(waiting_[next_]);
      last_ = std::max(last_, waiting_[next_]->lastLine);
    }
    for (Suppression* one : unused_)
      if (line <= one->lastLine) one->used = true;
    unused_.clear();
    return next_ > 0 && line <= last_;
  }

private:
  std::vector<Suppression*> waiting_; // by their first line; those before next_ have begun
  std::vector<Suppression*> unused_;  // have begun since the line that was asked for last
  std::size_t next_ = 0;
  std::uint32_t last_ = 0; // of those that have begun
};

} // namespace

std::vector<Suppression> suppressionsOf(const Project& project, Diagnostics& diagnostics) {
  Reader reader(project.sources, diagnostics);
  for (const Remark& remark : remarksOf(project))
    reader.read(remark);
  return reader.finish();
}

std::vector<Suppression> suppressionsOf(const std::vector<FileId>& cycleFiles, const SourceMap& sources,
                                        Diagnostics& diagnostics) {
  Reader reader(sources, diagnostics);
  for (const FileId id : cycleFiles) {
    const SourceFile& file = sources.file(id);
    for (std::uint32_t line = 1; line <= file.lineCount(); ++line) {
      const std::string_view text = file.line(line);
      bool quoted = false;
      std::size_t at = 0;
      while (at < text.size() && (quoted || !text.substr(at).starts_with("//")))
        quoted = quoted != (text[at++] == '"');
      if (at == text.size()) continue;
      const std::uint32_t begin = file.lineStart(line) + static_cast<std::uint32_t>(at);
      const auto end = static_cast<std::uint32_t>(file.lineStart(line) + text.size());
      reader.read({{id, begin, end}, text.substr(at)});
    }
  }
  return reader.finish();
}

void applySuppressions(std::vector<Suppression>& suppressions, const SourceMap& sources,
                       Diagnostics& diagnostics,
                       const std::function<bool(std::string_view code, FileId file)>& judged) {
  std::map<std::pair<FileId, std::string_view>, Lines> lines;
  for (Suppression& one : suppressions)
    lines[{one.range.file, one.code}].add(one);
  for (auto& [key, of] : lines)
    of.sort();
  std::vector<Diagnostic>& all = diagnostics.all();
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return all[a].range.begin < all[b].range.begin; });
  std::vector<bool> suppressed(all.size());
  for (const std::size_t i : order) {
    const auto of = all[i].range.hasPlace() ? lines.find({all[i].range.file, all[i].code}) : lines.end();
    suppressed[i] = of != lines.end() && of->second.suppress(sources.line(all[i].range));
  }
  std::size_t index = 0;
  std::erase_if(all, [&](const Diagnostic&) { return suppressed[index++]; });
  for (const Suppression& one : suppressions) {
    if (!one.used && judged(one.code, one.range.file))
      diagnostics.report<diag::SuppressionUnused>(one.range, one.code);
  }
}

} // namespace dotek::lint
