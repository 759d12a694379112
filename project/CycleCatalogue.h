// Pages of cycles for people: parameters, results, what a cycle refuses, how it is called.
#pragma once

#include "frontend/cycle/Ast.h"

#include <string>
#include <utility>
#include <vector>

namespace dotek::project {

// What the page of one cycle or one file of options prints.
struct CyclePage {
  struct Row {
    std::string name;
    std::string kind;      // "length", "choice of stops, flags"
    std::string initial;   // "required", "may be left out", "5 mm"
    std::string letter;    // wished for; "": none
    std::string meaning;   // its title
    std::string condition; // "depth > 0 mm"; "": none
    std::string group;
  };
  std::string name; // `bore_3`
  std::string title;
  std::string description; // the comment above the header
  bool options = false;
  bool helper = false; // written for other cycles: it needs the probe of its caller, or says so
  std::vector<Row> parameters;
  std::vector<Row> results; // name, kind and meaning
  std::vector<std::string>
      refusals; // before it moves: "The bore takes the ball (`diameter > 2 * ball_radius`)"
  std::vector<std::string> alarms; // while it runs, those of the cycles that it calls included
  std::vector<std::string> sets;   // "work offset `system`: x, y"
  std::vector<std::string> calls;  // names of cycles, each once
  std::string example;             // call bore diameter = .. -> it
  bool missStops = false;          // a touch without `else`: nothing found is an alarm
  bool meetStops = false;          // a protected move: what it meets is an alarm
  // Of `calls` those that have no page beside this one.
  std::vector<std::string> elsewhere;
};

// Of a linked cycle (frontend/cycle/Link.h).
CyclePage cyclePage(const frontend::cycle::File& file);

std::string markdown(const CyclePage& page);
std::string html(const CyclePage& page);
// The list of all pages, with links to NAME.md and NAME.html.
std::string markdownIndex(const std::vector<CyclePage>& pages);
std::string htmlIndex(const std::vector<CyclePage>& pages);

// `bore-3`: of files and links.
std::string fileStem(const std::string& cycle);

} // namespace dotek::project
