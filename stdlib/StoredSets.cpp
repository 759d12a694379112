// Macro sets and controls as stored tables. Every member of a type is named by a structured binding: one that
// is added to the type and not here breaks the build.
#include "stdlib/MovedSet.h"
#include "stdlib/StoredArchive.h"
#include "stdlib/StoredTables.h"

#include <algorithm>

namespace dotek::stdlib {

template <class Archive> void fields(Archive& archive, MacroArgument& it) {
  auto& [letter, role, axis, frame, kind, selector, point, required, positive, systemCode, systemRule,
         extendedFirst, extendedLast, extendedStep, unknown] = it;
  archive(letter, role, axis, frame, kind, selector, point, required, positive, systemCode, systemRule,
          extendedFirst, extendedLast, extendedStep, unknown);
}
template <class Archive> void fields(Archive& archive, MacroResult& it) {
  auto& [output, name, variable, documented, taken] = it;
  archive(output, name, variable, documented, taken);
}
template <class Archive> void fields(Archive& archive, MacroSignature& it) {
  auto& [program, title, intent, arguments, anyOf, results, unknown, grade, source] = it;
  archive(program, title, intent, arguments, anyOf, results, unknown, grade, source);
}
template <class Archive> void fields(Archive& archive, RefusedLetters& it) {
  auto& [programs, letters, text] = it;
  archive(programs, letters, text);
}
template <class Archive> void fields(Archive& archive, MacroAlarmInfo& it) {
  auto& [alarm, number, text] = it;
  archive(alarm, number, text);
}
template <class Archive> void fields(Archive& archive, ProbingFacts& it) {
  auto& [overtravel, overtravelZ, clearance, feedVariable, radiusX, radiusY, offsetX, offsetY, vectorFirst,
         vectorLast, lengthToTip, toolLength] = it;
  archive(overtravel, overtravelZ, clearance, feedVariable, radiusX, radiusY, offsetX, offsetY, vectorFirst,
          vectorLast, lengthToTip, toolLength);
}
template <class Archive> void fields(Archive& archive, MacroSet& it) {
  auto& [name, title, origin, signatures, scratch, overwritten, refused, alarms, probing, needs, callerValues,
         needsSkipPosition] = it;
  archive(name, title, origin, signatures, scratch, overwritten, refused, alarms, probing, needs,
          callerValues, needsSkipPosition);
}

template <class Archive> void fields(Archive& archive, AlarmInfo& it) {
  auto& [alarm, number, text, grade, source] = it;
  archive(alarm, number, text, grade, source);
}
template <class Archive> void fields(Archive& archive, CodeInfo& it) {
  auto& [letter, tenths, function, group, title, grade, source] = it;
  archive(letter, tenths, function, group, title, grade, source);
}
template <class Archive> void fields(Archive& archive, SystemVariables& it) {
  auto& [modalFirst, modalFeed, blockEnd, machine, position, skip, externalX, workOffsetX, extendedX,
         extendedStep, extendedCount, toolWear, toolGeometry, toolWearToo, toolGeometryToo, toolCount,
         modalWords, toolLength, alarm, timer, hours, message, extendedNumber, systemStep, axisStep] = it;
  archive(modalFirst, modalFeed, blockEnd, machine, position, skip, externalX, workOffsetX, extendedX,
          extendedStep, extendedCount, toolWear, toolGeometry, toolWearToo, toolGeometryToo, toolCount,
          modalWords, toolLength, alarm, timer, hours, message, extendedNumber, systemStep, axisStep);
}
template <class Archive> void fields(Archive& archive, LengthInPositions& it) {
  auto& [position, skip, grade, source] = it;
  archive(position, skip, grade, source);
}
template <class Archive> void fields(Archive& archive, VariableRange& it) {
  auto& [first, last, kept] = it;
  archive(first, last, kept);
}
template <class Archive> void fields(Archive& archive, CallCode& it) {
  auto& [letter, first, count, program, macro, holds, grade, source] = it;
  archive(letter, first, count, program, macro, holds, grade, source);
}
template <class Archive> void fields(Archive& archive, StateRange& it) {
  auto& [first, last, word, access, null, initial, title, grade, source] = it;
  archive(first, last, word, access, null, initial, title, grade, source);
}
template <class Archive> void fields(Archive& archive, RotationFacts& it) {
  auto& [positions, otherAxis] = it;
  archive(positions, otherAxis);
}
template <class Archive> void fields(Archive& archive, PmcWindow& it) {
  auto& [area, bytes, address, byte, word, doubleWord] = it;
  archive(area, bytes, address, byte, word, doubleWord);
}
template <class Archive> void fields(Archive& archive, TurningFacts& it) {
  auto& [increments, diameters, axes, startCodes, offsetDigits, grade, source] = it;
  archive(increments, diameters, axes, startCodes, offsetDigits, grade, source);
}
template <class Archive> void fields(Archive& archive, MacroPackage& it) {
  auto& [set, title, shift, calibrationFirst, calibrationLast, radiusX, radiusY, extendedFirst, extendedLast,
         extendedStep] = it;
  archive(set, title, shift, calibrationFirst, calibrationLast, radiusX, radiusY, extendedFirst, extendedLast,
          extendedStep);
}
template <class Archive> void fields(Archive& archive, Control& it) {
  auto& [name, title, origin, decimal, decimalGrade, arithmetic, lengths, increment, decimals, integerDigits,
         digits, ifThen, joinedConditions, thenGoto, bareFunctions, bracketDepth, locals, macroLevels, common,
         readOnly, toolOffsets, functions, alarmFirst, alarmLast, alarmShown, alarmLength, programLast,
         colonNames, programNames, sequenceLast, variables, withToolLength, arcTolerance, repeatLetter,
         dwellLetter, rotation, callDepth, repeatInProgram, callCodes, readAheadStops, state, window, package,
         printPadding, alarms, codes, turning] = it;
  archive(name, title, origin, decimal, decimalGrade, arithmetic, lengths, increment, decimals, integerDigits,
          digits, ifThen, joinedConditions, thenGoto, bareFunctions, bracketDepth, locals, macroLevels,
          common, readOnly, toolOffsets, functions, alarmFirst, alarmLast, alarmShown, alarmLength,
          programLast, colonNames, programNames, sequenceLast, variables, withToolLength, arcTolerance,
          repeatLetter, dwellLetter, rotation, callDepth, repeatInProgram, callCodes, readAheadStops, state,
          window, package, printPadding, alarms, codes, turning);
}

namespace {

template <class Table> std::string stored(Table& table) {
  StoredWriter writer;
  writer(table);
  return std::move(writer.out);
}

template <class Table> Table restored(std::string_view text) {
  Table table;
  StoredReader reader(text);
  reader(table);
  reader.end();
  return table;
}

const StoredTable* tableOf(std::span<const StoredTable> tables, std::string_view name) {
  const auto at = std::find_if(tables.begin(), tables.end(),
                               [&](const StoredTable& table) { return table.name == name; });
  return at == tables.end() ? nullptr : &*at;
}

} // namespace

std::string TableStore::store(MacroSet& set) {
  return stored(set);
}
std::string TableStore::store(Control& control) {
  return stored(control);
}
MacroSet TableStore::restoreMacroSet(std::string_view text) {
  return restored<MacroSet>(text);
}
Control TableStore::restoreControl(std::string_view text) {
  return restored<Control>(text);
}

std::optional<MacroSet> MacroSet::load(const DataFiles& files, std::string_view name) {
  const std::optional<MovedName> moved = movedName(name);
  if (!moved) return std::nullopt;
  if (moved->first) {
    // Only a text can be written with other variables.
    if (files.find("macrob", moved->set) == nullptr) return std::nullopt;
    std::optional<MacroSet> set = load(files, moved->set);
    if (!set || !keptVariables(*set)) return std::nullopt;
    return movedTo(std::move(*set), *moved->first);
  }
  const DataFile* file = files.find("macros", name);
  if (file == nullptr) return std::nullopt;
  const StoredTable* table = file->builtIn() ? tableOf(embeddedTables().macros, name) : nullptr;
  return table == nullptr ? TableStore::readMacroSet(*file) : TableStore::restoreMacroSet(table->text);
}

std::optional<Control> Control::load(const DataFiles& files, std::string_view name) {
  const DataFile* file = files.find("controls", name);
  if (file == nullptr) return std::nullopt;
  const std::vector<const DataFile*> all = files.list("controls");
  // A file of one's own may replace what a built-in control extends.
  const bool own = std::any_of(all.begin(), all.end(), [](const DataFile* each) { return !each->builtIn(); });
  const StoredTable* table = own ? nullptr : tableOf(embeddedTables().controls, name);
  return table == nullptr ? TableStore::readControl(files, *file) : TableStore::restoreControl(table->text);
}

} // namespace dotek::stdlib
