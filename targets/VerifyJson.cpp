// The document of `verify` as JSON; docs/verify.md says its shape.
#include "targets/VerifyDocument.h"

#include <nlohmann/json.hpp>

namespace dotek::targets {

namespace {

using Json = nlohmann::ordered_json;

Json maybe(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json countsOf(const VerifyDocument::Counts& counts) {
  return {{"all", counts.all},
          {"agree", counts.agree},
          {"differ", counts.differ},
          {"undecided", counts.undecided}};
}

Json fileOf(const VerifyDocument::File& file) {
  return {{"file", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}};
}

// Adds what an excerpt shows under a name; nothing where it has no line.
void add(Json& object, const char* name, const VerifyDocument::Excerpt& excerpt) {
  if (excerpt.line != 0)
    object[name] = {{"file", excerpt.file}, {"line", excerpt.line}, {"text", lineOf(excerpt)}};
}

Json differenceOf(const VerifyDocument::Difference& one) {
  Json out = {{"pair", one.pair},   {"aspect", one.aspect}, {"text", one.text},
              {"cases", one.cases}, {"of", one.of},         {"edge", one.edge}};
  add(out, "source", one.source);
  add(out, "post", one.post);
  add(out, "translation", one.translation);
  out["replay"] = one.replay;
  return out;
}

Json reasonOf(const VerifyDocument::Reason& one) {
  Json out = {{"cases", one.cases}, {"edge", one.edge}, {"why", one.why}};
  add(out, "at", one.at);
  out["rejected"] = one.rejected;
  out["remedy"] = maybe(one.remedy);
  out["replay"] = one.replay;
  return out;
}

Json findingOf(const VerifyDocument::Finding& one) {
  Json out = {{"about", one.about}, {"severity", one.severity}, {"code", one.code}, {"message", one.message}};
  if (one.line != 0) {
    out["file"] = one.file;
    out["line"] = one.line;
  }
  return out;
}

template <class Item, class Make> Json listOf(const std::vector<Item>& items, const Make& make) {
  Json out = Json::array();
  for (const Item& item : items)
    out.push_back(make(item));
  return out;
}

} // namespace

std::string jsonOf(const VerifyDocument& d) {
  Json out;
  out["schema"] = 1;
  out["tool"] = {{"name", "dotek"}, {"version", d.version}};
  out["date"] = maybe(d.date);
  out["remark"] = maybe(d.remark);
  out["command"] = d.command;
  out["verdict"] = d.verdict;
  out["summary"] = d.summary;
  out["cases"] = {{"drawn", countsOf(d.cases)}, {"edge", countsOf(d.edges)}};
  out["cases"]["edge"]["refused"] = d.edges.refused;
  out["compared"] = {{"pair", d.pair}, {"aspects", d.aspects}, {"tolerance_mm", d.tolerance}};
  if (d.wordSteps > 0) out["compared"]["word_steps"] = d.wordSteps;
  out["source"] = {{"name", d.title},
                   {"control", maybe(d.sourceControl)},
                   {"form", maybe(d.form)},
                   {"macros", maybe(d.sourceMacros)},
                   {"files", listOf(d.inputs, fileOf)}};
  if (!d.target.empty()) {
    Json& translation = out["translation"];
    translation = {{"target", d.target},
                   {"control", maybe(d.targetControl)},
                   {"macros", maybe(d.targetMacros)},
                   {"edited", d.edited}};
    if (d.translation) translation["text"] = fileOf(*d.translation);
  }
  out["settings"] = {{"seed", d.seed},
                     {"min_agreed_percent", d.minAgreed},
                     {"fixed", listOf(d.fixed,
                                      [](const auto& one) {
                                        return Json{{"name", one.first}, {"value", one.second}};
                                      })},
                     {"assumed", d.assumed}};
  out["differences"] = listOf(d.differences, differenceOf);
  out["undecided"] = listOf(d.undecided, reasonOf);
  out["findings"] = listOf(d.findings, findingOf);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace dotek::targets
