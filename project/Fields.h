// Which value a field of the post gets: the macro's defaults, `--set`, `--field`.
#pragma once

#include "frontend/compost/Ast.h"
#include "project/CycleFolder.h"
#include "project/Session.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::project {

// Where the value of a post's field comes from: a variable of the macro as it declares it, or a number.
struct FieldOrigin {
  std::string variable; // "" where `number` holds
  std::optional<double> number;
};

class FieldTable {
public:
  // `printed` are the fields that the post's branch of this cycle prints, as spelt there.
  FieldTable(const CycleFolder& folder, std::vector<std::string> printed, Session& session);

  // Takes a value of --set or of the job. false: neither the macro nor the branch knows the name.
  bool set(const std::string& name, double value, SourceRange where);
  // Takes --field POSTFIELD=VARIABLE. Reports and returns false where one of the names is not known.
  bool map(const std::string& postField, const std::string& variable);
  // Whether the branch prints the one and the macro declares the other, and no field of the first name: what
  // is given for several cycles is meant for those that lack it.
  bool knows(const std::string& postField, const std::string& variable) const;
  // All pairs of --field, each only where it is known if the cycle is one of `several`, then those of
  // dotek.toml that are known. The former are added to `used`. false: reported.
  bool mapGiven(bool several, std::set<std::string>& used);
  // Whether the macro declares the name, in whatever case.
  bool declares(const std::string& name) const { return declared(name) != nullptr; }
  // Reports the fields whose first value nobody overrides and no source lets us read. false: there are some.
  bool certain() const;
  // The end of a message about an unknown name: the nearest of macro and post, or what there is.
  std::string hint(const std::string& name) const;

  // What the field is that the Prog prints at `where`; reports why there is nothing.
  std::optional<FieldOrigin> origin(const std::string& name, SourceRange where);
  // Value of a field that the Prog prints at `where`; reports why there is none.
  std::optional<double> value(const std::string& name, SourceRange where);
  // Numbers that --set or the job gave for names that only the post knows.
  const std::map<std::string, double>& postOnly() const { return postOnly_; }
  // What the macro sees, by folded name.
  std::map<std::string, double> macroValues() const;
  // A value that the macro changes after its dialog.
  void change(const std::string& folded, double value);

private:
  struct Entry {
    std::string name; // as the macro spells it
    std::string folded;
    std::optional<double> value;
    SourceRange valueRange;
    std::string_view assumption; // that reading the first value needs; "" for none
  };
  const Entry* declared(const std::string& name) const;
  Entry* declared(const std::string& name);
  std::string proposal(const std::string& name) const;

  const CycleFolder& folder_;
  Session& session_;
  std::vector<std::string> printed_;
  std::vector<Entry> entries_;                             // in the order of declaration
  std::shared_ptr<const std::vector<std::size_t>> byName_; // entries by their folded names; of all copies
  std::map<std::string, double> postOnly_;                 // --set of names that the macro does not declare
  std::map<std::string, std::string> mapped_;              // post field -> macro variable
  std::set<std::string> told_;                             // post fields of which a finding was reported
};

} // namespace dotek::project
