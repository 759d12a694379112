#include "frontend/compost/ProgTables.h"
#include "support/messages/ComPost.h"

namespace dotek::frontend::compost {

ProgTables::ProgTables(const Program& program, const stdlib::Form& form) : form_(form) {
  std::map<std::uint32_t, const PictureDefinition*> defined;
  for (const Item& item : program.items) {
    if (const auto* one = std::get_if<Routine>(&item)) routines_.emplace(one->name, one);
    if (const auto* one = std::get_if<PictureDefinition>(&item)) defined.emplace(one->number, one);
  }
  for (const auto& [keyword, entry] : form.numerics) {
    auto parsed = Picture::parse(entry.picture);
    if (auto* one = std::get_if<Picture>(&parsed)) pictures_.insert_or_assign(keyword, std::move(*one));
  }
  for (const Item& item : program.items) {
    const auto* format = std::get_if<FormatDirective>(&item);
    if (format == nullptr) continue;
    if (format->kind == WordKind::Command) commandFormats_.emplace(format->name, format->nameRange);
    if (format->kind != WordKind::Numeric) continue; // another keyword than the number's
    const auto found = defined.find(format->number);
    if (found == defined.end()) continue; // reported by check
    auto parsed = Picture::parse(found->second->picture.text);
    if (auto* one = std::get_if<Picture>(&parsed)) pictures_.insert_or_assign(format->name, std::move(*one));
  }
}

const Routine* ProgTables::routine(std::string_view name) const {
  const auto found = routines_.find(name);
  return found == routines_.end() ? nullptr : found->second;
}

const SourceRange* ProgTables::commandFormat(std::string_view name) const {
  const auto found = commandFormats_.find(name);
  return found == commandFormats_.end() ? nullptr : &found->second;
}

void ProgTables::noteAssumed(const std::string& keyword, const stdlib::FormEntry& entry, SourceRange where,
                             Diagnostics& diagnostics) {
  if (entry.observed || !assumed_.insert(keyword).second) return;
  std::string what = "that `" + keyword + "` prints";
  if (!entry.text.empty()) what += " `" + entry.text + "`";
  if (!entry.value.empty())
    what += (entry.text.empty() ? " " : " and ") + entry.value + " with the picture `" + entry.picture + "`";
  diagnostics.report<diag::FormAssumed>(where, keyword, form_.name, what, form_.origin);
}

const Picture* ProgTables::picture(const std::string& keyword, SourceRange where, Diagnostics& diagnostics) {
  const auto found = pictures_.find(keyword);
  if (found == pictures_.end()) {
    if (told_.insert(keyword).second)
      diagnostics.report<diag::NoPicture>(where, keyword, form_.name, form_.origin);
    return nullptr;
  }
  if (!found->second.prefix().empty()) {
    if (told_.insert(keyword).second)
      diagnostics.report<diag::PicturePrefixUnverified>(where, found->second.text(), found->second.prefix());
    return nullptr;
  }
  return &found->second;
}

} // namespace dotek::frontend::compost
