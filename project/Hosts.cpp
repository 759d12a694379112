#include "project/Hosts.h"

#include "stdlib/HostInputs.h"
#include "support/Decimal.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"

namespace dotek::project {

std::string nearestHost(const std::string& name) {
  return nearestName(name, stdlib::hostInputNames());
}

std::map<std::string, double> parseHosts(const NamedTexts& given, Diagnostics& diagnostics) {
  std::map<std::string, double> out;
  for (const auto& [name, text] : given) {
    if (!stdlib::isHostInput(name)) {
      const std::string near = nearestHost(name);
      diagnostics.report<diag::UnknownHost>({}, name, near.empty() ? "" : "; did you mean `" + near + "`?");
      continue;
    }
    const std::optional<double> value = parseNumber(text);
    if (!value)
      diagnostics.report<diag::NotANumber>({}, "--host", name, text);
    else if (const std::string_view wanted = stdlib::hostInputRefuses(name, *value); !wanted.empty())
      diagnostics.report<diag::HostInputRange>({}, name, text, wanted);
    else if (!out.emplace(name, *value).second)
      diagnostics.report<diag::GivenTwice>({}, "--host", name);
  }
  return out;
}

} // namespace dotek::project
