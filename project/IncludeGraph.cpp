#include "project/IncludeGraph.h"

#include "support/messages/Commands.h"

#include <algorithm>

namespace dotek::project {

namespace gibbs = frontend::gibbs;

std::vector<const gibbs::Macro*> IncludeGraph::includedBy(const gibbs::Macro& macro) {
  explore(macro);
  checkDepth(macro.file);
  std::vector<const gibbs::Macro*> out;
  std::set<FileId> met{macro.file};
  // Those of one file in the order of its lines, each followed by what it includes itself.
  std::vector<const gibbs::Macro*> waiting;
  const auto push = [&](FileId file) {
    const std::vector<Edge>& edges = nodes_.at(file).edges;
    for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge)
      if (!met.contains(edge->to->file)) waiting.push_back(edge->to);
  };
  push(macro.file);
  while (!waiting.empty()) {
    const gibbs::Macro* const next = waiting.back();
    waiting.pop_back();
    if (!met.insert(next->file).second) continue;
    out.push_back(next);
    push(next->file);
  }
  return out;
}

// Without recursion: a chain may be as long as there are files.
void IncludeGraph::explore(const gibbs::Macro& macro) {
  if (nodes_.contains(macro.file)) return;
  enter(macro);
  while (!path_.empty()) {
    Step& step = path_.back();
    if (step.next < step.lines.size()) {
      follow(*step.lines[step.next++]);
      continue;
    }
    Node& node = nodes_.at(step.file);
    for (const Edge& edge : node.edges)
      node.height = std::max(node.height, nodes_.at(edge.to->file).height + 1);
    node.open = false;
    path_.pop_back();
  }
}

void IncludeGraph::enter(const gibbs::Macro& macro) {
  nodes_[macro.file].open = true;
  Step& step = path_.emplace_back();
  step.file = macro.file;
  for (const gibbs::Line& line : macro.lines)
    if (line.statement)
      if (const auto* include = std::get_if<gibbs::Include>(&line.statement->node))
        step.lines.push_back(include);
}

void IncludeGraph::follow(const gibbs::Include& include) {
  const gibbs::Macro* const to = load_(include.file, include.fileRange);
  if (to == nullptr) return;
  const auto known = nodes_.find(to->file);
  if (known != nodes_.end() && known->second.open) return closeLoop(include, to->file);
  nodes_.at(path_.back().file).edges.push_back({include.fileRange, to});
  if (known == nodes_.end()) enter(*to);
}

// The path from that file on is the loop. A file in which one was reported says no more of others.
void IncludeGraph::closeLoop(const gibbs::Include& include, FileId to) {
  if (!nodes_.at(path_.back().file).inLoop)
    diagnostics_.report<diag::IncludeLoop>(include.fileRange, include.file);
  for (auto step = path_.rbegin(); step != path_.rend(); ++step) {
    nodes_.at(step->file).inLoop = true;
    if (step->file == to) break;
  }
}

// The line that is too deep is on the longest chain. Files in a loop have no depth, and were reported.
void IncludeGraph::checkDepth(FileId file) {
  const Node* node = &nodes_.at(file);
  if (node->height <= limits_.includeDepth) return;
  for (std::uint32_t depth = 0;; ++depth) {
    const auto deepest = std::find_if(node->edges.begin(), node->edges.end(), [&](const Edge& edge) {
      return nodes_.at(edge.to->file).height + 1 == node->height;
    });
    if (node->inLoop || deepest == node->edges.end()) return;
    if (depth == limits_.includeDepth) {
      if (tooDeep_.insert({deepest->where.file, deepest->where.begin}).second)
        diagnostics_.report<diag::IncludeTooDeep>(deepest->where, limits_.includeDepth);
      return;
    }
    node = &nodes_.at(deepest->to->file);
  }
}

} // namespace dotek::project
