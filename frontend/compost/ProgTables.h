// Private to Post*.cpp, Lower*.cpp: routines, pictures and formats of a Prog with its form.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/Form.h"
#include "support/Diagnostics.h"
#include "support/Picture.h"

#include <map>
#include <set>
#include <string>

namespace dotek::frontend::compost {

class ProgTables {
public:
  ProgTables(const Program& program, const stdlib::Form& form);

  // nullptr: no routine of that name.
  const Routine* routine(std::string_view name) const;
  // Of a numeric keyword: FORMAT, else the form. nullptr: none that may be printed with; reported, of one
  // keyword once. The picture lives as long as this object.
  const Picture* picture(const std::string& keyword, SourceRange where, Diagnostics& diagnostics);
  // Reports what is printed by an entry that the form only assumes, of one keyword once.
  void noteAssumed(const std::string& keyword, const stdlib::FormEntry& entry, SourceRange where,
                   Diagnostics& diagnostics);
  // FORMAT of a command; nullptr: none.
  const SourceRange* commandFormat(std::string_view name) const;

private:
  const stdlib::Form& form_;
  std::map<std::string, const Routine*, std::less<>> routines_;
  std::map<std::string, Picture, std::less<>> pictures_;
  std::map<std::string, SourceRange, std::less<>> commandFormats_;
  std::set<std::string, std::less<>> told_;    // keywords without a picture
  std::set<std::string, std::less<>> assumed_; // keywords of which noteAssumed() reported
};

} // namespace dotek::frontend::compost
