#include "tests/unit/Mutants.h"

#include <algorithm>
#include <random>

namespace dotek::tests {

std::string InputFile::folder() const {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

const InputFile* Bundle::find(const std::string& wanted) const {
  for (const InputFile& file : files)
    if (file.name == wanted) return &file;
  return nullptr;
}

std::string withoutComments(const std::string& text, char kind) {
  std::string out = text;
  const char quote = kind == 'p' ? '\'' : kind == 'm' || kind == 'l' ? '"' : '\0';
  const char begin = kind == 'p' ? '{' : kind == 'n' ? '(' : kind == 's' ? ';' : '!';
  const char end = kind == 'p' ? '}' : kind == 'n' ? ')' : '\n';
  bool quoted = false;
  bool comment = false;
  for (char& c : out) {
    if (c == '\n') quoted = false;
    if (comment) {
      comment = c != end;
      if (c != '\n') c = ' ';
    } else if (quote != '\0' && c == quote) {
      quoted = !quoted;
    } else if (!quoted && c == begin) {
      comment = true;
      c = ' ';
    }
  }
  return out;
}

std::string mutated(const InputFile& file, const Change& edit) {
  std::string out = file.text;
  out.replace(edit.offset, edit.length, edit.text);
  return out;
}

std::vector<Line> linesOf(const InputFile& file) {
  std::vector<Line> out;
  for (std::size_t at = 0; at < file.text.size();) {
    const std::size_t end = std::min(file.text.find('\n', at), file.text.size());
    out.push_back({at, end - at, file.code.substr(at, end - at)});
    at = end + 1;
  }
  return out;
}

bool isBlank(const std::string& text) {
  return text.find_first_not_of(" \t\r") == std::string::npos;
}

void eachMatch(const InputFile& file, const std::regex& pattern, std::size_t group, const Replace& replace,
               Sites& sites) {
  for (const Line& line : linesOf(file)) {
    for (std::sregex_iterator match(line.code.begin(), line.code.end(), pattern), none; match != none;
         ++match) {
      if (!(*match)[group].matched) continue;
      if (auto text = replace(*match))
        sites.push_back({line.offset + static_cast<std::size_t>(match->position(group)),
                         static_cast<std::size_t>(match->length(group)), std::move(*text)});
    }
  }
}

Change dropLine(const InputFile& file, const Line& line) {
  const bool broken = line.offset + line.length < file.text.size();
  return {line.offset, line.length + (broken ? 1 : 0), ""};
}

void dropLines(const InputFile& file, const std::regex& pattern, Sites& sites) {
  for (const Line& line : linesOf(file))
    if (std::regex_search(line.code, pattern)) sites.push_back(dropLine(file, line));
}

namespace {

std::regex compiled(const char* pattern, bool ignoreCase) {
  return std::regex(pattern,
                    ignoreCase ? std::regex::ECMAScript | std::regex::icase : std::regex::ECMAScript);
}

} // namespace

Operator replacing(std::string_view id, std::string_view kinds, const char* pattern, std::size_t group,
                   Replace replace, bool ignoreCase) {
  return {id, kinds,
          [re = compiled(pattern, ignoreCase), group,
           replace = std::move(replace)](const InputFile& file, const Bundle&, Sites& sites) {
            eachMatch(file, re, group, replace, sites);
          }};
}

Operator taking(std::string_view id, std::string_view kinds, const char* pattern, std::size_t group,
                bool ignoreCase) {
  return replacing(
      id, kinds, pattern, group, [](const std::smatch&) { return std::optional<std::string>(""); },
      ignoreCase);
}

Operator droppingLines(std::string_view id, std::string_view kinds, const char* pattern, bool ignoreCase) {
  return {id, kinds,
          [re = compiled(pattern, ignoreCase)](const InputFile& file, const Bundle&, Sites& sites) {
            dropLines(file, re, sites);
          }};
}

std::string misspelt(const std::string& name) {
  std::string out = name;
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (out[i] == out[i - 1]) continue;
    std::swap(out[i], out[i - 1]);
    return out;
  }
  return out + out.back();
}

std::optional<std::string> shortened(const std::string& name) {
  if (name.size() < 3) return std::nullopt;
  std::string out = name;
  out.erase(out.size() / 2, 1);
  return out;
}

std::optional<std::string> swapped(const std::string& digits) {
  std::string out = digits;
  for (std::size_t i = out.size(); i-- > 1;) {
    if (out[i] == out[i - 1]) continue;
    std::swap(out[i], out[i - 1]);
    return out;
  }
  return std::nullopt;
}

std::vector<Operator> allOperators() {
  std::vector<Operator> out;
  for (auto list : {generalOperators(), macroOperators(), postOperators(), programOperators()})
    out.insert(out.end(), list.begin(), list.end());
  return out;
}

std::vector<Mutant> drawMutants(const std::vector<Operator>& operators, const std::vector<Bundle>& bundles,
                                std::uint64_t seed, std::size_t count, std::vector<std::string>& unfit) {
  std::mt19937_64 random(seed);
  // An operator may have a definition for each language.
  std::vector<std::string_view> ids;
  std::vector<std::vector<Mutant>> sites;
  for (const Operator& op : operators) {
    auto at = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), op.id) - ids.begin());
    if (at == ids.size()) {
      ids.push_back(op.id);
      sites.emplace_back();
    }
    for (std::size_t b = 0; b < bundles.size(); ++b) {
      for (std::size_t f = 0; f < bundles[b].files.size(); ++f) {
        const InputFile& file = bundles[b].files[f];
        if (!file.is(op.kinds)) continue;
        Sites found;
        op.fit(file, bundles[b], found);
        for (Change& edit : found)
          if (mutated(file, edit) != file.text) sites[at].push_back({&op, b, f, std::move(edit)});
      }
    }
  }
  for (std::size_t at = 0; at < ids.size(); ++at) {
    if (sites[at].empty()) unfit.emplace_back(ids[at]);
    for (std::size_t i = sites[at].size(); i > 1; --i)
      std::swap(sites[at][i - 1], sites[at][random() % i]);
  }
  std::vector<Mutant> out;
  for (std::size_t turn = 0; out.size() < count; ++turn) {
    bool any = false;
    for (const auto& list : sites) {
      if (turn >= list.size() || out.size() == count) continue;
      out.push_back(list[turn]);
      any = true;
    }
    if (!any) break;
  }
  return out;
}

} // namespace dotek::tests
